//! `SkipUnlessUpdated` and `WaitValueUpdate`.

use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError};

/// Ticks its child when an entry was written since the last tick.
///
/// Source: `updated_decorator.cpp`.
pub(super) struct UnlessUpdated {
    otherwise: NodeStatus,
    sequence: u64,
    is_running: bool,
}

impl UnlessUpdated {
    pub(super) fn new(otherwise: NodeStatus) -> Self {
        Self { otherwise, sequence: 0, is_running: false }
    }
}

impl BehaviorNode for UnlessUpdated {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        if !self.is_running {
            let key = run.port_key("entry").or(run.port_text("entry"));
            let key = key.ok_or_else(|| run.missing("entry"))?;
            let sequence = run.entry_sequence(key).unwrap_or(self.sequence);
            if sequence == self.sequence {
                return Ok(self.otherwise);
            }
            self.sequence = sequence;
        }
        let status = run.tick_child(0)?;
        self.is_running = status == NodeStatus::Running;
        Ok(status)
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.is_running = false;
        Ok(())
    }
}
