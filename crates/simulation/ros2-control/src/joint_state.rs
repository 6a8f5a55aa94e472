//! Publisher of joint states: `joint_state_broadcaster` and `joint_state_controller`.

use std::collections::BTreeMap;

use crate::{
    ControlCycle, ControllerError, ControllerInterface, InterfaceSelection, LoanedInterfaces,
};

/// States of all joints.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointStateReading {
    /// Joints that have a position, a velocity or an effort, with NaN for a missing one.
    pub joints: Vec<(String, [f64; 3])>,
    /// All interfaces of all components with their values.
    pub interfaces: Vec<(String, Vec<(String, f64)>)>,
}

/// Reads the states of joints.
///
/// Source: `joint_state_broadcaster.cpp` of `ros2_controllers`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointStateBroadcaster {
    /// Joints to read; empty for all. With both lists only these interfaces are read.
    pub joints: Vec<String>,
    /// Interfaces to read; empty for all.
    pub interfaces: Vec<String>,
    /// Joints without hardware that are published at zero.
    pub extra_joints: Vec<String>,
    /// Joints that are published besides `extra_joints`; `None` for all components.
    pub known_joints: Option<Vec<String>>,
    /// Interface names of the position, the velocity and the effort.
    pub mapped_names: [String; 3],
    /// States of the last update.
    pub reading: JointStateReading,
}

impl ControllerInterface for JointStateBroadcaster {
    fn command_interfaces(&self) -> InterfaceSelection {
        InterfaceSelection::Nothing
    }

    fn state_interfaces(&self) -> InterfaceSelection {
        if self.joints.is_empty() || self.interfaces.is_empty() {
            return InterfaceSelection::All;
        }
        let names = self.joints.iter().flat_map(|joint| {
            self.interfaces.iter().map(move |interface| format!("{joint}/{interface}"))
        });
        InterfaceSelection::Named(names.collect())
    }

    fn activate(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        cycle: ControlCycle,
    ) -> Result<(), ControllerError> {
        self.update(interfaces, cycle)
    }

    fn update(
        &mut self,
        interfaces: &mut LoanedInterfaces<'_>,
        _: ControlCycle,
    ) -> Result<(), ControllerError> {
        let mut order: Vec<String> = Vec::new();
        let mut all: BTreeMap<String, Vec<(String, f64)>> = BTreeMap::new();
        for index in 0..interfaces.state_count() {
            let name = interfaces.state_name(index).to_owned();
            let Some((owner, kind)) = name.rsplit_once('/') else { continue };
            if !all.contains_key(owner) {
                order.push(owner.to_owned());
            }
            let values = all.entry(owner.to_owned()).or_default();
            values.push((kind.to_owned(), interfaces.state(index)));
        }
        let mut reading = JointStateReading::default();
        for owner in order {
            let values = all.remove(&owner).unwrap_or_default();
            let state: [Option<f64>; 3] = std::array::from_fn(|index| {
                let wanted = &self.mapped_names[index];
                values.iter().find(|(name, _)| name == wanted).map(|(_, value)| *value)
            });
            let is_known = self.known_joints.as_ref().is_none_or(|known| known.contains(&owner));
            if is_known && state.iter().any(Option::is_some) {
                let state = state.map(|value| value.unwrap_or(f64::NAN));
                reading.joints.push((owner.clone(), state));
            }
            reading.interfaces.push((owner, values));
        }
        for joint in &self.extra_joints {
            if !reading.joints.iter().any(|(known, _)| known == joint) {
                reading.joints.push((joint.clone(), [0.0; 3]));
                let values = self.mapped_names.iter().map(|name| (name.clone(), 0.0)).collect();
                reading.interfaces.push((joint.clone(), values));
            }
        }
        self.reading = reading;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ControllerManager, Hardware, SwitchRequest};

    #[test]
    fn missing_interfaces_are_not_numbers() {
        let mut hardware = Hardware::default();
        hardware.add_state("arm/position", 0.5);
        hardware.add_state("arm/velocity", 0.1);
        hardware.add_state("imu/orientation.x", 0.0);
        let mapped_names = ["position", "velocity", "effort"].map(str::to_owned);
        let extra_joints = vec!["wheel".to_owned()];
        let broadcaster =
            JointStateBroadcaster { mapped_names, extra_joints, ..Default::default() };
        let mut manager = ControllerManager::new(hardware);
        manager.load("states", "", broadcaster).unwrap();
        manager.configure("states").unwrap();
        let activate = vec!["states".to_owned()];
        let cycle = ControlCycle { time_ns: 0, period_s: 0.01 };
        manager.switch(&SwitchRequest { activate, ..Default::default() }, cycle).unwrap();
        let reading = &manager.controllers()[0].controller.reading;
        let names: Vec<&str> = reading.joints.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["arm", "wheel"]);
        let [position, velocity, effort] = reading.joints[0].1;
        assert!(position == 0.5 && velocity == 0.1 && effort.is_nan());
        assert_eq!(reading.interfaces.len(), 3);
    }
}
