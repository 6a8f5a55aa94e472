//! SDF elements that keep their source location.

use std::borrow::Cow;

use periplus_diagnostics::Origin;
use periplus_geometry::{DQuat, Pose, format_number};
use periplus_xml::{Element, Text, XmlNode};

/// An element without content.
pub(super) fn element(name: &str, origin: Origin) -> Element {
    Element { origin, ..Element::new(name) }
}

/// `<name>text</name>`.
pub(super) fn leaf(name: &str, text: &str, origin: Origin) -> Element {
    let mut leaf = element(name, origin);
    leaf.children.push(XmlNode::Text(Text { text: text.into(), origin }));
    leaf
}

/// A leaf of numbers.
pub(super) fn numbers(name: &str, numbers: &[f64], origin: Origin) -> Element {
    let text: Vec<String> = numbers.iter().map(|number| format_number(*number)).collect();
    leaf(name, &text.join(" "), origin)
}

/// Adds a `<pose>`, exact to the last bit, unless it is the identity.
pub(super) fn push_pose(to: &mut Element, pose: Pose, origin: Origin) {
    if pose == Pose::IDENTITY {
        return;
    }
    let [x, y, z] = pose.translation.to_array();
    if pose.rotation == DQuat::IDENTITY {
        to.push(numbers("pose", &[x, y, z, 0.0, 0.0, 0.0], origin));
        return;
    }
    let [qx, qy, qz, qw] = pose.rotation.to_array();
    let pose = numbers("pose", &[x, y, z, qx, qy, qz, qw], origin);
    to.push(pose.with_attribute("rotation_format", "quat_xyzw"));
}

/// Child of a name, created if it does not exist.
pub(super) fn child_mut<'a>(parent: &'a mut Element, name: &str) -> &'a mut Element {
    let is_it = |node: &XmlNode| matches!(node, XmlNode::Element(child) if child.name == name);
    let place = match parent.children.iter().position(is_it) {
        Some(place) => place,
        None => {
            let child = element(name, parent.origin);
            parent.push(child);
            parent.children.len() - 1
        }
    };
    match &mut parent.children[place] {
        XmlNode::Element(child) => child,
        // The index was found by the same test.
        _ => unreachable!("the node at this index is an element"),
    }
}

/// Replaces the children of the same name by this one and returns the first of them.
pub(super) fn set(parent: &mut Element, child: Element) -> Option<Element> {
    let is_it =
        |node: &XmlNode| matches!(node, XmlNode::Element(other) if other.name == child.name);
    let first = parent.children.iter().position(is_it);
    let old = first.map(|place| parent.children.remove(place));
    parent.children.retain(|node| !is_it(node));
    parent.push(child);
    match old {
        Some(XmlNode::Element(old)) => Some(old),
        _ => None,
    }
}

/// Value and location of one of Gazebo's settings: the attribute `value`, or else the text (libsdformat,
/// `GetKeyValueAsString`).
pub(super) fn value(setting: &Element) -> (Cow<'_, str>, Origin) {
    match setting.attribute("value") {
        Some(value) => (Cow::Borrowed(value.value.trim()), value.value_origin),
        None => (setting.text(), setting.text_origin()),
    }
}

/// One of Gazebo's settings as a leaf of another name.
pub(super) fn renamed(setting: &Element, name: &str) -> Element {
    let (text, origin) = value(setting);
    leaf(name, &text, origin)
}

/// `true`, `yes` and `1` are true, and nothing else is (libsdformat, `ParseSDFExtension`).
pub(super) fn is_true(setting: &Element) -> bool {
    let (text, _) = value(setting);
    text.eq_ignore_ascii_case("true") || text.eq_ignore_ascii_case("yes") || text == "1"
}
