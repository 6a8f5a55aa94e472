//! Score of a drive, from the truth: length, clearance, collisions.
//!
//! Nothing that drives may read it. Clearance is measured at the height of the robot's lidar, to the walls
//! at the beginning.

use std::collections::BTreeSet;

use periplus_geometry::Pose2;
use periplus_grid::{GridInfo, occupancy, squared_distances};
use periplus_physics::LinkId;

use crate::Simulation;

/// Distance of the points on the footprint at which the clearance is measured \[m\].
const OUTLINE_STEP_M: f64 = 0.025;

/// Vertical part of a contact's normal above which it is a floor and not an obstacle.
const FLOOR_NORMAL_RATIO: f64 = 0.7;

/// Time between two samples \[ns\].
const SAMPLE_PERIOD_NS: i64 = 20_000_000;

/// Score of the first robot's drive.
#[derive(Clone, Debug)]
pub struct DriveScore {
    info: GridInfo,
    /// Distance of each cell to the nearest wall \[m\].
    distances_m: Vec<f64>,
    /// Points on the footprint, in the robot's frame \[m\].
    outline_m: Vec<[f64; 2]>,
    links: BTreeSet<LinkId>,
    /// Pose of the robot at the last sample, in the frame of the world.
    pub pose: Option<Pose2>,
    next_ns: i64,
    touches: bool,
    /// Distance driven \[m\].
    pub length_m: f64,
    /// Smallest distance from the footprint to a wall \[m\]; infinite without walls.
    pub min_clearance_m: f64,
    /// Number of times that the robot began to touch something that is not a floor.
    pub collision_count: usize,
}

impl DriveScore {
    /// Begins a score on the cells of a grid, outside of which there are no walls. `None` without a robot.
    pub fn new(simulation: &mut Simulation, info: GridInfo) -> Option<Self> {
        let walls = simulation.truth_map(info)?;
        let squared = squared_distances(&walls, |value| *value == occupancy::OCCUPIED);
        let to_m = |squared: &u32| libm::sqrt(f64::from(*squared)) * info.resolution_m;
        let robot = simulation.robot()?.model;
        let footprint = simulation.robot_footprint_m().unwrap_or_default();
        Some(Self {
            info,
            distances_m: squared.cells.iter().map(to_m).collect(),
            outline_m: outline(&footprint),
            links: simulation.motion().links(robot).collect(),
            pose: None,
            next_ns: simulation.time_ns(),
            touches: false,
            length_m: 0.0,
            min_clearance_m: f64::INFINITY,
            collision_count: 0,
        })
    }

    /// Takes a sample if one is due. Call it after each step.
    pub fn sample(&mut self, simulation: &Simulation) {
        let touches = self.is_in_contact(simulation);
        if touches && !self.touches {
            self.collision_count += 1;
            self.touches = true;
        }
        if simulation.time_ns() < self.next_ns {
            return;
        }
        self.next_ns = simulation.time_ns() + SAMPLE_PERIOD_NS;
        let Some(pose) = simulation.robot_pose().map(Pose2::from) else { return };
        if let Some(last) = self.pose {
            self.length_m += libm::hypot(pose.x_m - last.x_m, pose.y_m - last.y_m);
        }
        self.pose = Some(pose);
        let clearance_m = self.clearance_m(pose);
        self.min_clearance_m = self.min_clearance_m.min(clearance_m);
        let touches = touches || clearance_m == 0.0;
        self.collision_count += usize::from(touches && !self.touches);
        self.touches = touches;
    }

    /// Distance from the footprint at a pose to the nearest wall \[m\].
    fn clearance_m(&self, world_from_robot: Pose2) -> f64 {
        let distance_m = |[x, y]: &[f64; 2]| {
            let (x_m, y_m) = world_from_robot.transform_point(*x, *y);
            let cell = self.info.cell_of(x_m, y_m)?;
            Some(self.distances_m[self.info.index(cell)])
        };
        self.outline_m.iter().filter_map(distance_m).fold(f64::INFINITY, f64::min)
    }

    fn is_in_contact(&self, simulation: &Simulation) -> bool {
        simulation.motion().contacts().iter().any(|contact| {
            let [one, two] = [contact.one, contact.two].map(|it| self.links.contains(&it.link));
            one != two && contact.normal.z.abs() < FLOOR_NORMAL_RATIO
        })
    }
}

/// Points along the sides of a polygon.
fn outline(corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for (index, [x, y]) in corners.iter().enumerate() {
        let [next_x, next_y] = corners[(index + 1) % corners.len()];
        let count = libm::ceil(libm::hypot(next_x - x, next_y - y) / OUTLINE_STEP_M).max(1.0);
        for step in 0..count as usize {
            let part = step as f64 / count;
            points.push([x + part * (next_x - x), y + part * (next_y - y)]);
        }
    }
    points
}
