//! What a world can be told to do.

use periplus_geometry::{DVec3, Pose};

use super::World;
use crate::engine::Engine;
use crate::joints::Command;
use crate::kinematic::Twist;
use crate::limits::{
    MAX_ANGULAR_SPEED_RAD_S, MAX_FORCE_N, MAX_POSITION_M, MAX_SPEED_M_S, is_pose, is_within,
};
use crate::state::{JointId, LinkId, ModelId};

impl World {
    /// Tells the first axis of a joint what to do. False if there is none, or a number is none.
    pub fn command(&mut self, joint: JointId, command: Command) -> bool {
        self.command_axis(joint, 0, command)
    }

    /// Tells an axis of a joint what to do. False if there is none, or a number is none.
    ///
    /// In [`Mode::Kinematic`](crate::Mode) speeds and positions are reached exactly (by any effort
    /// but zero), and efforts move nothing.
    pub fn command_axis(&mut self, joint: JointId, axis: usize, command: Command) -> bool {
        if !command.is_sound() || axis >= self.axes(joint).len() {
            return false;
        }
        let first = self.records.joints[joint.0 as usize].axes.start;
        self.records.axes[first + axis].command = command;
        true
    }

    /// In [`Mode::Kinematic`](crate::Mode) a model goes along the arc of a twist of its own frame,
    /// on flat ground, until told otherwise. In [`Mode::Rigid`](crate::Mode), where wheels move a
    /// robot, this does nothing. Answers whether the model goes: it must be there, stand free, and
    /// the numbers must be finite.
    pub fn follow(&mut self, model: ModelId, twist: Twist) -> bool {
        self.follow_about(model, DVec3::ZERO, twist)
    }

    /// Like [`Self::follow`], with a point of the model [m] that the twist is that of, such as the
    /// [middle](Self::middle_of) between the wheels of a differential drive.
    pub fn follow_about(&mut self, model: ModelId, centre_m: DVec3, twist: Twist) -> bool {
        let speed = DVec3::new(twist.x_m_s, twist.y_m_s, 0.0);
        let sound =
            is_within(speed, MAX_SPEED_M_S) && twist.yaw_rad_s.abs() <= MAX_ANGULAR_SPEED_RAD_S;
        match &mut self.engine {
            Engine::Exact(exact) if sound && centre_m.is_finite() => {
                exact.follow(&self.records, model.0, centre_m, twist)
            }
            _ => false,
        }
    }

    /// Gives all bodies of a model a velocity as if it were one piece: of its frame's origin
    /// [m/s] and about it [rad/s], in world axes. This is what planar drives and Gazebo's
    /// `VelocityControl` do at each step. In [`Mode::Kinematic`](crate::Mode) the model keeps it
    /// until told otherwise, here or by [`Self::follow`].
    pub fn set_model_velocity(
        &mut self,
        model: ModelId,
        linear_m_s: DVec3,
        angular_rad_s: DVec3,
    ) -> bool {
        let sound = is_within(linear_m_s, MAX_SPEED_M_S)
            && is_within(angular_rad_s, MAX_ANGULAR_SPEED_RAD_S);
        let Some(pose) = self.model_pose(model).filter(|_| sound) else { return false };
        match &mut self.engine {
            Engine::Rigid(rigid) => {
                let bodies = self.records.bodies_of(model.0);
                let velocity = (linear_m_s, angular_rad_s);
                rigid.move_as_one(&self.records, bodies, pose.translation, velocity);
                true
            }
            Engine::Exact(exact) => exact.fly(&self.records, model.0, linear_m_s, angular_rad_s),
        }
    }

    /// Puts a model down somewhere, as it is bent, at rest. False if there is no such model, or
    /// the pose is beyond its [limit](crate::limits).
    pub fn set_pose(&mut self, model: ModelId, world_from_model: Pose) -> bool {
        let Some(now) = self.model_pose(model).filter(|_| is_pose(world_from_model)) else {
            return false;
        };
        let change = world_from_model * now.inverse();
        let records = &self.records;
        let places: Vec<(usize, Pose)> = records
            .bodies_of(model.0)
            .filter_map(|body| {
                Some((body, change * self.engine.body(records, body)?.world_from_body))
            })
            .collect();
        self.engine.place(records, model.0, &places);
        true
    }

    /// Puts one link down somewhere, at rest, with what is fixed to it. Joints pull it back if they
    /// can. False if it is not there, or the pose is beyond its [limit](crate::limits).
    pub fn set_link_pose(&mut self, link: LinkId, world_from_link: Pose) -> bool {
        let Some(record) = self.records.links.get(link.0 as usize) else { return false };
        let there = self.engine.body(&self.records, record.body).is_some();
        if !(there && is_pose(world_from_link)) {
            return false;
        }
        let place = (record.body, world_from_link * record.body_from_link.inverse());
        self.engine.place(&self.records, record.model, &[place]);
        true
    }

    /// Pushes a link for the next step only, at a point of the world [m], by a force [N] and a
    /// torque [N m] in world axes. False if it cannot be pushed.
    pub fn push(&mut self, link: LinkId, at_m: DVec3, force_n: DVec3, torque_n_m: DVec3) -> bool {
        let sound = is_within(at_m, MAX_POSITION_M)
            && is_within(force_n, MAX_FORCE_N)
            && is_within(torque_n_m, MAX_FORCE_N);
        let record = self.records.links.get(link.0 as usize).filter(|_| sound);
        match (&mut self.engine, record) {
            (Engine::Rigid(rigid), Some(link)) => {
                rigid.push(&self.records, link.body, at_m, (force_n, torque_n_m))
            }
            _ => false,
        }
    }
}

impl Command {
    /// Whether its numbers are some.
    fn is_sound(self) -> bool {
        match self {
            Self::Free => true,
            Self::Velocity { target, max_effort } => target.is_finite() && max_effort >= 0.0,
            Self::Position { target, max_speed, max_effort } => {
                target.is_finite() && max_speed >= 0.0 && max_effort >= 0.0
            }
            Self::Effort(effort) => effort.abs() <= MAX_FORCE_N,
        }
    }
}
