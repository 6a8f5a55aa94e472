//! The bodies that libsdformat makes of a URDF, compared with ours: names, masses, inertias,
//! shapes and where they are, sensors, joints.
//!
//! The answers come from `benches/oracles/sdf_oracle`; `PERIPLUS_SDF_ORACLE` names its outputs,
//! separated by colons. Without it this test prints that it was skipped.
#![allow(clippy::disallowed_methods, reason = "this test reads a corpus of real files")]

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_scene::{Inertial, JointKind, Link, Model};
use periplus_sdf::{NoIncludes, SdfContext};
use periplus_urdf::ConversionOptions;
use serde_json::Value;

/// A link of this file has `<box>0.1 0.1 0.1</box>`, without its attribute. Libsdformat takes the
/// link without any shape; here the shape before it stays.
const EXPLAINED: &str = "spawn_urdf";

#[test]
fn the_bodies_of_libsdformat() {
    let Ok(paths) = std::env::var("PERIPLUS_SDF_ORACLE") else {
        eprintln!("SKIPPED: PERIPLUS_SDF_ORACLE does not name outputs of sdf_oracle");
        return;
    };
    let mut faults = Vec::new();
    let mut compared = 0;
    for path in paths.split(':') {
        for line in std::fs::read_to_string(path).unwrap().lines() {
            let answer: Value = serde_json::from_str(line).unwrap();
            if answer["kind"] != "urdf" || answer["ok"] != true || answer["semantic"] != true {
                continue;
            }
            let file = answer["file"].as_str().unwrap();
            let Some(model) = std::fs::read(file).ok().and_then(|bytes| load(file, &bytes)) else {
                faults.push(format!("{file}: not read"));
                continue;
            };
            // Of a link with one bad shape liburdfdom leaves out all shapes that follow.
            let complains = answer["console"].as_array().is_some_and(|lines| {
                let text = |line: &Value| line.as_str().unwrap_or_default().to_owned();
                lines.iter().any(|line| text(line).contains("Could not parse"))
            });
            if complains || file.contains(EXPLAINED) {
                println!("not compared: {file}");
                continue;
            }
            compared += 1;
            let mut fault = |what: String| faults.push(format!("{file}: {what}"));
            compare(&model, &answer["models"][0], &mut fault);
        }
    }
    println!("{compared} files compared, {} faults", faults.len());
    assert!(compared > 0, "the oracle converted nothing");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

fn load(file: &str, bytes: &[u8]) -> Option<Model> {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let id = sources.add(file, periplus_xml::decode(bytes).ok()?.into_owned());
    let document = periplus_xml::parse(id, &sources, &mut diagnostics)?;
    let robot = periplus_urdf::read(&document, &mut diagnostics)?;
    let mut context = SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut NoIncludes,
    };
    Some(periplus_urdf::to_model(&robot, ConversionOptions::default(), &mut context))
}

fn compare(model: &Model, expected: &Value, fault: &mut dyn FnMut(String)) {
    if expected["name"] != *model.name || expected["static"] != model.is_static {
        fault(format!("{} is {}", model.name, expected["name"]));
    }
    if !near(model.parent_from_model, &expected["pose"]) {
        fault("pose of the model".into());
    }
    let links = by_name(&expected["links"]);
    let own: Vec<&str> = model.links.iter().map(|link| &*link.name).collect();
    for name in links.keys().filter(|name| !own.contains(name)) {
        fault(format!("link {name} is missing"));
    }
    for link in &model.links {
        match links.get(&*link.name) {
            Some(expected) => compare_link(link, expected, fault),
            None => fault(format!("link {} is not expected", link.name)),
        }
    }
    let joints = by_name(&expected["joints"]);
    for (name, expected) in &joints {
        let Some(joint) = model.joint(name) else {
            fault(format!("joint {name} is missing"));
            continue;
        };
        let kind = match joint.kind {
            JointKind::Continuous => "revolute".to_owned(),
            other => format!("{other:?}").to_lowercase(),
        };
        let child = model.link(&joint.child).map(|link| link.model_from_link);
        let model_from_joint = child.unwrap_or(Pose::IDENTITY) * joint.child_from_joint;
        if expected["type"] != kind
            || expected["child_link"] != *joint.child
            || expected["parent_link"] != *body(model, &joint.parent)
            || !near(model_from_joint, &expected["pose"])
        {
            fault(format!("joint {name}: {expected}"));
        }
        let (Some(axis), expected) = (&joint.axis, &expected["axes"][0]) else { continue };
        let xyz = expected["xyz"].as_array().map(|xyz| xyz.iter().filter_map(Value::as_f64));
        let xyz: Vec<f64> = xyz.into_iter().flatten().collect();
        let numbers = [
            (axis.lower.max(-1e16), &expected["lower"]),
            (axis.upper.min(1e16), &expected["upper"]),
            (axis.effort, &expected["effort"]),
            (axis.velocity, &expected["velocity"]),
            (axis.damping, &expected["damping"]),
            (axis.friction, &expected["friction"]),
        ];
        let same = |(own, expected): &(f64, &Value)| match expected.as_f64() {
            Some(expected) => (own - expected).abs() <= 1e-9 * (1.0 + expected.abs()),
            None => own.is_infinite(),
        };
        if axis.direction_in_joint.distance(DVec3::from_slice(&xyz)) > 1e-9
            || !numbers.iter().all(same)
        {
            fault(format!("axis of {name}: {axis:?} is {expected}"));
        }
    }
    for joint in model.joints.iter().filter(|joint| !joints.contains_key(&*joint.name)) {
        fault(format!("joint {} is not expected", joint.name));
    }
}

/// The link that carries a link or frame.
fn body<'a>(model: &'a Model, name: &'a str) -> &'a str {
    let mut name = name;
    while let Some(frame) = model.frames.iter().find(|frame| frame.name == name) {
        name = &frame.attached_to;
    }
    name
}

fn compare_link(link: &Link, expected: &Value, fault: &mut dyn FnMut(String)) {
    let name = &link.name;
    if !near(link.model_from_link, &expected["pose"]) {
        fault(format!("pose of {name}"));
    }
    let mass = expected["mass"].as_f64().unwrap_or(f64::NAN);
    if (link.inertial.mass_kg - mass).abs() > 1e-9 * mass {
        fault(format!("mass of {name}: {} is {mass}", link.inertial.mass_kg));
    }
    let theirs = Inertial {
        mass_kg: mass,
        link_from_inertial: pose(&expected["inertial_pose"]),
        inertia_kg_m2: std::array::from_fn(|index| {
            expected["inertia"][index].as_f64().unwrap_or(f64::NAN)
        }),
        ..Inertial::default()
    };
    let own = in_link(&link.inertial);
    let distance = link
        .inertial
        .link_from_inertial
        .translation
        .distance(theirs.link_from_inertial.translation);
    if distance > 1e-9 {
        fault(format!("centre of mass of {name}: {distance} m off"));
    }
    let theirs = in_link(&theirs);
    let size: f64 = theirs.iter().map(|part| part.abs()).sum();
    let worst = own.iter().zip(theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // NaN is worse than anything.
    if worst.is_nan() || worst > 1e-9 * size {
        fault(format!("inertia of {name}: {own:?} is {theirs:?}"));
    }
    let collisions = link.collisions.iter().map(|one| (&one.name, one.link_from_collision));
    placed("collisions", name, collisions.collect(), &expected["collisions"], fault);
    let visuals = link.visuals.iter().map(|one| (&one.name, one.link_from_visual));
    placed("visuals", name, visuals.collect(), &expected["visuals"], fault);
    let sensors = link.sensors.iter().map(|one| (&one.name, one.parent_from_sensor));
    placed("sensors", name, sensors.collect(), &expected["sensors"], fault);
}

/// Inertia about the centre of mass along the axes of the link.
fn in_link(inertial: &Inertial) -> [f64; 6] {
    let [xx, xy, xz, yy, yz, zz] = inertial.inertia_kg_m2;
    let rows = [DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz)];
    let turn = inertial.link_from_inertial.rotation;
    let times = |axis: DVec3| {
        let axis = turn.conjugate() * axis;
        turn * DVec3::new(rows[0].dot(axis), rows[1].dot(axis), rows[2].dot(axis))
    };
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(times);
    [x.x, y.x, z.x, y.y, z.y, z.z]
}

fn placed(
    what: &str,
    link: &str,
    own: Vec<(&String, Pose)>,
    expected: &Value,
    fault: &mut dyn FnMut(String),
) {
    let same = if what == "sensors" { near_sensor } else { near };
    let expected = by_name(expected);
    let names: Vec<&&String> = own.iter().map(|(name, _)| name).collect();
    for name in expected.keys() {
        if !names.iter().any(|own| own.as_str() == *name) {
            fault(format!("{what} of {link}: {name} is missing"));
        }
    }
    for (name, pose) in &own {
        match expected.get(&***name) {
            None => fault(format!("{what} of {link}: {name} is not expected")),
            Some(expected) if !same(*pose, &expected["pose"]) => {
                fault(format!(
                    "{what} of {link}: pose of {name}: {pose:?} is {}",
                    expected["pose"]
                ));
            }
            Some(_) => {}
        }
    }
}

fn by_name(list: &Value) -> BTreeMap<&str, &Value> {
    let list = list.as_array().map_or(&[][..], Vec::as_slice);
    list.iter().filter_map(|one| Some((one["name"].as_str()?, one))).collect()
}

fn pose(value: &Value) -> Pose {
    let at = |index: usize| value[index].as_f64().unwrap_or(f64::NAN);
    let rotation = DQuat::from_xyzw(at(4), at(5), at(6), at(3));
    Pose { translation: DVec3::new(at(0), at(1), at(2)), rotation }
}

/// True if two poses are equal up to the rounding of libsdformat: it converts to roll,
/// pitch and yaw, and where the sine of the pitch exceeds 0.99999 liburdfdom takes a right angle
/// (urdf_model/pose.h, `getRPY`), which is up to 4.5 mrad off.
fn near(own: Pose, expected: &Value) -> bool {
    let (metres, radians) = own.distance_to(pose(expected));
    let upright = own.rpy().pitch.sin().abs() > 0.99999;
    metres < 1e-6 && radians < if upright { 4.6e-3 } else { 1e-6 }
}

/// The same for a sensor that was merged: its pose is written with six digits, and a half turn is
/// 3.14159, 2.7e-6 off.
fn near_sensor(own: Pose, expected: &Value) -> bool {
    let (metres, radians) = own.distance_to(pose(expected));
    let size = own.translation.length();
    near(own, expected) || metres < 1e-6 + 1e-5 * size && radians < 2e-5
}
