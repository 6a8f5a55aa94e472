//! Conversion of old versions to the spelling of new ones.
//!
//! The rules are those of the `*.convert` files that libsdformat ships with each version of the schema;
//! content that these lose (the file of a 1.0 mesh, the script of a 1.0 material) is kept here. Renamed
//! elements keep their source location.

mod attributes;
mod imu;
mod unflatten;

use std::borrow::Cow;

use periplus_xml::{Attribute, Element, XmlNode};

use crate::version::Version;

/// Root of a document of any version, in the spelling of SDF 1.9.
pub(crate) fn upgrade(root: &Element, version: Version) -> Cow<'_, Element> {
    if version >= Version::new(8) || version >= Version::new(6) && is_up_to_date(root) {
        return Cow::Borrowed(root);
    }
    let mut root = root.clone();
    if version < Version::new(3) {
        each(&mut root, &mut attributes::to_children);
    }
    if version < Version::new(4) {
        each(&mut root, &mut steps_of_physics);
    }
    if version < Version::new(5) {
        each(&mut root, &mut |element| {
            if element.name == "joint" {
                axes_in_model(element);
            }
        });
    }
    if version < Version::new(6) {
        each(&mut root, &mut |element| match &*element.name {
            "world" => gravity_to_world(element),
            "imu" => imu::spread_noise(element),
            _ => {}
        });
    }
    if version < Version::new(7) {
        each(&mut root, &mut |element| match &*element.name {
            "pose" => rename_attribute(element, "frame", "relative_to"),
            "joint" => expressed_in_model(element),
            _ => {}
        });
    }
    for child in &mut root.children {
        if let XmlNode::Element(world) = child
            && world.name == "world"
        {
            elements_mut(world).filter(|it| it.name == "model").for_each(unflatten::unflatten);
        }
    }
    Cow::Owned(root)
}

/// Returns true if no conversion since 1.6 applies. Avoids the copy of large worlds.
fn is_up_to_date(element: &Element) -> bool {
    let changes = match &*element.name {
        "pose" => element.value("frame").is_some_and(|frame| !frame.is_empty()),
        "use_parent_model_frame" => true,
        "frame" => element.value("name").is_some_and(|name| name.ends_with(unflatten::MARK)),
        _ => false,
    };
    !changes && element.elements().all(|it| it.name == "plugin" || is_up_to_date(it))
}

/// Visits every element, outer ones first, except inside plugins: that is not SDF.
fn each(element: &mut Element, visit: &mut impl FnMut(&mut Element)) {
    visit(element);
    for child in elements_mut(element) {
        if child.name != "plugin" && child.prefix().is_none() {
            each(child, visit);
        }
    }
}

fn elements_mut(element: &mut Element) -> impl Iterator<Item = &mut Element> {
    element.children.iter_mut().filter_map(|node| match node {
        XmlNode::Element(child) => Some(child),
        _ => None,
    })
}

fn child_mut<'a>(element: &'a mut Element, name: &str) -> Option<&'a mut Element> {
    elements_mut(element).find(|child| child.name == name)
}

/// Removes and returns the first child of a name.
fn take_child(element: &mut Element, name: &str) -> Option<Element> {
    let at = element
        .children
        .iter()
        .position(|node| node.as_element().is_some_and(|child| child.name == name))?;
    match element.children.remove(at) {
        XmlNode::Element(child) => Some(child),
        _ => None,
    }
}

fn take_attribute(element: &mut Element, name: &str) -> Option<Attribute> {
    let at = element.attributes.iter().position(|attribute| attribute.name == name)?;
    Some(element.attributes.remove(at))
}

fn rename_attribute(element: &mut Element, from: &str, to: &str) {
    if element.attribute(to).is_none()
        && let Some(attribute) = element.attributes.iter_mut().find(|it| it.name == from)
    {
        attribute.name = to.into();
    }
}

/// 1.3 to 1.4: step sizes.
fn steps_of_physics(physics: &mut Element) {
    if physics.name != "physics" {
        return;
    }
    if let Some(mut rate) = take_child(physics, "update_rate") {
        rate.name = "real_time_update_rate".into();
        physics.push(rate);
    }
    let ode = child_mut(physics, "ode")
        .and_then(|ode| child_mut(ode, "solver"))
        .and_then(|solver| take_child(solver, "dt"));
    let bullet = child_mut(physics, "bullet").and_then(|bullet| take_child(bullet, "dt"));
    if let Some(mut step) = ode.or(bullet) {
        step.name = "max_step_size".into();
        physics.push(step);
    }
}

/// 1.4 to 1.5: axes were expressed in the frame of the model.
fn axes_in_model(joint: &mut Element) {
    for axis in elements_mut(joint).filter(|it| it.name == "axis" || it.name == "axis2") {
        if axis.child("use_parent_model_frame").is_none() {
            axis.push(Element::new("use_parent_model_frame").with_text("true"));
        }
    }
}

/// 1.5 to 1.6.
fn gravity_to_world(world: &mut Element) {
    for name in ["gravity", "magnetic_field"] {
        let moved = child_mut(world, "physics").and_then(|physics| take_child(physics, name));
        if let Some(moved) = moved
            && world.child(name).is_none()
        {
            world.push(moved);
        }
    }
}

/// 1.6 to 1.7.
fn expressed_in_model(joint: &mut Element) {
    for axis in elements_mut(joint).filter(|it| it.name == "axis" || it.name == "axis2") {
        let Some(flag) = take_child(axis, "use_parent_model_frame") else { continue };
        if !matches!(&*flag.text().to_ascii_lowercase(), "true" | "1") {
            continue;
        }
        if axis.child("xyz").is_none() {
            axis.push(Element::new("xyz").with_text("0 0 1"));
        }
        if let Some(xyz) = child_mut(axis, "xyz") {
            let written = xyz.clone().with_attribute("expressed_in", "__model__");
            *xyz = written;
        }
    }
}
