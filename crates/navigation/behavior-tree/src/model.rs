//! Models of nodes: kind and ports.

use periplus_xml::Element;

use crate::value::PortType;

/// Kind of a node: it decides the number of children.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// Leaf that acts.
    Action,
    /// Leaf that checks.
    Condition,
    /// Node with one or more children.
    Control,
    /// Node with one child.
    Decorator,
    /// Use of another tree.
    SubTree,
}

impl NodeKind {
    /// Name of the element in XML, such as `Action`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Action => "Action",
            Self::Condition => "Condition",
            Self::Control => "Control",
            Self::Decorator => "Decorator",
            Self::SubTree => "SubTree",
        }
    }

    /// Kind of a name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        let all = [Self::Action, Self::Condition, Self::Control, Self::Decorator, Self::SubTree];
        all.into_iter().find(|kind| kind.name() == name)
    }

    /// True for actions and conditions.
    #[must_use]
    pub fn is_leaf(self) -> bool {
        matches!(self, Self::Action | Self::Condition)
    }
}

/// Direction of a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PortDirection {
    /// The node reads it.
    Input,
    /// The node writes it.
    Output,
    /// Both.
    InOut,
}

/// Port of a node.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PortModel {
    /// Name of the attribute in XML.
    pub name: String,
    /// Direction.
    pub direction: PortDirection,
    /// Type of the value.
    pub port_type: PortType,
    /// Text that is used when the attribute is absent.
    pub default: Option<String>,
}

/// Model of a node: name, kind and ports.
///
/// ```
/// use periplus_behavior_tree::{NodeKind, NodeModel, PortType};
///
/// let model = NodeModel::new("Dock", NodeKind::Action)
///     .input_or("speed", PortType::real(), "0.1")
///     .output("retries", PortType::int());
/// assert_eq!(model.ports.len(), 2);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeModel {
    /// Name of the element in XML.
    pub name: String,
    /// Kind.
    pub kind: NodeKind,
    /// Ports.
    pub ports: Vec<PortModel>,
}

impl NodeModel {
    /// Returns a model without ports.
    #[must_use]
    pub fn new(name: &str, kind: NodeKind) -> Self {
        Self { name: name.to_owned(), kind, ports: Vec::new() }
    }

    /// Adds an input port.
    #[must_use]
    pub fn input(self, name: &str, port_type: PortType) -> Self {
        self.port(name, PortDirection::Input, port_type, None)
    }

    /// Adds an input port with a default.
    #[must_use]
    pub fn input_or(self, name: &str, port_type: PortType, default: &str) -> Self {
        self.port(name, PortDirection::Input, port_type, Some(default))
    }

    /// Adds an output port.
    #[must_use]
    pub fn output(self, name: &str, port_type: PortType) -> Self {
        self.port(name, PortDirection::Output, port_type, None)
    }

    /// Adds a port that is read and written.
    #[must_use]
    pub fn in_out(self, name: &str, port_type: PortType) -> Self {
        self.port(name, PortDirection::InOut, port_type, None)
    }

    fn port(
        mut self,
        name: &str,
        direction: PortDirection,
        port_type: PortType,
        default: Option<&str>,
    ) -> Self {
        let (name, default) = (name.to_owned(), default.map(str::to_owned));
        self.ports.push(PortModel { name, direction, port_type, default });
        self
    }

    /// Port by name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<&PortModel> {
        self.ports.iter().find(|port| port.name == name)
    }

    /// Models in the `TreeNodesModel` elements of a document, such as `nav2_tree_nodes.xml`. Those of
    /// subtrees are omitted. A default in quotes, as Nav2 writes defaults of texts, is the text in them.
    #[must_use]
    pub fn read_all(root: &Element) -> Vec<Self> {
        let models = root.named("TreeNodesModel").flat_map(Element::elements);
        models.filter_map(read).filter(|model| model.kind != NodeKind::SubTree).collect()
    }
}

/// Model of an element such as `<Action ID="Spin">`.
pub(crate) fn read(element: &Element) -> Option<NodeModel> {
    let kind = NodeKind::of_name(&element.name)?;
    let mut model = NodeModel::new(element.value("ID")?, kind);
    for port in element.elements() {
        let direction = match &*port.name {
            "input_port" => PortDirection::Input,
            "output_port" => PortDirection::Output,
            "inout_port" | "bidirectional_port" => PortDirection::InOut,
            _ => continue,
        };
        let Some(name) = port.value("name") else { continue };
        let port_type = PortType::of_cpp(port.value("type").unwrap_or_default());
        // Expressions of C++ have no value here.
        let default = port.value("default").filter(|text| !text.contains("::"));
        model = model.port(name, direction, port_type, default.map(|text| text.trim_matches('"')));
    }
    Some(model)
}
