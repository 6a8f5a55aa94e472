//! Drives that push a whole model: `planar_move` of Classic and `VelocityControl` of gz-sim.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::DVec3;
use periplus_msgs::geometry_msgs;
use periplus_physics::drives::{planar_velocity, truth};
use periplus_physics::{ModelId, World};
use periplus_plugin_specs::Family;

use super::beat::{Beat, earlier};
use super::body::Body;
use super::commands::Commands;
use super::order::Order;
use crate::states::{Teller, from_vector, planar_covariance, planar_twist, vector};
use crate::{Device, Moment, Span};

/// `libgazebo_ros_planar_move.so` of ROS 1 and ROS 2: the model is given its commanded velocity over
/// the plane, in its own heading. Odometry is the true pose in the world.
///
/// Source: `gazebo_plugins/src/gazebo_ros_planar_move.cpp` of `gazebo_ros_pkgs`. That of ROS 1 acts
/// at each step and may forget a command (`cmdTimeout`).
pub(crate) struct PlanarMove {
    name: String,
    model: ModelId,
    body: Body,
    commands: Commands,
    /// After so long a command is forgotten [ns]; none for never.
    timeout_ns: Option<i64>,
    heard_ns: i64,
    acts: Beat,
    tells: Beat,
    teller: Teller,
}

pub(crate) fn planar_move(order: &Order<'_>, diagnostics: &mut Diagnostics) -> Option<PlanarMove> {
    let node = order.node(diagnostics)?;
    let start_ns = order.setting.start_ns;
    let is_ros1 = order.plugin.known.family == Family::ClassicRos1;
    let names = if is_ros1 {
        ["odometryFrame", "robotBaseFrame", "publishOdometry", "publishTF"]
    } else {
        ["odometry_frame", "robot_base_frame", "publish_odom", "publish_odom_tf"]
    };
    let [parent, child, publishes, transforms] = names;
    let mut teller = Teller::between(order.text(parent), order.text(child));
    let (command_topic, odometry_topic, act_hz, tell_hz);
    if is_ros1 {
        teller.pose_covariance = planar_covariance(1e-5, 1e-5, 1e-3);
        command_topic = order.text("commandTopic");
        odometry_topic = order.text("odometryTopic");
        (act_hz, tell_hz) = (0.0, order.number("odometryRate"));
    } else {
        teller.pose_covariance = planar_covariance(
            order.number("covariance_x"),
            order.number("covariance_y"),
            order.number("covariance_yaw"),
        );
        teller.twist_covariance = teller.pose_covariance;
        (command_topic, odometry_topic) = ("cmd_vel".into(), "odom".into());
        (act_hz, tell_hz) = (order.number("update_rate"), order.number("publish_rate"));
    }
    // Of ROS 1 a rate of 0 means no odometry at all.
    let tells = !(is_ros1 && tell_hz == 0.0);
    if tells && order.flag(publishes) {
        teller = teller.on(order, &node, &odometry_topic, diagnostics)?;
    }
    if tells && order.flag(transforms) {
        teller = teller.with_tf(order, &node, "/tf", diagnostics)?;
    }
    let timeout_s = if is_ros1 { order.number("cmdTimeout") } else { -1.0 };
    #[expect(clippy::cast_possible_truncation, reason = "it saturates")]
    let timeout_ns = (timeout_s >= 0.0).then_some((timeout_s * 1e9) as i64);
    Some(PlanarMove {
        name: order.name(),
        model: order.setting.model,
        body: Body::of_model(order)?,
        commands: Commands::new(order, &node, &command_topic, diagnostics)?,
        timeout_ns,
        heard_ns: start_ns,
        acts: Beat::acting(act_hz, start_ns),
        tells: Beat::telling(tell_hz, start_ns),
        teller,
    })
}

impl Device for PlanarMove {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut World, span: Span) {
        if !self.acts.due(span.start_ns) {
            return;
        }
        let twist = self.commands.planar();
        if self.commands.take_news() {
            self.heard_ns = span.start_ns;
        }
        let twist = match self.timeout_ns {
            Some(timeout_ns) if span.start_ns - self.heard_ns > timeout_ns => {
                self.commands.stop();
                Default::default()
            }
            _ => twist,
        };
        let Some(state) = self.body.state(world) else { return };
        let (linear, angular) = planar_velocity(state.world_from_link, twist);
        if !world.follow(self.model, twist) {
            world.set_model_velocity(self.model, linear, angular);
        }
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        let now_ns = moment.time_ns();
        if !self.tells.due(now_ns) || !self.teller.is_heard() {
            return;
        }
        if let Some(state) = self.body.state(moment.world) {
            let twist = truth(state.world_from_link, state.linear_m_s, state.angular_rad_s);
            self.teller.tell(now_ns, state.world_from_link, planar_twist(twist));
        }
    }

    fn next_ns(&self) -> Option<i64> {
        let telling = self.tells.next_ns().filter(|_| self.teller.is_heard());
        earlier(self.acts.next_ns(), telling)
    }

    fn reset(&mut self, time_ns: i64) {
        self.commands.reset();
        self.heard_ns = time_ns;
        self.acts.restart(time_ns);
        self.tells.restart(time_ns);
    }
}

/// `gz-sim-velocity-control-system`: the model is given its commanded velocity along and about its
/// own axes at each step, zero before the first command, so that it neither falls nor is pushed.
///
/// Source: gz-sim 8, `VelocityControl.cc`; `Physics.cc` for what its commands mean.
pub(crate) struct VelocityControl {
    name: String,
    model: ModelId,
    commands: Commands,
}

pub(crate) fn velocity_control(
    order: &Order<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<VelocityControl> {
    let node = order.node(diagnostics)?;
    if order.plugin.values.is_given("link_name") {
        let message = "velocities of single links are not simulated";
        let help = "move the link by a joint and `gz-sim-joint-controller-system`";
        let origin = order.plugin.values.origin("link_name");
        diagnostics.push(
            Diagnostic::warning("link-velocity-not-simulated", message).at(origin).help(help),
        );
    }
    let first = geometry_msgs::Twist {
        linear: vector(DVec3::from_array(order.triple("initial_linear"))),
        angular: vector(DVec3::from_array(order.triple("initial_angular"))),
    };
    let commands = Commands::new(order, &node, &order.gz_topic("topic", "cmd_vel"), diagnostics)?;
    Some(VelocityControl {
        name: order.name(),
        model: order.setting.model,
        commands: commands.starting_with(first),
    })
}

impl Device for VelocityControl {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut World, _span: Span) {
        let full = self.commands.full();
        let (linear, angular) = (from_vector(&full.linear), from_vector(&full.angular));
        let is_planar = linear.z == 0.0 && angular.x == 0.0 && angular.y == 0.0;
        if is_planar && world.follow(self.model, self.commands.planar()) {
            return;
        }
        if let Some(pose) = world.model_pose(self.model) {
            world.set_model_velocity(self.model, pose.rotation * linear, pose.rotation * angular);
        }
    }

    fn reset(&mut self, _time_ns: i64) {
        self.commands.reset();
    }
}
