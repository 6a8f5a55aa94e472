//! `libgazebo_ros_ackermann_drive.so` of ROS 2.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::DVec3;
use periplus_graph::{Publisher, Qos};
use periplus_msgs::std_msgs;
use periplus_physics::drives::{ClassicAckermann, ClassicAckermannTarget, truth};
use periplus_physics::{Command, JointId, LinkState, Mode, ModelId, World};
use periplus_scene::{Shape, carrying_link};

use super::beat::{Beat, earlier};
use super::body::Body;
use super::commands::Commands;
use super::encoders::{angle, speed};
use super::order::Order;
use super::pid::{Gains, Pid};
use super::wheel_frames::WheelFrames;
use crate::states::{Teller, planar_covariance, planar_twist};
use crate::{Device, Moment, Span, publisher_qos};

const JOINTS: [&str; 6] = [
    "front_right_joint",
    "front_left_joint",
    "rear_right_joint",
    "rear_left_joint",
    "right_steering_joint",
    "left_steering_joint",
];

/// A car, driven and steered by efforts. A command's `linear.x` is its speed, its `angular.z` the
/// **angle** of the steering. Track and wheel base are measured on the model, the wheels' radius on
/// the collision of the right rear wheel. An effort lasts one step, though updates are rarer, as in
/// Gazebo, so that gains mean the same; with the default gains, which are 0, it stands.
///
/// Source: `gazebo_plugins/src/gazebo_ros_ackermann_drive.cpp` of `gazebo_ros_pkgs`.
pub(crate) struct Car {
    name: String,
    model: ModelId,
    body: Body,
    rear: [JointId; 2],
    /// Left, right.
    steered: [JointId; 2],
    steering_wheel: Option<JointId>,
    rear_middle_m: DVec3,
    law: ClassicAckermann,
    /// Of the speed, of the left and of the right steering.
    gains: [Gains; 3],
    controllers: [Pid; 3],
    commands: Commands,
    acts: Beat,
    tells: Beat,
    acted_ns: i64,
    teller: Teller,
    wheel_frames: Option<WheelFrames>,
    distance: Option<Publisher<std_msgs::Float32>>,
    distance_m: f64,
    last_m: Option<DVec3>,
}

pub(crate) fn build(order: &Order<'_>, diagnostics: &mut Diagnostics) -> Option<Car> {
    let found = JOINTS.map(|name| order.joint(name, diagnostics));
    let [front_right, front_left, rear_right, rear_left, steer_right, steer_left] =
        [found[0]?, found[1]?, found[2]?, found[3]?, found[4]?, found[5]?];
    let steering_wheel = match order.given_text("steering_wheel_joint") {
        Some(_) => order.joint("steering_wheel_joint", diagnostics),
        None => None,
    };
    let Some(radius_m) = radius_of(order, "rear_right_joint") else {
        let message = format!(
            "plugin `{}` takes the radius of its wheels from the first collision of the right rear \
             wheel, which is no cylinder or sphere",
            order.site.plugin.name
        );
        diagnostics.push(
            Diagnostic::error("wheel-radius-unknown", message)
                .at(order.plugin.values.origin("rear_right_joint"))
                .note("the plugin does nothing; the rest of the model runs")
                .help("give the wheel's link a `<cylinder>` or `<sphere>` as its first collision"),
        );
        return None;
    };
    let gains =
        ["linear_velocity", "left_steering", "right_steering"].map(|kind| gains(order, kind));
    if gains.iter().any(|gains| gains.p == 0.0 && gains.i == 0.0) {
        let message = format!("a gain of plugin `{}` is 0: the car stands", order.site.plugin.name);
        let help = "set `linear_velocity_pid_gain`, `left_steering_pid_gain` and \
                    `right_steering_pid_gain`";
        let finding = Diagnostic::warning("gains-zero", message).at(order.origin()).help(help);
        diagnostics.push(finding);
    }
    let node = order.node(diagnostics)?;
    let start_ns = order.setting.start_ns;
    let mut teller = Teller::between(order.text("odometry_frame"), order.text("robot_base_frame"));
    teller.pose_covariance = planar_covariance(
        order.number("covariance_x"),
        order.number("covariance_y"),
        order.number("covariance_yaw"),
    );
    teller.twist_covariance = teller.pose_covariance;
    if order.flag("publish_odom") {
        teller = teller.on(order, &node, "odom", diagnostics)?;
    }
    if order.flag("publish_odom_tf") {
        teller = teller.with_tf(order, &node, "/tf", diagnostics)?;
    }
    let distance = if order.flag("publish_distance") {
        let qos = publisher_qos(&order.plugin.ros, "distance", Qos::reliable(1));
        Some(order.accept(node.publisher("distance", qos), diagnostics)?)
    } else {
        None
    };
    let wheel_frames = order
        .flag("publish_wheel_tf")
        .then(|| WheelFrames::new(order, &node, &JOINTS, diagnostics))
        .flatten();
    let rear_middle_m = order.middle(&[rear_right, rear_left]);
    let law = ClassicAckermann {
        max_speed_m_s: order.number("max_speed"),
        max_steer_rad: order.number("max_steer"),
        max_steering_angle_rad: order.number("max_steering_angle"),
        wheel_separation_m: order.middle(&[front_left]).distance(order.middle(&[front_right])),
        wheel_base_m: order.middle(&[front_left, front_right]).distance(rear_middle_m),
        wheel_radius_m: radius_m,
    };
    Some(Car {
        name: order.name(),
        model: order.setting.model,
        body: Body::of_model(order)?,
        rear: [rear_left, rear_right],
        steered: [steer_left, steer_right],
        steering_wheel,
        rear_middle_m,
        law,
        gains,
        controllers: Default::default(),
        commands: Commands::new(order, &node, "cmd_vel", diagnostics)?,
        acts: Beat::acting(order.number("update_rate"), start_ns),
        tells: Beat::telling(order.number("update_rate"), start_ns),
        acted_ns: start_ns,
        teller,
        wheel_frames,
        distance,
        distance_m: 0.0,
        last_m: None,
    })
}

/// The gains of a part, without bounds of the answer.
fn gains(order: &Order<'_>, kind: &str) -> Gains {
    let [p, i, d] = order.triple(&format!("{kind}_pid_gain"));
    let [low, high, _] = order.triple(&format!("{kind}_i_range"));
    Gains { p, i, d, integral: [low, high], command: [0.0, -1.0], offset: 0.0 }
}

/// The radius of the wheel on a joint [m].
fn radius_of(order: &Order<'_>, parameter: &str) -> Option<f64> {
    let model = order.model();
    let joint = model.joint(order.text(parameter).trim())?;
    let wheel = carrying_link(model, &joint.child)?;
    match model.link(&wheel)?.collisions.first()?.shape {
        Shape::Cylinder { radius_m, .. } | Shape::Sphere { radius_m } => Some(radius_m),
        _ => None,
    }
}

impl Car {
    fn is_heard(&self) -> bool {
        self.teller.is_heard()
            || self.wheel_frames.as_ref().is_some_and(WheelFrames::is_heard)
            || self.distance.as_ref().is_some_and(Publisher::is_heard)
    }

    fn push(&self, world: &mut World, efforts: [f64; 3]) {
        let [drive, left, right] = efforts;
        let joints = [self.rear[0], self.rear[1], self.steered[0], self.steered[1]];
        for (joint, effort) in joints.into_iter().zip([drive, drive, left, right]) {
            world.command(joint, Command::Effort(effort));
        }
    }
}

impl Device for Car {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut World, span: Span) {
        if !self.acts.due(span.start_ns) {
            if world.mode() == Mode::Rigid {
                self.push(world, [0.0; 3]);
            }
            return;
        }
        let since = Span { start_ns: self.acted_ns, length_ns: span.start_ns - self.acted_ns };
        self.acted_ns = span.start_ns;
        let dt_s = since.seconds();
        let ClassicAckermannTarget { steering_rad, wheels_rad_s } =
            self.law.target(self.commands.planar());
        let at_rad = self.steered.map(|joint| angle(world, joint));
        let errors = [
            speed(world, self.rear[1]) - wheels_rad_s,
            at_rad[0] - steering_rad[0],
            at_rad[1] - steering_rad[1],
        ];
        let mut efforts = [0.0; 3];
        for (part, effort) in efforts.iter_mut().enumerate() {
            *effort = self.controllers[part].update(&self.gains[part], errors[part], dt_s);
        }
        self.push(world, efforts);
        let free = f64::INFINITY;
        if let Some(wheel) = self.steering_wheel {
            let target = self.law.steering_wheel_rad(at_rad);
            world.command(wheel, Command::Position { target, max_speed: free, max_effort: free });
        }
        // Without physics efforts move nothing: there it does what it is told.
        let twist = self.law.twist(steering_rad, wheels_rad_s);
        if world.follow_about(self.model, self.rear_middle_m, twist) {
            for (joint, target) in self.steered.into_iter().zip(steering_rad) {
                let command = Command::Position { target, max_speed: free, max_effort: free };
                world.command(joint, command);
            }
            for joint in self.rear {
                let command = Command::Velocity { target: wheels_rad_s, max_effort: free };
                world.command(joint, command);
            }
        }
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        let Some(state) = self.body.state(moment.world) else { return };
        let LinkState { world_from_link: pose, linear_m_s, angular_rad_s } = state;
        let at_m = DVec3 { z: 0.0, ..pose.translation };
        self.distance_m += at_m.distance(self.last_m.replace(at_m).unwrap_or(at_m));
        let now_ns = moment.time_ns();
        if !self.tells.due(now_ns) || !self.is_heard() {
            return;
        }
        self.teller.tell(now_ns, pose, planar_twist(truth(pose, linear_m_s, angular_rad_s)));
        if let Some(frames) = &self.wheel_frames {
            frames.tell(moment.world, now_ns);
        }
        if let Some(distance) = &self.distance {
            #[expect(clippy::cast_possible_truncation, reason = "the message has floats")]
            distance.publish(std_msgs::Float32 { data: self.distance_m as f32 });
        }
    }

    fn next_ns(&self) -> Option<i64> {
        let telling = self.tells.next_ns().filter(|_| self.is_heard());
        earlier(self.acts.next_ns(), telling)
    }

    fn reset(&mut self, time_ns: i64) {
        self.controllers = Default::default();
        self.commands.reset();
        self.acts.restart(time_ns);
        self.tells.restart(time_ns);
        self.acted_ns = time_ns;
        self.distance_m = 0.0;
        self.last_m = None;
    }
}
