//! `Timeout` and `Delay`, by the time of the ticks.

use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError};

/// One millisecond in nanoseconds.
pub(crate) const MILLISECOND_NS: i64 = 1_000_000;

/// Time of a port in milliseconds.
fn end_ns(run: &NodeRun<'_>, port: &str) -> Result<i64, TreeError> {
    let msec = run.input_i64(port).ok_or_else(|| run.missing(port))?;
    Ok(run.now_ns().saturating_add(msec.saturating_mul(MILLISECOND_NS)))
}

/// Fails and halts its child when it has been running for `msec`; 0 means no limit.
///
/// Source: `timeout_node.cpp`. Its timer fires between ticks; here the tick at or after that time fails.
#[derive(Default)]
pub(super) struct Timeout {
    /// End of the time; none before the first tick.
    end_ns: Option<i64>,
}

impl BehaviorNode for Timeout {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let end_ns = match self.end_ns {
            Some(end_ns) => end_ns,
            None => {
                run.set_running();
                let is_limited = run.input_i64("msec").ok_or_else(|| run.missing("msec"))? > 0;
                if is_limited { end_ns(run, "msec")? } else { i64::MAX }
            }
        };
        self.end_ns = Some(end_ns);
        if run.now_ns() >= end_ns && run.child_status(0) == NodeStatus::Running {
            run.halt_children()?;
            self.end_ns = None;
            return Ok(NodeStatus::Failure);
        }
        let status = run.tick_child(0)?;
        if status.is_completed() {
            self.end_ns = None;
            run.halt_children()?;
        }
        Ok(status)
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.end_ns = None;
        Ok(())
    }
}

/// Ticks its child `delay_msec` after its own first tick.
///
/// Source: `delay_node.cpp`.
#[derive(Default)]
pub(super) struct Delay {
    start_ns: Option<i64>,
}

impl BehaviorNode for Delay {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let start_ns = match self.start_ns {
            Some(start_ns) => start_ns,
            None => {
                run.set_running();
                end_ns(run, "delay_msec")?
            }
        };
        self.start_ns = Some(start_ns);
        if run.now_ns() < start_ns {
            return Ok(NodeStatus::Running);
        }
        let status = run.tick_child(0)?;
        if status.is_completed() {
            self.start_ns = None;
            run.halt_children()?;
        }
        Ok(status)
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.start_ns = None;
        Ok(())
    }
}
