//! `libgazebo_ros_tricycle_drive.so` of ROS 1 and ROS 2.

use periplus_diagnostics::Diagnostics;
use periplus_geometry::DVec3;
use periplus_physics::drives::{self, Steering};
use periplus_physics::{JointCommand, JointId, ModelId, PhysicsWorld};
use periplus_plugin_specs::Family;

use super::body::Body;
use super::build_context::BuildContext;
use super::classic_odometry::{ClassicOdometry, ClassicOdometryState, OdometrySource};
use super::commands::{Commands, CommandsState};
use super::encoders::{Encoders, angle, speed};
use super::rate_timer::{RateTimer, earlier};
use super::wheel_frames::WheelFrames;
use crate::states::{JointStates, OdometryPublisher, planar_covariance};
use crate::{Device, DeviceState, SenseContext, StepInterval};

/// A driven and steered wheel in front, two wheels with encoders behind. A command's `linear.x` is
/// the rim speed of the driven wheel, its `angular.z` the steering **angle**.
///
/// Source: `gazebo_plugins/src/gazebo_ros_tricycle_drive.cpp` of `gazebo_ros_pkgs`. One error of the
/// original is corrected: the sign of the yaw in wheel odometry.
pub(crate) struct Tricycle {
    name: String,
    model: ModelId,
    /// Midpoint of the encoder wheels, in the model [m].
    centre_m: DVec3,
    /// Distance from there to the driven wheel [m].
    wheel_base_m: f64,
    steering: JointId,
    driven: JointId,
    controller: drives::Tricycle,
    commands: Commands,
    state: TricycleState,
    odometry: ClassicOdometry,
}

#[derive(Clone)]
struct TricycleState {
    control_timer: RateTimer,
    acted_ns: i64,
}

/// Parameter names of the plugin in ROS 1 or ROS 2.
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

pub(crate) fn build(context: &BuildContext<'_>, diagnostics: &mut Diagnostics) -> Option<Tricycle> {
    let is_ros1 = context.plugin.known.family == Family::ClassicRos1;
    let names = if is_ros1 { ROS1 } else { ROS2 };
    let joints = names.joints.map(|name| context.joint(name, diagnostics));
    let [steering, driven, left, right] = [joints[0]?, joints[1]?, joints[2]?, joints[3]?];
    let node = context.node(diagnostics)?;
    let start_ns = context.setting.start_ns;
    let mut odometry_publisher =
        OdometryPublisher::between(context.text(names.frames[0]), context.text(names.frames[1]));
    odometry_publisher.pose_covariance = planar_covariance(1e-5, 1e-5, 1e-3);
    let (command_topic, counts_wheels);
    if is_ros1 {
        command_topic = context.text("commandTopic");
        counts_wheels = context.text("odometrySource") == "encoder";
        odometry_publisher =
            odometry_publisher.on(context, &node, &context.text("odometryTopic"), diagnostics)?;
        odometry_publisher = odometry_publisher.with_tf(context, &node, "/tf", diagnostics)?;
    } else {
        command_topic = "cmd_vel".to_owned();
        counts_wheels = context.plugin.values.integer("odometry_source") == Some(0);
        if context.flag("publish_odom") {
            odometry_publisher = odometry_publisher.on(context, &node, "odom", diagnostics)?;
            odometry_publisher = odometry_publisher.with_tf(context, &node, "/tf", diagnostics)?;
        }
    }
    let acceleration = context.number(names.acceleration);
    let controller = drives::Tricycle {
        actuated_wheel_diameter_m: context.number(names.driven_diameter),
        encoder_wheel_diameter_m: context.number(names.counted_diameter),
        encoder_wheel_separation_m: context.number(names.separation),
        wheel_acceleration_rad_s2: acceleration,
        wheel_deceleration_rad_s2: context
            .plugin
            .values
            .number(names.deceleration)
            .unwrap_or(acceleration),
        wheel_speed_tolerance_rad_s: context.number(names.speed_tolerance),
        steering_speed_rad_s: context.number(names.steering_speed),
        steering_angle_tolerance_rad: context.number(names.angle_tolerance),
        wheel_torque_n_m: context.plugin.values.number(names.torque).unwrap_or(f64::INFINITY),
        update_rate_hz: context.number(names.update_rate),
    };
    let centre_m = context.middle(&[left, right]);
    let encoders = Encoders::new(
        [left, right],
        controller.encoder_wheel_diameter_m / 2.0,
        controller.encoder_wheel_separation_m,
    );
    let wheel_frames = context
        .flag(names.wheel_tf)
        .then(|| WheelFrames::new(context, &node, &names.joints, diagnostics))
        .flatten();
    let joint_states = context
        .flag(names.joint_states)
        .then(|| {
            JointStates::of_wheels(context, &node, &[steering, driven, left, right], diagnostics)
        })
        .flatten();
    let body = Body::of_model(context)?;
    let rate_hz = controller.update_rate_hz;
    Some(Tricycle {
        name: context.name(),
        model: context.setting.model,
        centre_m,
        wheel_base_m: (context.middle(&[driven]) - centre_m).x,
        steering,
        driven,
        commands: Commands::new(context, &node, &command_topic, diagnostics)?,
        state: TricycleState {
            control_timer: RateTimer::for_controller(rate_hz, start_ns),
            acted_ns: start_ns,
        },
        controller,
        odometry: ClassicOdometry {
            source: OdometrySource::new(counts_wheels),
            body,
            encoders: Some(encoders),
            publisher: odometry_publisher,
            wheel_frames,
            joint_states,
            timer: RateTimer::for_publisher(rate_hz, start_ns),
        },
    })
}

impl Device for Tricycle {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut PhysicsWorld, span: StepInterval) {
        self.odometry.begin(world);
        if !self.state.control_timer.due(span.start_ns) {
            return;
        }
        let since = StepInterval {
            start_ns: self.state.acted_ns,
            length_ns: span.start_ns - self.state.acted_ns,
        };
        self.state.acted_ns = span.start_ns;
        let command = self.commands.planar();
        let at_rad = angle(world, self.steering);
        let rolls_rad_s = speed(world, self.driven);
        let (target, steering) =
            self.controller.update(command, rolls_rad_s, at_rad, since.seconds());
        let max_effort = self.controller.wheel_torque_n_m;
        world.command(self.driven, JointCommand::Velocity { target, max_effort });
        let free = f64::INFINITY;
        let steer = match steering {
            // The original sets the joint position at once.
            Steering::At(target) => {
                JointCommand::Position { target, max_speed: free, max_effort: free }
            }
            Steering::Turning(target) => JointCommand::Velocity { target, max_effort },
        };
        world.command(self.steering, steer);
        if self.wheel_base_m.abs() > 1e-6 {
            let twist = self.controller.twist(target, at_rad, self.wheel_base_m);
            if world.follow_about(self.model, self.centre_m, twist) {
                // Without physics nothing rolls the encoder wheels.
                self.odometry.roll(world, twist);
            }
        }
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        self.odometry.sense(moment);
    }

    fn next_ns(&self) -> Option<i64> {
        earlier(self.state.control_timer.next_ns(), self.odometry.next_ns())
    }

    fn reset(&mut self, time_ns: i64) {
        self.commands.reset();
        self.state.control_timer.restart(time_ns);
        self.state.acted_ns = time_ns;
        self.odometry.reset(time_ns);
    }

    fn save(&self) -> DeviceState {
        DeviceState::new((self.state.clone(), self.commands.save(), self.odometry.save()))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        type Saved = (TricycleState, CommandsState, ClassicOdometryState);
        let Some((state, commands, odometry)) = saved.get::<Saved>() else { return false };
        self.state = state.clone();
        self.commands.restore(commands);
        self.odometry.restore(odometry);
        true
    }
}
