//! Score of a drive, from the truth: length, clearance, collisions.
//!
//! Nothing that drives may read it. Clearance is measured at the height of the robot's lidar; a collision is a contact
//! of the physics, or a side of the footprint that meets a surface. Cells of the walls at the beginning show where the
//! surfaces need not be searched.

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

/// Beginning of a time in which the robot touches something that is not a floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveCollision {
    /// Time of the simulation \[s\].
    pub time_s: f64,
    /// Pose of the robot, in the frame of the world.
    pub pose: Pose2,
}

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
    /// Times at which the robot began to touch something.
    pub collisions: Vec<DriveCollision>,
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
            collisions: Vec::new(),
        })
    }

    /// Takes a sample if one is due. Call it after each step.
    pub fn sample(&mut self, simulation: &mut Simulation) {
        let in_contact = self.is_in_contact(simulation);
        let is_due = simulation.time_ns() >= self.next_ns;
        if !is_due && (self.touches || !in_contact) {
            return;
        }
        let Some(pose) = simulation.robot_pose().map(Pose2::from) else { return };
        let mut touches = in_contact;
        if is_due {
            self.next_ns = simulation.time_ns() + SAMPLE_PERIOD_NS;
            if let Some(last) = self.pose {
                self.length_m += libm::hypot(pose.x_m - last.x_m, pose.y_m - last.y_m);
            }
            self.pose = Some(pose);
            touches = touches || self.sample_clearance(simulation, pose);
        }
        if touches && !self.touches {
            let time_s = simulation.time_ns() as f64 * 1e-9;
            self.collisions.push(DriveCollision { time_s, pose });
        }
        self.touches = touches;
    }

    /// Searches the surfaces if one can be nearer than any before. Returns true if the footprint meets one.
    fn sample_clearance(&mut self, simulation: &mut Simulation, world_from_robot: Pose2) -> bool {
        let margin_m = OUTLINE_STEP_M + std::f64::consts::SQRT_2 * self.info.resolution_m;
        let cells_m = self.cell_clearance_m(world_from_robot);
        if cells_m.is_infinite() || cells_m > self.min_clearance_m + margin_m {
            return false;
        }
        let max_m = self.min_clearance_m.min(cells_m + margin_m);
        let is_near = |x_m, y_m| self.wall_cell_m(x_m, y_m) <= max_m + margin_m;
        let found_m = simulation.clearance_m(&self.outline_m, max_m, is_near);
        self.min_clearance_m =
            found_m.map_or(self.min_clearance_m, |it| it.min(self.min_clearance_m));
        found_m == Some(0.0)
    }

    /// Distance from the footprint at a pose to the nearest cell with a wall \[m\].
    fn cell_clearance_m(&self, world_from_robot: Pose2) -> f64 {
        let distance_m = |[x, y]: &[f64; 2]| {
            let (x_m, y_m) = world_from_robot.transform_point(*x, *y);
            self.wall_cell_m(x_m, y_m)
        };
        self.outline_m.iter().map(distance_m).fold(f64::INFINITY, f64::min)
    }

    /// Distance from a point to the nearest cell with a wall \[m\]; infinite outside of the grid.
    fn wall_cell_m(&self, x_m: f64, y_m: f64) -> f64 {
        let cell = self.info.cell_of(x_m, y_m);
        cell.map_or(f64::INFINITY, |cell| self.distances_m[self.info.index(cell)])
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
