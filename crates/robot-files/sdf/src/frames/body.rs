//! Poses of the parts of links and joints.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_scene::{Axis, Joint, Link, Sensor};

use super::scope::{Scope, report_unknown};
use crate::draft::{JointDraft, LinkDraft, Part};
use crate::pose::Reference;

/// Resolves the parts of a link whose own pose is resolved.
pub(super) fn place_link(draft: LinkDraft, scope: &Scope, diagnostics: &mut Diagnostics) -> Link {
    let mut link = draft.link;
    let link_from_model = link.model_from_link.inverse();
    for (part, frame) in draft.parts {
        let Some(model_from_frame) = find(&frame, scope, diagnostics) else { continue };
        // In its own link's frame nothing changes, not even by rounding.
        let link_from_frame = if frame.name == link.name {
            Pose::IDENTITY
        } else {
            link_from_model * model_from_frame
        };
        place_part(part, link_from_frame, &mut link);
    }
    link
}

fn place_part(part: Part, link_from_frame: Pose, link: &mut Link) {
    match part {
        Part::Collision(index) => {
            let pose = &mut link.collisions[index].link_from_collision;
            *pose = link_from_frame * *pose;
        }
        Part::Visual(index) => {
            let pose = &mut link.visuals[index].link_from_visual;
            *pose = link_from_frame * *pose;
        }
        Part::Light(index) => {
            let pose = &mut link.lights[index].parent_from_light;
            *pose = link_from_frame * *pose;
        }
        Part::Sensor(_) | Part::Camera(..) => {
            place_sensor(part, link_from_frame, &mut link.sensors);
        }
    }
}

/// Sensors precede their cameras in the list of parts, so a sensor's pose is resolved before that of its
/// camera.
fn place_sensor(part: Part, parent_from_frame: Pose, sensors: &mut [Sensor]) {
    match part {
        Part::Sensor(index) => {
            let pose = &mut sensors[index].parent_from_sensor;
            *pose = parent_from_frame * *pose;
        }
        Part::Camera(index, camera) => {
            let sensor = &mut sensors[index];
            let sensor_from_frame = sensor.parent_from_sensor.inverse() * parent_from_frame;
            if let periplus_scene::SensorKind::Camera(first) = &mut sensor.kind {
                let chosen = match camera.checked_sub(1) {
                    None => Some(&mut **first),
                    Some(other) => first.others.get_mut(other),
                };
                if let Some(chosen) = chosen {
                    chosen.sensor_from_camera = sensor_from_frame * chosen.sensor_from_camera;
                }
            }
        }
        _ => {}
    }
}

/// Resolves a joint, its axes and its sensors.
pub(super) fn place_joint(
    draft: JointDraft,
    model_from_joint: Pose,
    scope: &Scope,
    diagnostics: &mut Diagnostics,
) -> Joint {
    let mut joint = draft.joint;
    if draft.relative_to.is_some() {
        // An unknown child was reported when the frames were resolved.
        let model_from_child = scope.parent_from(&draft.child.name).unwrap_or_default();
        joint.child_from_joint = model_from_child.inverse() * model_from_joint;
        if scope.parent_from(&draft.child.name).is_none() {
            report_unknown(&draft.child, scope, diagnostics);
        }
    }
    if draft.parent.name != "world" {
        find(&draft.parent, scope, diagnostics);
    }
    if draft.parent.name == draft.child.name {
        diagnostics.push(
            Diagnostic::error(
                "bad-joint",
                format!("joint `{}` attaches `{}` to itself", joint.name, draft.child.name),
            )
            .at(draft.child.origin)
            .related(draft.parent.origin, "the parent"),
        );
    }
    let [first, second] = draft.expressed_in;
    turn_axis(&mut joint.axis, first, model_from_joint, scope, diagnostics);
    turn_axis(&mut joint.axis2, second, model_from_joint, scope, diagnostics);
    for (part, frame) in draft.parts {
        if let Some(model_from_frame) = find(&frame, scope, diagnostics) {
            let joint_from_frame = model_from_joint.inverse() * model_from_frame;
            place_sensor(part, joint_from_frame, &mut joint.sensors);
        }
    }
    joint.parent = draft.parent.name.to_string();
    joint.child = draft.child.name.to_string();
    joint
}

fn turn_axis(
    axis: &mut Option<Axis>,
    expressed_in: Option<Reference>,
    model_from_joint: Pose,
    scope: &Scope,
    diagnostics: &mut Diagnostics,
) {
    let (Some(axis), Some(frame)) = (axis, expressed_in) else { return };
    let Some(model_from_frame) = find(&frame, scope, diagnostics) else { return };
    let turn = (model_from_joint.inverse() * model_from_frame).rotation;
    if turn != Pose::IDENTITY.rotation {
        axis.direction_in_joint = (turn * axis.direction_in_joint).normalize();
    }
}

fn find(frame: &Reference, scope: &Scope, diagnostics: &mut Diagnostics) -> Option<Pose> {
    let pose = scope.parent_from(&frame.name);
    if pose.is_none() {
        report_unknown(frame, scope, diagnostics);
    }
    pose
}
