//! Controllers of single joints: `JointController` and `JointPositionController` of gz-sim.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_graph::{Mailbox, Qos, Sample};
use periplus_msgs::std_msgs;
use periplus_params::ParamValue;
use periplus_physics::{JointCommand, JointId, PhysicsWorld};

use super::build_context::BuildContext;
use super::encoders::{angle, speed};
use super::pid::{Gains, Pid};
use crate::{Device, DeviceState, SenseContext, StepInterval, gz_topic};

/// Interval of checks of a position that is not reached yet, in a world without physics [ns].
const MOVING_STEP_NS: i64 = 1_000_000;

/// Joints controlled by a speed or position command.
///
/// Source: gz-sim 8, `JointController.cc` and `JointPositionController.cc`. Commands are
/// `std_msgs/msg/Float64`, the bridge's equivalent of `gz.msgs.Double`. Several joints of a plugin
/// get the same command, each with its own controller.
pub(crate) struct JointControl {
    name: String,
    inbox: Mailbox<std_msgs::Float64>,
    mode: ControlMode,
    first: f64,
    state: JointControlState,
}

#[derive(Clone)]
struct JointControlState {
    joints: Vec<(JointId, Pid)>,
    last: f64,
    now_ns: i64,
    is_moving: bool,
}

/// Mode of control.
#[derive(Clone, Copy, Debug)]
enum ControlMode {
    /// Sets the speed.
    Speed,
    /// Holds the speed by efforts; without braking an effort never opposes the motion.
    SpeedByForce { gains: Gains },
    /// Moves to a position with a maximum speed \[m/s or rad/s\].
    Position { most: f64 },
    /// Holds a position by efforts.
    PositionByForce { gains: Gains },
}

/// `gz-sim-joint-controller-system`.
pub(crate) fn speed_controller(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<JointControl> {
    let mode = if context.flag("use_force_commands") {
        ControlMode::SpeedByForce { gains: Gains::read(context) }
    } else {
        ControlMode::Speed
    };
    let first = context.number("initial_velocity");
    build(context, mode, "cmd_vel", first, diagnostics)
}

/// `gz-sim-joint-position-controller-system`.
pub(crate) fn position_controller(
    context: &BuildContext<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<JointControl> {
    let gains = Gains::read(context);
    let mode = if context.flag("use_velocity_commands") {
        ControlMode::Position { most: gains.command[1].abs() }
    } else {
        ControlMode::PositionByForce { gains }
    };
    let index = context.plugin.values.integer("joint_index").unwrap_or_default();
    let first = context.number("initial_position");
    build(context, mode, &format!("{index}/cmd_pos"), first, diagnostics)
}

fn build(
    context: &BuildContext<'_>,
    mode: ControlMode,
    topic: &str,
    first: f64,
    diagnostics: &mut Diagnostics,
) -> Option<JointControl> {
    let joints = context.joints("joint_name", diagnostics)?;
    if context.plugin.values.integer("joint_index").is_some_and(|index| index != 0) {
        let origin = context.plugin.values.origin("joint_index");
        let message = "only the first axis of a joint is controlled";
        diagnostics.push(Diagnostic::error("joint-index", message).at(origin));
        return None;
    }
    if context.flag("use_actuator_msg") {
        let message = "commands of type `Actuators` are not supported; the topic expects a Float64";
        let origin = context.plugin.values.origin("use_actuator_msg");
        diagnostics.push(Diagnostic::warning("actuators-not-read", message).at(origin));
    }
    let node = context.node(diagnostics)?;
    let names = context.plugin.values.all("joint_name");
    let joint = names.iter().find_map(|(value, _)| match value {
        ParamValue::Text(name) => Some(name.trim().to_owned()),
        _ => None,
    })?;
    let fallback = match context.given_text("sub_topic") {
        Some(sub_topic) => sub_topic,
        None => format!("joint/{joint}/{topic}"),
    };
    let topic = gz_topic(&context.gz_topic("topic", &fallback));
    Some(JointControl {
        name: context.name(),
        inbox: context.accept(node.mailbox(&topic, Qos::reliable(1)), diagnostics)?,
        mode,
        first,
        state: JointControlState {
            joints: joints.into_iter().map(|joint| (joint, Pid::default())).collect(),
            last: first,
            now_ns: context.setting.start_ns,
            is_moving: false,
        },
    })
}

impl Device for JointControl {
    fn name(&self) -> &str {
        &self.name
    }

    fn act(&mut self, world: &mut PhysicsWorld, span: StepInterval) {
        if let Some(command) = self.inbox.latest().filter(|command| command.data.is_finite()) {
            self.state.last = command.data;
        }
        let (target, free) = (self.state.last, f64::INFINITY);
        for (joint, pid) in &mut self.state.joints {
            let command = match &self.mode {
                ControlMode::Speed => JointCommand::Velocity { target, max_effort: free },
                ControlMode::SpeedByForce { gains } => {
                    let error = speed(world, *joint) - target;
                    JointCommand::Effort(pid.update(gains, error, span.seconds()))
                }
                ControlMode::Position { most } => {
                    JointCommand::Position { target, max_speed: *most, max_effort: free }
                }
                ControlMode::PositionByForce { gains } => {
                    let error = angle(world, *joint) - target;
                    JointCommand::Effort(pid.update(gains, error, span.seconds()))
                }
            };
            world.command(*joint, command);
        }
    }

    fn sense(&mut self, moment: &mut SenseContext<'_>) {
        self.state.now_ns = moment.time_ns();
        let is_positional = matches!(self.mode, ControlMode::Position { .. });
        self.state.is_moving = is_positional
            && self.state.joints.iter().any(|(joint, _)| speed(moment.world, *joint).abs() > 1e-6);
    }

    fn next_ns(&self) -> Option<i64> {
        self.state.is_moving.then_some(self.state.now_ns + MOVING_STEP_NS)
    }

    fn reset(&mut self, time_ns: i64) {
        drop(self.inbox.drain());
        self.state.last = self.first;
        self.state.now_ns = time_ns;
        self.state.is_moving = false;
        for (_, pid) in &mut self.state.joints {
            *pid = Pid::default();
        }
    }

    fn save(&self) -> DeviceState {
        DeviceState::new((self.state.clone(), self.inbox.pending()))
    }

    fn restore(&mut self, saved: &DeviceState) -> bool {
        let Some((state, commands)) = saved.get::<(JointControlState, Vec<Sample>)>() else {
            return false;
        };
        self.state = state.clone();
        self.inbox.set_pending(commands);
        true
    }
}
