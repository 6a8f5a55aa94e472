//! Executable trees.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_diagnostics::Origin;

use crate::blackboard::Blackboard;
use crate::node::{BehaviorNode, NodeRun, TreeContext, TreeError};
use crate::registry::Parsers;
use crate::script::{Script, ScriptEnums};
use crate::value::PortType;
use crate::{NodeKind, NodeStatus, TreeValue};

/// Maximum number of ticks in one call of [`BehaviorTree::tick`] that nodes request by a wake-up. A loop of
/// children that finish at once continues in the next call.
pub const MAX_WAKE_UP_COUNT: usize = 1_000;
/// Maximum number of status changes that are kept until they are fetched; older ones are dropped.
pub const MAX_STATUS_CHANGE_COUNT: usize = 10_000;

/// Index of a node in its tree.
pub(crate) type NodeId = usize;

/// Change of the status of a node.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StatusChange {
    /// Time \[ns\].
    pub time_ns: i64,
    /// Number of the node in its tree, from 1 in depth-first order.
    pub uid: u16,
    /// Name of the node.
    pub node: Arc<str>,
    /// Status before.
    pub previous: NodeStatus,
    /// Status after.
    pub current: NodeStatus,
}

/// Node of a tree as users see it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreeNodeInfo {
    /// Number in the tree, from 1 in depth-first order.
    pub uid: u16,
    /// Name: the attribute `name`, or else the type.
    pub name: Arc<str>,
    /// Type, such as `RateController`.
    pub type_name: Arc<str>,
    /// Kind.
    pub kind: NodeKind,
    /// Number of nodes above it.
    pub depth: usize,
    /// Status.
    pub status: NodeStatus,
}

/// Port of a node in a tree.
#[derive(Clone, Debug)]
pub(crate) struct PortUse {
    /// Text in XML, or the default.
    pub(crate) text: Arc<str>,
    /// Name of the entry for `{name}`.
    pub(crate) key: Option<Arc<str>>,
    pub(crate) port_type: PortType,
}

/// Configuration of a node.
#[derive(Debug)]
pub(crate) struct NodeConfig {
    pub(crate) name: Arc<str>,
    pub(crate) type_name: Arc<str>,
    pub(crate) path: String,
    pub(crate) kind: NodeKind,
    pub(crate) depth: usize,
    pub(crate) ports: BTreeMap<String, PortUse>,
    pub(crate) board: usize,
    /// `_failureIf`, `_successIf`, `_skipIf`, `_while`.
    pub(crate) before: [Option<Script>; 4],
    /// `_onHalted`, `_onFailure`, `_onSuccess`, `_post`.
    pub(crate) after: [Option<Script>; 4],
    pub(crate) origin: Origin,
}

pub(crate) struct Slot {
    pub(crate) config: NodeConfig,
    pub(crate) children: Vec<NodeId>,
    /// None while it is being ticked.
    pub(crate) behavior: Option<Box<dyn BehaviorNode>>,
    pub(crate) status: NodeStatus,
}

/// State of a tree that nodes work on.
pub(crate) struct TreeCore {
    /// Nodes in depth-first order; the root is the first.
    pub(crate) nodes: Vec<Slot>,
    pub(crate) blackboard: Blackboard,
    pub(crate) enums: Arc<ScriptEnums>,
    pub(crate) parsers: Arc<Parsers>,
    pub(crate) changes: std::collections::VecDeque<StatusChange>,
    pub(crate) is_woken: bool,
    /// Number of ticks of the root.
    pub(crate) tick_count: u64,
}

/// Executable tree.
///
/// The caller ticks it with its time; it has no clock.
pub struct BehaviorTree {
    pub(crate) core: TreeCore,
    pub(crate) id: String,
}

impl BehaviorTree {
    /// Ticks the tree: once, and again as long as nodes request it by a wake-up, as `tickOnce` does.
    ///
    /// # Errors
    /// When a node cannot go on.
    pub fn tick(
        &mut self,
        now_ns: i64,
        context: &mut dyn TreeContext,
    ) -> Result<NodeStatus, TreeError> {
        let core = &mut self.core;
        let mut status = NodeStatus::Idle;
        for _ in 0..MAX_WAKE_UP_COUNT {
            core.is_woken = false;
            core.tick_count += 1;
            status = core.execute(0, now_ns, context)?;
            if status != NodeStatus::Running || !core.is_woken {
                break;
            }
        }
        if status.is_completed() {
            core.set_status(0, NodeStatus::Idle, now_ns);
        }
        Ok(status)
    }

    /// Halts all nodes that are running.
    ///
    /// # Errors
    /// When a node or its script `_onHalted` cannot go on.
    pub fn halt(&mut self, now_ns: i64, context: &mut dyn TreeContext) -> Result<(), TreeError> {
        let mut outcome = self.core.halt_node(0, now_ns, context);
        // After an error a child can be running below a node that is not.
        for id in 0..self.core.nodes.len() {
            if self.core.status(id) == NodeStatus::Running {
                outcome = outcome.and(self.core.halt_node(id, now_ns, context));
            }
        }
        outcome
    }

    /// ID of the main tree.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Blackboard of the tree.
    #[must_use]
    pub fn blackboard(&self) -> &Blackboard {
        &self.core.blackboard
    }

    /// Blackboard of the tree, to set entries of the root.
    pub fn blackboard_mut(&mut self) -> &mut Blackboard {
        &mut self.core.blackboard
    }

    /// All nodes with their status, in depth-first order.
    pub fn nodes(&self) -> impl Iterator<Item = TreeNodeInfo> + '_ {
        self.core.nodes.iter().enumerate().map(|(id, slot)| TreeNodeInfo {
            uid: uid(id),
            name: slot.config.name.clone(),
            type_name: slot.config.type_name.clone(),
            kind: slot.config.kind,
            depth: slot.config.depth,
            status: slot.status,
        })
    }

    /// Leaves that are running, in depth-first order.
    pub fn running_leaves(&self) -> impl Iterator<Item = TreeNodeInfo> + '_ {
        self.nodes().filter(|node| node.status == NodeStatus::Running && node.kind.is_leaf())
    }

    /// Returns the status changes since the last call, oldest first; at most [`MAX_STATUS_CHANGE_COUNT`].
    pub fn take_status_changes(&mut self) -> Vec<StatusChange> {
        self.core.changes.drain(..).collect()
    }
}

impl std::fmt::Debug for BehaviorTree {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BehaviorTree").field("id", &self.id).finish_non_exhaustive()
    }
}

fn uid(id: NodeId) -> u16 {
    u16::try_from(id + 1).unwrap_or(u16::MAX)
}

/// Indices in [`NodeConfig::before`].
const FAILURE_IF: usize = 0;
const SUCCESS_IF: usize = 1;
const SKIP_IF: usize = 2;
const WHILE: usize = 3;
/// Indices in [`NodeConfig::after`].
const ON_HALTED: usize = 0;
const ON_FAILURE: usize = 1;
const ON_SUCCESS: usize = 2;
const POST: usize = 3;

impl TreeCore {
    pub(crate) fn config(&self, id: NodeId) -> &NodeConfig {
        &self.nodes[id].config
    }

    pub(crate) fn children(&self, id: NodeId) -> &[NodeId] {
        &self.nodes[id].children
    }

    pub(crate) fn status(&self, id: NodeId) -> NodeStatus {
        self.nodes[id].status
    }

    pub(crate) fn error(&self, id: NodeId, message: impl Into<String>) -> TreeError {
        TreeError { node: self.config(id).path.clone(), message: message.into() }
    }

    pub(crate) fn set_status(&mut self, id: NodeId, current: NodeStatus, time_ns: i64) {
        let slot = &mut self.nodes[id];
        let previous = std::mem::replace(&mut slot.status, current);
        if previous == current {
            return;
        }
        if self.changes.len() >= MAX_STATUS_CHANGE_COUNT {
            self.changes.pop_front();
        }
        let node = slot.config.name.clone();
        self.changes.push_back(StatusChange { time_ns, uid: uid(id), node, previous, current });
    }

    /// Ticks a node with its conditions. Source: `TreeNode::executeTick`.
    pub(crate) fn execute(
        &mut self,
        id: NodeId,
        now_ns: i64,
        context: &mut dyn TreeContext,
    ) -> Result<NodeStatus, TreeError> {
        let status = match self.check_before(id, now_ns, context)? {
            Some(status) => status,
            None => self.tick_behavior(id, now_ns, context)?,
        };
        if status.is_completed() {
            let on = if status == NodeStatus::Success { ON_SUCCESS } else { ON_FAILURE };
            self.run_after(id, on)?;
            self.run_after(id, POST)?;
        }
        if status != NodeStatus::Skipped {
            self.set_status(id, status, now_ns);
        }
        let has_one_child = matches!(self.config(id).kind, NodeKind::Decorator | NodeKind::SubTree);
        if has_one_child && let Some(&child) = self.children(id).first() {
            // A decorator never leaves a completed child behind.
            if self.status(child).is_completed() {
                self.set_status(child, NodeStatus::Idle, now_ns);
            }
        }
        Ok(status)
    }

    fn tick_behavior(
        &mut self,
        id: NodeId,
        now_ns: i64,
        context: &mut dyn TreeContext,
    ) -> Result<NodeStatus, TreeError> {
        let Some(mut behavior) = self.nodes[id].behavior.take() else {
            return Err(self.error(id, "the node is ticked while it is being ticked"));
        };
        let outcome = behavior.tick(&mut NodeRun { core: self, id, now_ns, context });
        self.nodes[id].behavior = Some(behavior);
        match outcome? {
            NodeStatus::Idle => Err(self.error(id, "a node must not return IDLE")),
            status => Ok(status),
        }
    }

    fn check_before(
        &mut self,
        id: NodeId,
        now_ns: i64,
        context: &mut dyn TreeContext,
    ) -> Result<Option<NodeStatus>, TreeError> {
        let status = self.status(id);
        let outcomes = [
            (FAILURE_IF, NodeStatus::Failure),
            (SUCCESS_IF, NodeStatus::Success),
            (SKIP_IF, NodeStatus::Skipped),
        ];
        if !status.is_active() {
            for (index, outcome) in outcomes {
                if self.test_before(id, index)? == Some(true) {
                    return Ok(Some(outcome));
                }
            }
            if self.test_before(id, WHILE)? == Some(false) {
                return Ok(Some(NodeStatus::Skipped));
            }
        } else if status == NodeStatus::Running && self.test_before(id, WHILE)? == Some(false) {
            self.halt_node(id, now_ns, context)?;
            return Ok(Some(NodeStatus::Skipped));
        }
        Ok(None)
    }

    fn test_before(&mut self, id: NodeId, index: usize) -> Result<Option<bool>, TreeError> {
        let config = &self.nodes[id].config;
        let Some(script) = &config.before[index] else { return Ok(None) };
        match script.test_in(&mut self.blackboard, config.board, &self.enums) {
            Ok(holds) => Ok(Some(holds)),
            Err(error) => Err(self.error(id, error.message)),
        }
    }

    fn run_after(&mut self, id: NodeId, index: usize) -> Result<(), TreeError> {
        let config = &self.nodes[id].config;
        let Some(script) = &config.after[index] else { return Ok(()) };
        match script.run_in(&mut self.blackboard, config.board, &self.enums) {
            Ok(_) => Ok(()),
            Err(error) => Err(self.error(id, error.message)),
        }
    }

    /// Halts a node: its own state, then its children, then its script.
    pub(crate) fn halt_node(
        &mut self,
        id: NodeId,
        now_ns: i64,
        context: &mut dyn TreeContext,
    ) -> Result<(), TreeError> {
        let mut outcome = Ok(());
        if let Some(mut behavior) = self.nodes[id].behavior.take() {
            outcome = behavior.halt(&mut NodeRun { core: self, id, now_ns, context });
            self.nodes[id].behavior = Some(behavior);
        }
        for index in 0..self.children(id).len() {
            // Also after an error: no action may go on.
            let child = self.children(id)[index];
            outcome = outcome.and(self.halt_child(child, now_ns, context));
        }
        self.set_status(id, NodeStatus::Idle, now_ns);
        outcome.and(self.run_after(id, ON_HALTED))
    }

    /// Halts a child if it is running, and makes it idle.
    pub(crate) fn halt_child(
        &mut self,
        id: NodeId,
        now_ns: i64,
        context: &mut dyn TreeContext,
    ) -> Result<(), TreeError> {
        let outcome = match self.status(id) {
            NodeStatus::Running => self.halt_node(id, now_ns, context),
            _ => Ok(()),
        };
        self.set_status(id, NodeStatus::Idle, now_ns);
        outcome
    }

    pub(crate) fn input(&self, id: NodeId, port: &str) -> Option<TreeValue> {
        let config = self.config(id);
        let port = config.ports.get(port)?;
        let value = match &port.key {
            Some(key) => self.blackboard.get_in(config.board, key)?.clone(),
            None => TreeValue::Text(port.text.clone()),
        };
        match (&value, &port.port_type) {
            (TreeValue::Text(text), PortType::Object(name)) => self.parsers.get(&**name)?(text),
            (TreeValue::Text(text), port_type) => port_type.parse(text),
            _ => Some(value),
        }
    }
}
