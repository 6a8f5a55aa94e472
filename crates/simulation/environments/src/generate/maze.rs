//! Mazes: a random depth-first tree over square cells; with little clutter some walls of dead ends are removed.

use periplus_geometry::Stream;

use super::plan::{FloorPlan, WallAxis, WallLine};
use super::{WorldGeneratorParams, below, count_of, real};

/// Width of a corridor beyond that of a door \[m\].
const CORRIDOR_MARGIN_M: f64 = 0.5;

/// Walls to the right of and above each cell.
struct Maze {
    columns: usize,
    rows: usize,
    has_right: Vec<bool>,
    has_upper: Vec<bool>,
}

pub(super) fn build(params: &WorldGeneratorParams, stream: &mut Stream, plan: &mut FloorPlan) {
    let cell_m = params.door_width_m + CORRIDOR_MARGIN_M + params.wall_thickness_m;
    let [columns, rows] = [params.size_x_m, params.size_y_m].map(|side| count_of(side, cell_m));
    let mut maze = Maze {
        columns,
        rows,
        has_right: vec![true; columns * rows],
        has_upper: vec![true; columns * rows],
    };
    dig(&mut maze, stream);
    open_dead_ends(&mut maze, 1.0 - params.clutter, stream);
    plan.add_outer_walls(params);
    let half = [params.size_x_m / 2.0, params.size_y_m / 2.0];
    let x_of = |column: usize| params.size_x_m * real(column) / real(columns) - half[0];
    let y_of = |row: usize| params.size_y_m * real(row) / real(rows) - half[1];
    // Neighbouring walls of one line are one box.
    for column in 0..columns - 1 {
        for [from, to] in runs(rows, |row| maze.has_right[row * columns + column]) {
            let line = WallLine {
                axis: WallAxis::Y,
                at: x_of(column + 1),
                from: y_of(from),
                to: y_of(to),
            };
            plan.add_wall(line, params);
        }
    }
    for row in 0..rows - 1 {
        for [from, to] in runs(columns, |column| maze.has_upper[row * columns + column]) {
            let line =
                WallLine { axis: WallAxis::X, at: y_of(row + 1), from: x_of(from), to: x_of(to) };
            plan.add_wall(line, params);
        }
    }
}

impl Maze {
    /// The neighbours of a cell, each with the wall between them.
    fn neighbours(&self, cell: usize) -> impl Iterator<Item = (usize, Wall)> + use<> {
        let (column, row) = (cell % self.columns, cell / self.columns);
        let (columns, rows) = (self.columns, self.rows);
        [
            (column + 1 < columns).then(|| (cell + 1, Wall::Right(cell))),
            (column > 0).then(|| (cell - 1, Wall::Right(cell - 1))),
            (row + 1 < rows).then(|| (cell + columns, Wall::Upper(cell))),
            (row > 0).then(|| (cell - columns, Wall::Upper(cell - columns))),
        ]
        .into_iter()
        .flatten()
    }

    fn wall(&mut self, wall: Wall) -> &mut bool {
        match wall {
            Wall::Right(cell) => &mut self.has_right[cell],
            Wall::Upper(cell) => &mut self.has_upper[cell],
        }
    }
}

/// Wall to the right of a cell or above it.
#[derive(Clone, Copy)]
enum Wall {
    Right(usize),
    Upper(usize),
}

/// Removes walls until all cells are connected, by one path each.
fn dig(maze: &mut Maze, stream: &mut Stream) {
    let mut is_seen = vec![false; maze.columns * maze.rows];
    let first = below(stream, is_seen.len());
    is_seen[first] = true;
    let mut path = vec![first];
    while let Some(&cell) = path.last() {
        let fresh: Vec<(usize, Wall)> =
            maze.neighbours(cell).filter(|(next, _)| !is_seen[*next]).collect();
        if fresh.is_empty() {
            path.pop();
            continue;
        }
        let (next, wall) = fresh[below(stream, fresh.len())];
        *maze.wall(wall) = false;
        is_seen[next] = true;
        path.push(next);
    }
}

/// Opens a fraction of the dead ends, which makes loops.
fn open_dead_ends(maze: &mut Maze, fraction: f64, stream: &mut Stream) {
    for cell in 0..maze.columns * maze.rows {
        let walls: Vec<Wall> = maze.neighbours(cell).map(|(_, wall)| wall).collect();
        let closed: Vec<Wall> = walls.iter().copied().filter(|wall| *maze.wall(*wall)).collect();
        if walls.len() - closed.len() == 1 && !closed.is_empty() && stream.unit() < fraction {
            *maze.wall(closed[below(stream, closed.len())]) = false;
        }
    }
}

/// Ranges of consecutive numbers below `count` for which `is_wall` is true: start, and end after the last.
fn runs(count: usize, is_wall: impl Fn(usize) -> bool) -> Vec<[usize; 2]> {
    let mut runs: Vec<[usize; 2]> = Vec::new();
    for at in (0..count).filter(|at| is_wall(*at)) {
        match runs.last_mut() {
            Some([_, end]) if *end == at => *end = at + 1,
            _ => runs.push([at, at + 1]),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_maze_is_a_tree() {
        for seed in 0..20 {
            let mut maze =
                Maze { columns: 7, rows: 5, has_right: vec![true; 35], has_upper: vec![true; 35] };
            dig(&mut maze, &mut Stream::keyed(seed, "maze", 0));
            let open = maze.has_right.iter().chain(&maze.has_upper).filter(|it| !**it).count();
            assert_eq!(open, 34, "one passage less than cells");
        }
    }

    #[test]
    fn walls_of_a_line_are_joined() {
        let is_wall = [true, true, false, true];
        assert_eq!(runs(4, |at| is_wall[at]), [[0, 2], [3, 4]]);
        assert_eq!(runs(4, |_| false), Vec::<[usize; 2]>::new());
    }
}
