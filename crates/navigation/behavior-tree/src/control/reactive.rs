//! `ReactiveSequence` and `ReactiveFallback`.

use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError};

/// Ticks its children from the first one each time. When one is running, all others are halted.
///
/// Source: `reactive_sequence.cpp`, `reactive_fallback.cpp`.
pub(super) struct Reactive {
    /// Status of a child after which the next one is ticked.
    next: NodeStatus,
}

impl Reactive {
    pub(super) const SEQUENCE: Self = Self { next: NodeStatus::Success };
    pub(super) const FALLBACK: Self = Self { next: NodeStatus::Failure };
}

impl BehaviorNode for Reactive {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let mut is_skipped = true;
        run.set_running();
        for child in 0..run.child_count() {
            let status = run.tick_child(child)?;
            is_skipped &= status == NodeStatus::Skipped;
            match status {
                NodeStatus::Skipped => run.halt_child(child)?,
                status if status == self.next => {}
                NodeStatus::Running => {
                    let others = (0..run.child_count()).filter(|other| *other != child);
                    others.into_iter().try_for_each(|other| run.halt_child(other))?;
                    return Ok(NodeStatus::Running);
                }
                status => {
                    run.halt_children()?;
                    return Ok(status);
                }
            }
        }
        run.halt_children()?;
        Ok(if is_skipped { NodeStatus::Skipped } else { self.next })
    }
}
