//! Tree nodes that call a service.

use std::sync::Arc;

use periplus_behavior_tree::{BehaviorNode, NodeRun, NodeStatus, TreeError};
use periplus_costmap::Nav2Release;
use periplus_graph::{CallError, Client, GraphError, Level, Node, Pending};
use periplus_msgs::{Nav2Service, Service};

use super::shared::Shared;
use super::status::ServerError;

/// Response that arrives later.
type Answer<S> = Box<dyn Fn() -> Option<Result<Arc<<S as Service>::Response>, CallError>> + Send>;

/// Client of a service in the form of a release.
pub(super) struct Caller<S: Service> {
    call: Box<dyn Fn(S::Request) -> Answer<S> + Send>,
    is_ready: Box<dyn Fn() -> bool + Send>,
}

impl<S: Service> Caller<S> {
    /// Client of a service that all releases have in one form.
    pub(super) fn new(node: &Node, _: Nav2Release, name: &str) -> Result<Self, GraphError> {
        let client = Arc::new(node.client::<S>(name)?);
        let ready = client.clone();
        Ok(Self {
            call: Box::new(move |request| answer(client.call(request))),
            is_ready: Box::new(move || ready.is_ready()),
        })
    }

    /// Client of a service whose fields depend on the release.
    pub(super) fn of_release(
        node: &Node,
        release: Nav2Release,
        name: &str,
    ) -> Result<Self, GraphError>
    where
        S: Nav2Service,
    {
        if release == Nav2Release::Main {
            return Self::new(node, release, name);
        }
        let client: Arc<Client<S::Jazzy>> = Arc::new(node.client(name)?);
        let ready = client.clone();
        let call = move |request| -> Answer<S> {
            let pending = client.call(S::request_of_full(request));
            Box::new(move || {
                let response = pending.take()?;
                Some(response.map(|response| Arc::new(S::full_response((*response).clone()))))
            })
        };
        Ok(Self { call: Box::new(call), is_ready: Box::new(move || ready.is_ready()) })
    }
}

fn answer<S: Service>(pending: Pending<S>) -> Answer<S> {
    Box::new(move || pending.take())
}

/// Service that a tree node calls.
pub(super) trait TreeService: Default + Send + 'static {
    /// The service.
    type Service: Service;
    /// Name of the service, unless the port `service_name` names one; empty if the port is required.
    const SERVER: &'static str;

    /// Creates the client.
    fn caller(
        node: &Node,
        release: Nav2Release,
        name: &str,
    ) -> Result<Caller<Self::Service>, GraphError>;

    /// Request from the ports; none if there is nothing to request, and the node fails.
    fn request(
        &mut self,
        run: &mut NodeRun<'_>,
    ) -> Result<Option<<Self::Service as Service>::Request>, TreeError>;

    /// Status for a response.
    fn finish(
        &mut self,
        run: &mut NodeRun<'_>,
        response: &<Self::Service as Service>::Response,
    ) -> Result<NodeStatus, TreeError>;

    /// Message of a response that is a failure of the server; none for the outcome of a check.
    fn failure(_response: &<Self::Service as Service>::Response) -> Option<String> {
        None
    }
}

/// Tree node with its client.
pub(super) struct ServiceNode<T: TreeService> {
    shared: Arc<Shared>,
    service: T,
    caller: Option<(String, Caller<T::Service>)>,
    sent: Option<Answer<T::Service>>,
    /// Time at which the request was sent, or at which the node began to wait for the server \[ns\].
    since_ns: i64,
}

impl<T: TreeService> ServiceNode<T> {
    pub(super) fn new(shared: Arc<Shared>) -> Self {
        Self { shared, service: T::default(), caller: None, sent: None, since_ns: 0 }
    }

    fn name(run: &NodeRun<'_>) -> Result<String, TreeError> {
        let name = run.input_text("service_name").filter(|name| !name.is_empty());
        match name {
            Some(name) => Ok(name),
            None if T::SERVER.is_empty() => Err(run.missing("service_name")),
            None => Ok(T::SERVER.to_owned()),
        }
    }

    fn fail(&mut self, run: &NodeRun<'_>, server: &str, message: String) -> NodeStatus {
        self.sent = None;
        self.shared.node.log(Level::Warn, format!("{}: {message}", run.name()));
        let tree_node = run.name().to_owned();
        self.shared.report_error(ServerError {
            server: server.to_owned(),
            tree_node,
            code: 0,
            message,
        });
        NodeStatus::Failure
    }
}

impl<T: TreeService> BehaviorNode for ServiceNode<T> {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let now_ns = run.now_ns();
        if run.status() != NodeStatus::Running {
            (self.sent, self.since_ns) = (None, now_ns);
        }
        let name = Self::name(run)?;
        if self.caller.as_ref().is_none_or(|(known, _)| *known != name) {
            let caller = T::caller(&self.shared.node, self.shared.release, &name);
            self.caller =
                Some((name.clone(), caller.map_err(|error| run.error(error.to_string()))?));
        }
        let Some(sent) = &self.sent else {
            let Some((_, caller)) = &self.caller else { return Ok(NodeStatus::Failure) };
            if !(caller.is_ready)() {
                if now_ns - self.since_ns < self.shared.params.wait_for_service_ns() {
                    return Ok(NodeStatus::Running);
                }
                return Ok(self.fail(run, &name, format!("the service `{name}` is not available")));
            }
            let Some(request) = self.service.request(run)? else { return Ok(NodeStatus::Failure) };
            self.sent = Some((caller.call)(request));
            self.since_ns = now_ns;
            return Ok(NodeStatus::Running);
        };
        match sent() {
            Some(Ok(response)) => {
                self.sent = None;
                match T::failure(&response) {
                    Some(message) => drop(self.fail(run, &name, message)),
                    None => self.shared.report_success(&name),
                }
                self.service.finish(run, &response)
            }
            Some(Err(error)) => Ok(self.fail(run, &name, error.to_string())),
            None => {
                let given_ms = run.input_i64("server_timeout");
                let timeout_ns = given_ms.map_or(self.shared.params.server_timeout_ns(), |ms| {
                    ms.saturating_mul(1_000_000)
                });
                if now_ns - self.since_ns < timeout_ns {
                    return Ok(NodeStatus::Running);
                }
                let message = format!("Node timed out while executing service call to {name}.");
                Ok(self.fail(run, &name, message))
            }
        }
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.sent = None;
        Ok(())
    }
}
