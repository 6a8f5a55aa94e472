//! Controllers of single joints: `JointController` and `JointPositionController` of gz-sim.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Mailbox, Qos};
use periplus_msgs::std_msgs;
use periplus_params::Value;
use periplus_physics::{Command, JointId, World};

use super::encoders::{angle, speed};
use super::order::Order;
use super::pid::{Gains, Pid};
use crate::{Device, Moment, Span, gz_topic};

/// In a world without physics, a position that is not reached yet is looked at again after this
/// [ns].
const MOVING_STEP_NS: i64 = 1_000_000;

/// Joints that are told a number: a speed or a position.
///
/// Source: gz-sim 8, `JointController.cc` and `JointPositionController.cc`. Commands are
/// `std_msgs/msg/Float64`, as the bridge makes of `gz.msgs.Double`. Several joints of one plugin get
/// the same command, each with a controller of its own.
pub(crate) struct JointControl {
    name: String,
    joints: Vec<(JointId, Pid)>,
    inbox: Mailbox<std_msgs::Float64>,
    way: Way,
    first: f64,
    last: f64,
    now_ns: i64,
    is_moving: bool,
}

/// How a joint is brought to do what it is told.
#[derive(Clone, Copy, Debug)]
enum Way {
    /// Its speed is set.
    Speed,
    /// Its speed is held by forces; without braking a force never acts against the motion.
    SpeedByForce { gains: Gains },
    /// It goes to a position at no more than a speed \[m/s or rad/s\].
    Position { most: f64 },
    /// A position is held by forces.
    PositionByForce { gains: Gains },
}

/// `gz-sim-joint-controller-system`.
pub(crate) fn speed_controller(
    order: &Order<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<JointControl> {
    let way = if order.flag("use_force_commands") {
        Way::SpeedByForce { gains: Gains::read(order) }
    } else {
        Way::Speed
    };
    let first = order.number("initial_velocity");
    build(order, way, "cmd_vel", first, diagnostics)
}

/// `gz-sim-joint-position-controller-system`.
pub(crate) fn position_controller(
    order: &Order<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<JointControl> {
    let gains = Gains::read(order);
    let way = if order.flag("use_velocity_commands") {
        Way::Position { most: gains.command[1].abs() }
    } else {
        Way::PositionByForce { gains }
    };
    let index = order.plugin.values.integer("joint_index").unwrap_or_default();
    let first = order.number("initial_position");
    build(order, way, &format!("{index}/cmd_pos"), first, diagnostics)
}

fn build(
    order: &Order<'_>,
    way: Way,
    topic: &str,
    first: f64,
    diagnostics: &mut Diagnostics,
) -> Option<JointControl> {
    let joints = order.joints("joint_name", diagnostics)?;
    if order.plugin.values.integer("joint_index").is_some_and(|index| index != 0) {
        let origin = order.plugin.values.origin("joint_index");
        let message = "only the first axis of a joint is controlled";
        diagnostics.push(Diagnostic::error("joint-index", message).at(origin));
        return None;
    }
    if order.flag("use_actuator_msg") {
        let message = "commands as `Actuators` messages are not read; the topic takes a Float64";
        let origin = order.plugin.values.origin("use_actuator_msg");
        diagnostics.push(Diagnostic::warning("actuators-not-read", message).at(origin));
    }
    let node = order.node(diagnostics)?;
    let names = order.plugin.values.all("joint_name");
    let joint = names.iter().find_map(|(value, _)| match value {
        Value::Text(name) => Some(name.trim().to_owned()),
        _ => None,
    })?;
    let usual = match order.given_text("sub_topic") {
        Some(sub_topic) => sub_topic,
        None => format!("joint/{joint}/{topic}"),
    };
    let topic = gz_topic(&order.gz_topic("topic", &usual));
    Some(JointControl {
        name: order.name(),
        joints: joints.into_iter().map(|joint| (joint, Pid::default())).collect(),
        inbox: order.accept(node.mailbox(&topic, Qos::reliable(1)), diagnostics)?,
        way,
        first,
        last: first,
        now_ns: order.setting.start_ns,
        is_moving: false,
    })
}

impl Device for JointControl {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut World, span: Span) {
        if let Some(told) = self.inbox.latest().filter(|told| told.data.is_finite()) {
            self.last = told.data;
        }
        let (target, free) = (self.last, f64::INFINITY);
        for (joint, pid) in &mut self.joints {
            let command = match &self.way {
                Way::Speed => Command::Velocity { target, max_effort: free },
                Way::SpeedByForce { gains } => {
                    let error = speed(world, *joint) - target;
                    Command::Effort(pid.update(gains, error, span.seconds()))
                }
                Way::Position { most } => {
                    Command::Position { target, max_speed: *most, max_effort: free }
                }
                Way::PositionByForce { gains } => {
                    let error = angle(world, *joint) - target;
                    Command::Effort(pid.update(gains, error, span.seconds()))
                }
            };
            world.command(*joint, command);
        }
    }

    fn sense(&mut self, moment: &mut Moment<'_>) {
        self.now_ns = moment.time_ns();
        let is_positional = matches!(self.way, Way::Position { .. });
        self.is_moving = is_positional
            && self.joints.iter().any(|(joint, _)| speed(moment.world, *joint).abs() > 1e-6);
    }

    fn next_ns(&self) -> Option<i64> {
        self.is_moving.then_some(self.now_ns + MOVING_STEP_NS)
    }

    fn reset(&mut self, time_ns: i64) {
        drop(self.inbox.drain());
        self.last = self.first;
        self.now_ns = time_ns;
        self.is_moving = false;
        for (_, pid) in &mut self.joints {
            *pid = Pid::default();
        }
    }
}
