//! Registry of nodes by name.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::node::{BehaviorNode, NodeRun};
use crate::script::ScriptEnums;
use crate::{NodeModel, NodeStatus, TreeError, TreeValue};

type Build = dyn Fn() -> Box<dyn BehaviorNode> + Send + Sync;
type ParseText = dyn Fn(&str) -> Option<TreeValue> + Send + Sync;

/// Conversions of literals of object types, by the name of the type.
pub(crate) type Parsers = BTreeMap<String, Arc<ParseText>>;

/// Nodes that trees may use, by name.
///
/// [`NodeRegistry::new`] has those of BehaviorTree.CPP; [`crate::nav2::register`] adds the nodes of Nav2 that
/// need no ROS. A node is a type that implements [`BehaviorNode`]; a leaf without a state can be a
/// closure:
///
/// ```
/// use periplus_behavior_tree::{
///     BehaviorTree, Blackboard, NodeKind, NodeModel, NodeRegistry, NodeStatus, PortType, TreeFiles,
/// };
///
/// let mut registry = NodeRegistry::new();
/// let model = NodeModel::new("IsCharged", NodeKind::Condition).input("level", PortType::real());
/// registry.register_leaf(model, |run| {
///     let level = run.input_f64("level").unwrap_or(0.0);
///     Ok(if level > 0.2 { NodeStatus::Success } else { NodeStatus::Failure })
/// });
///
/// let xml = r#"<root BTCPP_format="4"><BehaviorTree ID="Main">
///   <IsCharged level="{battery}"/>
/// </BehaviorTree></root>"#;
/// let files = TreeFiles::parse("main.xml", xml, &registry);
/// assert!(files.diagnostics.is_empty());
/// let mut tree = files.tree("", &registry, Blackboard::new()).unwrap();
/// tree.blackboard_mut().set("battery", 0.5).unwrap();
/// assert_eq!(tree.tick(0, &mut ()), Ok(NodeStatus::Success));
/// ```
#[derive(Clone)]
pub struct NodeRegistry {
    nodes: BTreeMap<String, Registered>,
    pub(crate) enums: Arc<ScriptEnums>,
    pub(crate) parsers: Arc<Parsers>,
}

#[derive(Clone)]
pub(crate) struct Registered {
    pub(crate) model: Arc<NodeModel>,
    pub(crate) build: Arc<Build>,
}

impl Default for NodeRegistry {
    fn default() -> Self {
        Self::new()
    }
}

impl NodeRegistry {
    /// Returns a registry with the nodes of BehaviorTree.CPP.
    #[must_use]
    pub fn new() -> Self {
        let mut registry =
            Self { nodes: BTreeMap::new(), enums: Arc::default(), parsers: Arc::default() };
        crate::control::register(&mut registry);
        crate::decorator::register(&mut registry);
        crate::action::register(&mut registry);
        registry
    }

    /// Registers a node; it replaces an earlier one of the name. `build` is called for each use in a tree.
    pub fn register<N: BehaviorNode + 'static>(
        &mut self,
        model: NodeModel,
        build: impl Fn() -> N + Send + Sync + 'static,
    ) {
        let name = model.name.clone();
        let build = Arc::new(move || -> Box<dyn BehaviorNode> { Box::new(build()) });
        self.nodes.insert(name, Registered { model: Arc::new(model), build });
    }

    /// Registers a leaf that is a function of its inputs.
    pub fn register_leaf(
        &mut self,
        model: NodeModel,
        tick: impl Fn(&mut NodeRun<'_>) -> Result<NodeStatus, TreeError> + Clone + Send + Sync + 'static,
    ) {
        self.register(model, move || Leaf(tick.clone()));
    }

    /// Registers a name of an enumeration for scripts.
    pub fn register_enum(&mut self, name: &str, value: i64) {
        Arc::make_mut(&mut self.enums).insert(name.to_owned(), value);
    }

    /// Registers the conversion of literals of an object type, such as `geometry_msgs/PoseStamped`.
    pub fn register_parser(
        &mut self,
        type_name: &str,
        parse: impl Fn(&str) -> Option<TreeValue> + Send + Sync + 'static,
    ) {
        Arc::make_mut(&mut self.parsers).insert(type_name.to_owned(), Arc::new(parse));
    }

    /// Model of a node.
    #[must_use]
    pub fn model(&self, name: &str) -> Option<&NodeModel> {
        self.nodes.get(name).map(|node| &*node.model)
    }

    /// Models of all nodes, in alphabetical order.
    pub fn models(&self) -> impl Iterator<Item = &NodeModel> {
        self.nodes.values().map(|node| &*node.model)
    }

    pub(crate) fn find(&self, name: &str) -> Option<&Registered> {
        self.nodes.get(name)
    }
}

impl std::fmt::Debug for NodeRegistry {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_set().entries(self.nodes.keys()).finish()
    }
}

/// Leaf that is a function.
struct Leaf<F>(F);

impl<F> BehaviorNode for Leaf<F>
where
    F: Fn(&mut NodeRun<'_>) -> Result<NodeStatus, TreeError> + Send,
{
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        (self.0)(run)
    }
}
