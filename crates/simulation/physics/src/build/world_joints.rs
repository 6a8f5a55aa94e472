//! Joints between models.

use std::ops::Range;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_scene::Joint;

use crate::joints::{Axes, axes_of};
use crate::records::{JointRecord, Records, WORLD_BODY_INDEX};

/// A link of a world: its model, its body and `world_from_link`.
type WorldLink = (u32, usize, Pose);

/// Appends a joint of the world, between `model::link` names or `world`.
pub(crate) fn add_world_joint(records: &mut Records, joint: &Joint, diagnostics: &mut Diagnostics) {
    let ends = (end(records, &joint.parent), end(records, &joint.child));
    let ((_, parent, _), (model, child, world_from_child)) = match ends {
        (Some(parent), Some(child)) if child.1 != WORLD_BODY_INDEX => (parent, child),
        (parent, _) => {
            let missing = if parent.is_none() { &joint.parent } else { &joint.child };
            diagnostics.push(
                Diagnostic::error(
                    "joint-end-unknown",
                    format!("joint `{}` connects `{missing}`, which is not a link", joint.name),
                )
                .at(joint.origin)
                .note("the joint is omitted")
                .help("links of a world are named `model::link`"),
            );
            return;
        }
    };
    let world_from_joint = world_from_child * joint.child_from_joint;
    let mark = records.mark();
    let name = joint.name.clone();
    let place = Axes { parent, child, world_from_joint };
    let made = world_from_joint.is_finite() && parent != child;
    if !made || axes_of(joint, &name, place, records, diagnostics).is_none() {
        records.truncate(mark);
        return;
    }
    let axes: Range<usize> = mark.axes..records.axes.len();
    records.joints.push(JointRecord { model, name, axes });
}

fn end(records: &Records, name: &str) -> Option<WorldLink> {
    if name == "world" {
        return Some((0, WORLD_BODY_INDEX, Pose::IDENTITY));
    }
    let link = records.links.iter().find(|link| {
        let model = &records.models[link.model as usize];
        let scoped = name.strip_prefix(model.name.as_str());
        !model.removed && scoped.and_then(|name| name.strip_prefix("::")) == Some(&link.name)
    })?;
    let body = records.bodies.get(link.body)?;
    Some((link.model, link.body, body.world_from_body * link.body_from_link))
}
