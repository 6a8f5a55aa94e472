//! `TryCatch`.

use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError};

/// Ticks all children but the last as a sequence; after a failure the last one cleans up, and the node
/// fails.
///
/// Source: `try_catch_node.cpp`.
#[derive(Default)]
pub(super) struct TryCatch {
    current: usize,
    skipped: usize,
    is_catching: bool,
}

impl TryCatch {
    fn catch(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        if run.tick_child(run.child_count() - 1)? == NodeStatus::Running {
            return Ok(NodeStatus::Running);
        }
        run.halt_children()?;
        *self = Self::default();
        Ok(NodeStatus::Failure)
    }
}

impl BehaviorNode for TryCatch {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let count = run.child_count();
        if count < 2 {
            return Err(run.error("the node needs at least two children"));
        }
        if !run.status().is_active() {
            (self.skipped, self.is_catching) = (0, false);
        }
        run.set_running();
        if self.is_catching {
            return self.catch(run);
        }
        while self.current < count - 1 {
            match run.tick_child(self.current)? {
                NodeStatus::Running => return Ok(NodeStatus::Running),
                NodeStatus::Failure => {
                    run.halt_children()?;
                    (self.current, self.is_catching) = (0, true);
                    return self.catch(run);
                }
                status => {
                    self.current += 1;
                    self.skipped += usize::from(status == NodeStatus::Skipped);
                }
            }
        }
        let is_skipped = self.skipped == count - 1;
        run.halt_children()?;
        *self = Self::default();
        Ok(if is_skipped { NodeStatus::Skipped } else { NodeStatus::Success })
    }

    fn halt(&mut self, run: &mut NodeRun<'_>) -> Result<(), TreeError> {
        let last = run.child_count().saturating_sub(1);
        let catches = run.input_bool("catch_on_halt").unwrap_or_default();
        let outcome = if catches && !self.is_catching && run.status().is_active() && last > 0 {
            let halted = (0..last).try_for_each(|child| run.halt_child(child));
            // The parent halts it if it is running.
            halted.and_then(|()| run.tick_child(last)).map(drop)
        } else {
            Ok(())
        };
        *self = Self::default();
        outcome
    }
}
