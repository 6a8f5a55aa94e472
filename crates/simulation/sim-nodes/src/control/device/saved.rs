//! Saved state of a controller manager.

use std::collections::BTreeSet;

use periplus_graph::{Arguments, Level};
use periplus_ros2_control::{
    ControlCycle, ControllerLifecycle, Hardware, SwitchRequest, SwitchStrictness,
};

use super::ControlState;
use super::core::ControlCore;
use crate::DeviceState;
use crate::control::hardware::JointHardware;
use crate::control::plugin::GivenParameters;

/// All that decides the next actions of a controller manager.
pub(super) struct SavedControl {
    pub(super) state: ControlState,
    controllers: Vec<SavedController>,
    interfaces: Hardware,
    hardware: JointHardware,
    started_here: BTreeSet<String>,
}

struct SavedController {
    name: String,
    class: String,
    lifecycle: ControllerLifecycle,
    given: GivenParameters,
    state: DeviceState,
}

impl SavedControl {
    pub(super) fn of(core: &ControlCore, state: ControlState) -> Self {
        let each = core.manager.controllers().iter().map(|one| SavedController {
            name: one.name.clone(),
            class: one.class.clone(),
            lifecycle: one.lifecycle,
            given: one.controller.part().given.clone(),
            state: one.controller.save(),
        });
        Self {
            state,
            controllers: each.collect(),
            interfaces: core.manager.hardware.clone(),
            hardware: core.hardware.clone(),
            started_here: core.started_here.clone(),
        }
    }

    /// Restores the controllers: those that are loaded since are unloaded, those that were unloaded
    /// are loaded again.
    pub(super) fn restore(&self, core: &mut ControlCore) {
        let is_saved_active = |name: &str| {
            self.controllers
                .iter()
                .any(|one| one.name == name && one.lifecycle == ControllerLifecycle::Active)
        };
        let loaded: Vec<(String, ControllerLifecycle)> = core
            .manager
            .controllers()
            .iter()
            .map(|one| (one.name.clone(), one.lifecycle))
            .collect();
        let cycle = ControlCycle { time_ns: core.node.now_ns(), period_s: 0.0 };
        let is_active = |(_, lifecycle): &&(String, ControllerLifecycle)| {
            *lifecycle == ControllerLifecycle::Active
        };
        let active = loaded.iter().filter(is_active).map(|(name, _)| name.clone());
        let deactivate = active.filter(|name| !is_saved_active(name)).collect();
        let strictness = SwitchStrictness::BestEffort;
        let end = SwitchRequest { deactivate, strictness, ..SwitchRequest::default() };
        let mut problems: Vec<String> = Vec::new();
        problems.extend(core.manager.switch(&end, cycle).err().map(|error| error.to_string()));
        for (name, _) in &loaded {
            if !self.controllers.iter().any(|one| one.name == *name) {
                problems.extend(core.manager.unload(name).err().map(|error| error.to_string()));
            }
        }
        for saved in &self.controllers {
            if core.manager.find(&saved.name).is_none() {
                let given = saved.given.clone();
                let none = Arguments::default();
                problems.extend(core.load_with(&saved.name, &saved.class, given, &none).err());
            }
            let now = core.manager.find(&saved.name).map(|one| one.lifecycle);
            let is_configured = now.is_some_and(|now| now != ControllerLifecycle::Unconfigured);
            if saved.lifecycle == ControllerLifecycle::Unconfigured {
                problems.extend(core.manager.cleanup(&saved.name).err().map(|e| e.to_string()));
            } else if !is_configured {
                problems.extend(core.manager.configure(&saved.name).err().map(|e| e.to_string()));
            }
        }
        let active_now = |name: &String| {
            core.manager.find(name).is_some_and(|one| one.lifecycle == ControllerLifecycle::Active)
        };
        let saved_active = self.controllers.iter().filter(|one| is_saved_active(&one.name));
        let activate = saved_active.map(|one| one.name.clone()).filter(|name| !active_now(name));
        let activate = activate.collect();
        let begin = SwitchRequest { activate, strictness, ..SwitchRequest::default() };
        problems.extend(core.manager.switch(&begin, cycle).err().map(|error| error.to_string()));
        for one in core.manager.controllers_mut() {
            let saved = self.controllers.iter().find(|saved| saved.name == one.name);
            if saved.is_some_and(|saved| !one.controller.restore(&saved.state)) {
                problems.push(format!("the state of `{}` cannot be restored", one.name));
            }
        }
        core.manager.hardware.clone_from(&self.interfaces);
        core.hardware.clone_from(&self.hardware);
        core.started_here.clone_from(&self.started_here);
        for problem in problems {
            core.node.log(Level::Error, problem);
        }
    }
}
