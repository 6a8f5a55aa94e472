//! Decorators that translate the status of their child, or tick it under a condition.

use crate::script::Script;
use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError};

/// Status for the success and the failure of the child: `Inverter`, `ForceSuccess`, `ForceFailure`,
/// `KeepRunningUntilFailure`.
pub(super) struct Map {
    pub(super) success: NodeStatus,
    pub(super) failure: NodeStatus,
}

impl BehaviorNode for Map {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        run.set_running();
        let status = run.tick_child(0)?;
        if status.is_completed() {
            run.halt_children()?;
        }
        Ok(match status {
            NodeStatus::Success => self.success,
            NodeStatus::Failure => self.failure,
            // A skipped child does not end a loop.
            NodeStatus::Skipped if self.success == NodeStatus::Running => NodeStatus::Running,
            other => other,
        })
    }
}

/// Ticks its child until it has finished once; then skips it, or returns its status.
///
/// Source: `run_once_node.h`.
#[derive(Default)]
pub(super) struct RunOnce {
    returned: Option<NodeStatus>,
}

impl BehaviorNode for RunOnce {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        if let Some(returned) = self.returned {
            let skips = run.input_bool("then_skip").unwrap_or(true);
            return Ok(if skips { NodeStatus::Skipped } else { returned });
        }
        run.set_running();
        let status = run.tick_child(0)?;
        if status.is_completed() {
            self.returned = Some(status);
            run.halt_children()?;
        }
        Ok(status)
    }
}

/// Ticks its child if a script is true; the script is not executed again while the child is running.
///
/// Source: `script_precondition.h`.
#[derive(Default)]
pub(super) struct Precondition {
    script: Option<Script>,
    is_running: bool,
}

impl BehaviorNode for Precondition {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let source = run.input_text("if").ok_or_else(|| run.missing("if"))?;
        let script = crate::action::parsed(run, &mut self.script, &source)?;
        self.is_running = self.is_running || run.test_script(script)?;
        if !self.is_running {
            let otherwise = run.input_text("else").and_then(|name| NodeStatus::of_name(&name));
            return otherwise.ok_or_else(|| run.missing("else"));
        }
        let status = run.tick_child(0)?;
        if status.is_completed() {
            self.is_running = false;
            run.halt_children()?;
        }
        Ok(status)
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.is_running = false;
        Ok(())
    }
}

/// Ticks its child while two values are equal: the `BlackboardCheck` nodes of format 3.
///
/// Source: `blackboard_precondition.h` of version 3.8.
pub(super) struct BlackboardCheck;

impl BehaviorNode for BlackboardCheck {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        run.set_running();
        let [a, b] = [run.input("value_A"), run.input("value_B")];
        if a.is_some() && a == b {
            return run.tick_child(0);
        }
        if run.child_status(0) == NodeStatus::Running {
            run.halt_child(0)?;
        }
        let mismatch = run.input_text("return_on_mismatch");
        let mismatch = mismatch.and_then(|name| NodeStatus::of_name(&name));
        mismatch.ok_or_else(|| run.missing("return_on_mismatch"))
    }
}
