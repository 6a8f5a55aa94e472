//! Link frames moved to the joint above each link.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_scene::{Model, carrying_link};

/// Returns the same model with the frame of each link at the joint above it, as URDF requires.
pub(super) fn joints_at_links(model: &Model, diagnostics: &mut Diagnostics) -> Model {
    let mut model = model.clone();
    let places: BTreeMap<String, usize> =
        model.links.iter().enumerate().map(|(place, link)| (link.name.clone(), place)).collect();
    for place in 0..model.joints.len() {
        let joint = &model.joints[place];
        let own = places.contains_key(&joint.child).then(|| joint.child.clone());
        let carrier = own.or_else(|| carrying_link(&model, &joint.child));
        let Some(carrier) = carrier else { continue };
        let Some(&link) = places.get(&carrier) else { continue };
        let frame =
            |model: &Model| model.frames.iter().find(|one| one.name == joint.child).cloned();
        let frames = if carrier == joint.child { None } else { frame(&model) };
        let model_from_link = model.links[link].model_from_link;
        let link_from_child = match frames {
            Some(frame) => model_from_link.inverse() * frame.parent_from_frame,
            None => Pose::IDENTITY,
        };
        let link_from_joint = link_from_child * joint.child_from_joint;
        if link_from_joint != Pose::IDENTITY {
            diagnostics.push(
                Diagnostic::warning(
                    "frame-moved",
                    format!(
                        "the frame of the link `{carrier}` moves to its joint, `{}`",
                        joint.name
                    ),
                )
                .at(joint.origin)
                .note("in a URDF the frame of a link is that of the joint above it"),
            );
            move_frame(&mut model, link, link_from_joint);
        }
        model.joints[place].child = carrier;
        model.joints[place].child_from_joint = Pose::IDENTITY;
    }
    model
}

fn move_frame(model: &mut Model, link: usize, old_from_new: Pose) {
    let new_from_old = old_from_new.inverse();
    let link = &mut model.links[link];
    link.model_from_link = link.model_from_link * old_from_new;
    let poses = std::iter::once(&mut link.inertial.link_from_inertial)
        .chain(link.collisions.iter_mut().map(|one| &mut one.link_from_collision))
        .chain(link.visuals.iter_mut().map(|one| &mut one.link_from_visual))
        .chain(link.sensors.iter_mut().map(|one| &mut one.parent_from_sensor))
        .chain(link.lights.iter_mut().map(|one| &mut one.parent_from_light));
    for pose in poses {
        *pose = new_from_old * *pose;
    }
}
