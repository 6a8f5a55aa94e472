//! Drives of whole models: `planar_move` of Classic and `VelocityControl` of gz-sim.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::DVec3;
use periplus_msgs::geometry_msgs;
use periplus_physics::drives::{planar_velocity, true_twist};
use periplus_physics::{ModelId, PhysicsWorld};
use periplus_plugin_specs::Family;

use super::body::Body;
use super::build_context::BuildContext;
use super::commands::{Commands, CommandsState};
use super::rate_timer::{RateTimer, earlier};
use crate::states::{OdometryPublisher, from_vector, planar_covariance, planar_twist, vector};
use crate::{Device, DeviceState, SenseContext, StepInterval};

/// `libgazebo_ros_planar_move.so` of ROS 1 and ROS 2: sets the model's velocity in the plane to the
/// command, in its own heading. Odometry is the true pose in the world.
///
/// Source: `gazebo_plugins/src/gazebo_ros_planar_move.cpp` of `gazebo_ros_pkgs`. The ROS 1 version
/// acts in every step and supports a command timeout (`cmdTimeout`).
pub(crate) struct PlanarMove {
    name: String,
    model: ModelId,
    body: Body,
    commands: Commands,
    /// Timeout of a command [ns]; `None` for no timeout.
    timeout_ns: Option<i64>,
    state: PlanarMoveState,
    odometry_publisher: OdometryPublisher,
}

#[derive(Clone)]
struct PlanarMoveState {
    received_ns: i64,
    control_timer: RateTimer,
    publish_timer: RateTimer,
}

pub(crate) fn planar_move(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<PlanarMove> {
    let node = context.node(diagnostics)?;
    let start_ns = context.setting.start_ns;
    let is_ros1 = context.plugin.known.family == Family::ClassicRos1;
    let names = if is_ros1 {
        ["odometryFrame", "robotBaseFrame", "publishOdometry", "publishTF"]
    } else {
        ["odometry_frame", "robot_base_frame", "publish_odom", "publish_odom_tf"]
    };
    let [parent, child, publishes, transforms] = names;
    let mut odometry_publisher =
        OdometryPublisher::between(context.text(parent), context.text(child));
    let (command_topic, odometry_topic, act_hz, tell_hz);
    if is_ros1 {
        odometry_publisher.pose_covariance = planar_covariance(1e-5, 1e-5, 1e-3);
        command_topic = context.text("commandTopic");
        odometry_topic = context.text("odometryTopic");
        (act_hz, tell_hz) = (0.0, context.number("odometryRate"));
    } else {
        odometry_publisher.pose_covariance = planar_covariance(
            context.number("covariance_x"),
            context.number("covariance_y"),
            context.number("covariance_yaw"),
        );
        odometry_publisher.twist_covariance = odometry_publisher.pose_covariance;
        (command_topic, odometry_topic) = ("cmd_vel".into(), "odom".into());
        (act_hz, tell_hz) = (context.number("update_rate"), context.number("publish_rate"));
    }
    // In ROS 1 a rate of 0 disables odometry.
    let publish_timer = !(is_ros1 && tell_hz == 0.0);
    if publish_timer && context.flag(publishes) {
        odometry_publisher = odometry_publisher.on(context, &node, &odometry_topic, diagnostics)?;
    }
    if publish_timer && context.flag(transforms) {
        odometry_publisher = odometry_publisher.with_tf(context, &node, "/tf", diagnostics)?;
    }
    let timeout_s = if is_ros1 { context.number("cmdTimeout") } else { -1.0 };
    #[expect(clippy::cast_possible_truncation, reason = "it saturates")]
    let timeout_ns = (timeout_s >= 0.0).then_some((timeout_s * 1e9) as i64);
    Some(PlanarMove {
        name: context.name(),
        model: context.setting.model,
        body: Body::of_model(context)?,
        commands: Commands::new(context, &node, &command_topic, diagnostics)?,
        timeout_ns,
        state: PlanarMoveState {
            received_ns: start_ns,
            control_timer: RateTimer::for_controller(act_hz, start_ns),
            publish_timer: RateTimer::for_publisher(tell_hz, start_ns),
        },
        odometry_publisher,
    })
}

impl Device for PlanarMove {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut PhysicsWorld, span: StepInterval) {
        if !self.state.control_timer.due(span.start_ns) {
            return;
        }
        let twist = self.commands.planar();
        if self.commands.take_new_command() {
            self.state.received_ns = span.start_ns;
        }
        let twist = match self.timeout_ns {
            Some(timeout_ns) if span.start_ns - self.state.received_ns > timeout_ns => {
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

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        let now_ns = moment.time_ns();
        if !self.state.publish_timer.due(now_ns) || !self.odometry_publisher.has_subscribers() {
            return;
        }
        if let Some(state) = self.body.state(moment.world) {
            let twist = true_twist(state.world_from_link, state.linear_m_s, state.angular_rad_s);
            self.odometry_publisher.publish(now_ns, state.world_from_link, planar_twist(twist));
        }
    }

    fn next_ns(&self) -> Option<i64> {
        let for_publisher = self
            .state
            .publish_timer
            .next_ns()
            .filter(|_| self.odometry_publisher.has_subscribers());
        earlier(self.state.control_timer.next_ns(), for_publisher)
    }

    fn reset(&mut self, time_ns: i64) {
        self.commands.reset();
        self.state.received_ns = time_ns;
        self.state.control_timer.restart(time_ns);
        self.state.publish_timer.restart(time_ns);
    }

    fn save(&self) -> DeviceState {
        DeviceState::new((self.state.clone(), self.commands.save()))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some((state, commands)) = saved.get::<(PlanarMoveState, CommandsState)>() else {
            return false;
        };
        self.state = state.clone();
        self.commands.restore(commands);
        true
    }
}

/// `gz-sim-velocity-control-system`: sets the model's velocity along and about its own axes in every
/// step, zero before the first command, so that it neither falls nor is pushed.
///
/// Source: gz-sim 8, `VelocityControl.cc`; `Physics.cc` for the semantics of the commands.
pub(crate) struct VelocityControl {
    name: String,
    model: ModelId,
    commands: Commands,
}

pub(crate) fn velocity_control(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<VelocityControl> {
    let node = context.node(diagnostics)?;
    if context.plugin.values.is_given("link_name") {
        let message = "velocities of single links are not simulated";
        let help = "move the link by a joint and `gz-sim-joint-controller-system`";
        let origin = context.plugin.values.origin("link_name");
        diagnostics.push(
            Diagnostic::warning("link-velocity-not-simulated", message).at(origin).help(help),
        );
    }
    let first = geometry_msgs::Twist {
        linear: vector(DVec3::from_array(context.triple("initial_linear"))),
        angular: vector(DVec3::from_array(context.triple("initial_angular"))),
    };
    let commands =
        Commands::new(context, &node, &context.gz_topic("topic", "cmd_vel"), diagnostics)?;
    Some(VelocityControl {
        name: context.name(),
        model: context.setting.model,
        commands: commands.starting_with(first),
    })
}

impl Device for VelocityControl {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut PhysicsWorld, _span: StepInterval) {
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

    fn save(&self) -> DeviceState {
        DeviceState::new(self.commands.save())
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some(commands) = saved.get() else { return false };
        self.commands.restore(commands);
        true
    }
}
