//! Creation of executable trees from their definitions.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_xml::Element;

use crate::blackboard::{Blackboard, ROOT};
use crate::check::{AFTER, BEFORE, entry_of, is_subtree, type_name};
use crate::document::{TreeDefinition, TreeFiles, TreeFormat};
use crate::registry::Registered;
use crate::script::Script;
use crate::tree::{NodeConfig, NodeId, PortUse, Slot, TreeCore};
use crate::value::parse_bool;
use crate::{
    BehaviorNode, BehaviorTree, NodeKind, NodeRegistry, NodeRun, NodeStatus, TreeError, TreeValue,
};

/// Maximum number of nodes of a tree, with those of its subtrees.
pub const MAX_TREE_NODES: usize = 10_000;
/// Maximum nesting of nodes, through subtrees.
pub const MAX_TREE_DEPTH: usize = 256;

pub(crate) fn build(
    files: &TreeFiles,
    tree: &TreeDefinition,
    registry: &NodeRegistry,
    blackboard: Blackboard,
    findings: &mut Diagnostics,
) -> Option<BehaviorTree> {
    let core = TreeCore {
        nodes: Vec::new(),
        blackboard,
        enums: registry.enums.clone(),
        parsers: registry.parsers.clone(),
        changes: VecDeque::new(),
        is_woken: false,
        tick_count: 0,
    };
    let mut build = Build { files, registry, core, findings, open: Vec::new() };
    build.tree(tree, Scope { board: ROOT, prefix: "", depth: 0 })?;
    (!build.findings.has_errors()).then_some(BehaviorTree { core: build.core, id: tree.id.clone() })
}

struct Build<'a> {
    files: &'a TreeFiles,
    registry: &'a NodeRegistry,
    core: TreeCore,
    findings: &'a mut Diagnostics,
    /// IDs of the trees that contain the current node.
    open: Vec<String>,
}

/// Location of a node in the tree.
#[derive(Clone, Copy)]
struct Scope<'a> {
    board: usize,
    /// Path of the subtree, with a slash at its end.
    prefix: &'a str,
    depth: usize,
}

impl Build<'_> {
    fn tree(&mut self, tree: &TreeDefinition, scope: Scope<'_>) -> Option<NodeId> {
        self.open.push(tree.id.clone());
        let root = self.node(&tree.root, tree.format, scope);
        self.open.pop();
        root
    }

    fn node(&mut self, element: &Element, format: TreeFormat, scope: Scope<'_>) -> Option<NodeId> {
        let refuse = |message: String| Diagnostic::error("tree-size", message).at(element.origin);
        if self.core.nodes.len() >= MAX_TREE_NODES {
            let message = format!("the tree has more than {MAX_TREE_NODES} nodes");
            self.findings.push(refuse(message));
            return None;
        }
        if scope.depth >= MAX_TREE_DEPTH {
            let message = format!("nodes are nested more than {MAX_TREE_DEPTH} deep");
            self.findings.push(refuse(message));
            return None;
        }
        if is_subtree(element) {
            return self.subtree(element, format, scope);
        }
        let name = type_name(element)?;
        let registered = self.registry.find(name)?.clone();
        let behavior = (registered.build)();
        let ports = self.ports(element, &registered, scope.board);
        let kind = registered.model.kind;
        let id = self.push(element, name, kind, scope, ports, behavior);
        for child in element.elements() {
            let scope = Scope { depth: scope.depth + 1, ..scope };
            let child = self.node(child, format, scope)?;
            self.core.nodes[id].children.push(child);
        }
        Some(id)
    }

    fn push(
        &mut self,
        element: &Element,
        type_name: &str,
        kind: NodeKind,
        scope: Scope<'_>,
        ports: BTreeMap<String, PortUse>,
        behavior: Box<dyn BehaviorNode>,
    ) -> NodeId {
        // Scripts were parsed once by the check.
        let script = |name: &str| element.value(name).and_then(|text| Script::parse(text).ok());
        let name = element.value("name").unwrap_or(type_name);
        let config = NodeConfig {
            name: name.into(),
            type_name: type_name.into(),
            path: format!("{}{name}", scope.prefix),
            kind,
            depth: scope.depth,
            ports,
            board: scope.board,
            before: BEFORE.map(script),
            after: AFTER.map(script),
            origin: element.origin,
        };
        let status = NodeStatus::Idle;
        self.core.nodes.push(Slot {
            config,
            children: Vec::new(),
            behavior: Some(behavior),
            status,
        });
        self.core.nodes.len() - 1
    }

    fn ports(
        &mut self,
        element: &Element,
        registered: &Registered,
        board: usize,
    ) -> BTreeMap<String, PortUse> {
        let mut ports = BTreeMap::new();
        for port in &registered.model.ports {
            let attribute = element.attribute(&port.name);
            let Some(text) = attribute.map(|a| &*a.value).or(port.default.as_deref()) else {
                continue;
            };
            let key = entry_of(&port.name, text);
            if let (Some(key), Some(attribute)) = (&key, attribute)
                && let Err(earlier) = self.core.blackboard.declare(board, key, &port.port_type)
            {
                let first = self.first_use(key, board);
                let message = format!(
                    "the entry `{key}` has the type {} elsewhere, and {} here",
                    earlier.name(),
                    port.port_type.name()
                );
                let mut finding =
                    Diagnostic::error("entry-type", message).at(attribute.value_origin);
                if let Some((origin, node)) = first {
                    finding = finding.related(origin, format!("`{node}` uses it here"));
                }
                self.findings.push(finding);
            }
            let port_type = port.port_type.clone();
            let port_use = PortUse { text: text.into(), key: key.map(Into::into), port_type };
            ports.insert(port.name.clone(), port_use);
        }
        ports
    }

    /// First node of a board that uses an entry.
    fn first_use(
        &self,
        key: &str,
        board: usize,
    ) -> Option<(periplus_diagnostics::Origin, Arc<str>)> {
        let mut configs = self.core.nodes.iter().map(|slot| &slot.config);
        let user = configs.find(|config| {
            config.board == board
                && config.ports.values().any(|port| port.key.as_deref() == Some(key))
        })?;
        Some((user.origin, user.name.clone()))
    }

    fn subtree(
        &mut self,
        element: &Element,
        format: TreeFormat,
        scope: Scope<'_>,
    ) -> Option<NodeId> {
        let tree_id = element.value("ID")?;
        let tree = self.files.find(tree_id)?;
        if self.open.iter().any(|open| open == tree_id) {
            let message = format!("the tree `{tree_id}` contains itself");
            self.findings.push(Diagnostic::error("recursive-tree", message).at(element.origin));
            return None;
        }
        let board = self.subtree_board(element, format, scope.board);
        let node = self.push(
            element,
            tree_id,
            NodeKind::SubTree,
            scope,
            BTreeMap::new(),
            Box::new(SubTree),
        );
        let label = match element.value("name") {
            Some(name) => name.to_owned(),
            None => format!("{tree_id}::{}", node + 1),
        };
        let prefix = format!("{}{label}/", scope.prefix);
        let root = self.tree(tree, Scope { board, prefix: &prefix, depth: scope.depth + 1 })?;
        self.core.nodes[node].children.push(root);
        Some(node)
    }

    fn subtree_board(&mut self, element: &Element, format: TreeFormat, parent: usize) -> usize {
        let is_true = |name: &str| element.value(name).and_then(parse_bool) == Some(true);
        if is_true("__shared_blackboard") {
            return parent;
        }
        let is_autoremapped = is_true("_autoremap") || is_true("__autoremap");
        let board = self.core.blackboard.add_board(parent, is_autoremapped);
        let mut values: Vec<(String, String)> = element
            .attributes
            .iter()
            .filter(|attribute| {
                let name = &*attribute.name;
                !matches!(name, "ID" | "name") && !name.starts_with('_')
            })
            .map(|attribute| (attribute.name.to_string(), attribute.value.to_string()))
            .collect();
        if let Some(model) = self.files.models.get(element.value("ID").unwrap_or_default()) {
            for (port, default) in model {
                let is_given = values.iter().any(|(name, _)| name == port);
                match default {
                    _ if is_given || is_autoremapped => {}
                    Some(default) => values.push((port.clone(), default.clone())),
                    None => {
                        let message = format!("the subtree needs an attribute `{port}`");
                        let finding = Diagnostic::error("missing-port", message);
                        self.findings.push(finding.at(element.origin));
                    }
                }
            }
        }
        // In format 3 the attributes of <SubTree> are names of entries without braces.
        let are_names = format == TreeFormat::V3 && element.name == "SubTree";
        let (names, literals): (Vec<_>, Vec<_>) = values
            .into_iter()
            .map(|(port, text)| {
                let key = entry_of(&port, &text).or_else(|| are_names.then(|| text.clone()));
                (port, text, key)
            })
            .partition(|(_, _, key)| key.is_some());
        for (port, _, key) in names {
            self.core.blackboard.add_remap(board, &port, &key.unwrap_or_default());
        }
        for (port, text, _) in literals {
            // A literal belongs to the subtree, also with autoremap.
            self.core.blackboard.own(board, &port);
            if let Err(error) = self.core.blackboard.set_in(board, &port, literal(&text)) {
                let at = element.attribute(&port).map_or(element.origin, |a| a.value_origin);
                self.findings.push(Diagnostic::error("port-value", error.to_string()).at(at));
            }
        }
        board
    }
}

/// Value of a literal that a subtree gets: an integer, a number or a text.
fn literal(text: &str) -> TreeValue {
    if let Ok(value) = text.parse() {
        return TreeValue::Int(value);
    }
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => TreeValue::Real(value),
        _ => text.into(),
    }
}

/// Use of another tree.
struct SubTree;

impl BehaviorNode for SubTree {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        if run.status() == NodeStatus::Idle {
            run.set_running();
        }
        let status = run.tick_child(0)?;
        if status.is_completed() {
            run.halt_children()?;
        }
        Ok(status)
    }
}
