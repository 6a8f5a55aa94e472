//! Lists of controllers, interfaces and components, in the layouts of the releases.

use periplus_msgs::controller_manager_msgs as jazzy;
use periplus_msgs::controller_manager_msgs_humble as humble;
use periplus_msgs::controller_manager_msgs_main as rolling;
use periplus_ros2_control::{
    ControllerInterface as _, ControllerLifecycle, DescribedInterface, HardwareComponent,
    InterfaceSelection,
};

use super::lifecycle_state;
use crate::control::device::ControlCore;

/// Returns the names of interfaces.
fn names(selection: InterfaceSelection, all: impl Iterator<Item = String>) -> Vec<String> {
    match selection {
        InterfaceSelection::Nothing => Vec::new(),
        InterfaceSelection::All => all.collect(),
        InterfaceSelection::Named(names) => names,
    }
}

/// Returns the controllers.
pub(super) fn controllers(core: &ControlCore) -> Vec<jazzy::ControllerState> {
    let hardware = &core.manager.hardware;
    let update_rate = core.update_rate_hz() as u16;
    let each = core.manager.controllers().iter().map(|one| {
        let commands = hardware.commands().map(|(name, _)| name.to_owned());
        let states = hardware.states().map(|(name, _)| name.to_owned());
        let is_configured = one.lifecycle != ControllerLifecycle::Unconfigured;
        let claimed = hardware.commands().filter(|(_, by)| *by == Some(one.name.as_str()));
        jazzy::ControllerState {
            name: one.name.clone(),
            state: one.lifecycle.label().to_owned(),
            r#type: one.class.clone(),
            update_rate,
            claimed_interfaces: claimed.map(|(name, _)| name.to_owned()).collect(),
            required_command_interfaces: if is_configured {
                names(one.controller.command_interfaces(), commands)
            } else {
                Vec::new()
            },
            required_state_interfaces: if is_configured {
                names(one.controller.state_interfaces(), states)
            } else {
                Vec::new()
            },
            ..jazzy::ControllerState::default()
        }
    });
    each.collect()
}

/// Returns the controllers in the layout of Humble.
pub(super) fn controllers_humble(core: &ControlCore) -> Vec<humble::ControllerState> {
    let each = controllers(core).into_iter().map(|one| humble::ControllerState {
        name: one.name,
        state: one.state,
        r#type: one.r#type,
        claimed_interfaces: one.claimed_interfaces,
        required_command_interfaces: one.required_command_interfaces,
        required_state_interfaces: one.required_state_interfaces,
        ..humble::ControllerState::default()
    });
    each.collect()
}

/// Returns the command and state interfaces.
pub(super) fn interfaces(core: &ControlCore) -> [Vec<jazzy::HardwareInterface>; 2] {
    let hardware = &core.manager.hardware;
    let one = |name: &str, is_claimed: bool| jazzy::HardwareInterface {
        name: name.to_owned(),
        data_type: "double".to_owned(),
        is_available: true,
        is_claimed,
    };
    [
        hardware.commands().map(|(name, by)| one(name, by.is_some())).collect(),
        hardware.states().map(|(name, _)| one(name, false)).collect(),
    ]
}

fn without_type(interfaces: Vec<jazzy::HardwareInterface>) -> Vec<humble::HardwareInterface> {
    let each = interfaces.into_iter().map(|one| humble::HardwareInterface {
        name: one.name,
        is_available: one.is_available,
        is_claimed: one.is_claimed,
    });
    each.collect()
}

/// Returns the command and state interfaces in the layout of Humble.
pub(super) fn interfaces_humble(core: &ControlCore) -> [Vec<humble::HardwareInterface>; 2] {
    interfaces(core).map(without_type)
}

/// Returns the interfaces of a component.
fn of_component(
    core: &ControlCore,
    component: &HardwareComponent,
) -> [Vec<jazzy::HardwareInterface>; 2] {
    let names_of = |pick: fn(&DescribedInterface) -> &str, commands: bool| -> Vec<String> {
        let joints = component
            .joints
            .iter()
            .map(|joint| (&joint.name, if commands { &joint.commands } else { &joint.states }));
        let sensors = component
            .sensors
            .iter()
            .map(|sensor| (&sensor.name, if commands { &sensor.commands } else { &sensor.states }));
        let all = joints.chain(sensors);
        all.flat_map(|(owner, list)| list.iter().map(move |one| format!("{owner}/{}", pick(one))))
            .collect()
    };
    let [commands, states] = interfaces(core);
    let keep = |all: Vec<jazzy::HardwareInterface>, names: &[String]| {
        all.into_iter().filter(|one| names.contains(&one.name)).collect()
    };
    [
        keep(commands, &names_of(|one| &one.name, true)),
        keep(states, &names_of(|one| &one.name, false)),
    ]
}

/// Returns the hardware components.
pub(super) fn components(core: &ControlCore) -> Vec<jazzy::HardwareComponentState> {
    let rw_rate = core.update_rate_hz() as u16;
    let each = core.hardware.components.iter().map(|component| {
        let [command_interfaces, state_interfaces] = of_component(core, component);
        jazzy::HardwareComponentState {
            name: component.name.clone(),
            r#type: component.component_type.word().to_owned(),
            rw_rate,
            class_type: component.plugin.clone(),
            plugin_name: component.plugin.clone(),
            state: lifecycle_state(ControllerLifecycle::Active),
            command_interfaces,
            state_interfaces,
            ..jazzy::HardwareComponentState::default()
        }
    });
    each.collect()
}

/// Returns the hardware components in the layout of Humble.
pub(super) fn components_humble(core: &ControlCore) -> Vec<humble::HardwareComponentState> {
    let each = components(core).into_iter().map(|one| humble::HardwareComponentState {
        name: one.name,
        r#type: one.r#type,
        class_type: one.class_type,
        state: one.state,
        command_interfaces: without_type(one.command_interfaces),
        state_interfaces: without_type(one.state_interfaces),
    });
    each.collect()
}

/// Returns the hardware components in the layout of Rolling.
pub(super) fn components_main(core: &ControlCore) -> Vec<rolling::HardwareComponentState> {
    let each = components(core).into_iter().map(|one| rolling::HardwareComponentState {
        name: one.name,
        r#type: one.r#type,
        rw_rate: one.rw_rate,
        plugin_name: one.plugin_name,
        state: one.state,
        command_interfaces: one.command_interfaces,
        state_interfaces: one.state_interfaces,
        ..rolling::HardwareComponentState::default()
    });
    each.collect()
}
