//! `<joint>`.

use std::f64::consts::TAU;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::DVec3;
use periplus_scene::{Axis, Joint, JointKind, Mimic};
use periplus_xml::Element;

use super::sensor::read_sensor;
use super::shape::unit;
use crate::draft::{JointDraft, Part};
use crate::fields::Fields;
use crate::pose::Reference;
use crate::value;

const KINDS: [(&str, JointKind); 9] = [
    ("fixed", JointKind::Fixed),
    ("revolute", JointKind::Revolute),
    ("continuous", JointKind::Continuous),
    ("prismatic", JointKind::Prismatic),
    ("ball", JointKind::Ball),
    ("universal", JointKind::Universal),
    ("revolute2", JointKind::Revolute2),
    ("screw", JointKind::Screw),
    ("gearbox", JointKind::Gearbox),
];

/// SDF name of a joint type; `None` for types that only URDF has.
pub(crate) fn kind_name(kind: JointKind) -> Option<&'static str> {
    KINDS.iter().find(|(_, known)| *known == kind).map(|(name, _)| *name)
}

/// Reads a `<joint>`; `None` if parent, child or type are missing.
pub(crate) fn read_joint(element: &Element, diagnostics: &mut Diagnostics) -> Option<JointDraft> {
    let mut fields = Fields::new(element, diagnostics);
    let name = fields.required_attribute("name").map(|it| it.value.to_string());
    let name = name.unwrap_or_else(|| "joint".into());
    let kind = read_kind(&mut fields);
    let parent = end("parent", &name, &mut fields);
    let child = end("child", &name, &mut fields);
    let mut joint = Joint::new(name, kind?, "", "");
    joint.origin = element.origin;
    let (pose, relative_to) = fields.pose();
    joint.child_from_joint = pose;
    let mut expressed_in = [None, None];
    joint.axis = read_axis("axis", kind?, &mut fields, &mut expressed_in[0]);
    joint.axis2 = read_axis("axis2", kind?, &mut fields, &mut expressed_in[1]);
    joint.thread_pitch_m = thread_pitch(kind?, &mut fields);
    let mut parts = Vec::new();
    for (index, child) in fields.children("sensor").into_iter().enumerate() {
        let placed = read_sensor(child, fields.diagnostics);
        parts.extend(placed.relative_to.map(|it| (Part::Sensor(index), it)));
        for (camera, reference) in placed.cameras_relative_to {
            parts.push((Part::Camera(index, camera), reference));
        }
        joint.sensors.push(placed.value);
    }
    fields.verbatim(&["gearbox_ratio", "gearbox_reference_body", "physics", "frame"]);
    joint.extra = fields.finish();
    let (parent, child) = (parent?, child?);
    joint.parent = parent.name.to_string();
    joint.child = child.name.to_string();
    Some(JointDraft { joint, relative_to, parent, child, expressed_in, parts })
}

fn read_kind(fields: &mut Fields<'_, '_>) -> Option<JointKind> {
    let written = fields.required_attribute("type")?;
    let known = KINDS.iter().find(|(name, _)| *name == written.value);
    if known.is_none() {
        let names = KINDS.iter().map(|(name, _)| *name);
        fields.diagnostics.push(
            Diagnostic::error(
                "unknown-type",
                format!("`{}` is not a kind of joint", written.value),
            )
            .at(written.value_origin)
            .note(format!("kinds are {}", names.clone().collect::<Vec<_>>().join(", ")))
            .note("the joint is left out")
            .did_you_mean(written.value_origin, &written.value, names),
        );
    }
    known.map(|(_, kind)| *kind)
}

fn end(which: &'static str, joint: &str, fields: &mut Fields<'_, '_>) -> Option<Reference> {
    let (name, origin) = match fields.child(which) {
        Some(element) => {
            value::leaf(element, &[], fields.diagnostics);
            (element.text(), element.text_origin())
        }
        None => ("".into(), fields.origin()),
    };
    if name.is_empty() {
        fields.diagnostics.push(
            Diagnostic::error("missing-element", format!("joint `{joint}` lacks its `<{which}>`"))
                .at(origin)
                .note("the joint is left out"),
        );
        return None;
    }
    Some(Reference { name: name.as_ref().into(), origin })
}

fn read_axis(
    name: &'static str,
    kind: JointKind,
    fields: &mut Fields<'_, '_>,
    expressed_in: &mut Option<Reference>,
) -> Option<Axis> {
    let joint_origin = fields.origin();
    let Some(mut child) = fields.open(name) else {
        let wanted = match kind {
            JointKind::Fixed | JointKind::Ball => false,
            JointKind::Universal | JointKind::Revolute2 => true,
            _ => name == "axis",
        };
        if wanted {
            fields.diagnostics.push(
                Diagnostic::warning(
                    "missing-element",
                    format!("a joint of this kind needs its `<{name}>`"),
                )
                .at(joint_origin)
                .note("the default is used: z of the joint's frame, without limits")
                .help(format!("add `<{name}><xyz>0 0 1</xyz></{name}>`")),
            );
        }
        return wanted.then(Axis::default);
    };
    let mut axis =
        Axis { direction_in_joint: direction(&mut child, expressed_in), ..Axis::default() };
    if let Some(mut limit) = child.open("limit") {
        read_limits(&mut limit, &mut axis);
        limit.verbatim(&["stiffness", "dissipation"]);
        let rest = limit.finish();
        child.close("limit", rest);
    }
    if let Some(mut dynamics) = child.open("dynamics") {
        axis.damping = dynamics.number("damping", 0.0);
        axis.friction = dynamics.number("friction", 0.0);
        axis.spring_stiffness = dynamics.number("spring_stiffness", 0.0);
        axis.spring_reference = dynamics.number("spring_reference", 0.0);
        let rest = dynamics.finish();
        child.close("dynamics", rest);
    }
    axis.mimic = read_mimic(&mut child);
    child.verbatim(&["initial_position"]);
    axis.extra = child.finish();
    Some(axis)
}

fn direction(axis: &mut Fields<'_, '_>, expressed_in: &mut Option<Reference>) -> DVec3 {
    let Some(element) = axis.child("xyz") else {
        axis.require("xyz", "0 0 1");
        return DVec3::Z;
    };
    value::leaf(element, &["expressed_in"], axis.diagnostics);
    if let Some(frame) = element.attribute("expressed_in")
        && !frame.value.trim().is_empty()
    {
        *expressed_in =
            Some(Reference { name: frame.value.trim().into(), origin: frame.value_origin });
    }
    let Some(written) = value::numbers(element, axis.diagnostics).map(DVec3::from_array) else {
        return DVec3::Z;
    };
    unit(written).unwrap_or_else(|| {
        axis.diagnostics.push(
            Diagnostic::error("bad-direction", "the direction of an axis must not be zero")
                .at(element.text_origin())
                .note("0 0 1 is assumed"),
        );
        DVec3::Z
    })
}

fn read_limits(limit: &mut Fields<'_, '_>, axis: &mut Axis) {
    // SDF's values for infinite: 1e16, and -1 for values that cannot be negative.
    let free =
        |value: f64| if value.abs() >= 1e16 { value.signum() * f64::INFINITY } else { value };
    let or_free = |value: f64| if value < 0.0 { f64::INFINITY } else { free(value) };
    axis.lower = free(limit.limit("lower", f64::NEG_INFINITY));
    axis.upper = free(limit.limit("upper", f64::INFINITY));
    axis.effort = or_free(limit.limit("effort", f64::INFINITY));
    axis.velocity = or_free(limit.limit("velocity", f64::INFINITY));
    if axis.lower > axis.upper {
        let place =
            |name| limit.element.child(name).map_or(Origin::default(), Element::text_origin);
        let finding = Diagnostic::error("out-of-range", "`<lower>` is above `<upper>`")
            .at(place("lower"))
            .related(place("upper"), "the upper limit")
            .note("the two are swapped");
        limit.diagnostics.push(finding);
        std::mem::swap(&mut axis.lower, &mut axis.upper);
    }
}

fn read_mimic(axis: &mut Fields<'_, '_>) -> Option<Mimic> {
    let mut fields = axis.open("mimic")?;
    let joint = fields.required_attribute("joint").map(|it| it.value.to_string());
    let axis_name = fields.attribute("axis").map_or("axis", |it| &*it.value).to_owned();
    let mimic = Mimic {
        joint: joint.clone().unwrap_or_default(),
        axis: axis_name,
        multiplier: fields.number("multiplier", 1.0),
        offset: fields.number("offset", 0.0),
        reference: fields.number("reference", 0.0),
    };
    let rest = fields.finish();
    axis.close("mimic", rest);
    joint.map(|_| mimic)
}

/// `<screw_thread_pitch>` [m per turn] since SDF 1.10; before, `<thread_pitch>` [rad/m] with the
/// opposite sign (libsdformat, Joint.cc: `screw = -2π / thread`).
fn thread_pitch(kind: JointKind, fields: &mut Fields<'_, '_>) -> Option<f64> {
    let newer = fields.optional_number("screw_thread_pitch");
    let older = fields.optional_number("thread_pitch");
    let older = older.filter(|pitch| *pitch != 0.0).map(|pitch| -TAU / pitch);
    match kind {
        // The default of `<thread_pitch>` is 1.
        JointKind::Screw => Some(newer.or(older).unwrap_or(-TAU)),
        _ => newer,
    }
}
