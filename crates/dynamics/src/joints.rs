//! Joints: what they hold, what drives them, and where they are.

use std::f64::consts::{PI, TAU};

use periplus_base::{DQuat, DVec3, Pose};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::{Axis, Joint, JointKind};
use rapier3d_f64::dynamics::{
    GenericJoint, ImpulseJointHandle, ImpulseJointSet, JointAxesMask, JointAxis, MotorModel,
    RigidBodySet,
};
use rapier3d_f64::math::Vector;
use rapier3d_f64::parry::mass_properties::MassProperties;

use crate::build::{rapier_pose, scene_pose, split};
use crate::world::{Body, BodyKind, Records, push_body};

/// How hard a velocity motor pulls towards its speed [1/s]: of a difference, one part in
/// `1 + 1e5 dt` is left after a solver step, 1/26 at 0.25 ms. With 1e3 drives lag visibly.
const MOTOR_STIFFNESS: f64 = 1e5;
/// How fast a position command closes its error [1/s].
const POSITION_GAIN: f64 = 50.0;
/// How fast a follower closes its error, in parts of it per step.
const FOLLOW_GAIN: f64 = 0.2;
/// A turning limit is felt within this of it [rad]; angles in the solver fold at half a turn.
const LIMIT_REACH: f64 = 2.0;
/// SDF writes free limits as ±1e16.
const FREE: f64 = 1e15;
/// What the cross of a universal joint takes of the child's mass.
const CROSS_SHARE: f64 = 0.1;

/// What an axis is told to do, until told otherwise. Newtons and metres along a sliding axis,
/// newton metres and radians about a turning one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Command {
    /// Nothing: only its damping, friction and spring act.
    #[default]
    Free,
    /// To keep a speed.
    Velocity {
        /// The speed [m/s or rad/s], held to the axis' own limit.
        target: f64,
        /// Greatest effort [N or N m], beside the axis' own limit.
        max_effort: f64,
    },
    /// To go to a position and hold it: its speed is 50 times the way that is left, within limits.
    Position {
        /// The position [m or rad], held to the axis' own limits.
        target: f64,
        /// Greatest speed [m/s or rad/s], beside the axis' own limit.
        max_speed: f64,
        /// Greatest effort [N or N m], beside the axis' own limit.
        max_effort: f64,
    },
    /// To push with an effort [N or N m], held to the axis' own limit.
    Effort(f64),
}

/// Where an axis is and what drives it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisState {
    /// Way from where the file put it; turns are counted, not folded [m or rad].
    pub position: f64,
    /// Speed [m/s or rad/s].
    pub velocity: f64,
    /// What the motor (or the commanded effort) gave in the last step [N or N m].
    pub effort: f64,
}

/// `position = multiplier * leader + offset`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Follow {
    pub(crate) leader: usize,
    pub(crate) multiplier: f64,
    pub(crate) offset: f64,
}

/// One degree of freedom between two bodies. Its frames have the axis along x.
#[derive(Clone, Debug)]
pub(crate) struct AxisRecord {
    pub(crate) slides: bool,
    pub(crate) body1: usize,
    pub(crate) body2: usize,
    pub(crate) body1_from_axis: Pose,
    pub(crate) body2_from_axis: Pose,
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    pub(crate) effort: f64,
    pub(crate) velocity: f64,
    pub(crate) follows: Option<Follow>,
    pub(crate) data: GenericJoint,
    pub(crate) handle: Option<ImpulseJointHandle>,
    pub(crate) command: Command,
    pub(crate) state: AxisState,
}

/// A constraint that nobody commands.
#[derive(Clone, Debug)]
pub(crate) struct Hold {
    pub(crate) body1: usize,
    pub(crate) body2: usize,
    pub(crate) data: GenericJoint,
}

/// Where a joint sits.
#[derive(Clone, Copy)]
pub(crate) struct Axes {
    pub(crate) parent: usize,
    pub(crate) child: usize,
    pub(crate) world_from_joint: Pose,
}

/// Appends what a joint needs: axes, passive elements, the cross of a universal joint. None (and an
/// error) where it is impossible.
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
    let needs_axis = joint.kind != JointKind::Ball;
    if needs_axis && !sound(axis) || two && !sound(axis2) {
        diagnostics.push(
            Diagnostic::error(
                "joint-impossible",
                format!("an axis of joint `{name}` has no direction, or numbers that are none"),
            )
            .at(joint.origin)
            .help(
                "an axis is a direction other than 0 0 0, with finite damping, friction and spring",
            ),
        );
        return None;
    }
    let free = match joint.kind {
        JointKind::Ball => JointAxesMask::ANG_AXES,
        JointKind::Planar => JointAxesMask::LIN_Y | JointAxesMask::LIN_Z | JointAxesMask::ANG_X,
        JointKind::Universal | JointKind::Revolute2 => {
            let cross = cross_body(&place, records);
            hinge(axis, false, Axes { child: cross, ..place }, records);
            hinge(axis2, false, Axes { parent: cross, ..place }, records);
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
    records.holds.push(Hold { body1: place.parent, body2: place.child, data });
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

/// The axis' frame, x along it, in both bodies.
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
        // A negative limit means none in SDF.
        effort: if axis.effort < 0.0 { f64::INFINITY } else { axis.effort },
        velocity: if axis.velocity < 0.0 { f64::INFINITY } else { axis.velocity },
        follows: None,
        data: between(mask),
        handle: None,
        command: Command::Free,
        state: AxisState::default(),
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
        records.holds.push(Hold { body1, body2, data });
    }
    if axis.friction > 0.0 {
        let mut data = between(JointAxesMask::empty());
        data.set_motor_velocity(along, 0.0, MOTOR_STIFFNESS);
        data.set_motor_max_force(along, axis.friction);
        records.holds.push(Hold { body1, body2, data });
    }
    records.axes.push(record);
}

/// A small body between the two hinges of a universal joint, made of a part of the child's mass.
fn cross_body(place: &Axes, records: &mut Records) -> usize {
    let child = &mut records.bodies[place.child];
    let (mass, body) = if child.kind == BodyKind::Dynamic {
        let taken = split(&child.mass, CROSS_SHARE, Vector::ZERO);
        child.mass = split(&child.mass, 1.0 - CROSS_SHARE, child.mass.local_com);
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
        handle: None,
    };
    records.bodies[place.child].weight_share *= 1.0 - CROSS_SHARE;
    records.bodies.push(cross);
    records.bodies.len() - 1
}

/// Tells the solver of a turning limit. It knows angles within half a turn only, so its zero is
/// put in the middle of a narrow range, or at the nearer end of a wide one.
fn set_turning_limits(axis: &mut AxisRecord) -> bool {
    if axis.slides || (axis.lower.is_infinite() && axis.upper.is_infinite()) {
        return false;
    }
    let range = axis.upper - axis.lower;
    let narrow = range < TAU - LIMIT_REACH;
    let (zero, limits) = if narrow {
        ((axis.lower + axis.upper) / 2.0, Some([-range / 2.0, range / 2.0]))
    } else {
        let position = axis.state.position;
        if axis.upper - position < LIMIT_REACH {
            (axis.upper, Some([-PI, 0.0]))
        } else if position - axis.lower < LIMIT_REACH {
            (axis.lower, Some([0.0, PI]))
        } else {
            (0.0, None)
        }
    };
    let (sine, cosine) = libm::sincos(zero / 2.0);
    let turn =
        Pose { translation: DVec3::ZERO, rotation: DQuat::from_xyzw(sine, 0.0, 0.0, cosine) };
    axis.data.set_local_frame1(rapier_pose(axis.body1_from_axis * turn));
    match limits {
        Some(limits) => {
            axis.data.set_limits(JointAxis::AngX, limits);
        }
        None => axis.data.limit_axes -= JointAxesMask::ANG_X,
    }
    !narrow
}

impl AxisRecord {
    fn along(&self) -> JointAxis {
        if self.slides { JointAxis::LinX } else { JointAxis::AngX }
    }

    /// Prepares the solver's joint for a step. Efforts are added to the bodies.
    pub(crate) fn drive(
        &mut self,
        leader: Option<AxisState>,
        dt_s: f64,
        joints: &mut ImpulseJointSet,
        bodies: &mut RigidBodySet,
        records: &[Body],
    ) {
        let along = self.along();
        let moved_limits = set_turning_limits(self);
        let wanted = match (self.follows, leader) {
            (Some(follow), Some(leader)) => {
                let error =
                    follow.multiplier * leader.position + follow.offset - self.state.position;
                let speed = follow.multiplier * leader.velocity + error * FOLLOW_GAIN / dt_s;
                Some((speed, self.effort))
            }
            _ => match self.command {
                Command::Free => None,
                Command::Velocity { target, max_effort } => {
                    Some((target.clamp(-self.velocity, self.velocity), max_effort.min(self.effort)))
                }
                Command::Position { target, max_speed, max_effort } => {
                    let most = max_speed.min(self.velocity);
                    let way = target.clamp(self.lower, self.upper) - self.state.position;
                    let speed = (way * POSITION_GAIN).clamp(-most, most);
                    Some((speed, max_effort.min(self.effort)))
                }
                Command::Effort(effort) => {
                    self.push(effort.clamp(-self.effort, self.effort), bodies, records);
                    None
                }
            },
        };
        let before = self.data;
        match wanted {
            Some((speed, most)) => {
                self.data.set_motor_velocity(along, speed, MOTOR_STIFFNESS);
                self.data.set_motor_max_force(along, most.min(f64::MAX));
            }
            None => self.data.motor_axes -= JointAxesMask::from(along),
        }
        if moved_limits || before != self.data {
            let joint = self.handle.and_then(|handle| joints.get_mut(handle, true));
            if let Some(joint) = joint {
                let kept = joint.data.motors[along as usize].impulse;
                joint.data = self.data;
                // The solver starts from the last step's impulse.
                joint.data.motors[along as usize].impulse = kept;
            }
        }
    }

    fn push(&mut self, effort: f64, bodies: &mut RigidBodySet, records: &[Body]) {
        self.state.effort = effort;
        let handles = (records[self.body1].handle, records[self.body2].handle);
        let (Some(one), Some(two)) = handles else { return };
        let world_from_axis = scene_pose(bodies[two].position()) * self.body2_from_axis;
        let pushed = world_from_axis.rotation * DVec3::X * effort;
        let at = world_from_axis.translation;
        for (number, handle, pushed) in [(self.body1, one, -pushed), (self.body2, two, pushed)] {
            let body = &mut bodies[handle];
            if !body.is_dynamic() {
                continue;
            }
            if self.slides {
                push_body(body, records[number].mass.local_com, at, pushed);
            } else {
                body.add_torque(pushed, true);
            }
        }
    }

    /// Reads where the axis is after a step.
    pub(crate) fn observe(
        &mut self,
        substep_s: f64,
        joints: &ImpulseJointSet,
        bodies: &RigidBodySet,
        records: &[Body],
    ) {
        let (Some(one), Some(two)) = (records[self.body1].handle, records[self.body2].handle)
        else {
            return;
        };
        let (one, two) = (&bodies[one], &bodies[two]);
        let world_from_1 = scene_pose(one.position()) * self.body1_from_axis;
        let world_from_2 = scene_pose(two.position()) * self.body2_from_axis;
        let axis_in_world = world_from_1.rotation * DVec3::X;
        let state = &mut self.state;
        if self.slides {
            let between = world_from_2.translation - world_from_1.translation;
            state.position = between.dot(axis_in_world);
            let at = world_from_2.translation;
            let speed = two.velocity_at_point(at) - one.velocity_at_point(at);
            state.velocity = speed.dot(axis_in_world);
        } else {
            let between = world_from_1.rotation.conjugate() * world_from_2.rotation;
            let folded = 2.0 * libm::atan2(between.x, between.w);
            state.position += libm::remainder(folded - state.position, TAU);
            state.velocity = (two.angvel() - one.angvel()).dot(axis_in_world);
        }
        if !matches!(self.command, Command::Effort(_)) || self.follows.is_some() {
            let along = if self.slides { JointAxis::LinX } else { JointAxis::AngX };
            let joint = self.handle.and_then(|handle| joints.get(handle));
            let driven = self.data.motor_axes.contains(JointAxesMask::from(along));
            state.effort = match joint {
                // The solver's impulse is what the child pushes back with.
                Some(joint) if driven => -joint.data.motors[along as usize].impulse / substep_s,
                _ => 0.0,
            };
        }
    }
}
