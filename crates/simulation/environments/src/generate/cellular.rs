//! Cellular automata on grids of walls.

use periplus_geometry::Stream;

/// Grid of cells that are walls or free, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct WallCells {
    pub(super) columns: usize,
    pub(super) rows: usize,
    pub(super) is_wall: Vec<bool>,
}

/// Rule of an automaton: numbers of walls among the eight neighbours of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct AutomatonRule {
    /// Number from which a cell becomes a wall.
    pub(super) min_fill: usize,
    /// Number up to which a cell becomes free.
    pub(super) max_clear: usize,
    /// True if everything outside of the grid is a wall.
    pub(super) is_outside_wall: bool,
}

impl WallCells {
    /// Makes each cell a wall with a probability.
    pub(super) fn random(columns: usize, rows: usize, fill: f64, stream: &mut Stream) -> Self {
        let is_wall = (0..columns * rows).map(|_| stream.unit() < fill).collect();
        Self { columns, rows, is_wall }
    }

    /// Applies a rule to all cells at once.
    pub(super) fn stepped(&self, rule: AutomatonRule) -> Self {
        let cell = |index: usize| {
            let count = self.wall_neighbours(index, rule.is_outside_wall);
            if count >= rule.min_fill {
                true
            } else if count <= rule.max_clear {
                false
            } else {
                self.is_wall[index]
            }
        };
        Self { is_wall: (0..self.is_wall.len()).map(cell).collect(), ..*self }
    }

    fn wall_neighbours(&self, index: usize, is_outside_wall: bool) -> usize {
        let (column, row) = (index % self.columns, index / self.columns);
        let offsets = (-1..=1).flat_map(|y: isize| (-1..=1).map(move |x: isize| (x, y)));
        let is_wall = |(x, y): (isize, isize)| {
            let (Some(column), Some(row)) =
                (column.checked_add_signed(x), row.checked_add_signed(y))
            else {
                return is_outside_wall;
            };
            if column >= self.columns || row >= self.rows {
                return is_outside_wall;
            }
            self.is_wall[row * self.columns + column]
        };
        offsets.filter(|it| *it != (0, 0)).filter(|it| is_wall(*it)).count()
    }

    /// Returns the number of cells of the largest free area that is connected over sides.
    pub(super) fn largest_free_area(&self) -> usize {
        let mut is_seen = self.is_wall.clone();
        let mut largest = 0;
        for first in 0..is_seen.len() {
            let mut open = if is_seen[first] { Vec::new() } else { vec![first] };
            is_seen[first] = true;
            let mut count = 0;
            while let Some(cell) = open.pop() {
                count += 1;
                let (column, row) = (cell % self.columns, cell / self.columns);
                let next = [
                    (column > 0).then(|| cell - 1),
                    (column + 1 < self.columns).then(|| cell + 1),
                    (row > 0).then(|| cell - self.columns),
                    (row + 1 < self.rows).then(|| cell + self.columns),
                ];
                for next in next.into_iter().flatten() {
                    if !std::mem::replace(&mut is_seen[next], true) {
                        open.push(next);
                    }
                }
            }
            largest = largest.max(count);
        }
        largest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(rows: [&str; 4]) -> WallCells {
        let is_wall = rows.iter().flat_map(|row| row.chars().map(|it| it == '#')).collect();
        WallCells { columns: 5, rows: 4, is_wall }
    }

    #[test]
    fn single_cells_vanish_and_holes_close() {
        let before = cells(["###..", "#.#..", "###..", "....#"]);
        let rule = AutomatonRule { min_fill: 5, max_clear: 1, is_outside_wall: false };
        let after = before.stepped(rule);
        assert_eq!(after, cells(["###..", "###..", "###..", "....."]));
    }

    #[test]
    fn areas_are_connected_over_sides() {
        assert_eq!(cells([".#...", "#....", ".....", "....."]).largest_free_area(), 17);
        assert_eq!(cells(["#####", "#####", "#####", "#####"]).largest_free_area(), 0);
    }
}
