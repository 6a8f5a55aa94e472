//! Writer: robot to document.

use periplus_geometry::format_number;
use periplus_xml::{Document, Element, XmlNode};

use crate::robot::{
    Extra, GazeboBlock, Rotation, UrdfCollision, UrdfGeometry, UrdfInertial, UrdfJoint, UrdfLink,
    UrdfMaterial, UrdfOrigin, UrdfRobot, UrdfVisual,
};

/// Writes a robot. Reading it again gives an equal robot.
#[must_use]
pub fn write(robot: &UrdfRobot) -> Document {
    let mut root = Element::new("robot").with_attribute("name", &*robot.name);
    if let Some(version) = &robot.version {
        root = root.with_attribute("version", &**version);
    }
    root.attributes.extend(robot.extra.attributes.iter().cloned());
    root.children
        .extend(robot.origin_in_world.iter().map(|origin| XmlNode::Element(place(origin))));
    let children = (robot.materials.iter().map(material))
        .chain(robot.links.iter().map(link))
        .chain(robot.joints.iter().map(joint))
        .chain(robot.transmissions.iter().cloned())
        .chain(robot.ros2_controls.iter().cloned())
        .chain(robot.sensors.iter().cloned())
        .chain(robot.gazebo.iter().map(gazebo))
        .chain(robot.extra.elements.iter().cloned());
    root.children.extend(children.map(XmlNode::Element));
    Document { before: Vec::new(), root, after: Vec::new() }
}

fn numbers(numbers: &[f64]) -> String {
    numbers.iter().map(|number| format_number(*number)).collect::<Vec<_>>().join(" ")
}

fn with_number(element: Element, name: &str, number: f64) -> Element {
    element.with_attribute(name, format_number(number))
}

fn with_extra(mut element: Element, extra: &Extra) -> Element {
    element.attributes.extend(extra.attributes.iter().cloned());
    element.children.extend(extra.elements.iter().cloned().map(XmlNode::Element));
    element
}

fn place(placement: &UrdfOrigin) -> Element {
    let element = Element::new("origin").with_attribute("xyz", numbers(&placement.xyz_m));
    let element = match placement.rotation {
        Rotation::Rpy(rpy) => element.with_attribute("rpy", numbers(&rpy)),
        Rotation::Quaternion(xyzw) => element.with_attribute("quat_xyzw", numbers(&xyzw)),
    };
    with_extra(element, &placement.extra)
}

/// Adds an `<origin>` unless it is the identity.
fn with_place(element: Element, placement: &UrdfOrigin) -> Element {
    if *placement == UrdfOrigin::default() { element } else { element.with_child(place(placement)) }
}

fn material(material: &UrdfMaterial) -> Element {
    let mut element = Element::new("material").with_attribute("name", &*material.name);
    if let Some(colour) = &material.colour {
        let written = Element::new("color").with_attribute("rgba", numbers(&colour.rgba));
        element.push(with_extra(written, &colour.extra));
    }
    if let Some(texture) = &material.texture {
        let written = Element::new("texture").with_attribute("filename", &*texture.filename);
        element.push(with_extra(written, &texture.extra));
    }
    with_extra(element, &material.extra)
}

fn link(link: &UrdfLink) -> Element {
    let mut element = Element::new("link").with_attribute("name", &*link.name);
    let children = (link.inertial.iter().map(inertial))
        .chain(link.visuals.iter().map(visual))
        .chain(link.collisions.iter().map(collision));
    element.children.extend(children.map(XmlNode::Element));
    with_extra(element, &link.extra)
}

fn inertial(inertial: &UrdfInertial) -> Element {
    let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
    let mass = with_number(Element::new("mass"), "value", inertial.mass_kg);
    let inertia = names
        .iter()
        .zip(inertial.inertia_kg_m2)
        .fold(Element::new("inertia"), |element, (name, value)| with_number(element, name, value));
    let element = with_place(Element::new("inertial"), &inertial.link_from_inertial)
        .with_child(mass)
        .with_child(inertia);
    with_extra(element, &inertial.extra)
}

fn named(kind: &str, name: Option<&String>) -> Element {
    match name {
        Some(name) => Element::new(kind).with_attribute("name", &**name),
        None => Element::new(kind),
    }
}

fn visual(visual: &UrdfVisual) -> Element {
    let mut element = named("visual", visual.name.as_ref());
    element = with_place(element, &visual.link_from_visual).with_child(geometry(&visual.geometry));
    element.children.extend(visual.material.iter().map(|look| XmlNode::Element(material(look))));
    with_extra(element, &visual.extra)
}

fn collision(collision: &UrdfCollision) -> Element {
    let element = named("collision", collision.name.as_ref());
    let element = with_place(element, &collision.link_from_collision)
        .with_child(geometry(&collision.geometry));
    with_extra(element, &collision.extra)
}

fn geometry(geometry: &UrdfGeometry) -> Element {
    let round = |name: &str, radius_m: f64, length_m: f64| {
        let element = with_number(Element::new(name), "radius", radius_m);
        with_number(element, "length", length_m)
    };
    let shape = match geometry {
        UrdfGeometry::Box { size_m } => Element::new("box").with_attribute("size", numbers(size_m)),
        UrdfGeometry::Cylinder { radius_m, length_m } => round("cylinder", *radius_m, *length_m),
        UrdfGeometry::Capsule { radius_m, length_m } => round("capsule", *radius_m, *length_m),
        UrdfGeometry::Sphere { radius_m } => {
            with_number(Element::new("sphere"), "radius", *radius_m)
        }
        UrdfGeometry::Mesh { filename, scale, .. } => {
            let mesh = Element::new("mesh").with_attribute("filename", &**filename);
            if *scale == [1.0; 3] { mesh } else { mesh.with_attribute("scale", numbers(scale)) }
        }
        UrdfGeometry::Unknown(shape) => shape.clone(),
    };
    Element::new("geometry").with_child(shape)
}

fn joint(joint: &UrdfJoint) -> Element {
    let mut element = Element::new("joint")
        .with_attribute("name", &*joint.name)
        .with_attribute("type", joint.kind.name());
    element = with_place(element, &joint.parent_from_joint)
        .with_child(Element::new("parent").with_attribute("link", &*joint.parent))
        .with_child(Element::new("child").with_attribute("link", &*joint.child));
    if let Some((xyz, extra)) = &joint.axis {
        let axis = Element::new("axis").with_attribute("xyz", numbers(xyz));
        element.push(with_extra(axis, extra));
    }
    let group = |name, values: &[(&str, Option<f64>)], extra| {
        XmlNode::Element(with_extra(with_numbers(name, values), extra))
    };
    if let Some(limit) = &joint.limit {
        let values = [
            ("lower", Some(limit.lower)),
            ("upper", Some(limit.upper)),
            ("effort", Some(limit.effort)),
            ("velocity", Some(limit.velocity)),
        ];
        element.children.push(group("limit", &values, &limit.extra));
    }
    if let Some(dynamics) = &joint.dynamics {
        let values = [("damping", Some(dynamics.damping)), ("friction", Some(dynamics.friction))];
        element.children.push(group("dynamics", &values, &dynamics.extra));
    }
    element.children.extend(controller_parts(joint).into_iter().map(XmlNode::Element));
    if let Some(mimic) = &joint.mimic {
        let child = Element::new("mimic").with_attribute("joint", &*mimic.joint);
        let child = with_number(child, "multiplier", mimic.multiplier);
        element.push(with_extra(with_number(child, "offset", mimic.offset), &mimic.extra));
    }
    with_extra(element, &joint.extra)
}

/// `<calibration>` and `<safety_controller>` of a joint.
pub(crate) fn controller_parts(joint: &UrdfJoint) -> Vec<Element> {
    let mut parts = Vec::new();
    if let Some(calibration) = &joint.calibration {
        let values = [("rising", calibration.rising), ("falling", calibration.falling)];
        parts.push(with_extra(with_numbers("calibration", &values), &calibration.extra));
    }
    if let Some(safety) = &joint.safety_controller {
        let values = [
            ("soft_lower_limit", Some(safety.soft_lower_limit)),
            ("soft_upper_limit", Some(safety.soft_upper_limit)),
            ("k_position", Some(safety.k_position)),
            ("k_velocity", Some(safety.k_velocity)),
        ];
        parts.push(with_extra(with_numbers("safety_controller", &values), &safety.extra));
    }
    parts
}

fn with_numbers(name: &str, values: &[(&str, Option<f64>)]) -> Element {
    values.iter().fold(Element::new(name), |element, (name, value)| match value {
        Some(value) => with_number(element, name, *value),
        None => element,
    })
}

fn gazebo(block: &GazeboBlock) -> Element {
    let element = match &block.reference {
        Some(reference) => Element::new("gazebo").with_attribute("reference", &**reference),
        None => Element::new("gazebo"),
    };
    let mut element = with_extra(element, &block.extra);
    element.children.extend(block.content.iter().cloned().map(XmlNode::Element));
    element
}
