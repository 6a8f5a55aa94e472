//! Nodes that need the robot's position, its speed or the geometry of a path.

use super::conditions::Goals;
use super::timing::{number, seconds_ns};
use crate::{BehaviorNode, NodeRun, NodeStatus, PathGeometry, TreeError};

/// Position of the robot in the frames of the ports \[m\].
fn position_m(run: &mut NodeRun<'_>) -> Option<[f64; 2]> {
    let [global, base] = ["global_frame", "robot_base_frame"]
        .map(|port| run.input_text(port).filter(|name| !name.is_empty()));
    run.context().robot_position_m(global.as_deref(), base.as_deref())
}

fn distance_m(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// Ticks its child whenever the robot has travelled a distance since the child's last success.
///
/// Source: `distance_controller.cpp`.
#[derive(Default)]
pub(super) struct DistanceController {
    start_m: [f64; 2],
    is_first: bool,
}

impl BehaviorNode for DistanceController {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let Some(current_m) = position_m(run) else { return Ok(NodeStatus::Failure) };
        if !run.status().is_active() {
            self.start_m = current_m;
            self.is_first = true;
        }
        run.set_running();
        let is_due = distance_m(self.start_m, current_m) >= number(run, "distance")?;
        if !(self.is_first || is_due || run.child_status(0) == NodeStatus::Running) {
            return Ok(NodeStatus::Running);
        }
        self.is_first = false;
        let status = run.tick_child(0)?;
        if status == NodeStatus::Success {
            let Some(current_m) = position_m(run) else { return Ok(NodeStatus::Failure) };
            self.start_m = current_m;
        }
        Ok(status)
    }
}

/// Condition that succeeds whenever the robot has travelled a distance.
///
/// Source: `distance_traveled_condition.cpp`.
#[derive(Default)]
pub(super) struct DistanceTraveled {
    start_m: Option<[f64; 2]>,
}

impl BehaviorNode for DistanceTraveled {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let current_m = position_m(run);
        if !run.status().is_active() {
            self.start_m = current_m;
            return Ok(NodeStatus::Failure);
        }
        let Some(current_m) = current_m else { return Ok(NodeStatus::Failure) };
        let start_m = *self.start_m.get_or_insert(current_m);
        if distance_m(start_m, current_m) < number(run, "distance")? {
            return Ok(NodeStatus::Failure);
        }
        self.start_m = Some(current_m);
        Ok(NodeStatus::Success)
    }
}

/// Ticks its child at a rate that depends on the speed of the robot.
///
/// Source: `speed_controller.cpp`.
#[derive(Default)]
pub(super) struct SpeedController {
    goals: Goals,
    period_ns: i64,
    start_ns: i64,
    is_first: bool,
}

impl SpeedController {
    /// Period for the current speed: the rate is linear between the two speeds, and clamped.
    fn period_ns(run: &mut NodeRun<'_>) -> Result<i64, TreeError> {
        let [min_rate, max_rate] = [number(run, "min_rate")?, number(run, "max_rate")?];
        let [min_speed, max_speed] = [number(run, "min_speed")?, number(run, "max_speed")?];
        let speed = run.context().speed_m_s();
        let ratio = ((speed - min_speed) / (max_speed - min_speed)).max(0.0);
        let rate = (min_rate + ratio * (max_rate - min_rate)).clamp(min_rate, max_rate);
        Ok(seconds_ns(1.0 / rate))
    }
}

impl BehaviorNode for SpeedController {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let [min_rate, max_rate] = [number(run, "min_rate")?, number(run, "max_rate")?];
        if !(min_rate > 0.0 && max_rate >= min_rate) {
            return Err(run.error("`min_rate` must be positive, and not above `max_rate`"));
        }
        let now_ns = run.now_ns();
        let has_new_goal = self.goals.update(run);
        if has_new_goal || !run.status().is_active() {
            self.period_ns = seconds_ns(1.0 / max_rate);
            self.start_ns = now_ns;
            self.is_first = true;
        }
        run.set_running();
        let is_due = now_ns.saturating_sub(self.start_ns) >= self.period_ns;
        if !(self.is_first || is_due || run.child_status(0) == NodeStatus::Running) {
            return Ok(NodeStatus::Running);
        }
        self.is_first = false;
        if is_due {
            self.period_ns = Self::period_ns(run)?;
            self.start_ns = now_ns;
        }
        run.tick_child(0)
    }
}

/// Ticks its child when a new path to the same end is much longer than the last one, near the goal.
///
/// Source: `path_longer_on_approach.cpp`.
#[derive(Default)]
pub(super) struct PathLongerOnApproach {
    old: Option<PathGeometry>,
    /// True once two paths to the same end were seen.
    is_armed: bool,
}

/// A path to the same position with another number of poses.
fn is_updated(new: &PathGeometry, old: &PathGeometry) -> bool {
    old.pose_count != 0
        && new.pose_count != 0
        && new.pose_count != old.pose_count
        && new.end_position_m == old.end_position_m
}

impl BehaviorNode for PathLongerOnApproach {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let value = run.input("path");
        let new = value.and_then(|path| run.context().path_geometry(&path)).unwrap_or_default();
        let old = self.old.get_or_insert_default();
        if old.pose_count == 0 || new.pose_count == 0 || old.end_pose != new.end_pose {
            self.is_armed = false;
        }
        run.set_running();
        let is_near = old.length_m < number(run, "prox_len")?;
        let is_longer = new.length_m > number(run, "length_factor")? * old.length_m;
        if is_updated(&new, old) && is_near && is_longer && self.is_armed {
            let status = run.tick_child(0)?;
            if status.is_completed() {
                self.old = Some(new);
                run.halt_children()?;
            }
            return Ok(status);
        }
        self.old = Some(new);
        self.is_armed = true;
        Ok(NodeStatus::Success)
    }
}
