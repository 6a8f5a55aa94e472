//! `Sequence`, `Fallback`, and their variants.

use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError};

/// Variant of a sequence.
#[derive(Clone, Copy)]
pub(super) struct OnEnd {
    /// Status of a child after which the next child is ticked; it is also the status after the last.
    next: NodeStatus,
    /// Returns after each child that finishes at once, and requests another tick.
    yields: bool,
    /// Resumes at the child that failed.
    has_memory: bool,
}

impl OnEnd {
    /// Sequence: the next child after success.
    pub(super) const SUCCESS: Self =
        Self { next: NodeStatus::Success, yields: false, has_memory: false };
    /// Fallback: the next child after failure.
    pub(super) const FALLBACK: Self =
        Self { next: NodeStatus::Failure, yields: false, has_memory: false };

    pub(super) fn yielding(self) -> Self {
        Self { yields: true, ..self }
    }

    pub(super) fn with_memory(self) -> Self {
        Self { has_memory: true, ..self }
    }
}

/// Ticks its children one after the other; a running child is resumed.
///
/// Source: `sequence_node.cpp`, `fallback_node.cpp`, `sequence_with_memory_node.cpp`.
pub(super) struct Sequence {
    variant: OnEnd,
    current: usize,
    skipped: usize,
}

impl Sequence {
    pub(super) fn new(variant: OnEnd) -> Self {
        Self { variant, current: 0, skipped: 0 }
    }
}

impl BehaviorNode for Sequence {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let count = run.child_count();
        if !run.status().is_active() {
            self.skipped = 0;
        }
        run.set_running();
        while self.current < count {
            let was_idle = run.child_status(self.current) == NodeStatus::Idle;
            match run.tick_child(self.current)? {
                NodeStatus::Skipped => {
                    self.current += 1;
                    self.skipped += 1;
                }
                status if status == self.variant.next => {
                    self.current += 1;
                    if self.variant.yields && was_idle && self.current < count {
                        run.wake_up();
                        return Ok(NodeStatus::Running);
                    }
                }
                NodeStatus::Running => return Ok(NodeStatus::Running),
                status if self.variant.has_memory => {
                    (self.current..count).try_for_each(|child| run.halt_child(child))?;
                    return Ok(status);
                }
                status => {
                    run.halt_children()?;
                    self.current = 0;
                    return Ok(status);
                }
            }
        }
        let is_skipped = self.skipped == count;
        run.halt_children()?;
        (self.current, self.skipped) = (0, 0);
        Ok(if is_skipped { NodeStatus::Skipped } else { self.variant.next })
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        if !self.variant.has_memory {
            (self.current, self.skipped) = (0, 0);
        }
        Ok(())
    }
}
