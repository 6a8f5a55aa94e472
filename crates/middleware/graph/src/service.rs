//! Services: requests, responses and servers.

mod client;
mod error;
mod raw;

use std::collections::VecDeque;
use std::fmt;
use std::marker::PhantomData;
use std::sync::{Arc, Mutex, OnceLock, Weak};

use periplus_msgs::Service;

use crate::GraphError;

use crate::common::{Common, lock};
use crate::event_queue::{Event, Key, Rank};
use crate::graph::Core;
use crate::node::NodeCore;
use crate::parallel::{self, ParallelNamespace};
use crate::payload::Payload;
use crate::registry::TypeOf;
pub(crate) use client::{Caller, read_answer};
pub use client::{Client, Pending};
pub use error::CallError;
pub use raw::{RawCall, RawCalls, RawClient, RawMessage};

pub(crate) type Answer = Result<Arc<Payload>, CallError>;

/// A request to a server.
pub(crate) struct Request {
    pub(crate) payload: Arc<Payload>,
    pub(crate) reply: Reply,
}

/// Return path of a response. If it is dropped unused, the caller gets an error.
pub(crate) struct Reply {
    service: Arc<str>,
    /// The namespace of the caller that runs beside others.
    namespace: Option<Arc<ParallelNamespace>>,
    send: Option<Box<dyn FnOnce(Answer) + Send>>,
}

impl Reply {
    pub(crate) fn new(service: Arc<str>, send: impl FnOnce(Answer) + Send + 'static) -> Self {
        Self { service, namespace: parallel::running(), send: Some(Box::new(send)) }
    }

    pub(crate) fn send(mut self, answer: Answer) {
        self.send_once(answer);
    }

    fn send_once(&mut self, answer: Answer) {
        let Some(send) = self.send.take() else { return };
        if parallel::may_change(self.namespace.as_ref()) {
            send(answer);
        } else {
            parallel::after_all(move || send(answer));
        }
    }

    pub(crate) fn undecodable(self, error: &dyn fmt::Display) {
        let service = self.service.to_string();
        self.send(Err(CallError::Undecodable { service, reason: error.to_string() }));
    }
}

impl Drop for Reply {
    fn drop(&mut self) {
        if self.send.is_some() {
            let service = self.service.to_string();
            self.send_once(Err(CallError::Unanswered { service }));
        }
    }
}

/// Server end of a service.
pub(crate) struct Server {
    pub(crate) node: Arc<str>,
    pub(crate) name: Arc<str>,
    /// The namespace of the node that runs beside others.
    namespace: Option<Arc<ParallelNamespace>>,
    pub(crate) reaction: Option<ServerReaction>,
    /// Called from the thread of the client when a request arrives.
    wake: OnceLock<Box<dyn Fn() + Send + Sync>>,
    waiting: Mutex<Waiting>,
}

pub(crate) struct ServerReaction {
    /// The node whose queue runs it; in live mode its thread starts with the first request.
    pub(crate) node: Weak<NodeCore>,
    pub(crate) react: Box<dyn Fn(Request) + Send + Sync>,
}

#[derive(Default)]
struct Waiting {
    requests: VecDeque<(u64, Request)>,
    last: u64,
}

impl Server {
    /// Receives a request of a client on this thread.
    pub(crate) fn receive(self: &Arc<Self>, request: Request, common: &Arc<Common>) {
        if parallel::may_change(self.namespace.as_ref()) {
            return self.push(request, common);
        }
        let (this, common) = (self.clone(), common.clone());
        parallel::after_all(move || this.push(request, &common));
    }

    fn push(self: &Arc<Self>, request: Request, common: &Common) {
        let mut waiting = lock(&self.waiting);
        waiting.last += 1;
        let number = waiting.last;
        waiting.requests.push_back((number, request));
        drop(waiting);
        if let Some(wake) = self.wake.get() {
            wake();
        }
        let node = self.reaction.as_ref().and_then(|reaction| reaction.node.upgrade());
        if let Some(node) = node {
            let key = Key {
                time_ns: common.clock.now_ns(),
                node: self.node.clone(),
                rank: Rank::Request,
                name: self.name.clone(),
                sequence: number,
                ordinal: 0,
            };
            node.event_queue().add(key, self.clone());
        }
    }

    pub(crate) fn take(&self) -> Option<Request> {
        lock(&self.waiting).requests.pop_front().map(|(_, request)| request)
    }

    fn has_requests(&self) -> bool {
        !lock(&self.waiting).requests.is_empty()
    }

    fn take_number(&self, number: u64) -> Option<Request> {
        let mut waiting = lock(&self.waiting);
        let place = waiting.requests.iter().position(|(other, _)| *other == number)?;
        waiting.requests.remove(place).map(|(_, request)| request)
    }

    /// Removes the server from the graph; waiting callers get an error.
    pub(crate) fn leave(&self, core: &Core) {
        let mut registry = lock(&core.registry);
        registry.changes += 1;
        let entry = registry.services.get_mut(&self.name);
        let is_this = |server: &mut Arc<Self>| std::ptr::eq(&**server, self);
        let gone = entry.and_then(|entry| entry.server.take_if(is_this));
        drop(registry);
        drop(gone);
        self.withdraw();
    }

    fn withdraw(&self) {
        let waiting = std::mem::take(&mut lock(&self.waiting).requests);
        drop(waiting);
    }
}

impl Event for Server {
    fn happen(&self, key: &Key) {
        if let (Some(reaction), Some(request)) = (&self.reaction, self.take_number(key.sequence)) {
            (reaction.react)(request);
        }
    }

    fn forget(&self, key: &Key) {
        drop(self.take_number(key.sequence));
    }
}

/// A server that is removed from the graph when it is dropped.
pub(crate) struct OwnServer {
    pub(crate) server: Arc<Server>,
    node: Arc<NodeCore>,
}

impl Drop for OwnServer {
    fn drop(&mut self) {
        self.server.leave(&self.node.core);
    }
}

impl NodeCore {
    pub(crate) fn server(
        self: &Arc<Self>,
        name: &str,
        type_of: TypeOf,
        reaction: Option<ServerReaction>,
    ) -> Result<OwnServer, GraphError> {
        Ok(OwnServer { server: self.bare_server(name, type_of, reaction)?, node: self.clone() })
    }

    /// A server that the caller has to remove from the graph.
    pub(crate) fn bare_server(
        &self,
        name: &str,
        type_of: TypeOf,
        reaction: Option<ServerReaction>,
    ) -> Result<Arc<Server>, GraphError> {
        let name: Arc<str> = self.names.service(name)?.into();
        let mut registry = lock(&self.core.registry);
        let node = self.full_name.clone();
        let server = Arc::new(Server {
            node,
            name: name.clone(),
            namespace: self.namespace.clone(),
            reaction,
            wake: OnceLock::new(),
            waiting: Mutex::default(),
        });
        registry.service(&name, type_of, &self.full_name)?.set_server(server.clone())?;
        Ok(server)
    }
}

/// Polled service: requests wait in a queue.
pub struct Calls<S> {
    own: OwnServer,
    of: PhantomData<fn() -> S>,
}

impl<S: Service> Calls<S> {
    pub(crate) fn new(own: OwnServer) -> Self {
        Self { own, of: PhantomData }
    }

    /// Returns the oldest request.
    #[must_use]
    pub fn take(&self) -> Option<Call<S>> {
        loop {
            let Request { payload, reply } = self.own.server.take()?;
            match payload.message() {
                Ok(request) => return Some(Call { request, reply, of: PhantomData }),
                Err(error) => reply.undecodable(&error),
            }
        }
    }

    /// Full name of the service.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.own.server.name
    }
}

/// A request that waits for its response. Dropping it gives the caller an error.
#[must_use]
pub struct Call<S: Service> {
    /// The request message.
    pub request: Arc<S::Request>,
    reply: Reply,
    of: PhantomData<fn() -> S>,
}

impl<S: Service> Call<S> {
    /// Sends the response.
    pub fn answer(self, response: S::Response) {
        self.reply.send(Ok(Arc::new(Payload::typed(Arc::new(response)))));
    }
}
