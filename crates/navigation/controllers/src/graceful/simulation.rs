//! Simulation of the motion to a target, with its collision check.
//!
//! Source: `simulateTrajectory`, `rotateToTarget` and `inCollision` of `graceful_controller.cpp`.

use periplus_costmap::{CostmapView, Footprint, cost};
use periplus_geometry::{Pose2, Twist2};

use super::{GracefulParams, SmoothControlLaw};
use crate::BlockedCell;
use crate::collision::blocking_cell;
use crate::path::distance_m;

/// Number of steps to a target per step of a straight motion, at most; `graceful_controller.cpp`.
const MAX_DETOUR_FACTOR: f64 = 3.0;

/// Maximum number of steps of a simulation.
const MAX_STEP_COUNT: usize = 20_000;

/// Motion to a target without a collision.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SimulatedMotion {
    /// Poses in the base frame.
    pub poses: Vec<Pose2>,
    /// First velocity.
    pub command: Twist2,
}

/// Inputs of simulations in a cycle.
#[derive(Clone, Copy)]
pub(super) struct Simulation<'a> {
    pub params: &'a GracefulParams,
    pub view: &'a CostmapView<'a>,
    pub costmap_from_base: Pose2,
    /// Maximum speed, by which the step follows from the resolution \[m/s\].
    pub max_speed_m_s: f64,
    pub max_rate_rad_s: f64,
    /// Minimum turn rate of rotations in place \[rad/s\].
    pub min_rate_rad_s: f64,
}

impl Simulation<'_> {
    /// Returns the rotation in place towards an angle.
    pub(super) fn rotation(&self, angle_rad: f64) -> Twist2 {
        let rate_rad_s = self.params.rotation_scaling_factor * angle_rad * self.max_rate_rad_s;
        let magnitude_rad_s = rate_rad_s.abs().max(self.min_rate_rad_s);
        Twist2::new(0.0, 0.0, libm::copysign(magnitude_rad_s, rate_rad_s))
    }

    /// Returns the collision of the robot at a pose in the base frame.
    pub(super) fn collision(&self, pose: Pose2, scaling: f64) -> Option<BlockedCell> {
        if !self.params.use_collision_detection {
            return None;
        }
        collision(self.view, self.costmap_from_base * pose, scaling)
    }

    /// Simulates the motion to a target in the base frame; with `rotates_first` the robot first rotates in place.
    ///
    /// # Errors
    /// The cell with which it collides.
    pub(super) fn run(
        &self,
        law: &SmoothControlLaw,
        target: Pose2,
        rotates_first: bool,
        is_backward: bool,
    ) -> Result<SimulatedMotion, BlockedCell> {
        let angle_rad = libm::atan2(target.y_m, target.x_m);
        let tolerance_rad = self.params.initial_rotation_tolerance_rad;
        let mut is_rotating = rotates_first;
        let resolution_m = self.view.costs.resolution_m();
        let step_s = if self.max_speed_m_s > 0.0 { resolution_m / self.max_speed_m_s } else { 0.0 };
        let straight_count = libm::hypot(target.x_m, target.y_m) / resolution_m;
        let max_count = ((MAX_DETOUR_FACTOR * straight_count) as usize).min(MAX_STEP_COUNT);
        let mut pose = Pose2::IDENTITY;
        let mut motion = SimulatedMotion { poses: Vec::new(), command: Twist2::ZERO };
        loop {
            let is_first = motion.poses.is_empty();
            if is_rotating {
                let rest_rad = angle_rad - pose.yaw_rad;
                if is_first {
                    motion.command = self.rotation(rest_rad);
                }
                is_rotating = rest_rad.abs() >= tolerance_rad;
                pose.yaw_rad += motion.command.wz_rad_s * step_s;
            } else {
                if is_first {
                    motion.command = law.velocity(target, pose, is_backward);
                }
                pose = law.next_pose(step_s, target, pose, is_backward);
            }
            motion.poses.push(pose);
            let scaling = self.footprint_scaling(motion.command.vx_m_s);
            if let Some(blocked) = self.collision(pose, scaling) {
                return Err(blocked);
            }
            if distance_m(target, pose) <= resolution_m || motion.poses.len() >= max_count {
                return Ok(motion);
            }
        }
    }

    /// Growth of the footprint at a speed.
    fn footprint_scaling(&self, speed_m_s: f64) -> f64 {
        let from_m_s = self.params.footprint_scaling_linear_vel_m_s;
        let range_m_s = self.max_speed_m_s - from_m_s;
        if speed_m_s <= from_m_s || range_m_s <= 0.0 {
            return 1.0;
        }
        1.0 + (speed_m_s - from_m_s) / range_m_s * self.params.footprint_scaling_factor
    }

    /// Returns the highest cost at the positions of a motion.
    pub(super) fn max_cost(&self, poses: &[Pose2]) -> u8 {
        let cost_at = |pose: &Pose2| {
            let at = self.costmap_from_base * *pose;
            self.view.costs.cost_at(at.x_m, at.y_m)
        };
        poses.iter().filter_map(cost_at).max().unwrap_or(cost::FREE)
    }
}

/// Returns the collision of a robot at a pose in the frame of the costmap: of its centre if it is given by a radius,
/// else of its footprint. None outside of the costmap.
fn collision(view: &CostmapView<'_>, pose: Pose2, scaling: f64) -> Option<BlockedCell> {
    let cell = view.costs.info().cell_of(pose.x_m, pose.y_m)?;
    let is_unknown_blocked = |cost: u8| cost == cost::UNKNOWN && !view.tracks_unknown;
    if view.is_circular {
        let cost = view.costs.cost(cell)?;
        let is_blocked = matches!(cost, cost::LETHAL | cost::INSCRIBED) || is_unknown_blocked(cost);
        let position_m = view.costs.info().centre_of(cell);
        return is_blocked.then_some(BlockedCell { pose, cell: Some(cell), position_m, cost });
    }
    let scaled;
    let footprint = if scaling > 1.0 && view.footprint.points().len() > 3 {
        let points =
            view.footprint.points().iter().map(|[x_m, y_m]| [x_m * scaling, y_m * scaling]);
        scaled = Footprint::new(points.collect());
        &scaled
    } else {
        view.footprint
    };
    let view = CostmapView { footprint, ..*view };
    match view.footprint.cost(view.costs, pose) {
        cost::LETHAL => blocking_cell(&view, pose, |cost| cost == cost::LETHAL),
        found if is_unknown_blocked(found) => {
            blocking_cell(&view, pose, |cost| cost == cost::UNKNOWN)
        }
        _ => None,
    }
}
