//! Every file that liburdfdom (`check_urdf`) accepts is read, and is the same tree.
//!
//! The answers of the library come from `benches/oracles/urdf_oracle`; `PERIPLUS_URDF_ORACLE`
//! names its output. Without it this test prints that it was skipped.
#![allow(clippy::disallowed_methods, reason = "this test reads a corpus of real files")]

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostics, Severity, SourceMap};
use periplus_geometry::Pose;
use periplus_urdf::{UrdfGeometry, UrdfRobot};
use serde_json::Value;

/// Cases in which this reader is stricter than liburdfdom. The file is read nevertheless.
const STRICTER: [&str; 6] = [
    // The library reads `${...}` in names and texts as if it were meant.
    "unexpanded-xacro",
    // It never looks whether a mimicked joint is there, or an axis has a direction.
    "unknown-joint",
    "zero-axis",
    // It accepts negative masses and sizes.
    "negative-mass",
    "bad-size",
    // It accepts a link with two parent joints and shows it twice.
    "two-parents",
];

#[test]
fn the_trees_of_liburdfdom() {
    let Ok(path) = std::env::var("PERIPLUS_URDF_ORACLE") else {
        eprintln!("SKIPPED: PERIPLUS_URDF_ORACLE does not name the output of urdf_oracle");
        return;
    };
    let mut faults = Vec::new();
    let (mut accepted, mut refused) = (0, 0);
    for line in std::fs::read_to_string(path).unwrap().lines() {
        let answer: Value = serde_json::from_str(line).unwrap();
        let file = answer["file"].as_str().unwrap();
        let Ok(bytes) = std::fs::read(file) else { continue };
        let (robot, errors, is_warned) = load(file, &bytes);
        if answer["ok"] == true {
            accepted += 1;
            // The library prints an error for a link that it cannot read, leaves the rest of the
            // link out, and accepts the file. Here that is an error or a warning, and the rest is
            // kept.
            let complains = answer["console"].as_str().is_some_and(|text| text.contains("Error:"));
            let unexplained: Vec<_> =
                errors.iter().filter(|code| !STRICTER.contains(*code)).collect();
            if complains && errors.is_empty() && !is_warned {
                faults.push(format!("{file}: the library complains: {}", answer["console"]));
            }
            if !complains && !unexplained.is_empty() {
                faults.push(format!("{file}: refused: {unexplained:?}"));
            }
            match robot {
                Some(robot) => compare(file, &robot, &answer, complains, &mut faults),
                None => faults.push(format!("{file}: not read")),
            }
        } else {
            refused += 1;
            if errors.is_empty() {
                println!("more lenient: {file}: {}", answer["console"]);
            }
        }
    }
    println!("{accepted} accepted by liburdfdom, {refused} refused");
    assert!(accepted > 0, "the oracle accepted nothing");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Robot, codes of its errors, and true if any finding was about shapes.
fn load(file: &str, bytes: &[u8]) -> (Option<UrdfRobot>, Vec<&'static str>, bool) {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let Ok(text) = periplus_xml::decode(bytes) else { return (None, vec!["decode"], false) };
    let id = sources.add(file, text.into_owned());
    let robot = periplus_xml::parse(id, &sources, &mut diagnostics)
        .and_then(|document| periplus_urdf::read(&document, &mut diagnostics));
    let errors = diagnostics.iter().filter(|one| one.severity == Severity::Error);
    let is_warned = diagnostics.iter().any(|one| one.code == "missing-element");
    (robot, errors.map(|one| one.code).collect(), is_warned)
}

fn compare(
    file: &str,
    robot: &UrdfRobot,
    answer: &Value,
    tree_only: bool,
    faults: &mut Vec<String>,
) {
    let mut fault = |what: String| faults.push(format!("{file}: {what}"));
    if answer["name"] != *robot.name {
        fault(format!("name {} is {}", robot.name, answer["name"]));
    }
    let links: BTreeMap<&str, &Value> = by_name(&answer["links"]);
    let joints: BTreeMap<&str, &Value> = by_name(&answer["joints"]);
    if links.len() != robot.links.len() || joints.len() != robot.joints.len() {
        fault(format!(
            "{} links and {} joints, expected {} and {}",
            robot.links.len(),
            robot.joints.len(),
            links.len(),
            joints.len()
        ));
    }
    for link in &robot.links {
        let Some(expected) = links.get(&*link.name) else {
            fault(format!("link {} is not expected", link.name));
            continue;
        };
        let parents: Vec<&str> = robot
            .joints
            .iter()
            .filter(|joint| joint.child == link.name)
            .map(|joint| &*joint.parent)
            .collect();
        if expected["parent"].as_str() != parents.last().copied() {
            fault(format!("{} hangs on {parents:?}, not {}", link.name, expected["parent"]));
        }
        if tree_only {
            continue;
        }
        if let Some(inertial) = &link.inertial {
            let same = near(&[inertial.mass_kg], &expected["mass"])
                && near(&inertial.inertia_kg_m2, &expected["inertia"])
                && near(&wxyz(inertial.link_from_inertial.pose()), &expected["inertial_pose"]);
            if !same {
                fault(format!("inertial of {}", link.name));
            }
        } else if !expected["mass"].is_null() {
            fault(format!("inertial of {} is missing", link.name));
        }
        let collisions = link.collisions.iter().map(|collision| {
            (&collision.name, collision.link_from_collision.pose(), &collision.geometry)
        });
        if !shapes(collisions, &expected["collisions"]) {
            fault(format!("collisions of {}", link.name));
        }
        let visuals = link
            .visuals
            .iter()
            .map(|visual| (&visual.name, visual.link_from_visual.pose(), &visual.geometry));
        if !shapes(visuals, &expected["visuals"]) {
            fault(format!("visuals of {}", link.name));
        }
    }
    for joint in &robot.joints {
        let Some(expected) = joints.get(&*joint.name) else {
            fault(format!("joint {} is not expected", joint.name));
            continue;
        };
        let limit = joint.limit.as_ref();
        let dynamics = joint.dynamics.as_ref();
        let same = expected["type"] == joint.kind.name()
            && expected["parent"] == *joint.parent
            && expected["child"] == *joint.child
            && near(&wxyz(joint.parent_from_joint.pose()), &expected["pose"])
            && (!joint.kind.has_axis() || near(&joint.axis_xyz(), &expected["axis"]))
            && limit.is_some() != expected["limits"].is_null()
            && limit.is_none_or(|limit| {
                near(&[limit.lower], &expected["limits"]["lower"])
                    && near(&[limit.upper], &expected["limits"]["upper"])
                    && near(&[limit.effort], &expected["limits"]["effort"])
                    && near(&[limit.velocity], &expected["limits"]["velocity"])
            })
            && dynamics.is_some() != expected["dynamics"].is_null()
            && dynamics.is_none_or(|dynamics| {
                near(&[dynamics.damping], &expected["dynamics"]["damping"])
                    && near(&[dynamics.friction], &expected["dynamics"]["friction"])
            })
            && joint.mimic.is_some() != expected["mimic"].is_null()
            && joint.mimic.as_ref().is_none_or(|mimic| {
                near(&[mimic.multiplier], &expected["mimic"]["multiplier"])
                    && near(&[mimic.offset], &expected["mimic"]["offset"])
            });
        if !same {
            fault(format!("joint {}: {expected}", joint.name));
        }
    }
}

fn by_name(list: &Value) -> BTreeMap<&str, &Value> {
    let list = list.as_array().map_or(&[][..], Vec::as_slice);
    list.iter().filter_map(|one| Some((one["name"].as_str()?, one))).collect()
}

fn shapes<'a>(
    shapes: impl Iterator<Item = (&'a Option<String>, Pose, &'a UrdfGeometry)>,
    expected: &Value,
) -> bool {
    let shapes: Vec<_> = shapes.collect();
    let expected = expected.as_array().map_or(&[][..], Vec::as_slice);
    shapes.len() == expected.len()
        && shapes.iter().zip(expected).all(|((name, pose, geometry), expected)| {
            expected["name"].as_str().unwrap_or_default() == name.as_deref().unwrap_or_default()
                && near(&wxyz(*pose), &expected["pose"])
                && same_shape(geometry, &expected["geometry"])
        })
}

fn same_shape(geometry: &UrdfGeometry, expected: &Value) -> bool {
    match geometry {
        UrdfGeometry::Box { size_m } => near(size_m, &expected["size"]),
        UrdfGeometry::Cylinder { radius_m, length_m }
        | UrdfGeometry::Capsule { radius_m, length_m } => {
            near(&[*radius_m], &expected["radius"]) && near(&[*length_m], &expected["length"])
        }
        UrdfGeometry::Sphere { radius_m } => near(&[*radius_m], &expected["radius"]),
        UrdfGeometry::Mesh { filename, scale, .. } => {
            expected["uri"] == **filename && near(scale, &expected["scale"])
        }
        UrdfGeometry::Unknown(_) => false,
    }
}

/// Position and quaternion as the oracle writes them: w first, and the first part that is not
/// zero positive.
fn wxyz(pose: Pose) -> [f64; 7] {
    let [x, y, z] = pose.translation.to_array();
    let [qx, qy, qz, qw] = pose.rotation.to_array();
    [x, y, z, qw, qx, qy, qz]
}

fn near(values: &[f64], expected: &Value) -> bool {
    let expected: Vec<f64> = match expected {
        Value::Array(list) => list.iter().filter_map(Value::as_f64).collect(),
        other => other.as_f64().into_iter().collect(),
    };
    if values.len() != expected.len() {
        return false;
    }
    let close = |sign: f64| {
        values.iter().zip(&expected).enumerate().all(|(index, (value, expected))| {
            let sign = if values.len() == 7 && index >= 3 { sign } else { 1.0 };
            (sign * value - expected).abs() <= 1e-9 * (1.0 + expected.abs())
        })
    };
    close(1.0) || values.len() == 7 && close(-1.0)
}
