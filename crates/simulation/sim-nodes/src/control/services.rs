//! Services of the controller manager.

mod lists;

use periplus_graph::{Calls, GraphError, Node, Publisher, Qos};
use periplus_msgs::controller_manager_msgs as jazzy;
use periplus_msgs::controller_manager_msgs_humble as humble;
use periplus_msgs::controller_manager_msgs_main as rolling;
use periplus_msgs::lifecycle_msgs::State;
use periplus_msgs::std_msgs::Header;
use periplus_ros2_control::{
    ControlCycle, ControlRelease, ControllerKind, ControllerLifecycle, SwitchRequest,
    SwitchStrictness,
};

use super::device::ControlCore;

/// Services that differ between the releases.
enum ListServices {
    Humble {
        controllers: Calls<humble::ListControllers>,
        interfaces: Calls<humble::ListHardwareInterfaces>,
        components: Calls<humble::ListHardwareComponents>,
        switch: Calls<humble::SwitchController>,
    },
    Jazzy {
        controllers: Calls<jazzy::ListControllers>,
        interfaces: Calls<jazzy::ListHardwareInterfaces>,
        components: ComponentLists,
        switch: Calls<jazzy::SwitchController>,
        cleanup: Calls<jazzy::CleanupController>,
        activity: Publisher<jazzy::ControllerManagerActivity>,
    },
}

enum ComponentLists {
    Jazzy(Calls<jazzy::ListHardwareComponents>),
    Main(Calls<rolling::ListHardwareComponents>),
}

/// All services of a controller manager.
pub(super) struct ManagerServices {
    lists: ListServices,
    types: Calls<jazzy::ListControllerTypes>,
    load: Calls<jazzy::LoadController>,
    configure: Calls<jazzy::ConfigureController>,
    unload: Calls<jazzy::UnloadController>,
    reload: Calls<jazzy::ReloadControllerLibraries>,
    set_component: Calls<jazzy::SetHardwareComponentState>,
}

impl ManagerServices {
    pub(super) fn new(node: &Node, release: ControlRelease) -> Result<Self, GraphError> {
        let lists = if release <= ControlRelease::Humble {
            ListServices::Humble {
                controllers: node.server("~/list_controllers")?,
                interfaces: node.server("~/list_hardware_interfaces")?,
                components: node.server("~/list_hardware_components")?,
                switch: node.server("~/switch_controller")?,
            }
        } else {
            ListServices::Jazzy {
                controllers: node.server("~/list_controllers")?,
                interfaces: node.server("~/list_hardware_interfaces")?,
                components: if release == ControlRelease::Main {
                    ComponentLists::Main(node.server("~/list_hardware_components")?)
                } else {
                    ComponentLists::Jazzy(node.server("~/list_hardware_components")?)
                },
                switch: node.server("~/switch_controller")?,
                cleanup: node.server("~/cleanup_controller")?,
                activity: node.publisher("~/activity", Qos::latched(1))?,
            }
        };
        Ok(Self {
            lists,
            types: node.server("~/list_controller_types")?,
            load: node.server("~/load_controller")?,
            configure: node.server("~/configure_controller")?,
            unload: node.server("~/unload_controller")?,
            reload: node.server("~/reload_controller_libraries")?,
            set_component: node.server("~/set_hardware_component_state")?,
        })
    }

    /// Answers the requests that wait.
    pub(super) fn serve(&self, core: &mut ControlCore, cycle: ControlCycle) {
        let mut has_changed = false;
        while let Some(call) = self.load.take() {
            let ok = core.answer(|core| core.load(&call.request.name));
            has_changed |= ok;
            call.answer(jazzy::LoadControllerResponse { ok });
        }
        while let Some(call) = self.configure.take() {
            let ok = core.answer(|core| core.configure(&call.request.name));
            has_changed |= ok;
            call.answer(jazzy::ConfigureControllerResponse { ok });
        }
        while let Some(call) = self.unload.take() {
            let ok = core.answer(|core| {
                core.manager.unload(&call.request.name).map_err(|refused| refused.to_string())
            });
            has_changed |= ok;
            call.answer(jazzy::UnloadControllerResponse { ok });
        }
        while let Some(call) = self.types.take() {
            let classes = ControllerKind::classes(core.plugin.release);
            let types: Vec<String> = classes.iter().map(|(name, _)| (*name).to_owned()).collect();
            let base = "controller_interface::ControllerInterface".to_owned();
            let base_classes = vec![base; types.len()];
            call.answer(jazzy::ListControllerTypesResponse { types, base_classes });
        }
        while let Some(call) = self.reload.take() {
            // Classes are built in.
            call.answer(jazzy::ReloadControllerLibrariesResponse { ok: true });
        }
        while let Some(call) = self.set_component.take() {
            let is_known = core.hardware.components.iter().any(|one| one.name == call.request.name);
            // Simulated hardware is always active.
            let wants_active = call.request.target_state.id == State::PRIMARY_STATE_ACTIVE
                || call.request.target_state.label == "active";
            let state = State { id: State::PRIMARY_STATE_ACTIVE, label: "active".into() };
            let ok = is_known && wants_active;
            call.answer(jazzy::SetHardwareComponentStateResponse { ok, state });
        }
        has_changed |= self.serve_lists(core, cycle);
        if has_changed {
            self.publish_activity(core, cycle.time_ns);
        }
    }

    fn serve_lists(&self, core: &mut ControlCore, cycle: ControlCycle) -> bool {
        let mut has_changed = false;
        match &self.lists {
            ListServices::Humble { controllers, interfaces, components, switch } => {
                while let Some(call) = controllers.take() {
                    let controller = lists::controllers_humble(core);
                    call.answer(humble::ListControllersResponse { controller });
                }
                while let Some(call) = interfaces.take() {
                    let [command_interfaces, state_interfaces] = lists::interfaces_humble(core);
                    call.answer(humble::ListHardwareInterfacesResponse {
                        command_interfaces,
                        state_interfaces,
                    });
                }
                while let Some(call) = components.take() {
                    let component = lists::components_humble(core);
                    call.answer(humble::ListHardwareComponentsResponse { component });
                }
                while let Some(call) = switch.take() {
                    let request = &call.request;
                    let both = |new: &[String], old: &[String]| [new, old].concat();
                    let wish = SwitchRequest {
                        activate: both(&request.activate_controllers, &request.start_controllers),
                        deactivate: both(
                            &request.deactivate_controllers,
                            &request.stop_controllers,
                        ),
                        strictness: strictness(request.strictness),
                    };
                    let ok = core.answer(|core| core.switch(&wish, cycle));
                    has_changed |= ok;
                    call.answer(humble::SwitchControllerResponse { ok });
                }
            }
            ListServices::Jazzy {
                controllers, interfaces, components, switch, cleanup, ..
            } => {
                while let Some(call) = controllers.take() {
                    let controller = lists::controllers(core);
                    call.answer(jazzy::ListControllersResponse { controller });
                }
                while let Some(call) = interfaces.take() {
                    let [command_interfaces, state_interfaces] = lists::interfaces(core);
                    call.answer(jazzy::ListHardwareInterfacesResponse {
                        command_interfaces,
                        state_interfaces,
                    });
                }
                match components {
                    ComponentLists::Jazzy(calls) => {
                        while let Some(call) = calls.take() {
                            let component = lists::components(core);
                            call.answer(jazzy::ListHardwareComponentsResponse { component });
                        }
                    }
                    ComponentLists::Main(calls) => {
                        while let Some(call) = calls.take() {
                            let component = lists::components_main(core);
                            call.answer(rolling::ListHardwareComponentsResponse { component });
                        }
                    }
                }
                while let Some(call) = cleanup.take() {
                    let ok = core.answer(|core| {
                        core.manager
                            .cleanup(&call.request.name)
                            .map_err(|refused| refused.to_string())
                    });
                    has_changed |= ok;
                    call.answer(jazzy::CleanupControllerResponse { ok });
                }
                while let Some(call) = switch.take() {
                    let request = &call.request;
                    let wish = SwitchRequest {
                        activate: request.activate_controllers.clone(),
                        deactivate: request.deactivate_controllers.clone(),
                        strictness: strictness(request.strictness),
                    };
                    let outcome = core.switch(&wish, cycle);
                    let message = outcome.clone().err().unwrap_or_default();
                    let ok = core.answer(|_| outcome);
                    has_changed |= ok;
                    call.answer(jazzy::SwitchControllerResponse { ok, message });
                }
            }
        }
        has_changed
    }

    /// Publishes the states of controllers and components.
    pub(super) fn publish_activity(&self, core: &ControlCore, time_ns: i64) {
        if let ListServices::Jazzy { activity, .. } = &self.lists {
            let controllers = core.manager.controllers().iter();
            activity.publish(jazzy::ControllerManagerActivity {
                header: Header::at(time_ns, ""),
                controllers: controllers
                    .map(|one| jazzy::NamedLifecycleState {
                        name: one.name.clone(),
                        state: lifecycle_state(one.lifecycle),
                    })
                    .collect(),
                hardware_components: core
                    .hardware
                    .components
                    .iter()
                    .map(|one| jazzy::NamedLifecycleState {
                        name: one.name.clone(),
                        state: lifecycle_state(ControllerLifecycle::Active),
                    })
                    .collect(),
            });
        }
    }
}

/// Returns a lifecycle state as a message.
fn lifecycle_state(lifecycle: ControllerLifecycle) -> State {
    let id = match lifecycle {
        ControllerLifecycle::Unconfigured => State::PRIMARY_STATE_UNCONFIGURED,
        ControllerLifecycle::Inactive => State::PRIMARY_STATE_INACTIVE,
        ControllerLifecycle::Active => State::PRIMARY_STATE_ACTIVE,
    };
    State { id, label: lifecycle.label().to_owned() }
}

/// Returns the strictness of its number; zero is best effort.
fn strictness(number: i32) -> SwitchStrictness {
    match number {
        2 => SwitchStrictness::Strict,
        3 | 4 => SwitchStrictness::ForceAuto,
        _ => SwitchStrictness::BestEffort,
    }
}
