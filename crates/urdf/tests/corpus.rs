//! Real files: what is written reads back the same, and a model has the tree of its URDF.
//!
//! `PERIPLUS_URDF_ORACLE` names the output of `benches/oracles/urdf_oracle`, of which only the
//! names of the files are used. Without it this test says that it was skipped.
#![allow(clippy::disallowed_methods, reason = "this test reads a corpus of real files")]

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostics, Severity, SourceMap, Style, render};
use periplus_scene::tf_tree;
use periplus_sdf::{Context, NoIncludes};
use periplus_urdf::{JointType, Options, read, to_model, write};

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
    for line in std::fs::read_to_string(path).unwrap().lines() {
        let answer: serde_json::Value = serde_json::from_str(line).unwrap();
        let file = answer["file"].as_str().unwrap();
        let Ok(bytes) = std::fs::read(file) else { continue };
        let mut sources = SourceMap::new();
        let mut diagnostics = Diagnostics::new();
        let Ok(text) = periplus_xml::decode(&bytes) else { continue };
        let id = sources.add(file, text.into_owned());
        let Some(document) = periplus_xml::parse(id, &sources, &mut diagnostics) else { continue };
        let Some(robot) = read(&document, &mut diagnostics) else { continue };
        let written = write(&robot);
        assert_eq!(read(&written, &mut Diagnostics::new()).as_ref(), Some(&robot), "{file}");
        let accepted = !diagnostics.has_errors();
        let mut context = Context {
            sources: &mut sources,
            diagnostics: &mut diagnostics,
            includes: &mut NoIncludes,
        };
        let model = to_model(&robot, Options::default(), &mut context);
        if accepted {
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
                        .is_some_and(|joint| joint.kind == periplus_scene::JointKind::Revolute);
                    let moves =
                        (joint.kind != JointType::Fixed || hinge) && bodies.contains(&*joint.child);
                    let name = moves.then(|| joint.name.clone());
                    (joint.parent.clone(), joint.child.clone(), name)
                })
                .collect();
            let extra: Vec<_> = tree.difference(&expected).collect();
            let missing: Vec<_> = expected.difference(&tree).collect();
            // Blocks of SDF in the file may bring links and joints of their own.
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
                println!("{}", render(one, &sources, Style::Plain));
            }
        }
    }
    for ((severity, code), (count, files)) in codes.iter().rev() {
        println!("{:8} {code:24} {count:5} in {} files", severity.name(), files.len());
    }
    println!("{compared} trees compared");
    assert!(compared > 0, "nothing was compared");
}
