//! Reasons for failures and low speeds, in words.

use std::f64::consts::PI;

use periplus_costmap::cost;
use periplus_geometry::{Pose2, normalize_angle};

use super::cost_grid::CostGrid;
use super::limits::MppiVelocityLimits;
use super::optimizer::AttemptFailure;
use super::rollout::Start;

/// Share of the wanted speed below which a cycle is slow.
const SLOW_RATIO: f32 = 0.6;

/// Share of colliding samples that slows the robot down.
const CROWDED_RATIO: f32 = 0.3;

/// Facts of the last cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CycleFacts {
    pub(crate) start: Start,
    /// Commanded velocity forwards \[m/s\].
    pub(crate) command_vx: f32,
    pub(crate) command_speed: f32,
    pub(crate) samples: usize,
    pub(crate) colliding: usize,
    /// Distance along the path to the point that `PathFollowCritic` drives to \[m\].
    pub(crate) follow_aim: Option<f32>,
    /// Distance along the path to the first point in an obstacle \[m\].
    pub(crate) blocked: Option<f32>,
    /// Length of the local path \[m\].
    pub(crate) path_length: f32,
    /// Angle to the path a little ahead \[rad\].
    pub(crate) path_turn_rad: f32,
    /// Time covered by a sample \[s\].
    pub(crate) horizon_s: f32,
    pub(crate) acceleration: f32,
    pub(crate) period_s: f32,
    pub(crate) base: MppiVelocityLimits,
    pub(crate) limits: MppiVelocityLimits,
    pub(crate) vx_std: f32,
}

/// Position of the nearest obstacle seen from the robot, such as "0.12 m ahead".
fn describe_nearest(grid: &CostGrid, start: &Start) -> Option<String> {
    let [x, y] = grid.nearest_obstacle(start.x, start.y)?;
    let (dx, dy) = (f64::from(x - start.x), f64::from(y - start.y));
    let distance_m = libm::hypot(dx, dy);
    let bearing_rad = normalize_angle(libm::atan2(dy, dx) - f64::from(start.yaw));
    let side = match bearing_rad.abs() {
        angle if angle < PI / 4.0 => "ahead",
        angle if angle > 3.0 * PI / 4.0 => "behind",
        _ if bearing_rad > 0.0 => "to the left",
        _ => "to the right",
    };
    let radius_m = grid.inscribed_m;
    Some(format!(
        "the nearest obstacle is {distance_m:.2} m {side} of the robot's centre, whose inscribed radius is {radius_m:.2} m"
    ))
}

/// Reason for a failed cycle.
pub(crate) fn explain_failure(
    failure: AttemptFailure,
    samples: usize,
    step_s: f32,
    grid: &CostGrid,
    start: &Start,
    pose: Pose2,
) -> String {
    let nearest = describe_nearest(grid, start).map(|text| format!(": {text}")).unwrap_or_default();
    let here = match grid.find(start.x, start.y) {
        None => {
            return format!(
                "the robot at ({:.2}, {:.2}) is outside the local costmap; check its `global_frame` and `rolling_window`",
                pose.x_m, pose.y_m
            );
        }
        Some(cost::LETHAL) => {
            "; the robot's centre is in an obstacle already: clear the costmap or move the robot"
        }
        Some(cost::INSCRIBED) => {
            "; the robot is nearer to an obstacle than its inscribed radius already: back up, or check the footprint"
        }
        Some(cost::UNKNOWN) if !grid.tracks_unknown => {
            "; the robot is in unknown space, which counts as an obstacle"
        }
        Some(_) => "",
    };
    match failure {
        AttemptFailure::AllCollide => format!("all {samples} samples collide{nearest}{here}"),
        AttemptFailure::TrajectoryCollides(step) => {
            let time_s = step as f32 * step_s;
            format!("the optimal trajectory enters an obstacle after {time_s:.2} s{nearest}{here}")
        }
        AttemptFailure::NotFinite => {
            "the costs of the samples are not finite: check weights, `temperature` and accelerations".to_owned()
        }
    }
}

/// Reason for a low speed; none if the robot drives about as fast as it may.
pub(crate) fn explain_speed(facts: &CycleFacts, grid: &CostGrid) -> Option<String> {
    let CycleFacts { base, limits, command_speed: speed, .. } = *facts;
    if speed >= SLOW_RATIO * base.vx_max {
        return None;
    }
    let begin = format!("{speed:.2} of {:.2} m/s: ", base.vx_max);
    if limits.vx_max < base.vx_max && speed >= SLOW_RATIO * limits.vx_max {
        return Some(format!("{begin}the speed limit allows {:.2} m/s", limits.vx_max));
    }
    let crowded = facts.colliding as f32 > CROWDED_RATIO * facts.samples as f32;
    if crowded {
        let nearest = describe_nearest(grid, &facts.start).unwrap_or_default();
        return Some(format!(
            "{begin}{} of {} samples collide; {nearest}",
            facts.colliding, facts.samples
        ));
    }
    if let Some(blocked) = facts.blocked {
        let nearest = describe_nearest(grid, &facts.start).unwrap_or_default();
        return Some(format!("{begin}the path is blocked {blocked:.2} m ahead; {nearest}"));
    }
    if facts.path_length < base.vx_max * facts.horizon_s {
        return Some(format!(
            "{begin}the local path is {:.2} m long, less than the {:.2} m that the samples cover at full speed \
             (the goal is near, or the plan is cut)",
            facts.path_length,
            base.vx_max * facts.horizon_s
        ));
    }
    if facts.path_turn_rad > 0.5 {
        return Some(format!(
            "{begin}the path begins {:.0} degrees aside, and the robot turns towards it",
            facts.path_turn_rad.to_degrees()
        ));
    }
    let gained = facts.command_vx - facts.start.speed.vx;
    if gained > 0.8 * facts.acceleration * facts.period_s {
        return Some(format!("{begin}it accelerates with {:.2} m/s²", gained / facts.period_s));
    }
    let aim = facts.follow_aim?;
    if aim < 1.1 * speed * facts.horizon_s + 0.05 {
        return Some(format!(
            "{begin}`PathFollowCritic` aims at a point {aim:.2} m ahead, which this speed reaches within the {:.2} s of a \
             sample; raise its `offset_from_furthest`, or `vx_std` (now {:.2} m/s) so that samples reach further",
            facts.horizon_s, facts.vx_std
        ));
    }
    let nearest = describe_nearest(grid, &facts.start)?;
    Some(format!("{begin}costs along the path ({nearest})"))
}
