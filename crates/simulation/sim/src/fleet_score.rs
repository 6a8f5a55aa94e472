//! Score of several robots' drives, from the truth: lengths, contacts with walls and with each other.
//!
//! Nothing that drives may read it. Robots are the polygons around their collisions; walls are those of a map at the
//! height of a lidar at the beginning.

use periplus_geometry::{Pose, Pose2};
use periplus_grid::{OccupancyGrid, occupancy};

use crate::Simulation;

/// Time between two samples \[ns\].
const SAMPLE_PERIOD_NS: i64 = 100_000_000;

/// Distance below which two robots touch \[m\]: bodies of the physics overlap by less.
const CONTACT_GAP_M: f64 = 0.005;

/// Distance of the points on an outline that are looked up on the map \[m\].
const OUTLINE_STEP_M: f64 = 0.05;

/// Drive of a robot.
#[derive(Clone, Debug)]
pub struct FleetMember {
    /// Name of its model.
    pub name: String,
    /// Pose at the last sample, in the world.
    pub pose: Option<Pose2>,
    /// Distance driven \[m\].
    pub length_m: f64,
    /// Number of times that it began to touch a wall.
    pub wall_contacts: usize,
    /// Number of times that it began to touch another robot.
    pub robot_contacts: usize,
    footprint_m: Vec<[f64; 2]>,
    /// Radius of a circle around the footprint \[m\].
    radius_m: f64,
    touches_wall: bool,
    touches_robot: bool,
}

/// Scores of all robots.
#[derive(Clone, Debug)]
pub struct FleetScore {
    map: Option<OccupancyGrid>,
    /// The robots, in their order in the simulation.
    pub robots: Vec<FleetMember>,
    next_ns: i64,
}

impl FleetScore {
    /// Begins the scores of all robots, in a world with the walls of a map in its frame.
    #[must_use]
    pub fn new(simulation: &Simulation, map: Option<OccupancyGrid>) -> Self {
        let robots = simulation.robots().into_iter().map(|robot| {
            let footprint_m = simulation.model_footprint_m(&robot.name).unwrap_or_default();
            let radii = footprint_m.iter().map(|[x_m, y_m]| libm::hypot(*x_m, *y_m));
            FleetMember {
                radius_m: radii.fold(0.0, f64::max),
                name: robot.name,
                pose: None,
                length_m: 0.0,
                wall_contacts: 0,
                robot_contacts: 0,
                footprint_m,
                touches_wall: false,
                touches_robot: false,
            }
        });
        Self { map, robots: robots.collect(), next_ns: simulation.time_ns() }
    }

    /// Takes a sample if one is due. Call it after each step.
    pub fn sample(&mut self, simulation: &Simulation) {
        if simulation.time_ns() < self.next_ns {
            return;
        }
        self.next_ns = simulation.time_ns() + SAMPLE_PERIOD_NS;
        self.look(&|name| simulation.model_pose(name));
    }

    fn look(&mut self, pose_of: &dyn Fn(&str) -> Option<Pose>) {
        for robot in &mut self.robots {
            let Some(pose) = pose_of(&robot.name).map(Pose2::from) else { continue };
            if let Some(last) = robot.pose {
                robot.length_m += libm::hypot(pose.x_m - last.x_m, pose.y_m - last.y_m);
            }
            robot.pose = Some(pose);
        }
        let outlines: Vec<Vec<[f64; 2]>> = self.robots.iter().map(FleetMember::outline_m).collect();
        // Sorted by x, so that only robots side by side are compared.
        let mut order: Vec<usize> =
            (0..self.robots.len()).filter(|index| self.robots[*index].pose.is_some()).collect();
        let x_m = |index: usize| self.robots[index].pose.map_or(0.0, |pose| pose.x_m);
        order.sort_by(|one, two| x_m(*one).total_cmp(&x_m(*two)));
        let reach_m = self.robots.iter().map(|robot| robot.radius_m).fold(0.0, f64::max);
        let mut touched = vec![false; self.robots.len()];
        for (at, &one) in order.iter().enumerate() {
            let after = order[at + 1..].iter();
            let last_m = x_m(one) + 2.0 * reach_m + CONTACT_GAP_M;
            for &two in after.take_while(|two| x_m(**two) <= last_m) {
                if touch(&outlines[one], &outlines[two]) {
                    touched[one] = true;
                    touched[two] = true;
                }
            }
        }
        for ((robot, outline_m), touches_robot) in self.robots.iter_mut().zip(outlines).zip(touched)
        {
            let touches_wall = self.map.as_ref().is_some_and(|map| meets_wall(map, &outline_m));
            robot.wall_contacts += usize::from(touches_wall && !robot.touches_wall);
            robot.robot_contacts += usize::from(touches_robot && !robot.touches_robot);
            (robot.touches_wall, robot.touches_robot) = (touches_wall, touches_robot);
        }
    }
}

impl FleetMember {
    /// Corners in the world \[m\].
    fn outline_m(&self) -> Vec<[f64; 2]> {
        let Some(pose) = self.pose else { return Vec::new() };
        let corners = self.footprint_m.iter().map(|[x_m, y_m]| pose.transform_point(*x_m, *y_m));
        corners.map(|(x_m, y_m)| [x_m, y_m]).collect()
    }
}

/// True if a side of an outline is in a wall.
fn meets_wall(map: &OccupancyGrid, outline_m: &[[f64; 2]]) -> bool {
    sides(outline_m).any(|([x_m, y_m], [next_x_m, next_y_m])| {
        let length_m = libm::hypot(next_x_m - x_m, next_y_m - y_m);
        let count = libm::ceil(length_m / OUTLINE_STEP_M).max(1.0);
        (0..count as usize).any(|step| {
            let part = step as f64 / count;
            let at = (x_m + part * (next_x_m - x_m), y_m + part * (next_y_m - y_m));
            map.info.cell_of(at.0, at.1).is_some_and(|cell| map[cell] == occupancy::OCCUPIED)
        })
    })
}

/// True if two convex polygons are nearer than `CONTACT_GAP_M`, by their separating axes: the normals of all sides.
fn touch(one: &[[f64; 2]], two: &[[f64; 2]]) -> bool {
    let is_apart = |([x_m, y_m], [next_x_m, next_y_m]): ([f64; 2], [f64; 2])| {
        let (dx_m, dy_m) = (next_x_m - x_m, next_y_m - y_m);
        let length_m = libm::hypot(dx_m, dy_m);
        if length_m == 0.0 {
            return false;
        }
        let normal = [dy_m / length_m, -dx_m / length_m];
        let along = |points: &[[f64; 2]]| {
            let values = points.iter().map(|[x_m, y_m]| x_m * normal[0] + y_m * normal[1]);
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            })
        };
        let ((low, high), (other_low, other_high)) = (along(one), along(two));
        other_low - high > CONTACT_GAP_M || low - other_high > CONTACT_GAP_M
    };
    !one.is_empty() && !two.is_empty() && !sides(one).chain(sides(two)).any(is_apart)
}

fn sides(corners: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

#[cfg(test)]
mod tests {
    use periplus_grid::{Grid, GridInfo};

    use super::*;

    /// Robot of 0.4 m by 0.4 m.
    fn robot(name: &str) -> FleetMember {
        FleetMember {
            name: name.to_owned(),
            pose: None,
            length_m: 0.0,
            wall_contacts: 0,
            robot_contacts: 0,
            footprint_m: vec![[0.2, 0.2], [-0.2, 0.2], [-0.2, -0.2], [0.2, -0.2]],
            radius_m: 0.3,
            touches_wall: false,
            touches_robot: false,
        }
    }

    fn score(map: Option<OccupancyGrid>) -> FleetScore {
        FleetScore { map, robots: vec![robot("a"), robot("b")], next_ns: 0 }
    }

    /// Contacts of the first robot with the second, which comes towards it along x.
    #[track_caller]
    fn check(yaw_rad: f64, xs_m: &[f64], expected: usize) {
        let mut score = score(None);
        for x_m in xs_m {
            score.look(&|name| {
                let pose =
                    if name == "a" { Pose2::IDENTITY } else { Pose2::new(*x_m, 0.0, yaw_rad) };
                Some(Pose::from(pose))
            });
        }
        assert_eq!(score.robots[0].robot_contacts, expected);
        assert_eq!(score.robots[1].robot_contacts, expected);
    }

    #[test]
    fn squares_touch_at_their_sides() {
        check(0.0, &[1.0, 0.41], 0);
        check(0.0, &[1.0, 0.404], 1);
        // A contact that lasts is one, two are two.
        check(0.0, &[0.5, 0.39, 0.38, 0.5, 0.39], 2);
        // Corner first: 0.2 m and 0.2 m times the square root of 2.
        check(std::f64::consts::FRAC_PI_4, &[0.5], 0);
        check(std::f64::consts::FRAC_PI_4, &[0.48], 1);
    }

    #[test]
    fn a_wall_is_met_where_a_side_is_in_its_cell() {
        let info = GridInfo { resolution_m: 0.1, width: 20, height: 10, origin: Pose2::IDENTITY };
        let mut map = Grid { info, cells: vec![occupancy::FREE; 200] };
        for row in 0..10 {
            map[(15, row)] = occupancy::OCCUPIED;
        }
        let mut score = score(Some(map));
        for x_m in [1.0, 1.25, 1.35, 1.25] {
            score.look(&|name| (name == "a").then(|| Pose::from(Pose2::new(x_m, 0.5, 0.0))));
        }
        assert_eq!((score.robots[0].wall_contacts, score.robots[1].wall_contacts), (1, 0));
        assert!((score.robots[0].length_m - 0.45).abs() < 1e-12);
    }
}
