//! Actions and conditions of BehaviorTree.CPP.

use crate::decorator::MILLISECOND_NS;
use crate::script::Script;
use crate::value::PortType;
use crate::{BehaviorNode, NodeKind, NodeModel, NodeRegistry, NodeRun, NodeStatus, TreeError};

pub(crate) fn register(registry: &mut NodeRegistry) {
    let action = |name: &str| NodeModel::new(name, NodeKind::Action);
    registry.register_leaf(action("AlwaysSuccess"), |_| Ok(NodeStatus::Success));
    registry.register_leaf(action("AlwaysFailure"), |_| Ok(NodeStatus::Failure));
    let sleep = action("Sleep").input("msec", PortType::int());
    registry.register(sleep, Sleep::default);
    let set =
        action("SetBlackboard").input("value", PortType::Any).in_out("output_key", PortType::Any);
    registry.register_leaf(set, set_blackboard);
    let unset = action("UnsetBlackboard").input("key", PortType::Text);
    registry.register_leaf(unset, |run| {
        let key = run.input_text("key").ok_or_else(|| run.missing("key"))?;
        run.unset_entry(&key);
        Ok(NodeStatus::Success)
    });
    let script = action("Script").input("code", PortType::Text);
    registry.register(script, || ScriptNode { script: None, is_condition: false });
    let condition =
        NodeModel::new("ScriptCondition", NodeKind::Condition).input("code", PortType::Text);
    registry.register(condition, || ScriptNode { script: None, is_condition: true });
    let updated = action("WasEntryUpdated").input("entry", PortType::Any);
    registry.register(updated, WasEntryUpdated::default);
}

/// Copies a value into an entry. The entry may be written as a name, or in braces.
///
/// Source: `set_blackboard_node.h`.
fn set_blackboard(run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
    let key = run.port_key("output_key").or(run.port_text("output_key"));
    let key = key.ok_or_else(|| run.missing("output_key"))?.to_owned();
    let value = run.required("value")?;
    run.set_entry(&key, value)?;
    Ok(NodeStatus::Success)
}

/// Parses a script unless it is the one that was parsed last.
pub(crate) fn parsed<'a>(
    run: &NodeRun<'_>,
    cache: &'a mut Option<Script>,
    source: &str,
) -> Result<&'a Script, TreeError> {
    if cache.as_ref().is_none_or(|script| script.source() != source) {
        let script = Script::parse(source);
        *cache = Some(script.map_err(|error| run.error(format!("script `{source}`: {error}")))?);
    }
    cache.as_ref().ok_or_else(|| run.missing("code"))
}

/// `Script` and `ScriptCondition`.
struct ScriptNode {
    script: Option<Script>,
    is_condition: bool,
}

impl BehaviorNode for ScriptNode {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let source = run.input_text("code").ok_or_else(|| run.missing("code"))?;
        let script = parsed(run, &mut self.script, &source)?;
        if !self.is_condition {
            run.run_script(script)?;
            return Ok(NodeStatus::Success);
        }
        Ok(if run.test_script(script)? { NodeStatus::Success } else { NodeStatus::Failure })
    }
}

/// `Sleep`: runs for `msec`.
#[derive(Default)]
struct Sleep {
    end_ns: i64,
}

impl BehaviorNode for Sleep {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        if run.status() != NodeStatus::Running {
            let msec = run.input_i64("msec").ok_or_else(|| run.missing("msec"))?;
            self.end_ns = run.now_ns().saturating_add(msec.saturating_mul(MILLISECOND_NS));
        }
        let is_over = run.now_ns() >= self.end_ns;
        Ok(if is_over { NodeStatus::Success } else { NodeStatus::Running })
    }
}

/// `WasEntryUpdated`: succeeds when an entry was written since the last tick.
///
/// Source: `updated_action.cpp`.
#[derive(Default)]
struct WasEntryUpdated {
    sequence: u64,
}

impl BehaviorNode for WasEntryUpdated {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let key = run.port_key("entry").or(run.port_text("entry"));
        let key = key.ok_or_else(|| run.missing("entry"))?;
        let sequence = run.entry_sequence(key).unwrap_or(self.sequence);
        let is_new = std::mem::replace(&mut self.sequence, sequence) != sequence;
        Ok(if is_new { NodeStatus::Success } else { NodeStatus::Failure })
    }
}
