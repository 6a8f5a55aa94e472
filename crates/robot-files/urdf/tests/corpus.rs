//! Real files: written files are read back unchanged, and a model has the tree of its URDF.
//!
//! `PERIPLUS_URDF_ORACLE` names the output of `benches/oracles/urdf_oracle`, of which only the
//! names of the files are used. Without it this test prints that it was skipped.
#![allow(clippy::disallowed_methods, reason = "this test reads a corpus of real files")]
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "helpers of a test")]

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostics, RenderStyle, Severity, SourceMap, render};
use periplus_scene::{JointKind, Model, Scene, tf_tree};
use periplus_sdf::{NoIncludes, SdfContext};
use periplus_urdf::{ConversionOptions, JointType, from_model, read, to_model, write};
use periplus_xml::Document;
use serde_json::Value;

#[test]
fn real_files_keep_their_tree() {
    let Ok(path) = std::env::var("PERIPLUS_URDF_ORACLE") else {
        eprintln!("SKIPPED: PERIPLUS_URDF_ORACLE does not name the output of urdf_oracle");
        return;
    };
    // Shows all findings of this code.
    let shown = std::env::var("SHOW").ok();
    let mut codes: BTreeMap<(Severity, &str), (usize, BTreeSet<String>)> = BTreeMap::new();
    let mut compared = 0;
    let mut faults = Vec::new();
    for line in std::fs::read_to_string(path).unwrap().lines() {
        let answer: Value = serde_json::from_str(line).unwrap();
        let file = answer["file"].as_str().unwrap();
        let Ok(bytes) = std::fs::read(file) else { continue };
        let mut sources = SourceMap::new();
        let mut diagnostics = Diagnostics::new();
        let Ok(text) = periplus_xml::decode(&bytes) else { continue };
        let id = sources.add(file, text.into_owned());
        let Some(document) = periplus_xml::parse(id, &sources, &mut diagnostics) else { continue };
        let Some(robot) = read(&document, &mut diagnostics) else { continue };
        let id = sources.add("again.urdf", periplus_xml::write_document(&write(&robot)));
        let written = periplus_xml::parse(id, &sources, &mut Diagnostics::new()).unwrap();
        assert_eq!(read(&written, &mut Diagnostics::new()).as_ref(), Some(&robot), "{file}");
        let accepted = !diagnostics.has_errors();
        let mut context = SdfContext {
            sources: &mut sources,
            diagnostics: &mut diagnostics,
            includes: &mut NoIncludes,
        };
        let model = to_model(&robot, ConversionOptions::default(), &mut context);
        sdf_and_back(file, &model, &mut faults);
        if accepted {
            urdf_and_back(file, &model, &mut faults);
            compared += 1;
            let tree: BTreeSet<_> = tf_tree(&model)
                .into_iter()
                .map(|edge| (edge.parent, edge.child, edge.joint))
                .collect();
            let bodies: BTreeSet<&str> = model.links.iter().map(|link| &*link.name).collect();
            let expected: BTreeSet<_> = robot
                .joints
                .iter()
                .map(|joint| {
                    // A joint above what has no mass does not move, and what old files ask for
                    // with `disableFixedJointLumping` is a hinge that cannot turn.
                    let hinge = model
                        .joint(&joint.name)
                        .is_some_and(|joint| joint.kind == JointKind::Revolute);
                    let moves =
                        (joint.kind != JointType::Fixed || hinge) && bodies.contains(&*joint.child);
                    let name = moves.then(|| joint.name.clone());
                    (joint.parent.clone(), joint.child.clone(), name)
                })
                .collect();
            let extra: Vec<_> = tree.difference(&expected).collect();
            let missing: Vec<_> = expected.difference(&tree).collect();
            // Blocks of SDF in the file may add links and joints.
            let brings = robot.gazebo.iter().flat_map(|block| &block.content);
            if brings.clone().all(|part| part.name != "link" && part.name != "joint") {
                assert!(extra.is_empty(), "{file}: {extra:?}");
                assert!(missing.is_empty(), "{file}: {missing:?}");
            }
        }
        for one in diagnostics.iter() {
            let (count, files) = codes.entry((one.severity, one.code)).or_default();
            *count += 1;
            files.insert(file.to_owned());
            if shown.as_deref() == Some(one.code) {
                println!("{}", render(one, &sources, RenderStyle::Plain));
            }
        }
    }
    for ((severity, code), (count, files)) in codes.iter().rev() {
        println!("{:8} {code:24} {count:5} in {} files", severity.name(), files.len());
    }
    println!("{compared} trees compared");
    assert!(compared > 0, "nothing was compared");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

fn read_model(document: &Document) -> Option<Model> {
    let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
    let mut context = SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut NoIncludes,
    };
    periplus_sdf::read_document(document, &mut context).models.into_iter().next()
}

/// Written as SDF and read again, a model is the same, but for joints that SDF does not have.
fn sdf_and_back(file: &str, model: &Model, faults: &mut Vec<String>) {
    let mut model = model.clone();
    model.joints.retain(|joint| !matches!(joint.kind, JointKind::Floating | JointKind::Planar));
    let scene = Scene { models: vec![model.clone()], ..Scene::default() };
    let again = read_model(&periplus_sdf::write(&scene, &mut Diagnostics::new()));
    if again.as_ref() != Some(&model) {
        let place = again.and_then(|again| difference(&json(&model), &json(&again), 0.0, ""));
        faults.push(format!("{file}: SDF and back: {place:?}"));
    }
}

/// Written as URDF and read again, a model is the same but for rounding, or a diagnostic gives the reason.
fn urdf_and_back(file: &str, model: &Model, faults: &mut Vec<String>) {
    let mut diagnostics = Diagnostics::new();
    let Some(robot) = from_model(model, &mut diagnostics) else {
        let codes: Vec<_> = diagnostics.iter().map(|one| &one.message).collect();
        println!("no URDF again: {file}: {codes:?}");
        return;
    };
    if !diagnostics.is_empty() {
        let codes: Vec<_> = diagnostics.iter().map(|one| &one.message).collect();
        println!("not the same URDF: {file}: {codes:?}");
        return;
    }
    let text = periplus_xml::write_document(&write(&robot));
    let mut sources = SourceMap::new();
    let id = sources.add("again.urdf", text);
    let document = periplus_xml::parse(id, &sources, &mut diagnostics).unwrap();
    let again = read(&document, &mut diagnostics).unwrap();
    let mut context = SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut NoIncludes,
    };
    let again = to_model(&again, ConversionOptions::default(), &mut context);
    let (mut own, mut theirs) = (json(model), json(&again));
    for one in [&mut own, &mut theirs] {
        // The order of joints by name decides that of links.
        for list in ["links", "joints", "frames"] {
            if let Some(list) = one[list].as_array_mut() {
                list.sort_by_key(|one| one["name"].to_string());
            }
        }
    }
    if let Some(place) = difference(&own, &theirs, 1e-9, "") {
        faults.push(format!("{file}: URDF and back: {place}"));
    }
}

fn json(model: &Model) -> Value {
    serde_json::to_value(model).unwrap()
}

/// First position at which two values differ by more than rounding.
fn difference(a: &Value, b: &Value, tolerance: f64, place: &str) -> Option<String> {
    let differ = || Some(format!("{place}: {a} is {b}"));
    match (a, b) {
        // Two looks of one name, which a <gazebo> block made different, cannot both keep it.
        (Value::String(_), Value::Null) if place.ends_with("material.name") => None,
        (Value::Number(x), Value::Number(y)) => {
            let (x, y) = (x.as_f64()?, y.as_f64()?);
            if (x - y).abs() <= tolerance * (1.0 + x.abs()) { None } else { differ() }
        }
        (Value::Array(x), Value::Array(y)) if x.len() == y.len() => {
            let parts = |sign: f64| {
                x.iter().zip(y).enumerate().find_map(|(index, (x, y))| {
                    let place = format!("{place}[{index}]");
                    match y.as_f64() {
                        Some(y) => difference(x, &Value::from(sign * y), tolerance, &place),
                        None => difference(x, y, tolerance, &place),
                    }
                })
            };
            // A quaternion and its negative are one rotation.
            if place.ends_with("quat_xyzw") && parts(-1.0).is_none() { None } else { parts(1.0) }
        }
        (Value::Object(x), Value::Object(y)) => {
            let keys: BTreeSet<&String> = x.keys().chain(y.keys()).collect();
            keys.into_iter().find_map(|key| {
                let null = Value::Null;
                let place = format!("{place}.{key}");
                let (x, y) = (x.get(key).unwrap_or(&null), y.get(key).unwrap_or(&null));
                difference(x, y, tolerance, &place)
            })
        }
        _ if a == b => None,
        _ => differ(),
    }
}
