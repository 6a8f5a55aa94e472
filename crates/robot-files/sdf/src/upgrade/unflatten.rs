//! 1.7 to 1.8: models that were flattened into the model around them, with names prefixed by `name::`,
//! become nested models again. The frame `name::__model__` marks each of them.

use std::collections::{BTreeMap, BTreeSet};

use periplus_xml::{Attribute, Element, SmolStr, XmlNode};

use super::{take_attribute, take_child};

pub(super) const MARK: &str = "::__model__";

/// Restores the nested models of a flattened model.
pub(super) fn unflatten(model: &mut Element) {
    let marks: BTreeSet<SmolStr> = model.elements().filter_map(marked).collect();
    if marks.is_empty() {
        return;
    }
    // Every child goes to the outermost model in its name, at the position of the first child of that
    // model.
    let mut inner: BTreeMap<SmolStr, Element> = BTreeMap::new();
    let mut kept = Vec::new();
    for node in std::mem::take(&mut model.children) {
        let home = node.as_element().and_then(|child| home(child, &marks));
        match (node, home) {
            (XmlNode::Element(child), Some(name)) => {
                if !inner.contains_key(&name) {
                    kept.push(Err(name.clone()));
                }
                let new = || {
                    Element { origin: child.origin, ..Element::new("model") }
                        .with_attribute("name", name.clone())
                };
                let into = inner.entry(name.clone()).or_insert_with(new);
                adopt(child, &format!("{name}::"), into);
            }
            (other, _) => kept.push(Ok(other)),
        }
    }
    for place in kept {
        match place {
            Ok(node) => model.children.push(node),
            Err(name) => {
                if let Some(mut nested) = inner.remove(&name) {
                    unflatten(&mut nested);
                    model.push(nested);
                }
            }
        }
    }
}

/// Name of the flattened model that a frame marks.
fn marked(frame: &Element) -> Option<SmolStr> {
    let name = frame.value("name")?.strip_suffix(MARK)?;
    (frame.name == "frame" && !name.is_empty()).then(|| name.into())
}

/// Outermost flattened model that a child belongs to.
fn home(child: &Element, marks: &BTreeSet<SmolStr>) -> Option<SmolStr> {
    if !["link", "joint", "frame", "model", "gripper"].contains(&&*child.name) {
        return None;
    }
    let name = child.value("name")?;
    let mut prefixes = name.match_indices("::").map(|(at, _)| &name[..at]).take(64);
    prefixes.find_map(|prefix| marks.get(prefix)).cloned()
}

fn adopt(mut child: Element, prefix: &str, inner: &mut Element) {
    if child.name == "frame" && child.value("name") == Some(&format!("{prefix}__model__")) {
        // The frame's pose is the model's pose, and the frame that it is attached to is the canonical link.
        if let Some(mut attached) = take_attribute(&mut child, "attached_to") {
            strip(&mut attached.value, prefix);
            attached.name = "canonical_link".into();
            inner.attributes.push(attached);
        }
        if let Some(pose) = take_child(&mut child, "pose") {
            inner.push(pose);
        }
        return;
    }
    strip_names(&mut child, prefix);
    inner.push(child);
}

/// Removes the prefix from all names in an element and its descendants.
fn strip_names(element: &mut Element, prefix: &str) {
    for attribute in &mut element.attributes {
        let Attribute { name, value, .. } = attribute;
        if matches!(&**name, "name" | "relative_to" | "attached_to" | "expressed_in") {
            strip(value, prefix);
        }
    }
    let names_a_link = matches!(&*element.name, "parent" | "child" | "gripper_link" | "palm_link");
    for node in &mut element.children {
        match node {
            XmlNode::Element(child) if child.name != "plugin" => strip_names(child, prefix),
            XmlNode::Text(text) if names_a_link => {
                let trimmed = SmolStr::new(text.text.trim());
                if trimmed.starts_with(prefix) {
                    text.text = trimmed;
                    strip(&mut text.text, prefix);
                }
            }
            _ => {}
        }
    }
}

fn strip(name: &mut SmolStr, prefix: &str) {
    if let Some(rest) = name.strip_prefix(prefix) {
        *name = rest.into();
    }
}
