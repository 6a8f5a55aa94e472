//! Random goals on a map.

use std::collections::VecDeque;

use periplus_geometry::{Pose2, Stream};
use periplus_grid::{Cell, OccupancyGrid, occupancy, squared_distances};

/// Room around a goal beside the robot itself \[m\].
const MARGIN_M: f64 = 0.1;

/// Farthest cell from the start at which the search begins \[m\].
const MAX_START_DISTANCE_M: f64 = 1.0;

/// Draws poses on a map that a robot of a radius can reach from its start: where it has room in every heading, over a
/// path with that room. Empty if there are none.
pub(super) fn random_goals(
    map: &OccupancyGrid,
    start: Pose2,
    radius_m: f64,
    count: usize,
    seed: u64,
) -> Vec<Pose2> {
    let room = (radius_m + MARGIN_M) / map.info.resolution_m;
    let distances = squared_distances(map, |value| *value != occupancy::FREE);
    let has_room = |index: usize| f64::from(distances.cells[index]) >= room * room;
    let reachable = reachable(map, start, &has_room);
    if reachable.is_empty() {
        return Vec::new();
    }
    (0..count as u64)
        .map(|number| {
            let mut stream = Stream::keyed(seed, "random goals", number);
            let place = (stream.unit() * reachable.len() as f64) as usize;
            let (x_m, y_m) = map.info.centre_of(reachable[place.min(reachable.len() - 1)]);
            let yaw_rad = (2.0 * stream.unit() - 1.0) * std::f64::consts::PI;
            Pose2::new(x_m, y_m, yaw_rad)
        })
        .collect()
}

/// Cells that are connected to the one nearest to the start, in the order of their distance from it.
fn reachable(map: &OccupancyGrid, start: Pose2, has_room: &dyn Fn(usize) -> bool) -> Vec<Cell> {
    let info = &map.info;
    let Some(first) = nearest(map, start, has_room) else { return Vec::new() };
    let mut seen = vec![false; info.len()];
    seen[info.index(first)] = true;
    let (mut queue, mut found) = (VecDeque::from([first]), Vec::new());
    while let Some(cell) = queue.pop_front() {
        found.push(cell);
        for (dx, dy) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
            let next = cell.0.checked_add_signed(dx).zip(cell.1.checked_add_signed(dy));
            let Some(next) = next.filter(|next| info.contains(*next)) else { continue };
            let index = info.index(next);
            if !seen[index] && has_room(index) {
                seen[index] = true;
                queue.push_back(next);
            }
        }
    }
    found
}

/// Cell with room that is nearest to a pose.
fn nearest(map: &OccupancyGrid, start: Pose2, has_room: &dyn Fn(usize) -> bool) -> Option<Cell> {
    let info = &map.info;
    let cells = (0..info.len()).map(|index| info.cell(index));
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

#[cfg(test)]
mod tests {
    use periplus_grid::{Grid, GridInfo};

    use super::*;

    /// Two rooms of 3 m without a door.
    fn rooms() -> OccupancyGrid {
        let info = GridInfo { resolution_m: 0.1, width: 62, height: 32, origin: Pose2::IDENTITY };
        let mut map = Grid { info, cells: vec![occupancy::FREE; 62 * 32] };
        for y in 0..32 {
            for x in 0..62 {
                if y == 0 || y == 31 || [0, 30, 31, 61].contains(&x) {
                    map.cells[y * 62 + x] = occupancy::OCCUPIED;
                }
            }
        }
        map
    }

    #[test]
    fn goals_are_in_the_room_of_the_start_and_away_from_walls() {
        let goals = random_goals(&rooms(), Pose2::new(1.0, 1.0, 0.0), 0.2, 200, 1);
        assert_eq!(goals.len(), 200);
        for goal in &goals {
            assert!(
                (0.39..2.71).contains(&goal.x_m) && (0.39..2.81).contains(&goal.y_m),
                "{goal:?}"
            );
        }
        assert_eq!(goals, random_goals(&rooms(), Pose2::new(1.0, 1.0, 0.0), 0.2, 200, 1));
        assert_ne!(goals, random_goals(&rooms(), Pose2::new(1.0, 1.0, 0.0), 0.2, 200, 2));
    }

    #[test]
    fn a_robot_that_fits_nowhere_has_no_goals() {
        assert!(random_goals(&rooms(), Pose2::new(1.0, 1.0, 0.0), 2.0, 3, 1).is_empty());
    }
}
