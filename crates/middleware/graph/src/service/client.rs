//! Service clients.

use std::marker::PhantomData;
use std::sync::{Arc, Mutex};

use periplus_msgs::Service;

use super::{Answer, CallError, Reply, Request, Server};
use crate::GraphError;
use crate::common::lock;
use crate::node::NodeCore;
use crate::payload::Payload;
use crate::registry::TypeOf;
use crate::sample::EndpointId;

/// Client end of a service.
pub(crate) struct Caller {
    id: EndpointId,
    pub(crate) name: Arc<str>,
    pub(crate) node: Arc<NodeCore>,
}

impl Caller {
    pub(super) fn server(&self) -> Option<Arc<Server>> {
        let registry = lock(&self.node.core.registry);
        registry.services.get(&self.name).and_then(|entry| entry.server.clone())
    }

    pub(crate) fn call(&self, payload: Payload, reply: Reply) {
        match self.server() {
            Some(server) => {
                let request = Request { payload: Arc::new(payload), reply };
                server.receive(request, &self.node.core.common);
            }
            None => reply.send(Err(self.no_server())),
        }
    }

    fn no_server(&self) -> CallError {
        let registry = lock(&self.node.core.registry);
        let served = registry.services.iter().filter(|(_, entry)| entry.server.is_some());
        let names = served.map(|(name, _)| &**name);
        let near = periplus_diagnostics::closest(&self.name, names).map(str::to_owned);
        CallError::NoServer { service: self.name.to_string(), near }
    }
}

impl Drop for Caller {
    fn drop(&mut self) {
        let mut registry = lock(&self.node.core.registry);
        registry.changes += 1;
        if let Some(entry) = registry.services.get_mut(&self.name) {
            entry.remove_client(self.id);
        }
    }
}

impl NodeCore {
    pub(crate) fn caller(
        self: &Arc<Self>,
        name: &str,
        type_of: TypeOf,
    ) -> Result<Caller, GraphError> {
        let name: Arc<str> = self.names.service(name)?.into();
        let mut registry = lock(&self.core.registry);
        let id = registry.next_id();
        registry.service(&name, type_of, &self.full_name)?.add_client(id, self.full_name.clone());
        Ok(Caller { id, name, node: self.clone() })
    }
}

/// Client of a service.
pub struct Client<S> {
    pub(crate) caller: Caller,
    of: PhantomData<fn(S)>,
}

impl<S: Service> Client<S> {
    pub(crate) fn new(caller: Caller) -> Self {
        Self { caller, of: PhantomData }
    }

    /// Sends a request. The response arrives once the server has run; in lockstep, when the graph
    /// advances.
    #[must_use]
    pub fn call(&self, request: S::Request) -> Pending<S> {
        let slot = Arc::new(Mutex::new(None));
        let send = slot.clone();
        let name = self.caller.name.clone();
        let reply = Reply::new(name.clone(), move |answer| *lock(&send) = Some(answer));
        self.caller.call(Payload::typed(Arc::new(request)), reply);
        Pending { slot, name, of: PhantomData }
    }

    /// True if a server is available.
    #[must_use]
    pub fn is_ready(&self) -> bool {
        self.caller.server().is_some()
    }

    /// Full name of the service.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.caller.name
    }
}

/// A call that waits for its response.
pub struct Pending<S> {
    slot: Arc<Mutex<Option<Answer>>>,
    name: Arc<str>,
    of: PhantomData<fn() -> S>,
}

impl<S: Service> Pending<S> {
    /// Returns the response once, when it has arrived.
    #[must_use]
    pub fn take(&self) -> Option<Result<Arc<S::Response>, CallError>> {
        let answer = lock(&self.slot).take()?;
        Some(read_answer::<S>(answer, &self.name))
    }
}

/// Decodes the response.
pub(crate) fn read_answer<S: Service>(
    answer: Answer,
    service: &str,
) -> Result<Arc<S::Response>, CallError> {
    answer?.message().map_err(|error| CallError::Undecodable {
        service: service.to_owned(),
        reason: error.to_string(),
    })
}
