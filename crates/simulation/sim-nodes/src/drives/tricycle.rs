//! `libgazebo_ros_tricycle_drive.so` of ROS 1 and ROS 2.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DVec3, Pose};
use periplus_physics::drives::{self, Steering, truth};
use periplus_physics::{Command, JointId, ModelId, Twist, World};
use periplus_plugin_specs::Family;

use super::beat::{Beat, earlier};
use super::body::Body;
use super::commands::Commands;
use super::encoders::{Encoders, angle, speed};
use super::order::Order;
use super::wheel_frames::WheelFrames;
use crate::states::{JointStates, Teller, planar_covariance, planar_twist};
use crate::{Device, Moment, Span};

/// A driven and steered wheel in front, two counted wheels behind. A command's `linear.x` is the
/// speed of the driven wheel on the ground, its `angular.z` the **angle** of the steering.
///
/// Source: `gazebo_plugins/src/gazebo_ros_tricycle_drive.cpp` of `gazebo_ros_pkgs`. One slip of it is
/// not copied: odometry of wheels turns the right way round.
pub(crate) struct Tricycle {
    name: String,
    model: ModelId,
    body: Body,
    /// The middle between the counted wheels, in the model [m].
    centre_m: DVec3,
    /// From there to the driven wheel [m].
    wheel_base_m: f64,
    steering: JointId,
    driven: JointId,
    law: drives::Tricycle,
    commands: Commands,
    acts: Beat,
    tells: Beat,
    acted_ns: i64,
    encoders: Encoders,
    counts_wheels: bool,
    teller: Teller,
    wheel_frames: Option<WheelFrames>,
    joint_states: Option<JointStates>,
}

/// Names of parameters in both generations.
struct Names {
    joints: [&'static str; 4],
    separation: &'static str,
    counted_diameter: &'static str,
    driven_diameter: &'static str,
    torque: &'static str,
    acceleration: &'static str,
    deceleration: &'static str,
    speed_tolerance: &'static str,
    steering_speed: &'static str,
    angle_tolerance: &'static str,
    update_rate: &'static str,
    frames: [&'static str; 2],
    wheel_tf: &'static str,
    joint_states: &'static str,
}

const ROS1: Names = Names {
    joints: [
        "steeringJoint",
        "actuatedWheelJoint",
        "encoderWheelLeftJoint",
        "encoderWheelRightJoint",
    ],
    separation: "encoderWheelSeparation",
    counted_diameter: "encoderWheelDiameter",
    driven_diameter: "actuatedWheelDiameter",
    torque: "wheelTorque",
    acceleration: "wheelAcceleration",
    deceleration: "wheelDeceleration",
    speed_tolerance: "wheelSpeedTolerance",
    steering_speed: "steeringSpeed",
    angle_tolerance: "steeringAngleTolerance",
    update_rate: "updateRate",
    frames: ["odometryFrame", "robotBaseFrame"],
    wheel_tf: "publishWheelTF",
    joint_states: "publishWheelJointState",
};

const ROS2: Names = Names {
    joints: [
        "steering_joint",
        "actuated_wheel_joint",
        "encoder_wheel_left_joint",
        "encoder_wheel_right_joint",
    ],
    separation: "wheel_separation",
    counted_diameter: "encoder_wheel_diameter",
    driven_diameter: "actuated_wheel_diameter",
    torque: "max_wheel_torque",
    acceleration: "max_wheel_acceleration",
    deceleration: "max_wheel_deceleration",
    speed_tolerance: "max_wheel_speed_tolerance",
    steering_speed: "max_steering_speed",
    angle_tolerance: "max_steering_angle_tolerance",
    update_rate: "update_rate",
    frames: ["odometry_frame", "robot_base_frame"],
    wheel_tf: "publish_wheel_tf",
    joint_states: "publish_wheel_joint_state",
};

pub(crate) fn build(order: &Order<'_>, diagnostics: &mut Diagnostics) -> Option<Tricycle> {
    let is_ros1 = order.plugin.known.family == Family::ClassicRos1;
    let names = if is_ros1 { ROS1 } else { ROS2 };
    let joints = names.joints.map(|name| order.joint(name, diagnostics));
    let [steering, driven, left, right] = [joints[0]?, joints[1]?, joints[2]?, joints[3]?];
    let node = order.node(diagnostics)?;
    let start_ns = order.setting.start_ns;
    let mut teller = Teller::between(order.text(names.frames[0]), order.text(names.frames[1]));
    teller.pose_covariance = planar_covariance(1e-5, 1e-5, 1e-3);
    let (command_topic, counts_wheels);
    if is_ros1 {
        command_topic = order.text("commandTopic");
        counts_wheels = order.text("odometrySource") == "encoder";
        teller = teller.on(order, &node, &order.text("odometryTopic"), diagnostics)?;
        teller = teller.with_tf(order, &node, "/tf", diagnostics)?;
    } else {
        command_topic = "cmd_vel".to_owned();
        counts_wheels = order.plugin.values.integer("odometry_source") == Some(0);
        if order.flag("publish_odom") {
            teller = teller.on(order, &node, "odom", diagnostics)?;
            teller = teller.with_tf(order, &node, "/tf", diagnostics)?;
        }
    }
    let acceleration = order.number(names.acceleration);
    let law = drives::Tricycle {
        actuated_wheel_diameter_m: order.number(names.driven_diameter),
        encoder_wheel_diameter_m: order.number(names.counted_diameter),
        encoder_wheel_separation_m: order.number(names.separation),
        wheel_acceleration_rad_s2: acceleration,
        wheel_deceleration_rad_s2: order
            .plugin
            .values
            .number(names.deceleration)
            .unwrap_or(acceleration),
        wheel_speed_tolerance_rad_s: order.number(names.speed_tolerance),
        steering_speed_rad_s: order.number(names.steering_speed),
        steering_angle_tolerance_rad: order.number(names.angle_tolerance),
        wheel_torque_n_m: order.plugin.values.number(names.torque).unwrap_or(f64::INFINITY),
        update_rate_hz: order.number(names.update_rate),
    };
    let centre_m = order.middle(&[left, right]);
    let encoders = Encoders::new(
        [left, right],
        law.encoder_wheel_diameter_m / 2.0,
        law.encoder_wheel_separation_m,
    );
    let wheel_frames = order
        .flag(names.wheel_tf)
        .then(|| WheelFrames::new(order, &node, &names.joints, diagnostics))
        .flatten();
    let joint_states = order
        .flag(names.joint_states)
        .then(|| {
            JointStates::of_wheels(order, &node, &[steering, driven, left, right], diagnostics)
        })
        .flatten();
    Some(Tricycle {
        name: order.name(),
        model: order.setting.model,
        body: Body::of_model(order)?,
        centre_m,
        wheel_base_m: (order.middle(&[driven]) - centre_m).x,
        steering,
        driven,
        commands: Commands::new(order, &node, &command_topic, diagnostics)?,
        acts: Beat::acting(law.update_rate_hz, start_ns),
        tells: Beat::telling(law.update_rate_hz, start_ns),
        acted_ns: start_ns,
        encoders,
        law,
        counts_wheels,
        teller,
        wheel_frames,
        joint_states,
    })
}

impl Tricycle {
    fn is_heard(&self) -> bool {
        self.teller.is_heard()
            || self.wheel_frames.as_ref().is_some_and(WheelFrames::is_heard)
            || self.joint_states.as_ref().is_some_and(JointStates::is_heard)
    }

    fn told(&self, world: &World) -> Option<(Pose, Twist)> {
        if self.counts_wheels {
            let odometry = self.encoders.odometry;
            return Some((odometry.pose.pose(), odometry.twist));
        }
        let state = self.body.state(world)?;
        let twist = truth(state.world_from_link, state.linear_m_s, state.angular_rad_s);
        Some((state.world_from_link, twist))
    }
}

impl Device for Tricycle {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut World, span: Span) {
        self.encoders.begin(world);
        if !self.acts.due(span.start_ns) {
            return;
        }
        let since = Span { start_ns: self.acted_ns, length_ns: span.start_ns - self.acted_ns };
        self.acted_ns = span.start_ns;
        let command = self.commands.planar();
        let at_rad = angle(world, self.steering);
        let rolls_rad_s = speed(world, self.driven);
        let (target, steering) = self.law.update(command, rolls_rad_s, at_rad, since.seconds());
        let max_effort = self.law.wheel_torque_n_m;
        world.command(self.driven, Command::Velocity { target, max_effort });
        let free = f64::INFINITY;
        let steer = match steering {
            // The original puts the joint there at once.
            Steering::At(target) => Command::Position { target, max_speed: free, max_effort: free },
            Steering::Turning(target) => Command::Velocity { target, max_effort },
        };
        world.command(self.steering, steer);
        if self.wheel_base_m.abs() > 1e-6 {
            let twist = self.law.twist(target, at_rad, self.wheel_base_m);
            if world.follow_about(self.model, self.centre_m, twist) {
                // Without physics nothing rolls the counted wheels along.
                self.encoders.roll(world, twist);
            }
        }
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        self.encoders.observe(moment.world, moment.span.seconds());
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
        self.commands.reset();
        self.acts.restart(time_ns);
        self.tells.restart(time_ns);
        self.acted_ns = time_ns;
        self.encoders.reset();
    }
}
