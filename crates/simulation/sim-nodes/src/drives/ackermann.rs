//! `libgazebo_ros_ackermann_drive.so` of ROS 2.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::DVec3;
use periplus_graph::{Publisher, Qos};
use periplus_msgs::std_msgs;
use periplus_physics::drives::{ClassicAckermann, ClassicAckermannTarget, true_twist};
use periplus_physics::{JointCommand, JointId, LinkState, ModelId, PhysicsMode, PhysicsWorld};
use periplus_scene::{Shape, carrying_link};

use super::body::Body;
use super::build_context::BuildContext;
use super::commands::{Commands, CommandsState};
use super::encoders::{angle, speed};
use super::pid::{Gains, Pid};
use super::rate_timer::{RateTimer, earlier};
use super::wheel_frames::WheelFrames;
use crate::states::{OdometryPublisher, planar_twist};
use crate::{Device, DeviceState, SenseContext, StepInterval, publisher_qos};

const JOINTS: [&str; 6] = [
    "front_right_joint",
    "front_left_joint",
    "rear_right_joint",
    "rear_left_joint",
    "right_steering_joint",
    "left_steering_joint",
];

/// An Ackermann car, driven and steered by efforts. A command's `linear.x` is the speed, its
/// `angular.z` the steering **angle**. Track and wheel base are measured on the model, the wheel
/// radius on the collision of the right rear wheel. An effort lasts one step even at a lower update
/// rate, as in Gazebo, so gains have the same meaning; with the default gains of 0 the car does not
/// move.
///
/// Source: `gazebo_plugins/src/gazebo_ros_ackermann_drive.cpp` of `gazebo_ros_pkgs`.
pub(crate) struct AckermannDrive {
    name: String,
    model: ModelId,
    body: Body,
    rear: [JointId; 2],
    /// Left, right.
    steered: [JointId; 2],
    steering_wheel: Option<JointId>,
    rear_middle_m: DVec3,
    controller: ClassicAckermann,
    /// Speed, left steering, right steering.
    gains: [Gains; 3],
    commands: Commands,
    state: AckermannState,
    odometry_publisher: OdometryPublisher,
    wheel_frames: Option<WheelFrames>,
    distance: Option<Publisher<std_msgs::Float32>>,
}

#[derive(Clone)]
struct AckermannState {
    controllers: [Pid; 3],
    control_timer: RateTimer,
    publish_timer: RateTimer,
    acted_ns: i64,
    distance_m: f64,
    last_m: Option<DVec3>,
}

pub(crate) fn build(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<AckermannDrive> {
    let found = JOINTS.map(|name| context.joint(name, diagnostics));
    let [front_right, front_left, rear_right, rear_left, steer_right, steer_left] =
        [found[0]?, found[1]?, found[2]?, found[3]?, found[4]?, found[5]?];
    let steering_wheel = match context.given_text("steering_wheel_joint") {
        Some(_) => context.joint("steering_wheel_joint", diagnostics),
        None => None,
    };
    let Some(radius_m) = radius_of(context, "rear_right_joint") else {
        let message = format!(
            "plugin `{}` gets the radius of its wheels from the first collision of the right rear \
             wheel, which is not a cylinder or sphere",
            context.site.plugin.name
        );
        diagnostics.push(
            Diagnostic::error("wheel-radius-unknown", message)
                .at(context.plugin.values.origin("rear_right_joint"))
                .note("the plugin is disabled; the rest of the model runs")
                .help("give the wheel's link a `<cylinder>` or `<sphere>` as its first collision"),
        );
        return None;
    };
    let gains =
        ["linear_velocity", "left_steering", "right_steering"].map(|kind| gains(context, kind));
    if gains.iter().any(|gains| gains.p == 0.0 && gains.i == 0.0) {
        let message =
            format!("a gain of plugin `{}` is 0: the car will not move", context.site.plugin.name);
        let help = "set `linear_velocity_pid_gain`, `left_steering_pid_gain` and \
                    `right_steering_pid_gain`";
        let finding = Diagnostic::warning("gains-zero", message).at(context.origin()).help(help);
        diagnostics.push(finding);
    }
    let node = context.node(diagnostics)?;
    let start_ns = context.setting.start_ns;
    let odometry_publisher = OdometryPublisher::of_gazebo_ros(context, &node, diagnostics)?;
    let distance = if context.flag("publish_distance") {
        let qos = publisher_qos(&context.plugin.ros, "distance", Qos::reliable(1));
        Some(context.accept(node.publisher("distance", qos), diagnostics)?)
    } else {
        None
    };
    let wheel_frames = context
        .flag("publish_wheel_tf")
        .then(|| WheelFrames::new(context, &node, &JOINTS, diagnostics))
        .flatten();
    let rear_middle_m = context.middle(&[rear_right, rear_left]);
    let controller = ClassicAckermann {
        max_speed_m_s: context.number("max_speed"),
        max_steer_rad: context.number("max_steer"),
        max_steering_angle_rad: context.number("max_steering_angle"),
        wheel_separation_m: context.middle(&[front_left]).distance(context.middle(&[front_right])),
        wheel_base_m: context.middle(&[front_left, front_right]).distance(rear_middle_m),
        wheel_radius_m: radius_m,
    };
    Some(AckermannDrive {
        name: context.name(),
        model: context.setting.model,
        body: Body::of_model(context)?,
        rear: [rear_left, rear_right],
        steered: [steer_left, steer_right],
        steering_wheel,
        rear_middle_m,
        controller,
        gains,
        commands: Commands::new(context, &node, "cmd_vel", diagnostics)?,
        state: AckermannState {
            controllers: Default::default(),
            control_timer: RateTimer::for_controller(context.number("update_rate"), start_ns),
            publish_timer: RateTimer::for_publisher(context.number("update_rate"), start_ns),
            acted_ns: start_ns,
            distance_m: 0.0,
            last_m: None,
        },
        odometry_publisher,
        wheel_frames,
        distance,
    })
}

/// Returns the gains of a controller; its output is unbounded.
fn gains(context: &BuildContext<'_>, kind: &str) -> Gains {
    let [p, i, d] = context.triple(&format!("{kind}_pid_gain"));
    let [low, high, _] = context.triple(&format!("{kind}_i_range"));
    Gains { p, i, d, integral: [low, high], command: [0.0, -1.0], offset: 0.0 }
}

/// Returns the radius of the wheel on a joint [m].
fn radius_of(context: &BuildContext<'_>, parameter: &str) -> Option<f64> {
    let model = context.model();
    let joint = model.joint(context.text(parameter).trim())?;
    let wheel = carrying_link(model, &joint.child)?;
    match model.link(&wheel)?.collisions.first()?.shape {
        Shape::Cylinder { radius_m, .. } | Shape::Sphere { radius_m } => Some(radius_m),
        _ => None,
    }
}

impl AckermannDrive {
    fn has_subscribers(&self) -> bool {
        self.odometry_publisher.has_subscribers()
            || self.wheel_frames.as_ref().is_some_and(WheelFrames::has_subscribers)
            || self.distance.as_ref().is_some_and(Publisher::is_heard)
    }

    fn push(&self, world: &mut PhysicsWorld, efforts: [f64; 3]) {
        let [drive, left, right] = efforts;
        let joints = [self.rear[0], self.rear[1], self.steered[0], self.steered[1]];
        for (joint, effort) in joints.into_iter().zip([drive, drive, left, right]) {
            world.command(joint, JointCommand::Effort(effort));
        }
    }
}

impl Device for AckermannDrive {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut PhysicsWorld, span: StepInterval) {
        if !self.state.control_timer.due(span.start_ns) {
            if world.mode() == PhysicsMode::Rigid {
                self.push(world, [0.0; 3]);
            }
            return;
        }
        let since = StepInterval {
            start_ns: self.state.acted_ns,
            length_ns: span.start_ns - self.state.acted_ns,
        };
        self.state.acted_ns = span.start_ns;
        let dt_s = since.seconds();
        let ClassicAckermannTarget { steering_rad, wheels_rad_s } =
            self.controller.target(self.commands.planar());
        let at_rad = self.steered.map(|joint| angle(world, joint));
        let errors = [
            speed(world, self.rear[1]) - wheels_rad_s,
            at_rad[0] - steering_rad[0],
            at_rad[1] - steering_rad[1],
        ];
        let mut efforts = [0.0; 3];
        for (part, effort) in efforts.iter_mut().enumerate() {
            *effort = self.state.controllers[part].update(&self.gains[part], errors[part], dt_s);
        }
        self.push(world, efforts);
        let free = f64::INFINITY;
        if let Some(wheel) = self.steering_wheel {
            let target = self.controller.steering_wheel_rad(at_rad);
            world.command(
                wheel,
                JointCommand::Position { target, max_speed: free, max_effort: free },
            );
        }
        // Without physics efforts have no effect: the commands are applied to the joints directly.
        let twist = self.controller.twist(steering_rad, wheels_rad_s);
        if world.follow_about(self.model, self.rear_middle_m, twist) {
            for (joint, target) in self.steered.into_iter().zip(steering_rad) {
                let command = JointCommand::Position { target, max_speed: free, max_effort: free };
                world.command(joint, command);
            }
            for joint in self.rear {
                let command = JointCommand::Velocity { target: wheels_rad_s, max_effort: free };
                world.command(joint, command);
            }
        }
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let Some(state) = self.body.state(moment.world) else { return };
        let LinkState { world_from_link: pose, linear_m_s, angular_rad_s } = state;
        let at_m = DVec3 { z: 0.0, ..pose.translation };
        self.state.distance_m += at_m.distance(self.state.last_m.replace(at_m).unwrap_or(at_m));
        let now_ns = moment.time_ns();
        if !self.state.publish_timer.due(now_ns) || !self.has_subscribers() {
            return;
        }
        self.odometry_publisher.publish(
            now_ns,
            pose,
            planar_twist(true_twist(pose, linear_m_s, angular_rad_s)),
        );
        if let Some(frames) = &self.wheel_frames {
            frames.publish(moment.world, now_ns);
        }
        if let Some(distance) = &self.distance {
            #[expect(clippy::cast_possible_truncation, reason = "the message has floats")]
            distance.publish(std_msgs::Float32 { data: self.state.distance_m as f32 });
        }
    }

    fn next_ns(&self) -> Option<i64> {
        let for_publisher = self.state.publish_timer.next_ns().filter(|_| self.has_subscribers());
        earlier(self.state.control_timer.next_ns(), for_publisher)
    }

    fn reset(&mut self, time_ns: i64) {
        self.state.controllers = Default::default();
        self.commands.reset();
        self.state.control_timer.restart(time_ns);
        self.state.publish_timer.restart(time_ns);
        self.state.acted_ns = time_ns;
        self.state.distance_m = 0.0;
        self.state.last_m = None;
    }

    fn save(&self) -> DeviceState {
        DeviceState::new((self.state.clone(), self.commands.save()))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some((state, commands)) = saved.get::<(AckermannState, CommandsState)>() else {
            return false;
        };
        self.state = state.clone();
        self.commands.restore(commands);
        true
    }
}
