//! Behaviour of nodes, and their access to the tree while they are ticked.

use std::fmt;

use crate::tree::{NodeId, TreeCore};
use crate::value::{PortType, list_parts};
use crate::{NodeStatus, TreeValue};

/// Behaviour of a node.
///
/// A control node or decorator ticks its children through [`NodeRun`]; a leaf works on its ports.
pub trait BehaviorNode: Send {
    /// Executes the node once.
    ///
    /// # Errors
    /// When the tree cannot go on, such as a required port without a value; the tree then ends.
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError>;

    /// Stops a running node and resets its state. Its children are halted after this, and its status
    /// becomes idle.
    ///
    /// # Errors
    /// As for [`BehaviorNode::tick`].
    fn halt(&mut self, _run: &mut NodeRun<'_>) -> Result<(), TreeError> {
        Ok(())
    }
}

/// Fault during execution that ends a tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreeError {
    /// Path of the node: its name after those of the subtrees that contain it.
    pub node: String,
    /// Description of the fault.
    pub message: String,
}

impl fmt::Display for TreeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.node, self.message)
    }
}

impl std::error::Error for TreeError {}

/// Length and end of a path that a blackboard entry contains.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathGeometry {
    /// Number of poses.
    pub pose_count: usize,
    /// Sum of the distances between its poses \[m\].
    pub length_m: f64,
    /// Position of the last pose \[m\].
    pub end_position_m: [f64; 3],
    /// Position \[m\] and orientation (quaternion x, y, z, w) of the last pose.
    pub end_pose: [f64; 7],
}

/// Data about the robot that some nodes of Nav2 need. A tree without such nodes uses `()`.
pub trait TreeContext {
    /// Position of `robot_base_frame` in `global_frame` \[m\]; frames that are not given are those of the
    /// navigator. None while the transform is not available.
    fn robot_position_m(
        &mut self,
        _global_frame: Option<&str>,
        _robot_base_frame: Option<&str>,
    ) -> Option<[f64; 2]> {
        None
    }

    /// Speed of the robot by its odometry, smoothed \[m/s\].
    fn speed_m_s(&mut self) -> f64 {
        0.0
    }

    /// Geometry of a path on the blackboard; none if the value is not a path.
    fn path_geometry(&mut self, _path: &TreeValue) -> Option<PathGeometry> {
        None
    }
}

impl TreeContext for () {}

/// Access of a node to its tree during a tick.
pub struct NodeRun<'a> {
    pub(crate) core: &'a mut TreeCore,
    pub(crate) id: NodeId,
    pub(crate) now_ns: i64,
    pub(crate) context: &'a mut dyn TreeContext,
}

impl NodeRun<'_> {
    /// Time of the tick \[ns\].
    #[must_use]
    pub fn now_ns(&self) -> i64 {
        self.now_ns
    }

    /// Number of ticks of the tree up to this one. A node that is ticked each time sees consecutive numbers.
    #[must_use]
    pub fn tick_count(&self) -> u64 {
        self.core.tick_count
    }

    /// Data about the robot.
    pub fn context(&mut self) -> &mut dyn TreeContext {
        self.context
    }

    /// Name of the node: its attribute `name`, or else its type.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.core.config(self.id).name
    }

    /// Type of the node, such as `RateController`.
    #[must_use]
    pub fn type_name(&self) -> &str {
        &self.core.config(self.id).type_name
    }

    /// Error of this node.
    #[must_use]
    pub fn error(&self, message: impl Into<String>) -> TreeError {
        self.core.error(self.id, message)
    }

    /// Status of this node before the tick.
    #[must_use]
    pub fn status(&self) -> NodeStatus {
        self.core.status(self.id)
    }

    /// Marks this node as running before its children are ticked.
    pub fn set_running(&mut self) {
        self.core.set_status(self.id, NodeStatus::Running, self.now_ns);
    }

    /// Number of children.
    #[must_use]
    pub fn child_count(&self) -> usize {
        self.core.children(self.id).len()
    }

    /// Status of a child.
    #[must_use]
    pub fn child_status(&self, child: usize) -> NodeStatus {
        self.core.children(self.id).get(child).map_or(NodeStatus::Idle, |id| self.core.status(*id))
    }

    /// Ticks a child.
    ///
    /// # Errors
    /// The error of the child, or an error if there is no such child.
    pub fn tick_child(&mut self, child: usize) -> Result<NodeStatus, TreeError> {
        let Some(id) = self.core.children(self.id).get(child).copied() else {
            return Err(self.error(format!("the node has no child {child}")));
        };
        self.core.execute(id, self.now_ns, self.context)
    }

    /// Halts a child if it is running, and makes it idle.
    ///
    /// # Errors
    /// The error of the child.
    pub fn halt_child(&mut self, child: usize) -> Result<(), TreeError> {
        match self.core.children(self.id).get(child).copied() {
            Some(id) => self.core.halt_child(id, self.now_ns, self.context),
            None => Ok(()),
        }
    }

    /// Halts all children, in order, and makes them idle.
    ///
    /// # Errors
    /// The error of a child.
    pub fn halt_children(&mut self) -> Result<(), TreeError> {
        (0..self.child_count()).try_for_each(|child| self.halt_child(child))
    }

    /// Halts all children and makes this node idle, as a node does that halts itself.
    ///
    /// # Errors
    /// The error of a child.
    pub fn halt_self(&mut self) -> Result<(), TreeError> {
        self.halt_children()?;
        self.core.set_status(self.id, NodeStatus::Idle, self.now_ns);
        Ok(())
    }

    /// Requests another tick of the tree at once, in [`crate::BehaviorTree::tick`].
    pub fn wake_up(&mut self) {
        self.core.is_woken = true;
    }

    /// Text of a port as written in XML, or its default. None if it has neither.
    #[must_use]
    pub fn port_text(&self, port: &str) -> Option<&str> {
        self.core.config(self.id).ports.get(port).map(|port| &*port.text)
    }

    /// Name of the blackboard entry that a port refers to; none for literals.
    #[must_use]
    pub fn port_key(&self, port: &str) -> Option<&str> {
        self.core.config(self.id).ports.get(port)?.key.as_deref()
    }

    /// Value of an input port: the entry that it refers to, or its literal. None if the entry has no value,
    /// or the text is not a value of the port's type.
    #[must_use]
    pub fn input(&self, port: &str) -> Option<TreeValue> {
        self.core.input(self.id, port)
    }

    /// Input as a number.
    #[must_use]
    pub fn input_f64(&self, port: &str) -> Option<f64> {
        match self.input(port)? {
            TreeValue::Text(text) => PortType::real().parse(&text)?.as_f64(),
            value => value.as_f64(),
        }
    }

    /// Input as an integer.
    #[must_use]
    pub fn input_i64(&self, port: &str) -> Option<i64> {
        match self.input(port)? {
            TreeValue::Text(text) => PortType::int().parse(&text)?.as_i64(),
            value => value.as_i64(),
        }
    }

    /// Input as a truth value.
    #[must_use]
    pub fn input_bool(&self, port: &str) -> Option<bool> {
        self.input(port)?.as_bool()
    }

    /// Input as a text.
    #[must_use]
    pub fn input_text(&self, port: &str) -> Option<String> {
        self.input(port)?.to_text()
    }

    /// Input as an object of one type.
    #[must_use]
    pub fn input_object<T: Clone + 'static>(&self, port: &str) -> Option<T> {
        self.input(port)?.get::<T>().cloned()
    }

    /// Input as a list of texts, which semicolons separate.
    #[must_use]
    pub fn input_list(&self, port: &str) -> Option<Vec<String>> {
        match self.input(port)? {
            TreeValue::Object(object) => object.get::<Vec<String>>().cloned(),
            value => Some(list_parts(&value.to_text()?).map(str::to_owned).collect()),
        }
    }

    /// Input that the node cannot do without, by [`NodeRun::input`].
    ///
    /// # Errors
    /// When it has no value.
    pub fn required(&self, port: &str) -> Result<TreeValue, TreeError> {
        self.input(port).ok_or_else(|| self.missing(port))
    }

    /// Error of a port without a value.
    #[must_use]
    pub fn missing(&self, port: &str) -> TreeError {
        let what = match (self.port_text(port), self.port_key(port)) {
            (_, Some(key)) => format!("its blackboard entry `{key}` has no value"),
            (Some(text), _) => format!("`{text}` is not a value of its type"),
            (None, None) => format!("add an attribute `{port}`"),
        };
        self.error(format!("the port `{port}` has no value: {what}"))
    }

    /// Writes an output port; without effect if the port is not connected.
    ///
    /// # Errors
    /// When the entry has another type.
    pub fn set_output(&mut self, port: &str, value: impl Into<TreeValue>) -> Result<(), TreeError> {
        let config = self.core.config(self.id);
        let Some(key) = config.ports.get(port).and_then(|port| port.key.clone()) else {
            return Ok(());
        };
        self.set_entry(&key, value)
    }

    /// Value of a blackboard entry, in the subtree of this node.
    #[must_use]
    pub fn entry(&self, key: &str) -> Option<&TreeValue> {
        self.core.blackboard.get_in(self.core.config(self.id).board, key)
    }

    /// Number of writes of a blackboard entry; none if it does not exist.
    #[must_use]
    pub fn entry_sequence(&self, key: &str) -> Option<u64> {
        self.core.blackboard.sequence(self.core.config(self.id).board, key)
    }

    /// Sets a blackboard entry, in the subtree of this node.
    ///
    /// # Errors
    /// When the entry has another type.
    pub fn set_entry(&mut self, key: &str, value: impl Into<TreeValue>) -> Result<(), TreeError> {
        let board = self.core.config(self.id).board;
        let set = self.core.blackboard.set_in(board, key, value.into());
        set.map_err(|error| self.error(error.to_string()))
    }

    /// Removes a blackboard entry.
    pub fn unset_entry(&mut self, key: &str) {
        let board = self.core.config(self.id).board;
        self.core.blackboard.unset_in(board, key);
    }

    /// Input port, or the blackboard entry of the same name where the port is not connected.
    #[must_use]
    pub fn input_or_entry(&self, port: &str) -> Option<TreeValue> {
        match self.port_text(port) {
            Some(_) => self.input(port),
            None => self.entry(port).cloned(),
        }
    }

    /// Executes a script in the subtree of this node and returns its truth value.
    pub(crate) fn test_script(&mut self, script: &crate::Script) -> Result<bool, TreeError> {
        let board = self.core.config(self.id).board;
        let enums = self.core.enums.clone();
        let outcome = script.test_in(&mut self.core.blackboard, board, &enums);
        outcome.map_err(|error| self.error(format!("script `{}`: {error}", script.source())))
    }

    /// Executes a script in the subtree of this node.
    pub(crate) fn run_script(&mut self, script: &crate::Script) -> Result<TreeValue, TreeError> {
        let board = self.core.config(self.id).board;
        let enums = self.core.enums.clone();
        let outcome = script.run_in(&mut self.core.blackboard, board, &enums);
        outcome.map_err(|error| self.error(format!("script `{}`: {error}", script.source())))
    }
}
