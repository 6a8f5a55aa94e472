//! `Repeat` and `RetryUntilSuccessful`.

use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError};

/// Number of a port that means "without end".
const ENDLESS: i64 = -1;

/// Repeats its child until it has succeeded `num_cycles` times, or fails.
///
/// Source: `repeat_node.cpp`.
#[derive(Default)]
pub(super) struct Repeat {
    count: i64,
}

/// Repeats its child until it succeeds, or has failed `num_attempts` times.
///
/// Source: `retry_node.cpp`.
#[derive(Default)]
pub(super) struct Retry {
    count: i64,
}

/// Ticks the child while the count is below the limit of the port; `again` is the status that counts.
fn repeated(
    count: &mut i64,
    again: NodeStatus,
    port: &str,
    run: &mut NodeRun<'_>,
) -> Result<NodeStatus, TreeError> {
    let limit = |run: &NodeRun<'_>| run.input_i64(port).ok_or_else(|| run.missing(port));
    let mut goes_on = limit(run)? == ENDLESS || *count < limit(run)?;
    run.set_running();
    while goes_on {
        let was_idle = run.child_status(0) == NodeStatus::Idle;
        match run.tick_child(0)? {
            NodeStatus::Running => return Ok(NodeStatus::Running),
            NodeStatus::Skipped => {
                run.halt_children()?;
                return Ok(NodeStatus::Skipped);
            }
            status if status == again => {
                *count = count.saturating_add(1);
                goes_on = limit(run)? == ENDLESS || *count < limit(run)?;
                run.halt_children()?;
                if was_idle && goes_on {
                    run.wake_up();
                    return Ok(NodeStatus::Running);
                }
            }
            status => {
                *count = 0;
                run.halt_children()?;
                return Ok(status);
            }
        }
    }
    *count = 0;
    Ok(again)
}

impl BehaviorNode for Repeat {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        repeated(&mut self.count, NodeStatus::Success, "num_cycles", run)
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.count = 0;
        Ok(())
    }
}

impl BehaviorNode for Retry {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        repeated(&mut self.count, NodeStatus::Failure, "num_attempts", run)
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.count = 0;
        Ok(())
    }
}
