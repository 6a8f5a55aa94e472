//! Clients of a controller manager, in the layout of its release.

use std::sync::Arc;

use periplus_graph::{CallError, Client, Graph, Node, Pending};
use periplus_msgs::Service;
use periplus_msgs::controller_manager_msgs as jazzy;
use periplus_msgs::controller_manager_msgs_humble as humble;
use periplus_msgs::rcl_interfaces::{Parameter, SetParameters, SetParametersRequest};

/// Clients of services that differ between the releases.
enum ReleaseClients {
    Humble { list: Client<humble::ListControllers>, switch: Client<humble::SwitchController> },
    Jazzy { list: Client<jazzy::ListControllers>, switch: Client<jazzy::SwitchController> },
}

/// Clients of a controller manager.
pub(super) struct Clients {
    set: Client<SetParameters>,
    load: Client<jazzy::LoadController>,
    configure: Client<jazzy::ConfigureController>,
    unload: Client<jazzy::UnloadController>,
    release: ReleaseClients,
}

/// An answer that is waited for: names of a list, or the end of a sentence about a failure.
pub(super) struct Reply(Box<dyn Fn() -> Option<Result<Vec<String>, String>> + Send>);

impl Reply {
    /// Returns the answer once it has come.
    pub(super) fn take(&self) -> Option<Result<Vec<String>, String>> {
        (self.0)()
    }

    fn new<S: Service>(
        pending: Pending<S>,
        read: impl Fn(&S::Response) -> Result<Vec<String>, String> + Send + 'static,
    ) -> Self {
        let read_answer = move |answer: Result<Arc<S::Response>, CallError>| match answer {
            Ok(response) => read(&response),
            Err(error) => Err(format!(": {error}")),
        };
        Self(Box::new(move || pending.take().map(&read_answer)))
    }

    fn ok<S: Service>(pending: Pending<S>, is_ok: fn(&S::Response) -> bool) -> Self {
        let refused = "; the log of the controller manager has the reason";
        Self::new(
            pending,
            move |response| {
                if is_ok(response) { Ok(Vec::new()) } else { Err(refused.to_owned()) }
            },
        )
    }
}

impl Clients {
    /// Creates the clients once the services exist: their types show the release.
    ///
    /// # Errors
    /// A message, when a client cannot be created.
    pub(super) fn connect(
        node: &Node,
        graph: &Graph,
        manager: &str,
    ) -> Result<Option<Self>, String> {
        let switch = format!("{manager}/switch_controller");
        let services = graph.services();
        let Some(found) =
            services.iter().find(|service| service.name == switch && service.server.is_some())
        else {
            return Ok(None);
        };
        let hash = found.type_hash.as_deref();
        let is_humble = hash == Some(<humble::SwitchController as Service>::TYPE_HASH);
        let name = |service: &str| format!("{manager}/{service}");
        let made = || -> Result<Self, periplus_graph::GraphError> {
            let list = name("list_controllers");
            Ok(Self {
                set: node.client(&name("set_parameters"))?,
                load: node.client(&name("load_controller"))?,
                configure: node.client(&name("configure_controller"))?,
                unload: node.client(&name("unload_controller"))?,
                release: if is_humble {
                    let (list, switch) = (node.client(&list)?, node.client(&switch)?);
                    ReleaseClients::Humble { list, switch }
                } else {
                    let (list, switch) = (node.client(&list)?, node.client(&switch)?);
                    ReleaseClients::Jazzy { list, switch }
                },
            })
        };
        made().map(Some).map_err(|error| error.to_string())
    }

    pub(super) fn list(&self) -> Reply {
        match &self.release {
            ReleaseClients::Humble { list, .. } => {
                Reply::new(list.call(humble::ListControllersRequest::default()), |response| {
                    Ok(response.controller.iter().map(|one| one.name.clone()).collect())
                })
            }
            ReleaseClients::Jazzy { list, .. } => {
                Reply::new(list.call(jazzy::ListControllersRequest::default()), |response| {
                    Ok(response.controller.iter().map(|one| one.name.clone()).collect())
                })
            }
        }
    }

    pub(super) fn set(&self, parameters: Vec<Parameter>) -> Reply {
        Reply::new(self.set.call(SetParametersRequest { parameters }), |response| {
            match response.results.iter().find(|result| !result.successful) {
                Some(refused) => Err(format!(": {}", refused.reason)),
                None => Ok(Vec::new()),
            }
        })
    }

    pub(super) fn load(&self, name: &str) -> Reply {
        let request = jazzy::LoadControllerRequest { name: name.to_owned() };
        Reply::ok(self.load.call(request), |response| response.ok)
    }

    pub(super) fn configure(&self, name: &str) -> Reply {
        let request = jazzy::ConfigureControllerRequest { name: name.to_owned() };
        Reply::ok(self.configure.call(request), |response| response.ok)
    }

    pub(super) fn unload(&self, name: &str) -> Reply {
        let request = jazzy::UnloadControllerRequest { name: name.to_owned() };
        Reply::ok(self.unload.call(request), |response| response.ok)
    }

    pub(super) fn switch(&self, activate: &[String], deactivate: &[String]) -> Reply {
        let (activate, deactivate) = (activate.to_vec(), deactivate.to_vec());
        match &self.release {
            ReleaseClients::Humble { switch, .. } => {
                let request = humble::SwitchControllerRequest {
                    activate_controllers: activate,
                    deactivate_controllers: deactivate,
                    strictness: humble::SwitchControllerRequest::STRICT,
                    ..Default::default()
                };
                Reply::ok(switch.call(request), |response| response.ok)
            }
            ReleaseClients::Jazzy { switch, .. } => {
                let request = jazzy::SwitchControllerRequest {
                    activate_controllers: activate,
                    deactivate_controllers: deactivate,
                    strictness: jazzy::SwitchControllerRequest::STRICT,
                    ..Default::default()
                };
                Reply::new(switch.call(request), |response| {
                    if response.ok {
                        Ok(Vec::new())
                    } else {
                        Err(format!(": {}", response.message))
                    }
                })
            }
        }
    }
}
