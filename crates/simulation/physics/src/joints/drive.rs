//! Motors of axes in the solver, and their measured state.

use std::f64::consts::{PI, TAU};

use periplus_geometry::{DQuat, DVec3, Pose};
use rapier3d_f64::dynamics::{ImpulseJointHandle, JointAxesMask, JointAxis};

use super::{AxisRecord, AxisState, JointCommand, POSITION_GAIN_PER_S};
use crate::build::{rapier_pose, scene_pose};
use crate::records::Body;
use crate::rigid::{Rigid, apply_force_at};

/// Gain of a velocity motor [1/s]: a fraction `1 / (1 + 1e5 dt)` of a speed error remains after a
/// solver step, 1/26 at 0.25 ms. With 1e3 drives lag visibly.
pub(super) const MOTOR_GAIN_PER_S: f64 = 1e5;
/// Fraction of its error that a mimic axis corrects per step.
const MIMIC_CORRECTION_FRACTION: f64 = 0.2;
/// Distance from a revolute limit within which it is active [rad]; the solver wraps angles at half a
/// turn.
const LIMIT_ACTIVE_RAD: f64 = 2.0;

/// Sets a revolute limit in the solver, which represents angles within half a turn only. Its zero is
/// at the middle of a narrow range, or at the nearer end of a wide one.
pub(super) fn set_turning_limits(axis: &mut AxisRecord) -> bool {
    if axis.slides || (axis.lower.is_infinite() && axis.upper.is_infinite()) {
        return false;
    }
    let range = axis.upper - axis.lower;
    let narrow = range < TAU - LIMIT_ACTIVE_RAD;
    let (zero, limits) = if narrow {
        ((axis.lower + axis.upper) / 2.0, Some([-range / 2.0, range / 2.0]))
    } else {
        let position = axis.state.position;
        if axis.upper - position < LIMIT_ACTIVE_RAD {
            (axis.upper, Some([-PI, 0.0]))
        } else if position - axis.lower < LIMIT_ACTIVE_RAD {
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

    /// Prepares the solver's joint for a step. Efforts are applied to the bodies.
    pub(crate) fn drive(
        &mut self,
        leader: Option<AxisState>,
        dt_s: f64,
        handle: Option<ImpulseJointHandle>,
        rigid: &mut Rigid,
        records: &[Body],
    ) {
        let along = self.along();
        let moved_limits = set_turning_limits(self);
        let wanted = match (self.mimics, leader) {
            (Some(follow), Some(leader)) => {
                let error =
                    follow.multiplier * leader.position + follow.offset - self.state.position;
                let speed =
                    follow.multiplier * leader.velocity + error * MIMIC_CORRECTION_FRACTION / dt_s;
                Some((speed, self.effort))
            }
            _ => match self.command {
                JointCommand::Free => None,
                JointCommand::Velocity { target, max_effort } => {
                    Some((target.clamp(-self.velocity, self.velocity), max_effort.min(self.effort)))
                }
                JointCommand::Position { target, max_speed, max_effort } => {
                    let most = max_speed.min(self.velocity);
                    let way = target.clamp(self.lower, self.upper) - self.state.position;
                    let speed = (way * POSITION_GAIN_PER_S).clamp(-most, most);
                    Some((speed, max_effort.min(self.effort)))
                }
                JointCommand::Effort(effort) => {
                    self.apply_effort(effort.clamp(-self.effort, self.effort), rigid, records);
                    None
                }
            },
        };
        let goes = matches!(self.command, JointCommand::Velocity { target, .. } if target != 0.0);
        if goes {
            let ends = [rigid.bodies[self.body1], rigid.bodies[self.body2]];
            ends.into_iter().flatten().for_each(|end| rigid.keep_awake(end));
        }
        let before = self.data;
        match wanted {
            Some((speed, most)) => {
                self.data.set_motor_velocity(along, speed, MOTOR_GAIN_PER_S);
                self.data.set_motor_max_force(along, most.min(f64::MAX));
            }
            None => self.data.motor_axes -= JointAxesMask::from(along),
        }
        if moved_limits || before != self.data {
            let joints = &mut rigid.solver.impulse_joints;
            let joint = handle.and_then(|handle| joints.get_mut(handle, true));
            if let Some(joint) = joint {
                let kept = joint.data.motors[along as usize].impulse;
                joint.data = self.data;
                // The solver warm-starts from the last step's impulse.
                joint.data.motors[along as usize].impulse = kept;
            }
        }
    }

    fn apply_effort(&mut self, effort: f64, rigid: &mut Rigid, records: &[Body]) {
        self.state.effort = effort;
        let (Some(one), Some(two)) = (rigid.bodies[self.body1], rigid.bodies[self.body2]) else {
            return;
        };
        let bodies = &mut rigid.solver.bodies;
        let world_from_axis = scene_pose(bodies[two].position()) * self.body2_from_axis;
        let pushed = world_from_axis.rotation * DVec3::X * effort;
        let at = world_from_axis.translation;
        for (number, handle, pushed) in [(self.body1, one, -pushed), (self.body2, two, pushed)] {
            let body = &mut bodies[handle];
            if !body.is_dynamic() {
                continue;
            }
            if self.slides {
                apply_force_at(body, records[number].mass.local_com, at, pushed);
            } else {
                body.add_torque(pushed, true);
            }
        }
    }

    /// Reads the state of the axis after a step.
    pub(crate) fn observe(&mut self, handle: Option<ImpulseJointHandle>, rigid: &Rigid) {
        let (Some(one), Some(two)) = (rigid.bodies[self.body1], rigid.bodies[self.body2]) else {
            return;
        };
        let (one, two) = (&rigid.solver.bodies[one], &rigid.solver.bodies[two]);
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
        if !matches!(self.command, JointCommand::Effort(_)) || self.mimics.is_some() {
            let along = if self.slides { JointAxis::LinX } else { JointAxis::AngX };
            let joint = handle.and_then(|handle| rigid.solver.impulse_joints.get(handle));
            let driven = self.data.motor_axes.contains(JointAxesMask::from(along));
            state.effort = match joint {
                // The solver's impulse is the reaction of the child.
                Some(joint) if driven => {
                    -joint.data.motors[along as usize].impulse / rigid.substep_s()
                }
                _ => 0.0,
            };
        }
    }
}
