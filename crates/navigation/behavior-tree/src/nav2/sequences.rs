//! `PipelineSequence`, `NonblockingSequence` and `PersistentSequence`.

use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError, TreeValue};

/// Sequence that ticks all earlier children again. A running child ends the tick unless a later one was
/// reached before.
///
/// Source: `pipeline_sequence.cpp`.
#[derive(Default)]
pub(super) struct PipelineSequence {
    furthest: usize,
}

impl BehaviorNode for PipelineSequence {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let mut skipped = 0;
        for child in 0..run.child_count() {
            match run.tick_child(child)? {
                NodeStatus::Failure => {
                    run.halt_children()?;
                    self.furthest = 0;
                    return Ok(NodeStatus::Failure);
                }
                NodeStatus::Running if child >= self.furthest => {
                    self.furthest = child;
                    return Ok(NodeStatus::Running);
                }
                NodeStatus::Skipped => skipped += 1,
                _ => {}
            }
        }
        run.halt_children()?;
        self.furthest = 0;
        let is_skipped = skipped == run.child_count();
        Ok(if is_skipped { NodeStatus::Skipped } else { NodeStatus::Success })
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.furthest = 0;
        Ok(())
    }
}

/// Sequence that ticks all children each time, also behind a running one. Done when all succeed.
///
/// Source: `nonblocking_sequence.cpp`.
pub(super) struct NonblockingSequence;

impl BehaviorNode for NonblockingSequence {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let mut is_done = true;
        for child in 0..run.child_count() {
            match run.tick_child(child)? {
                NodeStatus::Failure => {
                    run.halt_children()?;
                    return Ok(NodeStatus::Failure);
                }
                NodeStatus::Running => is_done = false,
                NodeStatus::Skipped => return Err(run.error("a child must not be skipped")),
                _ => {}
            }
        }
        if !is_done {
            return Ok(NodeStatus::Running);
        }
        run.halt_children()?;
        Ok(NodeStatus::Success)
    }
}

/// Sequence whose index is a blackboard entry, so that it survives a halt.
///
/// Source: `persistent_sequence.cpp`.
pub(super) struct PersistentSequence;

const INDEX: &str = "current_child_idx";

impl BehaviorNode for PersistentSequence {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let index = run.input_i64(INDEX).ok_or_else(|| run.missing(INDEX))?;
        let mut index = usize::try_from(index)
            .map_err(|_| run.error(format!("`{INDEX}` is {index}, and must not be negative")))?;
        run.set_running();
        while index < run.child_count() {
            match run.tick_child(index)? {
                NodeStatus::Running => return Ok(NodeStatus::Running),
                NodeStatus::Failure => {
                    run.halt_children()?;
                    run.set_output(INDEX, TreeValue::Int(0))?;
                    return Ok(NodeStatus::Failure);
                }
                _ => {
                    index += 1;
                    let number = i64::try_from(index).unwrap_or_default();
                    run.set_output(INDEX, TreeValue::Int(number))?;
                }
            }
        }
        run.halt_children()?;
        run.set_output(INDEX, TreeValue::Int(0))?;
        Ok(NodeStatus::Success)
    }
}
