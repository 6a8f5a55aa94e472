//! 1.7 to 1.8: models that were flattened into the model around them, their names prefixed with
//! `name::`, become nested models again. The frame `name::__model__` tells that there was one.

use periplus_xml::{Attribute, Element, Node, SmolStr};

use super::{take_attribute, take_child};

pub(super) const MARK: &str = "::__model__";

pub(super) fn unflatten(model: &mut Element) {
    // Outermost first: `a::__model__` before `a::b::__model__`, which `a` then takes along.
    while let Some(name) = outermost(model) {
        let prefix = format!("{name}::");
        let mut inner = Element { origin: model.origin, ..Element::new("model") }
            .with_attribute("name", name.as_str());
        let mut kept = Vec::new();
        let mut at = None;
        for node in std::mem::take(&mut model.children) {
            match node {
                Node::Element(child) if belongs(&child, &prefix) => {
                    at.get_or_insert(kept.len());
                    adopt(child, &prefix, &mut inner);
                }
                other => kept.push(other),
            }
        }
        unflatten(&mut inner);
        kept.insert(at.unwrap_or(0).min(kept.len()), Node::Element(inner));
        model.children = kept;
    }
}

/// The name of the outermost flattened model.
fn outermost(model: &Element) -> Option<SmolStr> {
    model
        .elements()
        .filter(|child| child.name == "frame")
        .filter_map(|frame| frame.value("name")?.strip_suffix(MARK))
        .filter(|name| !name.is_empty())
        .min_by_key(|name| name.matches("::").count())
        .map(SmolStr::new)
}

fn belongs(child: &Element, prefix: &str) -> bool {
    ["link", "joint", "frame", "model", "gripper"].contains(&&*child.name)
        && child.value("name").is_some_and(|name| name.starts_with(prefix))
}

fn adopt(mut child: Element, prefix: &str, inner: &mut Element) {
    if child.name == "frame" && child.value("name") == Some(&format!("{}__model__", prefix)) {
        // The frame's pose is the model's, and what it is attached to the canonical link.
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

/// Takes the prefix off all names that an element and what is in it mentions.
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
            Node::Element(child) if child.name != "plugin" => strip_names(child, prefix),
            Node::Text(text) if names_a_link => {
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
