//! `RateController`, `SingleTrigger` and `GoalUpdatedController`.

use super::conditions::Goals;
use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError};

/// Nanoseconds of a number of seconds.
#[allow(clippy::cast_possible_truncation, reason = "saturates")]
pub(super) fn seconds_ns(seconds: f64) -> i64 {
    libm::round(seconds * 1e9) as i64
}

/// Number of an input port.
pub(super) fn number(run: &NodeRun<'_>, port: &str) -> Result<f64, TreeError> {
    run.input_f64(port).ok_or_else(|| run.missing(port))
}

/// Ticks its child at a rate. The period begins when the child succeeds; in between the node returns its
/// last status, which is running. A running child is ticked each time.
///
/// Source: `rate_controller.cpp`.
#[derive(Default)]
pub(super) struct RateController {
    period_ns: i64,
    start_ns: i64,
    is_first: bool,
}

impl BehaviorNode for RateController {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        if !run.status().is_active() {
            self.period_ns = seconds_ns(1.0 / number(run, "hz")?);
            self.start_ns = run.now_ns();
            self.is_first = true;
        }
        run.set_running();
        let is_due = run.now_ns().saturating_sub(self.start_ns) >= self.period_ns;
        if !(self.is_first || is_due || run.child_status(0) == NodeStatus::Running) {
            return Ok(NodeStatus::Running);
        }
        self.is_first = false;
        let status = run.tick_child(0)?;
        if status == NodeStatus::Success {
            self.start_ns = run.now_ns();
        }
        Ok(status)
    }
}

/// Ticks its child until it has finished once, then fails.
///
/// Source: `single_trigger_node.cpp`.
#[derive(Default)]
pub(super) struct SingleTrigger {
    is_over: bool,
}

impl BehaviorNode for SingleTrigger {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        if !run.status().is_active() {
            self.is_over = false;
        }
        run.set_running();
        if self.is_over {
            return Ok(NodeStatus::Failure);
        }
        let status = run.tick_child(0)?;
        self.is_over = status.is_completed();
        Ok(status)
    }
}

/// Ticks its child when the goal has changed, and while the child is running.
///
/// Source: `goal_updated_controller.cpp`.
#[derive(Default)]
pub(super) struct GoalUpdatedController {
    goals: Goals,
    is_changed: bool,
}

impl BehaviorNode for GoalUpdatedController {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let is_active = run.status().is_active();
        run.set_running();
        if self.goals.update(run) || !is_active {
            self.is_changed = true;
        }
        if !self.is_changed && run.child_status(0) != NodeStatus::Running {
            return Ok(NodeStatus::Running);
        }
        self.is_changed = false;
        run.tick_child(0)
    }
}
