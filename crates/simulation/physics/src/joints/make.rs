//! Conversion of joints to axes and constraints.

use std::f64::consts::TAU;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DQuat, DVec3, Pose};
use periplus_scene::{Axis, Joint, JointKind};
use rapier3d_f64::dynamics::{GenericJoint, JointAxesMask, JointAxis, MotorModel};
use rapier3d_f64::math::Vector;
use rapier3d_f64::parry::mass_properties::MassProperties;

use super::drive::{MOTOR_GAIN_PER_S, set_turning_limits};
use super::{AxisRecord, AxisState, Constraint, JointCommand, MimicCoupling};
use crate::build::{rapier_pose, split};
use crate::records::{Body, BodyKind, Records};

/// Threshold of unlimited axes: SDF writes ±1e16.
const FREE: f64 = 1e15;
/// Mass of a universal joint's cross relative to the child's mass.
const CROSS_MASS_FRACTION: f64 = 0.1;

/// Bodies and frame of a joint.
#[derive(Clone, Copy)]
pub(crate) struct Axes {
    pub(crate) parent: usize,
    pub(crate) child: usize,
    pub(crate) world_from_joint: Pose,
}

/// Appends the records of a joint: axes, passive elements, the cross of a universal joint. Reports
/// an error and returns `None` for an invalid joint.
pub(crate) fn axes_of(
    joint: &Joint,
    name: &str,
    place: Axes,
    records: &mut Records,
    diagnostics: &mut Diagnostics,
) -> Option<()> {
    let standard = Axis::default();
    let axis = joint.axis.as_ref().unwrap_or(&standard);
    let axis2 = joint.axis2.as_ref().unwrap_or(&standard);
    let two = matches!(joint.kind, JointKind::Universal | JointKind::Revolute2);
    let needs_axis = !matches!(joint.kind, JointKind::Ball | JointKind::Fixed);
    if matches!(joint.kind, JointKind::Floating | JointKind::Gearbox) {
        return Some(());
    }
    if needs_axis && !sound(axis) || two && !sound(axis2) {
        diagnostics.push(
            Diagnostic::error(
                "joint-impossible",
                format!(
                    "an axis of joint `{name}` has no direction, or values that are not finite"
                ),
            )
            .at(joint.origin)
            .help(
                "an axis is a direction other than 0 0 0, with finite damping, friction and spring",
            ),
        );
        return None;
    }
    let free = match joint.kind {
        // Only between models: inside a model, links on fixed joints are one body.
        JointKind::Fixed => JointAxesMask::empty(),
        JointKind::Ball => JointAxesMask::ANG_AXES,
        JointKind::Planar => JointAxesMask::LIN_Y | JointAxesMask::LIN_Z | JointAxesMask::ANG_X,
        JointKind::Universal | JointKind::Revolute2 => {
            let cross = cross_body(&place, records);
            hinge(axis, false, Axes { child: cross, ..place }, records);
            hinge(axis2, false, Axes { parent: cross, ..place }, records);
            return Some(());
        }
        JointKind::Screw => {
            let cross = cross_body(&place, records);
            let turn = records.axes.len();
            hinge(axis, false, Axes { child: cross, ..place }, records);
            let way = Axis { direction_in_joint: axis.direction_in_joint, ..Axis::default() };
            hinge(&way, true, Axes { parent: cross, ..place }, records);
            let pitch_m = joint.thread_pitch_m.filter(|pitch| pitch.is_finite()).unwrap_or(1.0);
            records.axes[turn + 1].mimics =
                Some(MimicCoupling { leader: turn, multiplier: pitch_m / TAU, offset: 0.0 });
            return Some(());
        }
        kind => {
            let unlimited = Axis { lower: f64::NEG_INFINITY, upper: f64::INFINITY, ..axis.clone() };
            let axis = if kind == JointKind::Continuous { &unlimited } else { axis };
            hinge(axis, kind == JointKind::Prismatic, place, records);
            return Some(());
        }
    };
    let (body1_from_axis, body2_from_axis) = frames(axis, &place, records);
    let mut data = GenericJoint::new(JointAxesMask::all() - free);
    data.set_local_frame1(rapier_pose(body1_from_axis));
    data.set_local_frame2(rapier_pose(body2_from_axis));
    data.set_contacts_enabled(false);
    records.constraints.push(Constraint { body1: place.parent, body2: place.child, data });
    Some(())
}

fn sound(axis: &Axis) -> bool {
    let direction = axis.direction_in_joint;
    let numbers = [axis.damping, axis.friction, axis.spring_stiffness, axis.spring_reference];
    direction.is_finite()
        && direction.length() > 1e-9
        && numbers.iter().all(|number| number.is_finite())
        && ![axis.lower, axis.upper, axis.effort, axis.velocity].iter().any(|value| value.is_nan())
}

/// Returns the axis' frame, x along it, in both bodies.
fn frames(axis: &Axis, place: &Axes, records: &Records) -> (Pose, Pose) {
    let direction = axis.direction_in_joint.normalize_or(DVec3::X);
    let turn = DQuat::from_rotation_arc(DVec3::X, direction);
    let world_from_axis =
        place.world_from_joint * Pose { translation: DVec3::ZERO, rotation: turn };
    let of = |body: usize| records.bodies[body].world_from_body.inverse() * world_from_axis;
    (of(place.parent), of(place.child))
}

fn hinge(axis: &Axis, slides: bool, place: Axes, records: &mut Records) {
    let (body1_from_axis, body2_from_axis) = frames(axis, &place, records);
    let (mask, along) = if slides {
        (JointAxesMask::LOCKED_PRISMATIC_AXES, JointAxis::LinX)
    } else {
        (JointAxesMask::LOCKED_REVOLUTE_AXES, JointAxis::AngX)
    };
    let between = |locked: JointAxesMask| {
        let mut data = GenericJoint::new(locked);
        data.set_local_frame1(rapier_pose(body1_from_axis));
        data.set_local_frame2(rapier_pose(body2_from_axis));
        data.set_contacts_enabled(false);
        data
    };
    let limit = |value: f64| if value.abs() >= FREE { value * f64::INFINITY } else { value };
    let (lower, upper) = (limit(axis.lower), limit(axis.upper));
    let mut record = AxisRecord {
        slides,
        body1: place.parent,
        body2: place.child,
        body1_from_axis,
        body2_from_axis,
        lower: lower.min(upper),
        upper: upper.max(lower),
        // A negative limit means unlimited in SDF.
        effort: if axis.effort < 0.0 { f64::INFINITY } else { axis.effort },
        velocity: if axis.velocity < 0.0 { f64::INFINITY } else { axis.velocity },
        mimics: None,
        data: between(mask),
        command: JointCommand::Free,
        is_seized: false,
        state: AxisState::default(),
        changed: false,
    };
    if slides && (record.lower.is_finite() || record.upper.is_finite()) {
        record.data.set_limits(along, [record.lower.max(-FREE), record.upper.min(FREE)]);
    }
    set_turning_limits(&mut record);
    let (body1, body2) = (place.parent, place.child);
    if axis.damping > 0.0 || axis.spring_stiffness > 0.0 {
        let mut data = between(JointAxesMask::empty());
        data.set_motor_model(along, MotorModel::ForceBased);
        let (k, d) = (axis.spring_stiffness.max(0.0), axis.damping.max(0.0));
        data.set_motor(along, axis.spring_reference, 0.0, k, d);
        records.constraints.push(Constraint { body1, body2, data });
    }
    if axis.friction > 0.0 {
        let mut data = between(JointAxesMask::empty());
        data.set_motor_velocity(along, 0.0, MOTOR_GAIN_PER_S);
        data.set_motor_max_force(along, axis.friction);
        records.constraints.push(Constraint { body1, body2, data });
    }
    records.axes.push(record);
}

/// Adds a small body between the two hinges of a universal joint, with a fraction of the child's
/// mass.
fn cross_body(place: &Axes, records: &mut Records) -> usize {
    let child = &mut records.bodies[place.child];
    let (mass, body) = if child.kind == BodyKind::Dynamic {
        let taken = split(&child.mass, CROSS_MASS_FRACTION, Vector::ZERO);
        child.mass = split(&child.mass, 1.0 - CROSS_MASS_FRACTION, child.mass.local_com);
        (taken, &*child)
    } else {
        (MassProperties::new(Vector::ZERO, 0.1, Vector::splat(1e-4)), &*child)
    };
    let cross = Body {
        name: body.name.clone(),
        kind: BodyKind::Dynamic,
        world_from_body: place.world_from_joint,
        mass,
        weight_share: mass.mass(),
        damping: body.damping,
        can_sleep: body.can_sleep,
        colliders: Vec::new(),
        anisotropic_colliders: Vec::new(),
        removed: false,
    };
    records.bodies[place.child].weight_share *= 1.0 - CROSS_MASS_FRACTION;
    records.bodies.push(cross);
    records.bodies.len() - 1
}
