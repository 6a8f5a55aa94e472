//! Collision check along the arc of a command.
//!
//! Source: `collision_checker.cpp`.

use std::fmt;

use periplus_costmap::CostmapView;
use periplus_geometry::{Pose2, Twist2};

use super::PurePursuitParams;
use crate::{BlockedCell, footprint_collision};

/// Velocity below which a robot that turns rotates in place \[m/s, rad/s\].
const IN_PLACE_M_S: f64 = 0.01;

/// Maximum number of poses of an arc, beyond which a check ends.
const MAX_ARC_COUNT: usize = 10_000;

/// Extent of the check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CollisionHorizon {
    /// Maximum time \[s\].
    pub time_s: f64,
    /// Maximum straight distance from the robot \[m\].
    pub distance_m: f64,
}

impl CollisionHorizon {
    /// Returns the extent for a command: up to the lookahead point, or with `min_distance_to_obstacle` (main) at least
    /// that far.
    #[must_use]
    pub fn new(
        params: &PurePursuitParams,
        command: Twist2,
        lookahead_m: f64,
        plan_length_m: f64,
    ) -> Self {
        let min_m = params.min_distance_to_obstacle_m;
        let plain = Self { time_s: params.max_time_to_collision_s, distance_m: lookahead_m };
        if min_m <= 0.0 {
            return plain;
        }
        let speed_m_s = command.vx_m_s.abs().max(params.min_approach_linear_velocity_m_s);
        let time_s = plain.time_s.max(min_m / speed_m_s);
        if !params.use_velocity_scaled_lookahead_dist {
            return Self { time_s, ..plain };
        }
        let wanted_m = if params.allow_obstacle_checking_beyond_goal {
            min_m
        } else {
            min_m.min(plan_length_m)
        };
        let distance_m = lookahead_m.max(wanted_m).min(params.max_lookahead_dist_m);
        Self { time_s, distance_m }
    }
}

/// Collision on an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcCollision {
    /// Time from now \[s\].
    pub time_s: f64,
    /// Cell that is touched.
    pub blocked: BlockedCell,
}

impl fmt::Display for ArcCollision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.time_s > 0.0 {
            write!(f, "In {:.2} s {}", self.time_s, self.blocked)
        } else {
            write!(f, "Now {}", self.blocked)
        }
    }
}

/// Returns the first collision of the footprint at a pose and then along the arc of a command, in steps of one cell or
/// of a rotation that moves the outermost corner by one cell. The poses are added to `arc`.
#[must_use]
pub fn arc_collision(
    view: &CostmapView<'_>,
    pose: Pose2,
    command: Twist2,
    horizon: CollisionHorizon,
    arc: &mut Vec<Pose2>,
) -> Option<ArcCollision> {
    if let Some(blocked) = footprint_collision(view, pose) {
        return Some(ArcCollision { time_s: 0.0, blocked });
    }
    let resolution_m = view.costs.resolution_m();
    let (speed_m_s, rate_rad_s) = (command.vx_m_s.abs(), command.wz_rad_s.abs());
    let step_s = if speed_m_s < IN_PLACE_M_S && rate_rad_s > IN_PLACE_M_S {
        let radius_m = view.footprint.circumscribed_radius_m;
        2.0 * libm::sin(resolution_m / 2.0 / radius_m) / rate_rad_s
    } else {
        resolution_m / speed_m_s
    };
    if step_s.is_nan() || step_s <= 0.0 {
        return None;
    }
    let mut next = pose;
    for index in 1..=MAX_ARC_COUNT {
        let time_s = index as f64 * step_s;
        if time_s >= horizon.time_s {
            break;
        }
        let (sine, cosine) = libm::sincos(next.yaw_rad);
        next.x_m += step_s * command.vx_m_s * cosine;
        next.y_m += step_s * command.vx_m_s * sine;
        next.yaw_rad += step_s * command.wz_rad_s;
        if libm::hypot(next.x_m - pose.x_m, next.y_m - pose.y_m) > horizon.distance_m {
            break;
        }
        arc.push(next);
        if let Some(blocked) = footprint_collision(view, next) {
            return Some(ArcCollision { time_s, blocked });
        }
    }
    None
}
