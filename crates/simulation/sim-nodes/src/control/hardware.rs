//! Joints of the simulation as hardware.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_physics::{JointCommand, JointId, PhysicsWorld};
use periplus_ros2_control::{
    Hardware, HardwareComponent, JointInterfaceKind, hardware_of_model, hardware_of_transmissions,
};

use super::inertial::InertialSensor;
use super::joints::ModelJoint;
use super::plugin::{ControlPlugin, WriteRule};
use crate::drives::BuildContext;

/// Beginnings of the classes of hardware that Gazebo simulates.
const SIMULATED_CLASSES: [&str; 4] =
    ["gz_ros2_control/", "ign_ros2_control/", "gazebo_ros2_control/", "mock_components/"];

/// A joint with its interfaces' names.
#[derive(Clone, Debug)]
struct HardwareJoint {
    id: JointId,
    /// Names of the position, velocity and effort interfaces.
    names: [String; 3],
    is_commanded: bool,
}

/// The components of a robot on the joints of a simulation.
#[derive(Clone, Debug)]
pub(super) struct JointHardware {
    pub(super) components: Vec<HardwareComponent>,
    joints: Vec<HardwareJoint>,
    sensors: Vec<InertialSensor>,
    rule: WriteRule,
}

impl JointHardware {
    /// Connects the described components to joints and sensors. Missing joints are reported.
    pub(super) fn new(
        context: &BuildContext<'_>,
        plugin: &ControlPlugin,
        known: &BTreeMap<String, ModelJoint>,
        diagnostics: &mut Diagnostics,
    ) -> (Self, Hardware) {
        let components = if plugin.release.is_ros1() {
            hardware_of_transmissions(context.model()).into_iter().collect()
        } else {
            hardware_of_model(context.model())
        };
        if components.is_empty() {
            diagnostics.push(no_hardware(context, plugin));
        }
        let mut hardware = Hardware::default();
        let mut joints: Vec<HardwareJoint> = Vec::new();
        let mut sensors = Vec::new();
        for component in &components {
            let class = component.plugin.as_str();
            let is_simulated = plugin.release.is_ros1()
                || SIMULATED_CLASSES.iter().any(|start| class.starts_with(start));
            if !is_simulated {
                diagnostics.push(
                    Diagnostic::warning(
                        "hardware-class",
                        format!("the hardware `{}` has the class `{class}`", component.name),
                    )
                    .at(context.origin())
                    .note("its joints are simulated as `gz_ros2_control/GazeboSimSystem`"),
                );
            }
            for joint in &component.joints {
                let Some(found) = known.get(&joint.name) else {
                    let origin = context.origin();
                    let _ = context.joint_named(&joint.name, origin, diagnostics);
                    continue;
                };
                for command in &joint.commands {
                    hardware.add_command(format!("{}/{}", joint.name, command.name));
                }
                for state in &joint.states {
                    hardware.add_state(format!("{}/{}", joint.name, state.name), 0.0);
                }
                let names = JointInterfaceKind::ALL.map(|kind| kind.of(&joint.name));
                match joints.iter_mut().find(|one| one.id == found.id) {
                    Some(one) => one.is_commanded |= !joint.commands.is_empty(),
                    None => joints.push(HardwareJoint {
                        id: found.id,
                        names,
                        is_commanded: !joint.commands.is_empty(),
                    }),
                }
            }
            for sensor in &component.sensors {
                for command in &sensor.commands {
                    hardware.add_command(format!("{}/{}", sensor.name, command.name));
                }
                for state in &sensor.states {
                    let value = state.initial_value.unwrap_or_default();
                    hardware.add_state(format!("{}/{}", sensor.name, state.name), value);
                }
                sensors.extend(InertialSensor::find(context, &sensor.name));
            }
        }
        (Self { components, joints, sensors, rule: plugin.write_rule }, hardware)
    }

    /// Reads the joints and sensors into the state interfaces after a time [s].
    pub(super) fn read(&mut self, world: &PhysicsWorld, hardware: &mut Hardware, dt_s: f64) {
        for joint in &self.joints {
            let state = world.axis_state(joint.id).unwrap_or_default();
            for (name, value) in
                joint.names.iter().zip([state.position, state.velocity, state.effort])
            {
                hardware.set_state(name, value);
            }
        }
        for sensor in &mut self.sensors {
            sensor.read(world, hardware, dt_s);
        }
    }

    /// Commands the joints. A velocity precedes a position, and a position an effort, as in
    /// `GazeboSimSystem::write`.
    pub(super) fn write(&self, world: &mut PhysicsWorld, hardware: &Hardware, rate_hz: f64) {
        let free = f64::INFINITY;
        for joint in &self.joints {
            let [position, velocity, effort] = &joint.names;
            let command = if hardware.is_claimed(velocity) {
                let target = hardware.claimed_command(velocity).unwrap_or_default();
                JointCommand::Velocity { target, max_effort: free }
            } else if hardware.is_claimed(position) {
                let at = world.axis_state(joint.id).unwrap_or_default().position;
                let target = hardware.claimed_command(position).unwrap_or(at);
                match self.rule {
                    WriteRule::Gz { position_gain, .. } => {
                        let target = (target - at) * position_gain * rate_hz;
                        JointCommand::Velocity { target, max_effort: free }
                    }
                    WriteRule::Classic => {
                        JointCommand::Position { target, max_speed: free, max_effort: free }
                    }
                }
            } else if hardware.is_claimed(effort) {
                JointCommand::Effort(hardware.claimed_command(effort).unwrap_or_default())
            } else if matches!(self.rule, WriteRule::Gz { holds: true, .. }) && joint.is_commanded {
                JointCommand::Velocity { target: 0.0, max_effort: free }
            } else {
                JointCommand::Free
            };
            world.command(joint.id, command);
        }
    }

    /// Resets to the initial state.
    pub(super) fn reset(&mut self) {
        self.sensors.iter_mut().for_each(InertialSensor::reset);
    }
}

/// Warning for a robot without hardware.
fn no_hardware(context: &BuildContext<'_>, plugin: &ControlPlugin) -> Diagnostic {
    let name = &context.site.plugin.name;
    let (element, of) = if plugin.release.is_ros1() {
        ("<transmission>", "of ROS 1")
    } else {
        ("<ros2_control>", "in the robot's description")
    };
    let message = format!("plugin `{name}` finds no `{element}` {of}, so it controls no joints");
    Diagnostic::warning("no-hardware", message)
        .at(context.origin())
        .help(format!("add `{element}` with the joints and their interfaces"))
}
