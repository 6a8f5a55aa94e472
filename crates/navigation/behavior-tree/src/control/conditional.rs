//! `IfThenElse`, `WhileDoElse` and `Switch`.

use crate::script::ScriptEnums;
use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError};

fn check_count(run: &NodeRun<'_>) -> Result<(), TreeError> {
    match run.child_count() {
        2 | 3 => Ok(()),
        count => Err(run.error(format!("the node has {count} children, and must have 2 or 3"))),
    }
}

/// Ticks the second child if the first succeeded, and the third otherwise. The condition is not checked
/// again while the chosen child is running.
///
/// Source: `if_then_else_node.cpp`.
#[derive(Default)]
pub(super) struct IfThenElse {
    chosen: usize,
}

impl BehaviorNode for IfThenElse {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        check_count(run)?;
        run.set_running();
        if self.chosen == 0 {
            self.chosen = match run.tick_child(0)? {
                NodeStatus::Success => 1,
                NodeStatus::Failure if run.child_count() == 3 => 2,
                status => return Ok(status),
            };
        }
        let status = run.tick_child(self.chosen)?;
        if status != NodeStatus::Running {
            run.halt_children()?;
            self.chosen = 0;
        }
        Ok(status)
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.chosen = 0;
        Ok(())
    }
}

/// As [`IfThenElse`], but the condition is checked at each tick.
///
/// Source: `while_do_else_node.cpp`.
pub(super) struct WhileDoElse;

impl BehaviorNode for WhileDoElse {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        check_count(run)?;
        run.set_running();
        let has_else = run.child_count() == 3;
        let status = match run.tick_child(0)? {
            NodeStatus::Success => {
                run.halt_child(2)?;
                run.tick_child(1)?
            }
            NodeStatus::Failure if has_else => {
                run.halt_child(1)?;
                run.tick_child(2)?
            }
            NodeStatus::Running => return Ok(NodeStatus::Running),
            status => status,
        };
        if status != NodeStatus::Running {
            run.halt_children()?;
        }
        Ok(status)
    }
}

/// Ticks the child of the case that equals the variable; the last child is the default.
///
/// Source: `switch_node.cpp`.
pub(super) struct Switch {
    cases: usize,
    running: Option<usize>,
}

impl Switch {
    pub(super) fn new(cases: usize) -> Self {
        Self { cases, running: None }
    }

    fn matching(&self, run: &NodeRun<'_>) -> usize {
        let Some(variable) = run.input_text("variable") else { return self.cases };
        let is_case = |case: &usize| {
            let value = run.input_text(&format!("case_{}", case + 1));
            value.is_some_and(|value| are_equal(&variable, &value, &run.core.enums))
        };
        (0..self.cases).find(is_case).unwrap_or(self.cases)
    }
}

/// Compares texts, and as numbers if both are numbers or names of enumerations.
fn are_equal(a: &str, b: &str, enums: &ScriptEnums) -> bool {
    #[allow(clippy::cast_precision_loss, reason = "enumerations are small")]
    let number = |text: &str| match enums.get(text) {
        Some(number) => Some(*number as f64),
        None => text.parse::<f64>().ok(),
    };
    a == b
        || matches!((number(a), number(b)),
            (Some(a), Some(b)) if (a - b).abs() <= f64::from(f32::EPSILON))
}

impl BehaviorNode for Switch {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        if run.child_count() != self.cases + 1 {
            let (cases, count) = (self.cases, run.child_count());
            return Err(run.error(format!(
                "the node has {count} children, and must have {cases} for its cases and one default"
            )));
        }
        let matching = self.matching(run);
        if let Some(running) = self.running.filter(|running| *running != matching) {
            run.halt_child(running)?;
        }
        let status = run.tick_child(matching)?;
        self.running = (status == NodeStatus::Running).then_some(matching);
        if status.is_completed() {
            run.halt_children()?;
        }
        Ok(status)
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.running = None;
        Ok(())
    }
}
