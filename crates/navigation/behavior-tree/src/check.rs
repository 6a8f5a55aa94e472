//! Checks of tree definitions: names, numbers of children, ports, literals, scripts.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_xml::{Attribute, Element};

use crate::document::{TreeDefinition, TreeFormat};
use crate::script::Script;
use crate::value::PortType;
use crate::{NodeKind, NodeModel, NodeRegistry};

/// Attributes with a script that decides about a tick, in the order of evaluation.
pub(crate) const BEFORE: [&str; 4] = ["_failureIf", "_successIf", "_skipIf", "_while"];
/// Attributes with a script that is executed afterwards.
pub(crate) const AFTER: [&str; 4] = ["_onHalted", "_onFailure", "_onSuccess", "_post"];
/// Attributes that editors write.
const IGNORED: [&str; 4] = ["_description", "_uid", "_fullpath", "_fullPath"];

/// Type of the node of an element: `<Spin>` or `<Action ID="Spin">`. None for uses of trees and elements
/// without ID.
pub(crate) fn type_name(element: &Element) -> Option<&str> {
    match NodeKind::of_name(&element.name) {
        Some(_) => element.value("ID"),
        None => Some(&element.name),
    }
}

/// True for uses of other trees.
pub(crate) fn is_subtree(element: &Element) -> bool {
    matches!(&*element.name, "SubTree" | "SubTreePlus")
}

/// Entry that the text of a port refers to: `{name}`, or `{=}` and `=` for the name of the port.
pub(crate) fn entry_of(port: &str, text: &str) -> Option<String> {
    if matches!(text, "{=}" | "=") {
        return Some(port.to_owned());
    }
    let inner = text.trim_matches(' ').strip_prefix('{')?.strip_suffix('}')?;
    (!inner.is_empty()).then(|| inner.to_owned())
}

pub(crate) fn check_trees(
    trees: &[TreeDefinition],
    registry: &NodeRegistry,
    findings: &mut Diagnostics,
) {
    for tree in trees {
        let mut check = Check { trees, registry, format: tree.format, findings };
        check.tree_id(tree);
        check.element(&tree.root);
    }
}

struct Check<'a> {
    trees: &'a [TreeDefinition],
    registry: &'a NodeRegistry,
    format: TreeFormat,
    findings: &'a mut Diagnostics,
}

impl Check<'_> {
    fn tree_id(&mut self, tree: &TreeDefinition) {
        // BehaviorTree.CPP 3 does not mind.
        if tree.format == TreeFormat::V4 && self.registry.model(&tree.id).is_some() {
            let message = format!("the tree `{}` has the name of a node", tree.id);
            self.findings.push(Diagnostic::error("tree-name", message).at(tree.origin));
        }
    }

    fn element(&mut self, element: &Element) {
        if is_subtree(element) {
            self.subtree(element);
            return;
        }
        let Some(name) = type_name(element).filter(|name| !name.is_empty()) else {
            let message = format!("<{}> needs an attribute `ID`", element.name);
            self.findings.push(Diagnostic::error("no-id", message).at(element.origin));
            return;
        };
        match self.registry.model(name) {
            Some(model) => self.node(element, model),
            None => self.unknown_node(element, name),
        }
        for child in element.elements() {
            self.element(child);
        }
    }

    fn unknown_node(&mut self, element: &Element, name: &str) {
        let origin = match NodeKind::of_name(&element.name) {
            Some(_) => element.attribute("ID").map_or(element.origin, |id| id.value_origin),
            None => element.name_origin(),
        };
        let mut finding =
            Diagnostic::error("unknown-node", format!("unknown node `{name}`")).at(origin);
        finding = if self.trees.iter().any(|tree| tree.id == name) {
            finding.help(format!("`{name}` is a tree: write <SubTree ID=\"{name}\"/>"))
        } else {
            let known: Vec<&str> = self.registry.models().map(|model| &*model.name).collect();
            finding.did_you_mean(origin, name, known)
        };
        self.findings.push(finding);
    }

    fn node(&mut self, element: &Element, model: &NodeModel) {
        let count = element.elements().count();
        let wrong = match model.kind {
            NodeKind::Decorator if count != 1 => Some("exactly one child"),
            NodeKind::Control if count == 0 => Some("one or more children"),
            NodeKind::Action | NodeKind::Condition | NodeKind::SubTree if count != 0 => {
                Some("no children")
            }
            _ => None,
        };
        if let Some(expected) = wrong {
            let message =
                format!("`{}` has {count} children, and must have {expected}", model.name);
            self.findings.push(Diagnostic::error("child-count", message).at(element.name_origin()));
        }
        if let Some(kind) = NodeKind::of_name(&element.name)
            && kind != model.kind
        {
            let message = format!("`{}` is not of the kind {}", model.name, element.name);
            let help = format!("write <{} ID=\"{}\">", model.kind.name(), model.name);
            let finding = Diagnostic::warning("node-kind", message).at(element.name_origin());
            self.findings.push(finding.help(help));
        }
        for attribute in &element.attributes {
            self.attribute(element, attribute, model);
        }
    }

    fn attribute(&mut self, element: &Element, attribute: &Attribute, model: &NodeModel) {
        let name = &*attribute.name;
        let is_id = name == "ID" && NodeKind::of_name(&element.name).is_some();
        if name == "name" || is_id || IGNORED.contains(&name) {
            return;
        }
        if BEFORE.contains(&name) || AFTER.contains(&name) {
            self.script(attribute);
            return;
        }
        let known_names = || {
            let ports = model.ports.iter().map(|port| &*port.name);
            ports.chain(["name"]).chain(BEFORE).chain(AFTER)
        };
        let span = attribute.origin.0.map(|span| span.part(0, attribute.name.len()));
        let at = periplus_diagnostics::Origin(span);
        if name.starts_with('_') {
            let message = format!("unknown attribute `{name}`");
            let finding = Diagnostic::warning("unknown-attribute", message).at(at);
            self.findings.push(finding.did_you_mean(at, name, known_names()));
            return;
        }
        let Some(port) = model.find(name) else {
            let ports: Vec<&str> = model.ports.iter().map(|port| &*port.name).collect();
            let note = match ports[..] {
                [] => format!("`{}` has no ports", model.name),
                _ => format!("ports of `{}`: {}", model.name, ports.join(", ")),
            };
            let message = format!("`{}` has no port `{name}`", model.name);
            let finding = Diagnostic::error("unknown-port", message).at(at).note(note);
            self.findings.push(finding.did_you_mean(at, name, known_names()));
            return;
        };
        let text = &*attribute.value;
        if entry_of(name, text).is_some() {
            return;
        }
        let can_be_read = match &port.port_type {
            PortType::Object(type_name) => {
                self.registry.parsers.get(&**type_name).is_some_and(|parse| parse(text).is_some())
            }
            // An output that is not connected.
            _ if text.is_empty() => true,
            port_type => port_type.parse(text).is_some(),
        };
        // A text in an output port names nothing: the node's own rule decides.
        if !can_be_read && port.direction != crate::PortDirection::Output {
            let message = format!("`{text}` is not a value of type {}", port.port_type.name());
            let finding = Diagnostic::error("port-value", message).at(attribute.value_origin);
            let help = format!("a blackboard entry is written in braces, such as `{{{name}}}`");
            self.findings.push(finding.help(help));
        }
        if matches!(
            (&*model.name, name),
            ("Script" | "ScriptCondition", "code") | ("Precondition", "if")
        ) {
            self.script(attribute);
        }
    }

    fn script(&mut self, attribute: &Attribute) {
        if let Err(error) = Script::parse(&attribute.value) {
            let at = attribute.value_origin;
            // Entities make the source longer than the value.
            let is_plain =
                at.0.is_some_and(|span| (span.end - span.start) as usize == attribute.value.len());
            let span = at.0.map(|span| match is_plain {
                true => span.part(error.range.start, error.range.end),
                false => span,
            });
            let finding = Diagnostic::error("script", format!("script: {}", error.message));
            self.findings.push(finding.at(periplus_diagnostics::Origin(span)));
        }
    }

    fn subtree(&mut self, element: &Element) {
        if element.name == "SubTreePlus" && self.format == TreeFormat::V4 {
            let message = "<SubTreePlus> belongs to format 3";
            let finding = Diagnostic::error("unknown-node", message).at(element.name_origin());
            self.findings
                .push(finding.help("write <SubTree>, with `_autoremap` for `__autoremap`"));
        }
        let Some(id) = element.attribute("ID") else {
            let message = "<SubTree> needs an attribute `ID` with the ID of a tree";
            self.findings.push(Diagnostic::error("no-id", message).at(element.origin));
            return;
        };
        if !self.trees.iter().any(|tree| tree.id == id.value) {
            let known = self.trees.iter().map(|tree| tree.id.as_str());
            let finding =
                Diagnostic::error("unknown-tree", format!("there is no tree `{}`", id.value));
            let at = id.value_origin;
            self.findings.push(finding.at(at).did_you_mean(at, &id.value, known));
        }
        if let Some(child) = element.elements().next() {
            let message = "<SubTree> must not have children";
            self.findings.push(Diagnostic::error("child-count", message).at(child.name_origin()));
        }
        for attribute in &element.attributes {
            let name = &*attribute.name;
            if BEFORE.contains(&name) || AFTER.contains(&name) {
                self.script(attribute);
            } else if matches!(name, "_autoremap" | "__autoremap" | "__shared_blackboard")
                && crate::value::parse_bool(&attribute.value).is_none()
            {
                let message = format!("`{}` is neither true nor false", attribute.value);
                let finding = Diagnostic::error("port-value", message);
                self.findings.push(finding.at(attribute.value_origin));
            }
        }
    }
}
