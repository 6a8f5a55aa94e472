//! Random goals on a map.

use periplus_geometry::{Pose2, Stream};
use periplus_grid::OccupancyGrid;
use periplus_sim::reachable_cells;

/// Draws poses on a map that a robot of a radius can reach from its start: where it has room in every heading, over a
/// path with that room. Empty if there are none.
pub(super) fn random_goals(
    map: &OccupancyGrid,
    start: Pose2,
    radius_m: f64,
    count: usize,
    seed: u64,
) -> Vec<Pose2> {
    let reachable = reachable_cells(map, start, radius_m);
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

#[cfg(test)]
mod tests {
    use periplus_grid::{Grid, GridInfo, occupancy};

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
