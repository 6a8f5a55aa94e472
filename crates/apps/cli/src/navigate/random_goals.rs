//! Random goals on a map.

use periplus_geometry::{Pose2, Stream};
use periplus_grid::{Cell, GridInfo, OccupancyGrid};
use periplus_sim::FreeFloor;

/// Goals on a map that robots of a radius can reach from their starts: where they have room in every heading, over a path
/// with that room. Robots that start in the same area share its cells.
pub(super) struct GoalAreas<'a> {
    info: GridInfo,
    floor: FreeFloor<'a>,
    /// Cells of each area, the nearest to the first start in it first.
    areas: Vec<Vec<Cell>>,
    /// Number of the area of each cell.
    area_of: Vec<Option<usize>>,
}

impl<'a> GoalAreas<'a> {
    pub(super) fn new(map: &'a OccupancyGrid, radius_m: f64) -> Self {
        Self {
            info: map.info,
            floor: FreeFloor::new(map, radius_m),
            areas: Vec::new(),
            area_of: vec![None; map.info.len()],
        }
    }

    /// Draws goals of a robot. Empty if it has no room at its start.
    pub(super) fn draw(&mut self, start: Pose2, count: usize, seed: u64) -> Vec<Pose2> {
        let Some(first) = self.floor.start_cell(start) else { return Vec::new() };
        let area = self.area_around(first);
        let (cells, info) = (&self.areas[area], &self.info);
        (0..count as u64)
            .map(|number| {
                let mut stream = Stream::keyed(seed, "random goals", number);
                let place = (stream.unit() * cells.len() as f64) as usize;
                let (x_m, y_m) = info.centre_of(cells[place.min(cells.len() - 1)]);
                let yaw_rad = (2.0 * stream.unit() - 1.0) * std::f64::consts::PI;
                Pose2::new(x_m, y_m, yaw_rad)
            })
            .collect()
    }

    /// Number of the area around a cell, which is found when it is first needed.
    fn area_around(&mut self, first: Cell) -> usize {
        if let Some(known) = self.area_of[self.info.index(first)] {
            return known;
        }
        let cells = self.floor.reachable_from(first);
        for cell in &cells {
            self.area_of[self.info.index(*cell)] = Some(self.areas.len());
        }
        self.areas.push(cells);
        self.areas.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use periplus_grid::{Grid, occupancy};

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

    fn goals_of(seed: u64) -> Vec<Pose2> {
        let map = rooms();
        GoalAreas::new(&map, 0.2).draw(Pose2::new(1.0, 1.0, 0.0), 200, seed)
    }

    #[test]
    fn goals_are_in_the_room_of_the_start_and_away_from_walls() {
        let goals = goals_of(1);
        assert_eq!(goals.len(), 200);
        for goal in &goals {
            assert!(
                (0.39..2.71).contains(&goal.x_m) && (0.39..2.81).contains(&goal.y_m),
                "{goal:?}"
            );
        }
        assert_eq!(goals, goals_of(1));
        assert_ne!(goals, goals_of(2));
    }

    #[test]
    fn robots_in_one_room_share_its_cells() {
        let map = rooms();
        let mut areas = GoalAreas::new(&map, 0.2);
        let [one, other, beyond] = [1.0, 2.0, 5.0].map(|x_m| Pose2::new(x_m, 1.0, 0.0));
        let goals = areas.draw(one, 20, 1);
        assert_eq!(areas.draw(other, 20, 1), goals);
        assert!(areas.draw(beyond, 20, 1).iter().all(|goal| goal.x_m > 3.0));
        assert_eq!(areas.areas.len(), 2);
    }

    #[test]
    fn a_robot_that_fits_nowhere_has_no_goals() {
        let map = rooms();
        assert!(GoalAreas::new(&map, 2.0).draw(Pose2::new(1.0, 1.0, 0.0), 3, 1).is_empty());
    }
}
