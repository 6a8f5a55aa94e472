//! Cells of a map with room for a robot.

use std::collections::{BTreeMap, VecDeque};

use periplus_geometry::Pose2;
use periplus_grid::{Cell, OccupancyGrid, occupancy, squared_distances};

/// Room around a robot beside its radius \[m\].
const MARGIN_M: f64 = 0.1;

/// Farthest cell from the start at which the search begins \[m\].
const MAX_START_DISTANCE_M: f64 = 1.0;

/// Cells of a map where a robot has room in every heading.
pub struct FreeFloor<'a> {
    map: &'a OccupancyGrid,
    has_room: Vec<bool>,
}

impl<'a> FreeFloor<'a> {
    /// Finds the cells for a robot of a radius.
    #[must_use]
    pub fn new(map: &'a OccupancyGrid, radius_m: f64) -> Self {
        let room = (radius_m + MARGIN_M) / map.info.resolution_m;
        let distances = squared_distances(map, |value| *value != occupancy::FREE);
        let has_room = distances.cells.iter().map(|distance| f64::from(*distance) >= room * room);
        Self { map, has_room: has_room.collect() }
    }

    /// Returns the cell from which a robot at a pose starts: the nearest with room.
    #[must_use]
    pub fn start_cell(&self, start: Pose2) -> Option<Cell> {
        nearest(self.map, start, &|index| self.has_room[index])
    }

    /// Returns the cells that a robot can reach from a cell, in the order of the length of the path there: over a path
    /// with room.
    #[must_use]
    pub fn reachable_from(&self, first: Cell) -> Vec<Cell> {
        let info = &self.map.info;
        let mut seen = vec![false; info.len()];
        seen[info.index(first)] = true;
        let (mut queue, mut found) = (VecDeque::from([first]), Vec::new());
        while let Some(cell) = queue.pop_front() {
            found.push(cell);
            for (dx, dy) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
                let next = cell.0.checked_add_signed(dx).zip(cell.1.checked_add_signed(dy));
                let Some(next) = next.filter(|next| info.contains(*next)) else { continue };
                let index = info.index(next);
                if !seen[index] && self.has_room[index] {
                    seen[index] = true;
                    queue.push_back(next);
                }
            }
        }
        found
    }
}

/// Returns the cells that a robot of a radius can reach from its start, in the order of the length of the path there:
/// where it has room in every heading, over a path with that room. Empty if there are none.
#[must_use]
pub fn reachable_cells(map: &OccupancyGrid, start: Pose2, radius_m: f64) -> Vec<Cell> {
    let floor = FreeFloor::new(map, radius_m);
    floor.start_cell(start).map(|first| floor.reachable_from(first)).unwrap_or_default()
}

/// Cell with room that is nearest to a pose.
fn nearest(map: &OccupancyGrid, start: Pose2, has_room: &dyn Fn(usize) -> bool) -> Option<Cell> {
    let info = &map.info;
    let reach = (MAX_START_DISTANCE_M / info.resolution_m) as i64 + 2;
    let (column, row) = info.whole_cells_to(start.x_m, start.y_m);
    let within = |middle: i64, size: usize| {
        let end = middle.saturating_add(reach + 1).clamp(0, size as i64);
        // Both are from 0 to the size.
        (middle.saturating_sub(reach).clamp(0, end) as usize)..(end as usize)
    };
    let columns = within(column, info.width);
    let cells =
        within(row, info.height).flat_map(|row| columns.clone().map(move |column| (column, row)));
    let squared_m2 = |cell: Cell| {
        let (x_m, y_m) = info.centre_of(cell);
        let (dx_m, dy_m) = (x_m - start.x_m, y_m - start.y_m);
        dx_m * dx_m + dy_m * dy_m
    };
    let near = cells.filter(|cell| {
        has_room(info.index(*cell))
            && squared_m2(*cell) <= MAX_START_DISTANCE_M * MAX_START_DISTANCE_M
    });
    near.min_by(|one, two| squared_m2(*one).total_cmp(&squared_m2(*two)))
}

/// Returns poses for robots of a radius, `spacing_m` apart \[m\], the nearest to the start first, all with its heading. They
/// are fewer than `count` where the floor has no more room.
#[must_use]
pub fn spread_poses(
    map: &OccupancyGrid,
    start: Pose2,
    radius_m: f64,
    spacing_m: f64,
    count: usize,
) -> Vec<Pose2> {
    let mut poses: Vec<Pose2> = Vec::new();
    // Poses by squares of the spacing: only the squares around a position can have one that is too near.
    let mut squares: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    let square_of = |x_m: f64, y_m: f64| {
        (libm::floor(x_m / spacing_m) as i64, libm::floor(y_m / spacing_m) as i64)
    };
    for cell in reachable_cells(map, start, radius_m) {
        if poses.len() == count {
            break;
        }
        let (x_m, y_m) = map.info.centre_of(cell);
        let (column, row) = square_of(x_m, y_m);
        let is_near = |index: &usize| {
            let (dx_m, dy_m) = (poses[*index].x_m - x_m, poses[*index].y_m - y_m);
            dx_m * dx_m + dy_m * dy_m < spacing_m * spacing_m
        };
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (column + dx, row + dy)));
        if around.filter_map(|square| squares.get(&square)).flatten().any(is_near) {
            continue;
        }
        squares.entry((column, row)).or_default().push(poses.len());
        poses.push(Pose2::new(x_m, y_m, start.yaw_rad));
    }
    poses
}

#[cfg(test)]
mod tests {
    use periplus_grid::{Grid, GridInfo};

    use super::*;

    /// A room of 4 m by 2 m.
    fn room() -> OccupancyGrid {
        let info = GridInfo { resolution_m: 0.1, width: 42, height: 22, origin: Pose2::IDENTITY };
        let mut map = Grid { info, cells: vec![occupancy::FREE; 42 * 22] };
        for y in 0..22 {
            for x in 0..42 {
                if [0, 41].contains(&x) || [0, 21].contains(&y) {
                    map.cells[y * 42 + x] = occupancy::OCCUPIED;
                }
            }
        }
        map
    }

    #[test]
    fn robots_keep_their_distance_from_walls_and_each_other() {
        let start = Pose2::new(1.0, 1.0, 0.5);
        let poses = spread_poses(&room(), start, 0.2, 0.5, 10);
        assert_eq!(poses.len(), 10);
        assert!(libm::hypot(poses[0].x_m - 1.0, poses[0].y_m - 1.0) < 0.1);
        for (at, pose) in poses.iter().enumerate() {
            assert!(
                (0.39..3.81).contains(&pose.x_m) && (0.39..1.81).contains(&pose.y_m),
                "{pose:?}"
            );
            assert_eq!(pose.yaw_rad, 0.5);
            for other in &poses[..at] {
                assert!(libm::hypot(pose.x_m - other.x_m, pose.y_m - other.y_m) >= 0.5);
            }
        }
    }

    #[test]
    fn a_full_room_takes_no_more() {
        let poses = spread_poses(&room(), Pose2::new(1.0, 1.0, 0.0), 0.2, 1.0, 1000);
        // Columns 1 m apart between 0.3 m and 3.8 m, rows between 0.3 m and 1.8 m.
        assert!((4..=8).contains(&poses.len()), "{}", poses.len());
        assert!(spread_poses(&room(), Pose2::new(1.0, 1.0, 0.0), 2.0, 1.0, 3).is_empty());
    }
}
