//! Commands of a world.

use periplus_geometry::{DVec3, Pose};

use super::PhysicsWorld;
use crate::engine::Engine;
use crate::joints::JointCommand;
use crate::kinematic::Twist;
use crate::limits::{
    MAX_ANGULAR_SPEED_RAD_S, MAX_FORCE_N, MAX_POSITION_M, MAX_SPEED_M_S, is_pose, is_within,
};
use crate::state::{JointId, LinkId, ModelId};

impl PhysicsWorld {
    /// Commands the first axis of a joint. Returns false without such an axis, or for a non-finite
    /// number.
    pub fn command(&mut self, joint: JointId, command: JointCommand) -> bool {
        self.command_axis(joint, 0, command)
    }

    /// Commands an axis of a joint. Returns false without such an axis, or for a non-finite number.
    ///
    /// In [`PhysicsMode::Kinematic`](crate::PhysicsMode) speeds and positions are reached exactly (with any effort
    /// but zero), and efforts have no effect.
    pub fn command_axis(&mut self, joint: JointId, axis: usize, command: JointCommand) -> bool {
        if !command.is_sound() || axis >= self.axes(joint).len() {
            return false;
        }
        let first = self.records.joints[joint.0 as usize].axes.start;
        let axis = &mut self.records.axes[first + axis];
        if !axis.is_seized {
            axis.command = command;
        }
        true
    }

    /// In [`PhysicsMode::Kinematic`](crate::PhysicsMode) moves a model along the arc of a twist in the model's frame,
    /// in the plane, until the next command. In [`PhysicsMode::Rigid`](crate::PhysicsMode), where wheels move a
    /// robot, this does nothing. Returns true if the model moves: it must exist and be free, and the
    /// numbers must be finite.
    pub fn follow(&mut self, model: ModelId, twist: Twist) -> bool {
        self.follow_about(model, DVec3::ZERO, twist)
    }

    /// Like [`Self::follow`], for the twist of a point of the model [m], such as the
    /// [midpoint](Self::middle_of) of the wheels of a differential drive.
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

    /// Sets the velocities of all bodies of a model as one rigid piece: of its frame's origin [m/s]
    /// and about it [rad/s], in world axes. Planar drives and Gazebo's `VelocityControl` do this in
    /// every step. In [`PhysicsMode::Kinematic`](crate::PhysicsMode) the model keeps it until the next command,
    /// here or by [`Self::follow`].
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
            Engine::Exact(exact) => {
                exact.set_velocity(&self.records, model.0, linear_m_s, angular_rad_s)
            }
        }
    }

    /// Sets the pose of a model with its current joint positions, at rest. Returns false if the
    /// model does not exist, or the pose is beyond its [limit](crate::limits).
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

    /// Sets the pose of a link, at rest, with the links fixed to it. Joints pull it back if they
    /// can. Returns false if it does not exist, or the pose is beyond its [limit](crate::limits).
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

    /// Applies a force [N] and a torque [N m] to a link at a point of the world [m], in world axes,
    /// for the next step only. Returns false for an immovable link.
    pub fn apply_force(
        &mut self,
        link: LinkId,
        at_m: DVec3,
        force_n: DVec3,
        torque_n_m: DVec3,
    ) -> bool {
        let sound = is_within(at_m, MAX_POSITION_M)
            && is_within(force_n, MAX_FORCE_N)
            && is_within(torque_n_m, MAX_FORCE_N);
        let record = self.records.links.get(link.0 as usize).filter(|_| sound);
        match (&mut self.engine, record) {
            (Engine::Rigid(rigid), Some(link)) => {
                rigid.apply_force(&self.records, link.body, at_m, (force_n, torque_n_m))
            }
            _ => false,
        }
    }
}

impl JointCommand {
    /// Returns true if all numbers are finite.
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
