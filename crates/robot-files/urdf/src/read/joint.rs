//! Joints.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_xml::Element;

use super::fields::{
    extra, number, only_child, required_name, required_number, required_text, vector,
};
use super::origin_of;
use crate::robot::{
    Dynamics, JointCalibration, JointType, Limit, SafetyController, UrdfJoint, UrdfMimic,
};

const CHILDREN: [&str; 9] = [
    "origin",
    "parent",
    "child",
    "axis",
    "limit",
    "dynamics",
    "mimic",
    "calibration",
    "safety_controller",
];

/// Reads a `<joint>`; `None`, with an error, if it has no name.
pub(super) fn joint(element: &Element, diagnostics: &mut Diagnostics) -> Option<UrdfJoint> {
    let name = required_name(element, "name", diagnostics)?;
    let kind = kind(element, &name, diagnostics);
    let (parent, parent_origin) = end(element, "parent", &name, diagnostics);
    let (child, child_origin) = end(element, "child", &name, diagnostics);
    let joint = UrdfJoint {
        kind,
        parent,
        child,
        parent_from_joint: origin_of(element, diagnostics),
        axis: only_child(element, "axis", diagnostics).map(|axis| axis_of(axis, diagnostics)),
        limit: only_child(element, "limit", diagnostics).map(|limit| limit_of(limit, diagnostics)),
        dynamics: only_child(element, "dynamics", diagnostics)
            .map(|dynamics| dynamics_of(dynamics, diagnostics)),
        mimic: only_child(element, "mimic", diagnostics)
            .and_then(|mimic| mimic_of(mimic, diagnostics)),
        calibration: only_child(element, "calibration", diagnostics).map(|calibration| {
            JointCalibration {
                rising: number(calibration, "rising", diagnostics),
                falling: number(calibration, "falling", diagnostics),
                extra: extra(calibration, &["rising", "falling"], &[], &[], diagnostics),
            }
        }),
        safety_controller: only_child(element, "safety_controller", diagnostics)
            .map(|safety| safety_of(safety, diagnostics)),
        extra: extra(element, &["name", "type"], &CHILDREN, &[], diagnostics),
        origin: element.origin,
        parent_origin,
        child_origin,
        name,
    };
    check_limit(&joint, diagnostics);
    check_axis(&joint, element, diagnostics);
    Some(joint)
}

fn kind(element: &Element, name: &str, diagnostics: &mut Diagnostics) -> JointType {
    let Some(kind) = required_text(element, "type", diagnostics) else {
        return JointType::Fixed;
    };
    let known = JointType::ALL.iter().find(|(known, _)| *known == kind.value.trim());
    if let Some((_, known)) = known {
        return *known;
    }
    let names = JointType::ALL.map(|(name, _)| name);
    diagnostics.push(
        Diagnostic::error(
            "unknown-joint-type",
            format!("the joint `{name}` is of no known type: `{}`", kind.value),
        )
        .at(kind.value_origin)
        .label("taken as fixed")
        .note(format!("the types are {}", names.join(", ")))
        .did_you_mean(kind.value_origin, &kind.value, names),
    );
    JointType::Fixed
}

/// Link named by `<parent link=...>` or `<child link=...>`.
fn end(joint: &Element, end: &str, name: &str, diagnostics: &mut Diagnostics) -> (String, Origin) {
    let Some(element) = only_child(joint, end, diagnostics) else {
        diagnostics.push(
            Diagnostic::error("missing-element", format!("the joint `{name}` has no `{end}`"))
                .at(joint.origin)
                .help(format!("write <{end} link=\"...\"/>")),
        );
        return (String::new(), joint.origin);
    };
    extra(element, &["link"], &[], &[], diagnostics);
    let link = required_name(element, "link", diagnostics).unwrap_or_default();
    let origin = element.attribute("link").map_or(element.origin, |link| link.value_origin);
    (link, origin)
}

fn axis_of(element: &Element, diagnostics: &mut Diagnostics) -> ([f64; 3], crate::robot::Extra) {
    let xyz = if element.attribute("xyz").is_some() {
        vector(element, "xyz", diagnostics).unwrap_or(crate::robot::DEFAULT_AXIS)
    } else {
        required_text(element, "xyz", diagnostics);
        crate::robot::DEFAULT_AXIS
    };
    (xyz, extra(element, &["xyz"], &[], &[], diagnostics))
}

fn check_axis(joint: &UrdfJoint, element: &Element, diagnostics: &mut Diagnostics) {
    if joint.kind.has_axis() && joint.axis_xyz() == [0.0; 3] {
        let axis = element.child("axis").unwrap_or(element);
        let place = axis.attribute("xyz").map_or(axis.origin, |xyz| xyz.value_origin);
        diagnostics.push(
            Diagnostic::error(
                "zero-axis",
                format!("the axis of the joint `{}` has no direction", joint.name),
            )
            .at(place)
            .help("write a direction such as 0 0 1, or type=\"fixed\""),
        );
    }
}

fn limit_of(element: &Element, diagnostics: &mut Diagnostics) -> Limit {
    Limit {
        lower: number(element, "lower", diagnostics).unwrap_or(0.0),
        upper: number(element, "upper", diagnostics).unwrap_or(0.0),
        effort: required_number(element, "effort", diagnostics),
        velocity: required_number(element, "velocity", diagnostics),
        extra: extra(element, &["lower", "upper", "effort", "velocity"], &[], &[], diagnostics),
        origin: element.origin,
    }
}

fn check_limit(joint: &UrdfJoint, diagnostics: &mut Diagnostics) {
    let needs_one = matches!(joint.kind, JointType::Revolute | JointType::Prismatic);
    match &joint.limit {
        None if needs_one => {
            let error = Diagnostic::error(
                "missing-limit",
                format!("the {} joint `{}` has no `limit`", joint.kind.name(), joint.name),
            )
            .at(joint.origin)
            .help("write <limit lower=\"-1\" upper=\"1\" effort=\"10\" velocity=\"1\"/>");
            diagnostics.push(if joint.kind == JointType::Revolute {
                error.help("or write type=\"continuous\" for a joint without limits")
            } else {
                error
            });
        }
        Some(limit) if needs_one && limit.lower > limit.upper => diagnostics.push(
            Diagnostic::warning(
                "swapped-limits",
                format!("the lower limit of the joint `{}` is above its upper limit", joint.name),
            )
            .at(limit.origin)
            .label("swapped, as Gazebo does")
            .help("swap them"),
        ),
        Some(limit) if limit.effort < 0.0 || limit.velocity < 0.0 => diagnostics.push(
            Diagnostic::warning(
                "negative-limit",
                format!("effort and velocity of the joint `{}` bound a magnitude", joint.name),
            )
            .at(limit.origin)
            .help("write positive numbers"),
        ),
        _ => {}
    }
}

fn dynamics_of(element: &Element, diagnostics: &mut Diagnostics) -> Dynamics {
    let names = ["damping", "friction"];
    if names.iter().all(|name| element.attribute(name).is_none()) {
        diagnostics.push(
            Diagnostic::error(
                "missing-attribute",
                "this `dynamics` has neither `damping` nor `friction`",
            )
            .at(element.origin)
            .help("write <dynamics damping=\"0.1\" friction=\"0\"/>, or leave it out"),
        );
    }
    Dynamics {
        damping: number(element, "damping", diagnostics).unwrap_or(0.0),
        friction: number(element, "friction", diagnostics).unwrap_or(0.0),
        extra: extra(element, &names, &[], &[], diagnostics),
    }
}

fn mimic_of(element: &Element, diagnostics: &mut Diagnostics) -> Option<UrdfMimic> {
    let joint = required_name(element, "joint", diagnostics)?;
    let origin = element.attribute("joint").map_or(element.origin, |joint| joint.value_origin);
    Some(UrdfMimic {
        joint,
        multiplier: number(element, "multiplier", diagnostics).unwrap_or(1.0),
        offset: number(element, "offset", diagnostics).unwrap_or(0.0),
        extra: extra(element, &["joint", "multiplier", "offset"], &[], &[], diagnostics),
        origin,
    })
}

fn safety_of(element: &Element, diagnostics: &mut Diagnostics) -> SafetyController {
    let names = ["soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"];
    SafetyController {
        soft_lower_limit: number(element, names[0], diagnostics).unwrap_or(0.0),
        soft_upper_limit: number(element, names[1], diagnostics).unwrap_or(0.0),
        k_position: number(element, names[2], diagnostics).unwrap_or(0.0),
        k_velocity: required_number(element, names[3], diagnostics),
        extra: extra(element, &names, &[], &[], diagnostics),
    }
}
