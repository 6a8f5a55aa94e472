//! Check that a model can be expressed as URDF.

use std::collections::BTreeSet;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::{FrameRole, JointKind, Model, TfEdge};

/// Returns true if a model is one tree of links with joints that URDF has; otherwise reports errors.
pub(super) fn check(model: &Model, tree: &[TfEdge], diagnostics: &mut Diagnostics) -> bool {
    let before = diagnostics.errors();
    for nested in &model.models {
        diagnostics.push(
            Diagnostic::error(
                "not-in-urdf",
                format!("a URDF has no models in it, and here is `{}`", nested.name),
            )
            .at(nested.origin)
            .help("bring its links into the model itself: <include merge=\"true\">"),
        );
    }
    for joint in &model.joints {
        let name = &joint.name;
        let what = match joint.kind {
            JointKind::Ball => "ball",
            JointKind::Universal => "universal",
            JointKind::Revolute2 => "revolute2",
            JointKind::Screw => "screw",
            JointKind::Gearbox => "gearbox",
            _ => continue,
        };
        diagnostics.push(
            Diagnostic::error(
                "not-in-urdf",
                format!("a URDF has no {what} joints, and `{name}` is one"),
            )
            .at(joint.origin)
            .help(match joint.kind {
                JointKind::Ball => {
                    "make it of three continuous joints and two links without extent"
                }
                JointKind::Universal | JointKind::Revolute2 => {
                    "make it of two continuous joints and a link without extent"
                }
                _ => "couple two joints by <mimic>",
            }),
        );
    }
    closed_loops(model, tree, diagnostics);
    roots(model, tree, diagnostics);
    diagnostics.errors() == before
}

/// Each link must be the child of at most one joint.
fn closed_loops(model: &Model, tree: &[TfEdge], diagnostics: &mut Diagnostics) {
    let mut held: BTreeSet<&str> = BTreeSet::new();
    let children: BTreeSet<&str> = tree.iter().map(|edge| &*edge.child).collect();
    let links: BTreeSet<&str> = model.links.iter().map(|link| &*link.name).collect();
    for joint in &model.joints {
        let child = joint.child.as_str();
        let first = held.insert(child);
        if !first || links.contains(child) && !children.contains(child) {
            diagnostics.push(
                Diagnostic::error(
                    "not-in-urdf",
                    format!(
                        "a URDF is a tree, and the joint `{}` closes a loop at `{child}`",
                        joint.name
                    ),
                )
                .at(joint.origin)
                .help("leave the joint out, or keep the model as SDF"),
            );
        }
        if child == "world" {
            diagnostics.push(
                Diagnostic::error(
                    "not-in-urdf",
                    format!("the world is the child of the joint `{}`", joint.name),
                )
                .at(joint.origin)
                .help("make the world its parent"),
            );
        }
    }
}

/// All links must belong to one tree.
fn roots(model: &Model, tree: &[TfEdge], diagnostics: &mut Diagnostics) {
    let hung: BTreeSet<&str> = tree.iter().map(|edge| &*edge.child).collect();
    let worldly = tree.iter().any(|edge| edge.parent == "world");
    let links = model.links.iter().map(|link| (&*link.name, link.origin));
    let frames = model
        .frames
        .iter()
        .filter(|frame| frame.role == FrameRole::MergedLink)
        .map(|frame| (&*frame.name, frame.origin));
    let mut roots = links.chain(frames).filter(|(name, _)| !hung.contains(name));
    let first = if worldly { None } else { roots.next() };
    if first.is_none() && !worldly {
        diagnostics.push(
            Diagnostic::error("not-in-urdf", format!("the model `{}` has no links", model.name))
                .at(model.origin),
        );
    }
    for (name, origin) in roots {
        let error = Diagnostic::error(
            "not-in-urdf",
            format!("a URDF is one tree, and the link `{name}` has no parent joint"),
        )
        .at(origin)
        .help("attach it with a joint, or convert it as a separate model");
        diagnostics.push(match first {
            Some((_, root)) => error.related(root, "the root"),
            None => error,
        });
    }
}
