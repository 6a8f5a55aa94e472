//! Drives of Gazebo Classic with wheels on the left and on the right.

mod parts;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DVec3, Pose};
use periplus_physics::drives::{ClassicDiffDrive, ClassicDrive, truth};
use periplus_physics::{Command, JointId, ModelId, Twist, World};
use periplus_plugin_specs::Family;

use super::beat::{Beat, earlier};
use super::body::Body;
use super::commands::Commands;
use super::encoders::{Encoders, speed};
use super::order::Order;
use super::wheel_frames::WheelFrames;
use crate::states::{JointStates, Teller, planar_twist};
use crate::{Device, Moment, Span};

/// `libgazebo_ros_diff_drive.so` of ROS 1 and ROS 2, and `libgazebo_ros_skid_steer_drive.so`.
///
/// Source: `gazebo_plugins/src/gazebo_ros_diff_drive.cpp` and `gazebo_ros_skid_steer_drive.cpp` of
/// `gazebo_ros_pkgs`. Commands hold for ever. Odometry of the kind `WORLD` is the true pose of the
/// model in the world, not from zero; odometry of wheels looks at the first pair only.
pub(crate) struct WheelDrive {
    name: String,
    model: ModelId,
    /// The middle between the wheels, in the model [m].
    centre_m: DVec3,
    body: Body,
    drive: ClassicDiffDrive,
    law: ClassicDrive,
    pairs: Vec<[JointId; 2]>,
    commands: Commands,
    acts: Beat,
    tells: Beat,
    acted_ns: i64,
    /// None where the truth is told.
    encoders: Option<Encoders>,
    teller: Teller,
    wheel_frames: Option<WheelFrames>,
    joint_states: Option<JointStates>,
}

pub(crate) fn build(order: &Order<'_>, diagnostics: &mut Diagnostics) -> Option<WheelDrive> {
    let node = order.node(diagnostics)?;
    let parts = match (order.plugin.known.id, order.plugin.known.family) {
        ("gazebo_ros_skid_steer_drive", _) => parts::skid_steer(order, node, diagnostics)?,
        (_, Family::ClassicRos1) => parts::diff_drive_of_ros1(order, node, diagnostics)?,
        _ => parts::diff_drive_of_ros2(order, node, diagnostics)?,
    };
    let body = Body::of_model(order)?;
    let commands = Commands::new(order, &parts.node, &parts.command_topic, diagnostics)?;
    let (rate_hz, start_ns) = (parts.drive.update_rate_hz, order.setting.start_ns);
    let encoders = parts
        .pairs
        .first()
        .zip(parts.drive.pairs.first())
        .map(|(wheels, pair)| Encoders::new(*wheels, pair.diameter_m / 2.0, pair.separation_m));
    Some(WheelDrive {
        name: order.name(),
        model: order.setting.model,
        centre_m: order.middle(&parts.pairs.concat()),
        body,
        law: ClassicDrive::default(),
        commands,
        acts: Beat::acting(rate_hz, start_ns),
        tells: Beat::telling(rate_hz, start_ns),
        acted_ns: start_ns,
        encoders: encoders.filter(|_| parts.counts_wheels),
        teller: parts.teller,
        wheel_frames: parts.wheel_frames,
        joint_states: parts.joint_states,
        drive: parts.drive,
        pairs: parts.pairs,
    })
}

impl WheelDrive {
    fn is_heard(&self) -> bool {
        self.teller.is_heard()
            || self.wheel_frames.as_ref().is_some_and(WheelFrames::is_heard)
            || self.joint_states.as_ref().is_some_and(JointStates::is_heard)
    }

    fn told(&self, world: &World) -> Option<(Pose, Twist)> {
        if let Some(encoders) = &self.encoders {
            return Some((encoders.odometry.pose.pose(), encoders.odometry.twist));
        }
        let state = self.body.state(world)?;
        let twist = truth(state.world_from_link, state.linear_m_s, state.angular_rad_s);
        Some((state.world_from_link, twist))
    }
}

impl Device for WheelDrive {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut World, span: Span) {
        if let Some(encoders) = &mut self.encoders {
            encoders.begin(world);
        }
        if !self.acts.due(span.start_ns) {
            return;
        }
        let since = Span { start_ns: self.acted_ns, length_ns: span.start_ns - self.acted_ns };
        self.acted_ns = span.start_ns;
        let wheels: Vec<[f64; 2]> =
            self.pairs.iter().map(|pair| pair.map(|joint| speed(world, joint))).collect();
        let wanted = self.commands.planar();
        let answer = self.law.update(&self.drive, wanted, &wheels, since.seconds());
        let max_effort = self.drive.max_wheel_torque_n_m;
        for (pair, targets) in self.pairs.iter().zip(&answer) {
            for (&joint, &target) in pair.iter().zip(targets) {
                world.command(joint, Command::Velocity { target, max_effort });
            }
        }
        world.follow_about(self.model, self.centre_m, self.drive.twist(&answer));
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        if let Some(encoders) = &mut self.encoders {
            encoders.observe(moment.world, moment.span.seconds());
        }
        let now_ns = moment.time_ns();
        if !self.tells.due(now_ns) || !self.is_heard() {
            return;
        }
        if let Some((pose, twist)) = self.told(moment.world) {
            self.teller.tell(now_ns, pose, planar_twist(twist));
        }
        if let Some(frames) = &self.wheel_frames {
            frames.tell(moment.world, now_ns);
        }
        if let Some(states) = &self.joint_states {
            states.tell(moment.world, now_ns);
        }
    }

    fn next_ns(&self) -> Option<i64> {
        let telling = self.tells.next_ns().filter(|_| self.is_heard());
        earlier(self.acts.next_ns(), telling)
    }

    fn reset(&mut self, time_ns: i64) {
        self.law = ClassicDrive::default();
        self.commands.reset();
        self.acts.restart(time_ns);
        self.tells.restart(time_ns);
        self.acted_ns = time_ns;
        if let Some(encoders) = &mut self.encoders {
            encoders.reset();
        }
    }
}
