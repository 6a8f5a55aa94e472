//! Reader: document to robot.

mod fields;
mod joint;
mod link;
mod material;
mod xacro;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::format_number;
use periplus_sdf::keep;
use periplus_xml::{Document, Element};

use crate::robot::{GazeboBlock, Rotation, UrdfOrigin, UrdfRobot};
use fields::{extra, only_child, required_name, vector};

/// Children of `<robot>` that may be repeated.
const MANY: [&str; 9] = [
    "link",
    "joint",
    "material",
    "gazebo",
    "transmission",
    "ros2_control",
    "sensor",
    // Settings of other simulators, for their own readers.
    "mujoco",
    "isaac_sim",
];

/// Reads a URDF and checks it as `check_urdf` does, and more: names, the tree, limits, masses. Returns
/// `None` if the root is not a `<robot>`; after other errors the robot holds everything that could be read.
#[must_use]
pub fn read(document: &Document, diagnostics: &mut Diagnostics) -> Option<UrdfRobot> {
    let root = &document.root;
    if root.name != "robot" {
        diagnostics.push(not_a_robot(root));
        return None;
    }
    let robot = robot(root, diagnostics);
    xacro::check(root, diagnostics);
    crate::check::check(&robot, root, diagnostics);
    Some(robot)
}

fn robot(root: &Element, diagnostics: &mut Diagnostics) -> UrdfRobot {
    let name = required_name(root, "name", diagnostics);
    let mut extra = extra(root, &["name", "version"], &["origin"], &MANY, diagnostics);
    for name in ["mujoco", "isaac_sim"] {
        extra.elements.extend(root.named(name).map(keep));
    }
    let verbatim = |name| root.named(name).map(keep).collect();
    UrdfRobot {
        name: name.unwrap_or_default(),
        version: version(root, diagnostics),
        origin_in_world: only_child(root, "origin", diagnostics)
            .map(|origin| placement(origin, diagnostics)),
        links: root.named("link").filter_map(|element| link::link(element, diagnostics)).collect(),
        joints: root
            .named("joint")
            .filter_map(|element| joint::joint(element, diagnostics))
            .collect(),
        materials: root
            .named("material")
            .filter_map(|element| material::global(element, diagnostics))
            .collect(),
        gazebo: root.named("gazebo").map(|element| gazebo(element, diagnostics)).collect(),
        transmissions: verbatim("transmission"),
        ros2_controls: verbatim("ros2_control"),
        sensors: verbatim("sensor"),
        extra,
        origin: root.origin,
    }
}

fn version(root: &Element, diagnostics: &mut Diagnostics) -> Option<String> {
    let attribute = root.attribute("version")?;
    let known = ["1.0", "1.1", "1.2", "1"];
    if !known.contains(&attribute.value.trim()) {
        diagnostics.push(
            Diagnostic::warning(
                "unknown-version",
                format!("unknown URDF version `{}`", attribute.value),
            )
            .at(attribute.value_origin)
            .help("write version=\"1.0\", or leave it out"),
        );
    }
    Some(attribute.value.to_string())
}

fn gazebo(element: &Element, diagnostics: &mut Diagnostics) -> GazeboBlock {
    let reference = element.attribute("reference");
    let attributes: Vec<_> =
        element.attributes.iter().filter(|attribute| attribute.name != "reference").collect();
    for attribute in &attributes {
        if !attribute.name.contains(':') && attribute.name != "xmlns" {
            diagnostics.push(
                Diagnostic::warning(
                    "unknown-attribute",
                    format!("`gazebo` has no attribute `{}`", attribute.name),
                )
                .at(attribute.origin)
                .did_you_mean(
                    attribute
                        .origin
                        .0
                        .map_or(attribute.origin, |span| span.part(0, attribute.name.len()).into()),
                    &attribute.name,
                    ["reference"],
                ),
            );
        }
    }
    GazeboBlock {
        reference: reference.map(|reference| reference.value.trim().to_owned()),
        content: element.elements().map(keep).collect(),
        extra: crate::robot::Extra {
            attributes: attributes.into_iter().cloned().collect(),
            elements: Vec::new(),
        },
        origin: reference.map_or(element.origin, |reference| reference.value_origin),
    }
}

/// Reads an `<origin>`.
fn placement(element: &Element, diagnostics: &mut Diagnostics) -> UrdfOrigin {
    let rotation = match vector::<4>(element, "quat_xyzw", diagnostics) {
        Some(xyzw) if xyzw.iter().map(|part| part * part).sum::<f64>() > 1e-12 => {
            if let Some(rpy) = element.attribute("rpy") {
                diagnostics.push(
                    Diagnostic::warning(
                        "two-rotations",
                        "this origin has both `rpy` and `quat_xyzw`; the quaternion is used",
                    )
                    .at(rpy.origin)
                    .help("keep one of them"),
                );
            }
            Rotation::Quaternion(xyzw)
        }
        Some(_) => {
            diagnostics.push(
                Diagnostic::error("bad-number", "a quaternion of length zero is not a rotation")
                    .at(element.attribute("quat_xyzw").map_or(element.origin, |a| a.value_origin))
                    .help("write quat_xyzw=\"0 0 0 1\" for no rotation"),
            );
            Rotation::default()
        }
        None => {
            let rpy = vector(element, "rpy", diagnostics).unwrap_or_default();
            check_radians(element, rpy, diagnostics);
            Rotation::Rpy(rpy)
        }
    };
    UrdfOrigin {
        xyz_m: vector(element, "xyz", diagnostics).unwrap_or_default(),
        rotation,
        extra: extra(element, &["xyz", "rpy", "quat_xyzw"], &[], &[], diagnostics),
    }
}

/// Angles beyond a full turn are nearly always degrees.
fn check_radians(element: &Element, rpy: [f64; 3], diagnostics: &mut Diagnostics) {
    // Slightly more than 2 pi, to allow for rounding.
    const MAX_ANGLE_RAD: f64 = 6.3;
    if rpy.iter().all(|angle| angle.abs() <= MAX_ANGLE_RAD) {
        return;
    }
    let Some(written) = element.attribute("rpy") else { return };
    let radians = rpy.map(|degrees| {
        let rounded = format!("{:.4}", degrees.to_radians());
        format_number(rounded.parse::<f64>().unwrap_or_default() + 0.0)
    });
    diagnostics.push(
        Diagnostic::warning(
            "degrees",
            "angles of `rpy` are in radians, and these look like degrees",
        )
        .at(written.value_origin)
        .replace(written.value_origin, radians.join(" "), "in radians, degrees would be"),
    );
}

/// Reads the `<origin>` of an element; the identity if it has none.
fn origin_of(element: &Element, diagnostics: &mut Diagnostics) -> UrdfOrigin {
    only_child(element, "origin", diagnostics)
        .map(|origin| placement(origin, diagnostics))
        .unwrap_or_default()
}

fn not_a_robot(root: &Element) -> Diagnostic {
    let error = Diagnostic::error(
        "not-urdf",
        format!("the root of a URDF is `robot`, and here it is `{}`", root.name),
    )
    .at(root.name_origin());
    match root.local_name() {
        "sdf" | "gazebo" | "world" | "model" => {
            error.help("this looks like SDF; name the file .sdf or .world")
        }
        "COLLADA" => error.help("this is a mesh; name it in <mesh filename=\"...\"/>"),
        "mujoco" => error.help("this is MJCF, which is not read here"),
        "launch" => error.help("this is a launch file; give the robot file that it loads"),
        "robot" => error.help("write <robot> without a prefix"),
        _ => error.did_you_mean(root.name_origin(), &root.name, ["robot"]),
    }
}

#[cfg(test)]
pub(crate) mod tests;
