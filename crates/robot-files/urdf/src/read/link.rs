//! Links.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_xml::Element;

use super::fields::{
    extra, only_child, required_name, required_number, required_text, unknown_element, vector,
};
use super::{material, origin_of};
use crate::robot::{UrdfCollision, UrdfGeometry, UrdfInertial, UrdfLink, UrdfVisual};

/// Reads a `<link>`; `None`, with an error, if it has no name.
pub(super) fn link(element: &Element, diagnostics: &mut Diagnostics) -> Option<UrdfLink> {
    let name = required_name(element, "name", diagnostics)?;
    Some(UrdfLink {
        name,
        inertial: only_child(element, "inertial", diagnostics)
            .map(|inertial| self::inertial(inertial, diagnostics)),
        visuals: element
            .named("visual")
            .filter_map(|visual| self::visual(visual, diagnostics))
            .collect(),
        collisions: element
            .named("collision")
            .filter_map(|collision| self::collision(collision, diagnostics))
            .collect(),
        // `type` is written by some exporters and ignored by all readers.
        extra: extra(element, &["name"], &["inertial"], &["visual", "collision"], diagnostics),
        origin: element.origin,
    })
}

fn inertial(element: &Element, diagnostics: &mut Diagnostics) -> UrdfInertial {
    let link_from_inertial = origin_of(element, diagnostics);
    let mut rest = extra(element, &[], &["origin", "mass", "inertia"], &[], diagnostics);
    let missing = |name: &str, example: &str| {
        Diagnostic::error("missing-element", format!("this `inertial` has no `{name}`"))
            .at(element.origin)
            .help(format!("write {example}"))
    };
    let mass_kg = match only_child(element, "mass", diagnostics) {
        Some(mass) => {
            let attributes = extra(mass, &["value"], &[], &[], diagnostics);
            keep_nested(mass, attributes, &mut rest);
            required_number(mass, "value", diagnostics)
        }
        None => {
            diagnostics.push(missing("mass", "<mass value=\"1\"/>"));
            0.0
        }
    };
    let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
    let inertia_kg_m2 = match only_child(element, "inertia", diagnostics) {
        Some(inertia) => {
            let attributes = extra(inertia, &names, &[], &[], diagnostics);
            keep_nested(inertia, attributes, &mut rest);
            names.map(|name| required_number(inertia, name, diagnostics))
        }
        None => {
            diagnostics.push(missing(
                "inertia",
                "<inertia ixx=\"0.1\" ixy=\"0\" ixz=\"0\" iyy=\"0.1\" iyz=\"0\" izz=\"0.1\"/>",
            ));
            [0.0; 6]
        }
    };
    UrdfInertial { link_from_inertial, mass_kg, inertia_kg_m2, extra: rest, origin: element.origin }
}

/// Unknown content of `<mass>` or `<inertia>` is kept as a second such element, which readers ignore.
fn keep_nested(element: &Element, found: crate::robot::Extra, rest: &mut crate::robot::Extra) {
    if !found.is_empty() {
        rest.elements.push(periplus_sdf::keep(element));
    }
}

fn visual(element: &Element, diagnostics: &mut Diagnostics) -> Option<UrdfVisual> {
    Some(UrdfVisual {
        name: element.value("name").map(str::to_owned),
        link_from_visual: origin_of(element, diagnostics),
        material: only_child(element, "material", diagnostics)
            .map(|material| material::of_visual(material, diagnostics)),
        // `group` is from the first draft of the format.
        extra: extra(element, &["name"], &["origin", "geometry", "material"], &[], diagnostics),
        geometry: geometry(element, diagnostics)?,
        origin: element.origin,
    })
}

fn collision(element: &Element, diagnostics: &mut Diagnostics) -> Option<UrdfCollision> {
    Some(UrdfCollision {
        name: element.value("name").map(str::to_owned),
        link_from_collision: origin_of(element, diagnostics),
        extra: extra(element, &["name"], &["origin", "geometry"], &[], diagnostics),
        geometry: geometry(element, diagnostics)?,
        origin: element.origin,
    })
}

/// Behaviour of liburdfdom for a shape that it cannot read.
const REST_OF_LINK: &str = "ROS and Gazebo accept the robot, but leave out all shapes of this link \
                            that follow";

const SHAPES: [&str; 5] = ["box", "cylinder", "sphere", "mesh", "capsule"];

fn geometry(parent: &Element, diagnostics: &mut Diagnostics) -> Option<UrdfGeometry> {
    let example = "write <geometry><box size=\"1 1 1\"/></geometry>";
    let Some(geometry) = only_child(parent, "geometry", diagnostics) else {
        diagnostics.push(
            Diagnostic::warning(
                "missing-element",
                format!("this `{}` has no `geometry`", parent.name),
            )
            .at(parent.origin)
            .label("left out")
            .note(REST_OF_LINK)
            .help(example),
        );
        return None;
    };
    let mut shapes = geometry.elements();
    let Some(shape) = shapes.next() else {
        diagnostics.push(
            Diagnostic::warning("missing-element", "this `geometry` holds no shape")
                .at(geometry.origin)
                .label("left out")
                .note(REST_OF_LINK)
                .help(example),
        );
        return None;
    };
    if let Some(second) = shapes.next() {
        diagnostics.push(
            Diagnostic::warning("two-shapes", "a `geometry` holds one shape, and here is another")
                .at(second.origin)
                .label("not read, in other readers too")
                .related(shape.origin, "this one is used")
                .help(format!("write a second `{}` for it", parent.name)),
        );
    }
    let mut known: &[&str] = &[];
    let read = match &*shape.name {
        "box" => {
            known = &["size"];
            UrdfGeometry::Box { size_m: sizes(shape, "size", diagnostics) }
        }
        "cylinder" => {
            known = &["radius", "length"];
            UrdfGeometry::Cylinder {
                radius_m: size(shape, "radius", diagnostics),
                length_m: size(shape, "length", diagnostics),
            }
        }
        "capsule" => {
            known = &["radius", "length"];
            UrdfGeometry::Capsule {
                radius_m: size(shape, "radius", diagnostics),
                length_m: size(shape, "length", diagnostics),
            }
        }
        "sphere" => {
            known = &["radius"];
            UrdfGeometry::Sphere { radius_m: size(shape, "radius", diagnostics) }
        }
        "mesh" => {
            known = &["filename", "scale"];
            let filename = required_text(shape, "filename", diagnostics);
            UrdfGeometry::Mesh {
                filename: filename.map(|name| name.value.to_string()).unwrap_or_default(),
                scale: vector(shape, "scale", diagnostics).unwrap_or([1.0; 3]),
                origin: filename.map_or(shape.origin, |name| name.value_origin),
            }
        }
        _ => {
            if shape.prefix().is_none() {
                let mut error = unknown_element(geometry, shape, SHAPES);
                error.severity = periplus_diagnostics::Severity::Error;
                diagnostics.push(error.note(format!("the shapes are {}", SHAPES.join(", "))));
            }
            UrdfGeometry::Unknown(periplus_sdf::keep(shape))
        }
    };
    if !known.is_empty() {
        // Reported here; a shape has no field for unknown content.
        extra(shape, known, &[], &[], diagnostics);
    }
    Some(read)
}

fn size(shape: &Element, name: &str, diagnostics: &mut Diagnostics) -> f64 {
    let before = diagnostics.errors();
    let size = required_number(shape, name, diagnostics);
    if diagnostics.errors() == before {
        check_size(&[size], shape, name, diagnostics);
    }
    size
}

fn sizes(shape: &Element, name: &str, diagnostics: &mut Diagnostics) -> [f64; 3] {
    if required_text(shape, name, diagnostics).is_none() {
        return [0.0; 3];
    }
    let Some(sizes) = vector(shape, name, diagnostics) else { return [0.0; 3] };
    check_size(&sizes, shape, name, diagnostics);
    sizes
}

fn check_size(sizes: &[f64], shape: &Element, name: &str, diagnostics: &mut Diagnostics) {
    let place = shape.attribute(name).map_or(shape.origin, |size| size.value_origin);
    if sizes.iter().any(|size| *size < 0.0) {
        diagnostics.push(
            Diagnostic::error("bad-size", format!("a {} of negative {name}", shape.name))
                .at(place)
                .label("left empty")
                .help("sizes are positive"),
        );
    } else if sizes.contains(&0.0) {
        diagnostics.push(
            Diagnostic::warning("flat-shape", format!("a {} without extent", shape.name))
                .at(place)
                .label("left empty")
                .help("sizes are positive lengths in metres"),
        );
    }
}
