//! `RecoveryNode` and `RoundRobin`.

use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError};

/// Ticks its first child; after a failure the second one, and if that succeeds the first one again, in the
/// same tick.
///
/// Source: `recovery_node.cpp`.
#[derive(Default)]
pub(super) struct RecoveryNode {
    retries: i64,
    is_recovering: bool,
}

impl RecoveryNode {
    fn end(&mut self, run: &mut NodeRun<'_>, status: NodeStatus) -> Result<NodeStatus, TreeError> {
        *self = Self::default();
        run.halt_self()?;
        Ok(status)
    }
}

impl BehaviorNode for RecoveryNode {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let max_retries = run.input_i64("number_of_retries");
        let max_retries = max_retries.ok_or_else(|| run.missing("number_of_retries"))?;
        if run.child_count() != 2 {
            let count = run.child_count();
            return Err(run.error(format!("the node has {count} children, and must have two")));
        }
        run.set_running();
        while self.retries <= max_retries {
            if !self.is_recovering {
                match run.tick_child(0)? {
                    NodeStatus::Running => return Ok(NodeStatus::Running),
                    NodeStatus::Failure if self.retries < max_retries => {
                        run.halt_child(0)?;
                        self.is_recovering = true;
                    }
                    status => return self.end(run, status),
                }
            } else {
                match run.tick_child(1)? {
                    NodeStatus::Running => return Ok(NodeStatus::Running),
                    NodeStatus::Success => {
                        run.halt_child(1)?;
                        self.retries += 1;
                        self.is_recovering = false;
                    }
                    NodeStatus::Skipped => {
                        // The retries that were made still count.
                        self.is_recovering = false;
                        run.halt_child(1)?;
                        return Ok(NodeStatus::Failure);
                    }
                    status => return self.end(run, status),
                }
            }
        }
        self.end(run, NodeStatus::Failure)
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        *self = Self::default();
        Ok(())
    }
}

/// Ticks its children in turn: each success ends the call, and the next call begins with the next child. A
/// failure goes on to the next child at once.
///
/// Source: `round_robin_node.cpp`.
#[derive(Default)]
pub(super) struct RoundRobin {
    current: usize,
    failed: usize,
}

impl BehaviorNode for RoundRobin {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let count = run.child_count();
        let wraps = run.input_bool("wrap_around").unwrap_or_default();
        run.set_running();
        let mut skipped = 0;
        while self.failed + skipped < count {
            let status = run.tick_child(self.current)?;
            if status == NodeStatus::Running {
                return Ok(NodeStatus::Running);
            }
            self.current += 1;
            let is_last = self.current == count;
            if is_last && wraps {
                self.current = 0;
            }
            match status {
                NodeStatus::Failure => self.failed += 1,
                NodeStatus::Skipped => skipped += 1,
                // Without wrapping even the success of the last child is a failure.
                _ if is_last && !wraps => {}
                _ => {
                    self.failed = 0;
                    run.halt_children()?;
                    return Ok(NodeStatus::Success);
                }
            }
            if is_last && !wraps {
                break;
            }
        }
        *self = Self::default();
        run.halt_self()?;
        Ok(if skipped == count { NodeStatus::Skipped } else { NodeStatus::Failure })
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        *self = Self::default();
        Ok(())
    }
}
