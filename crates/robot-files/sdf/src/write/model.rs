//! `<model>`, `<joint>`, `<frame>`.

use std::f64::consts::TAU;

use periplus_diagnostics::Diagnostic;
use periplus_scene::{Axis, FrameRole, Joint, JointKind, Model, NamedFrame};
use periplus_xml::Element;

use super::link::write_link;
use super::out::{Out, numbers, write_pose};
use super::sensor::write_sensor;
use super::{Writer, write_plugin};
use crate::frames::first_link;
use crate::read::joint::kind_name;
use crate::version::Version;

pub(super) fn write_model(model: &Model, writer: &mut Writer<'_>) -> Element {
    let mut out = Out::named("model", &model.name);
    if let Some(link) = &model.canonical_link
        && first_link(model).as_ref() != Some(link)
    {
        out.attribute("canonical_link", link);
    }
    if let Some(uri) = &model.included_from {
        writer.own_names = true;
        out.attribute("periplus:included_from", uri);
    }
    out.pose(model.parent_from_model);
    out.flag("static", model.is_static, false);
    out.flag("self_collide", model.self_collide, false);
    out.flag("allow_auto_disable", model.allow_auto_disable, true);
    out.flag("enable_wind", model.enable_wind, false);
    for link in &model.links {
        out.push(write_link(link, writer));
    }
    for joint in &model.joints {
        if let Some(element) = write_joint(joint, writer) {
            out.push(element);
        }
    }
    for frame in &model.frames {
        out.push(write_frame(frame, "__model__", writer));
    }
    for inner in &model.models {
        out.push(write_model(inner, writer));
    }
    for plugin in &model.plugins {
        out.push(write_plugin(plugin));
    }
    out.finish(&model.extra)
}

/// Frame of a model or world with the root frame `root`.
pub(super) fn write_frame(frame: &NamedFrame, root: &str, writer: &mut Writer<'_>) -> Element {
    let mut out = Out::named("frame", &frame.name);
    if frame.attached_to != root {
        out.attribute("attached_to", &frame.attached_to);
    }
    let role = match frame.role {
        FrameRole::Declared => None,
        FrameRole::MergedLink => Some("merged_link"),
        FrameRole::MergedJoint => Some("merged_joint"),
    };
    if let Some(role) = role {
        writer.own_names = true;
        out.attribute("periplus:role", role);
    }
    out.push(write_pose(frame.parent_from_frame).with_attribute("relative_to", root));
    out.finish(&[])
}

/// Writes a `<joint>`; `None` for types that SDF does not have.
pub(super) fn write_joint(joint: &Joint, writer: &mut Writer<'_>) -> Option<Element> {
    let Some(kind) = kind_name(joint.kind) else {
        let words = if joint.kind == JointKind::Floating { "float" } else { "slide in a plane" };
        let finding = Diagnostic::warning(
            "not-in-sdf",
            format!("SDF has no joints that {words}; joint `{}` is left out", joint.name),
        );
        writer.diagnostics.push(finding.at(joint.origin));
        return None;
    };
    let mut out = Out::named("joint", &joint.name);
    out.attribute("type", kind);
    out.pose(joint.child_from_joint);
    out.text("parent", &joint.parent);
    out.text("child", &joint.child);
    if let Some(pitch_m) = joint.thread_pitch_m {
        out.always("screw_thread_pitch", pitch_m);
        // For readers of SDF before 1.10; newer ones use the other element.
        if pitch_m != 0.0 {
            out.always("thread_pitch", -TAU / pitch_m);
        }
    }
    for (name, axis) in [("axis", &joint.axis), ("axis2", &joint.axis2)] {
        if let Some(axis) = axis {
            out.push(write_axis(name, axis, writer));
        }
    }
    for sensor in &joint.sensors {
        out.push(write_sensor(sensor));
    }
    Some(out.finish(&joint.extra))
}

fn write_axis(name: &str, axis: &Axis, writer: &mut Writer<'_>) -> Element {
    let mut out = Out::new(name);
    out.text("xyz", numbers(&axis.direction_in_joint.to_array()));
    let mut limit = Out::new("limit");
    limit.number("lower", axis.lower, f64::NEG_INFINITY);
    limit.number("upper", axis.upper, f64::INFINITY);
    limit.number("effort", axis.effort, f64::INFINITY);
    limit.number("velocity", axis.velocity, f64::INFINITY);
    out.push_filled(limit.finish(&[]));
    let mut dynamics = Out::new("dynamics");
    dynamics.number("damping", axis.damping, 0.0);
    dynamics.number("friction", axis.friction, 0.0);
    dynamics.number("spring_reference", axis.spring_reference, 0.0);
    dynamics.number("spring_stiffness", axis.spring_stiffness, 0.0);
    out.push_filled(dynamics.finish(&[]));
    if let Some(mimic) = &axis.mimic {
        writer.needs(Version::new(11));
        let mut element = Out::new("mimic");
        element.attribute("joint", &mimic.joint);
        element.attribute("axis", &mimic.axis);
        element.always("multiplier", mimic.multiplier);
        element.always("offset", mimic.offset);
        element.always("reference", mimic.reference);
        out.push(element.finish(&[]));
    }
    out.finish(&axis.extra)
}
