//! Shortest paths of a disc on a map.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use periplus_grid::{Cell, GridInfo, Line, OccupancyGrid, occupancy, squared_distances};

/// Returns the length of the shortest path of a disc between two points \[m\]; none without a path over free cells.
///
/// Theta* (Nash et al. 2007, "Theta*: Any-Angle Path Planning on Grids"): paths turn at cells only, and are a little longer
/// than the true shortest ones. A cell is passable if it is free and no wall is nearer than the radius, less half the
/// diagonal of a cell, by which the position of a wall is uncertain.
#[must_use]
pub fn shortest_path_m(
    map: &OccupancyGrid,
    radius_m: f64,
    from_m: [f64; 2],
    to_m: [f64; 2],
) -> Option<f64> {
    let info = map.info;
    let (start, goal) = (cell(&info, from_m)?, cell(&info, to_m)?);
    let open = passable(map, radius_m);
    if !open[start] || !open[goal] {
        return None;
    }
    let point = |index: usize| match index {
        // Start and goal are points, not centres of cells.
        _ if index == start => from_m,
        _ if index == goal => to_m,
        _ => {
            let (x_m, y_m) = info.centre_of(info.cell(index));
            [x_m, y_m]
        }
    };
    let distance_m = |a: usize, b: usize| {
        let ([ax, ay], [bx, by]) = (point(a), point(b));
        libm::hypot(ax - bx, ay - by)
    };
    let is_visible = |a: usize, b: usize| {
        Line::between(info.cell(a), info.cell(b))
            .all(|at| info.contains(at) && open[info.index(at)])
    };
    let mut length_m = vec![f64::INFINITY; open.len()];
    let mut parent = vec![usize::MAX; open.len()];
    let mut is_closed = vec![false; open.len()];
    let mut queue = BinaryHeap::new();
    (length_m[start], parent[start]) = (0.0, start);
    queue.push(Entry { estimate_m: distance_m(start, goal), index: start });
    while let Some(Entry { index, .. }) = queue.pop() {
        if index == goal {
            return Some(length_m[goal]);
        }
        if std::mem::replace(&mut is_closed[index], true) {
            continue;
        }
        for next in neighbours(&info, index).filter(|next| open[*next] && !is_closed[*next]) {
            // The straight line from the parent is never longer than the path over this cell.
            let before = parent[index];
            let via = if is_visible(before, next) { before } else { index };
            let new_m = length_m[via] + distance_m(via, next);
            if new_m < length_m[next] {
                (length_m[next], parent[next]) = (new_m, via);
                queue.push(Entry { estimate_m: new_m + distance_m(next, goal), index: next });
            }
        }
    }
    None
}

fn cell(info: &GridInfo, [x_m, y_m]: [f64; 2]) -> Option<usize> {
    info.cell_of(x_m, y_m).map(|cell| info.index(cell))
}

fn passable(map: &OccupancyGrid, radius_m: f64) -> Vec<bool> {
    let resolution_m = map.info.resolution_m;
    let margin_cells = radius_m / resolution_m - std::f64::consts::FRAC_1_SQRT_2;
    let near = squared_distances(map, |value| *value > occupancy::FREE);
    let limit = margin_cells.max(0.0) * margin_cells.max(0.0);
    let all = (0..map.info.len()).map(|index| map.info.cell(index));
    all.map(|at| {
        let is_free = map.get(at) == Some(&occupancy::FREE);
        is_free && near.get(at).is_some_and(|squared| f64::from(*squared) >= limit)
    })
    .collect()
}

/// The eight neighbours of a cell inside the grid.
fn neighbours(info: &GridInfo, index: usize) -> impl Iterator<Item = usize> {
    let ((column, row), info) = (info.cell(index), *info);
    let offsets: [(isize, isize); 8] =
        [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)];
    offsets
        .into_iter()
        // One below 0 is outside of every grid.
        .map(move |(columns, rows)| -> Cell {
            (column.wrapping_add_signed(columns), row.wrapping_add_signed(rows))
        })
        .filter(move |cell| info.contains(*cell))
        .map(move |cell| info.index(cell))
}

/// Cell in the queue; the smallest estimate is the largest entry, and equal ones have an order.
#[derive(PartialEq)]
struct Entry {
    estimate_m: f64,
    index: usize,
}

impl Eq for Entry {}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_estimate = other.estimate_m.total_cmp(&self.estimate_m);
        by_estimate.then(other.index.cmp(&self.index))
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;

    use super::*;

    /// A room of 4 m by 4 m with cells of 0.05 m, and a wall along x = 2 up to y = `wall_m`.
    fn room(wall_m: f64) -> OccupancyGrid {
        let info = GridInfo::new(0.05, 80, 80, Pose2::IDENTITY).unwrap();
        let cells = (0..info.len()).map(|index| {
            let (x_m, y_m) = info.centre_of(info.cell(index));
            let is_wall = (x_m - 2.0).abs() < 0.05 && y_m < wall_m;
            if is_wall { occupancy::OCCUPIED } else { occupancy::FREE }
        });
        OccupancyGrid::from_cells(info, cells.collect()).unwrap()
    }

    fn check(wall_m: f64, radius_m: f64, expected_m: Option<f64>) {
        let found = shortest_path_m(&room(wall_m), radius_m, [1.0, 1.0], [3.0, 1.0]);
        match (found, expected_m) {
            (Some(found), Some(expected)) => {
                assert!(found >= expected - 0.1 && found < expected * 1.03, "{found} {expected}");
            }
            (found, expected) => assert_eq!(found, expected),
        }
    }

    #[test]
    fn an_empty_room_is_crossed_in_a_straight_line() {
        assert_eq!(shortest_path_m(&room(0.0), 0.2, [1.0, 1.0], [3.0, 1.0]), Some(2.0));
        let diagonal = shortest_path_m(&room(0.0), 0.2, [0.5, 0.5], [3.5, 1.3]).unwrap();
        assert!((diagonal - libm::hypot(3.0, 0.8)).abs() < 1e-9, "{diagonal}");
    }

    #[test]
    fn a_wall_is_passed_at_its_end() {
        // From (1, 1) to the corner (1.95, 2) of the wall, 0.1 m over it, and the same again.
        check(2.0, 0.0, Some(2.0 * libm::hypot(0.95, 1.0) + 0.1));
        // The centre of a disc follows tangents of 1.346 m, and arcs of 59 degrees around both corners.
        check(2.0, 0.3, Some(2.0 * 1.346 + 2.0 * 0.3 * 59_f64.to_radians() + 0.1));
        check(4.0, 0.0, None);
        // The gap of 0.5 m is too narrow for a disc of 1.2 m: its centre does not fit.
        check(3.5, 0.6, None);
    }

    #[test]
    fn a_point_outside_or_in_a_wall_has_no_path() {
        let room = room(2.0);
        assert_eq!(shortest_path_m(&room, 0.1, [9.0, 1.0], [3.0, 1.0]), None);
        assert_eq!(shortest_path_m(&room, 0.1, [2.0, 1.0], [3.0, 1.0]), None);
    }
}
