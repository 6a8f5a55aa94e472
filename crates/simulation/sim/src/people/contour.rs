//! Outlines of free cells as walls.

use periplus_crowds::{DVec2, Wall};
use periplus_grid::Grid;

/// Largest deviation of a wall from the borders of the cells, as a part of a cell: slanted walls are straight.
const MAX_DEVIATION_RATIO: f64 = 0.8;

/// Returns walls around all free cells.
pub(crate) fn walls_around(free: &Grid<bool>) -> Vec<Wall> {
    let mut walls = Vec::new();
    for outline in outlines(free) {
        let points = simplified(&outline);
        let position = |number: usize| {
            let (x_m, y_m) = free.info.point_at(points[number].x, points[number].y);
            DVec2::new(x_m, y_m)
        };
        walls.extend((0..points.len()).map(|number| Wall {
            start: position(number),
            end: position((number + 1) % points.len()),
        }));
    }
    walls
}

/// Corners of the closed borders between free and other cells, in columns and rows, with the free cells at the left.
fn outlines(free: &Grid<bool>) -> Vec<Vec<DVec2>> {
    let (columns, rows) = (free.info.width + 1, free.info.height + 1);
    let is_free = |column: isize, row: isize| {
        let cell = usize::try_from(column).ok().zip(usize::try_from(row).ok());
        cell.and_then(|cell| free.get(cell)).copied().unwrap_or(false)
    };
    // Borders that leave each corner, a bit for each direction.
    let mut leaving = vec![0_u8; columns * rows];
    for row in 0..free.info.height {
        for column in 0..free.info.width {
            if !free[(column, row)] {
                continue;
            }
            let (x, y) = (column as isize, row as isize);
            let sides = [
                (is_free(x, y - 1), column, row),
                (is_free(x + 1, y), column + 1, row),
                (is_free(x, y + 1), column + 1, row + 1),
                (is_free(x - 1, y), column, row + 1),
            ];
            for (direction, (is_open, column, row)) in sides.into_iter().enumerate() {
                if !is_open {
                    leaving[row * columns + column] |= 1 << direction;
                }
            }
        }
    }
    let mut found = Vec::new();
    for start in 0..leaving.len() {
        while leaving[start] != 0 {
            found.push(outline(&mut leaving, columns, start));
        }
    }
    found
}

/// Follows a border from a corner until it closes, and removes it.
fn outline(leaving: &mut [u8], columns: usize, start: usize) -> Vec<DVec2> {
    let mut corners = Vec::new();
    let (mut at, mut last) = (start, None);
    loop {
        // At a corner of two free cells the border stays at the cell from which it comes.
        let order =
            last.map_or([0, 1, 2, 3], |last: usize| [1, 0, 3, 2].map(|turn| (last + turn) % 4));
        let Some(direction) = order.into_iter().find(|it| leaving[at] & (1 << it) != 0) else {
            return corners;
        };
        leaving[at] &= !(1 << direction);
        if last != Some(direction) {
            corners.push(DVec2::new((at % columns) as f64, (at / columns) as f64));
        }
        at = match direction {
            0 => at + 1,
            1 => at + columns,
            2 => at - 1,
            _ => at - columns,
        };
        last = Some(direction);
    }
}

/// Leaves out corners of a closed line that deviate little (Ramer 1972, Douglas and Peucker 1973).
fn simplified(corners: &[DVec2]) -> Vec<DVec2> {
    let Some(first) = corners.first() else { return Vec::new() };
    let far = |one: &usize, two: &usize| {
        let [one, two] = [one, two].map(|it| corners[*it].distance_squared(*first));
        one.total_cmp(&two)
    };
    let middle = (0..corners.len()).max_by(far).unwrap_or(0);
    let mut kept = vec![false; corners.len() + 1];
    (kept[0], kept[middle]) = (true, true);
    let mut open = vec![(0, middle), (middle, corners.len())];
    while let Some((from, to)) = open.pop() {
        let line = Wall { start: corners[from], end: corners[to % corners.len()] };
        let deviation =
            |number: usize| line.nearest_point(corners[number]).distance(corners[number]);
        let worst = (from + 1..to).max_by(|one, two| deviation(*one).total_cmp(&deviation(*two)));
        if let Some(worst) = worst.filter(|worst| deviation(*worst) > MAX_DEVIATION_RATIO) {
            kept[worst] = true;
            open.extend([(from, worst), (worst, to)]);
        }
    }
    corners.iter().zip(kept).filter(|(_, is_kept)| *is_kept).map(|(corner, _)| *corner).collect()
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use periplus_grid::GridInfo;

    use super::*;

    /// Free cells are `.`, the first line is the highest row; cells have 1 m.
    fn grid(lines: &[&str]) -> Grid<bool> {
        let info = GridInfo::new(1.0, lines[0].len(), lines.len(), Pose2::IDENTITY).unwrap();
        let cells = lines.iter().rev().flat_map(|line| line.chars().map(|it| it == '.')).collect();
        Grid { info, cells }
    }

    /// Number of outlines and the corners of all.
    fn check(lines: &[&str], expected: &[&[[f64; 2]]]) {
        let found: Vec<Vec<[f64; 2]>> = outlines(&grid(lines))
            .iter()
            .map(|outline| outline.iter().map(DVec2::to_array).collect())
            .collect();
        let expected: Vec<Vec<[f64; 2]>> = expected.iter().map(|it| it.to_vec()).collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn the_free_cells_are_at_the_left() {
        check(&["###", "#.#", "###"], &[&[[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]]]);
        // A pillar in a room has its own outline, in the other direction.
        check(
            &["...", ".#.", "..."],
            &[
                &[[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]],
                &[[1.0, 1.0], [1.0, 2.0], [2.0, 2.0], [2.0, 1.0]],
            ],
        );
    }

    #[test]
    fn cells_that_meet_in_a_corner_are_apart() {
        check(
            &["#.", ".#"],
            &[
                &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
                &[[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]],
            ],
        );
    }

    #[test]
    fn the_border_of_a_slanted_wall_is_straight() {
        let lines: Vec<String> =
            (0..20).map(|row| ".".repeat(row + 1) + &"#".repeat(20 - row)).collect();
        let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
        let walls = walls_around(&grid(&lines));
        assert!((3..=4).contains(&walls.len()), "{walls:?}");
        let length_m: f64 = walls.iter().map(|wall| wall.start.distance(wall.end)).sum();
        assert!((length_m - (40.0 + 20.0 * std::f64::consts::SQRT_2)).abs() < 2.0, "{length_m}");
    }
}
