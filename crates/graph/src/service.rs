//! Services: a call and its answer.

mod raw;

use std::collections::VecDeque;
use std::fmt;
use std::marker::PhantomData;
use std::sync::{Arc, Mutex};

use periplus_msgs::Service;

use crate::GraphError;

use crate::agenda::{Agenda, Event, Key, Rank};
use crate::common::{Common, lock};
use crate::node::NodeCore;
use crate::payload::Payload;
use crate::registry::TypeOf;
use crate::sample::EndpointId;
pub use raw::{RawCall, RawCalls, RawClient, RawMessage};

/// Why a call has no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CallError {
    /// Nobody answers this service.
    NoServer {
        /// Its full name.
        service: String,
        /// The service that may be meant.
        near: Option<String>,
    },
    /// Who answers it went away, or let the call fall.
    Unanswered {
        /// Full name of the service.
        service: String,
    },
    /// The question or the answer is no such message.
    Undecodable {
        /// Full name of the service.
        service: String,
        /// What is wrong with it.
        reason: String,
    },
}

impl fmt::Display for CallError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoServer { service, near } => {
                write!(f, "nobody answers the service `{service}`")?;
                match near {
                    Some(near) => write!(f, ", did you mean `{near}`?"),
                    None => Ok(()),
                }
            }
            Self::Unanswered { service } => {
                write!(f, "who answers the service `{service}` went away without an answer")
            }
            Self::Undecodable { service, reason } => {
                write!(f, "a message of the service `{service}` cannot be read: {reason}")
            }
        }
    }
}

impl std::error::Error for CallError {}

pub(crate) type Answer = Result<Arc<Payload>, CallError>;

/// A call on its way to who answers.
pub(crate) struct Request {
    pub(crate) payload: Arc<Payload>,
    pub(crate) reply: Reply,
}

/// The way back. If it is dropped unused, the caller is told so.
pub(crate) struct Reply {
    service: Arc<str>,
    send: Option<Box<dyn FnOnce(Answer) + Send>>,
}

impl Reply {
    pub(crate) fn new(service: Arc<str>, send: impl FnOnce(Answer) + Send + 'static) -> Self {
        Self { service, send: Some(Box::new(send)) }
    }

    pub(crate) fn send(mut self, answer: Answer) {
        if let Some(send) = self.send.take() {
            send(answer);
        }
    }

    pub(crate) fn undecodable(self, error: &dyn fmt::Display) {
        let service = self.service.to_string();
        self.send(Err(CallError::Undecodable { service, reason: error.to_string() }));
    }
}

impl Drop for Reply {
    fn drop(&mut self) {
        if let Some(send) = self.send.take() {
            send(Err(CallError::Unanswered { service: self.service.to_string() }));
        }
    }
}

/// The end that answers.
pub(crate) struct Server {
    pub(crate) node: Arc<str>,
    pub(crate) name: Arc<str>,
    pub(crate) reaction: Option<ServerReaction>,
    waiting: Mutex<Waiting>,
}

pub(crate) struct ServerReaction {
    pub(crate) agenda: Arc<Agenda>,
    pub(crate) react: Box<dyn Fn(Request) + Send + Sync>,
}

#[derive(Default)]
struct Waiting {
    requests: VecDeque<(u64, Request)>,
    last: u64,
}

impl Server {
    pub(crate) fn push(self: &Arc<Self>, request: Request, common: &Common) {
        let mut waiting = lock(&self.waiting);
        waiting.last += 1;
        let number = waiting.last;
        waiting.requests.push_back((number, request));
        drop(waiting);
        if let Some(reaction) = &self.reaction {
            let key = Key {
                time_ns: common.clock.now_ns(),
                node: self.node.clone(),
                rank: Rank::Request,
                name: self.name.clone(),
                sequence: number,
                ordinal: 0,
            };
            reaction.agenda.add(key, self.clone());
        }
    }

    pub(crate) fn take(&self) -> Option<Request> {
        lock(&self.waiting).requests.pop_front().map(|(_, request)| request)
    }

    fn take_number(&self, number: u64) -> Option<Request> {
        let mut waiting = lock(&self.waiting);
        let place = waiting.requests.iter().position(|(other, _)| *other == number)?;
        waiting.requests.remove(place).map(|(_, request)| request)
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

/// A server that leaves the graph when it is dropped.
pub(crate) struct OwnServer {
    pub(crate) server: Arc<Server>,
    node: Arc<NodeCore>,
}

impl Drop for OwnServer {
    fn drop(&mut self) {
        let mut registry = lock(&self.node.core.registry);
        let entry = registry.services.get_mut(&self.server.name);
        let gone = entry.and_then(|entry| entry.server.take());
        drop(registry);
        drop(gone);
        self.server.withdraw();
    }
}

/// The end that calls.
pub(crate) struct Caller {
    id: EndpointId,
    pub(crate) name: Arc<str>,
    pub(crate) node: Arc<NodeCore>,
}

impl Caller {
    fn server(&self) -> Option<Arc<Server>> {
        let registry = lock(&self.node.core.registry);
        registry.services.get(&self.name).and_then(|entry| entry.server.clone())
    }

    pub(crate) fn call(&self, payload: Payload, reply: Reply) {
        match self.server() {
            Some(server) => {
                let request = Request { payload: Arc::new(payload), reply };
                server.push(request, &self.node.core.common);
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
        if let Some(entry) = registry.services.get_mut(&self.name) {
            entry.remove_client(self.id);
        }
    }
}

impl NodeCore {
    pub(crate) fn server(
        self: &Arc<Self>,
        name: &str,
        type_of: TypeOf,
        reaction: Option<ServerReaction>,
    ) -> Result<OwnServer, GraphError> {
        let name: Arc<str> = self.names.service(name)?.into();
        let mut registry = lock(&self.core.registry);
        let node = self.full_name.clone();
        let server =
            Arc::new(Server { node, name: name.clone(), reaction, waiting: Mutex::default() });
        registry.service(&name, type_of, &self.full_name)?.set_server(server.clone())?;
        Ok(OwnServer { server, node: self.clone() })
    }

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

/// The calls of a service, until somebody looks.
pub struct Calls<S> {
    own: OwnServer,
    of: PhantomData<fn() -> S>,
}

impl<S: Service> Calls<S> {
    pub(crate) fn new(own: OwnServer) -> Self {
        Self { own, of: PhantomData }
    }

    /// The oldest call that waits.
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

/// A call that waits for its answer. If it is dropped, the caller is told that none will come.
#[must_use]
pub struct Call<S: Service> {
    /// The question.
    pub request: Arc<S::Request>,
    reply: Reply,
    of: PhantomData<fn() -> S>,
}

impl<S: Service> Call<S> {
    /// Answers.
    pub fn answer(self, response: S::Response) {
        self.reply.send(Ok(Arc::new(Payload::typed(Arc::new(response)))));
    }
}

/// Calls a service.
pub struct Client<S> {
    pub(crate) caller: Caller,
    of: PhantomData<fn(S)>,
}

impl<S: Service> Client<S> {
    pub(crate) fn new(caller: Caller) -> Self {
        Self { caller, of: PhantomData }
    }

    /// Asks. The answer comes when who answers has had time to; in lockstep, when the graph goes on.
    #[must_use]
    pub fn call(&self, request: S::Request) -> Pending<S> {
        let slot = Arc::new(Mutex::new(None));
        let send = slot.clone();
        let name = self.caller.name.clone();
        let reply = Reply::new(name.clone(), move |answer| *lock(&send) = Some(answer));
        self.caller.call(Payload::typed(Arc::new(request)), reply);
        Pending { slot, name, of: PhantomData }
    }

    /// Whether somebody answers.
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

/// A call whose answer is on its way.
pub struct Pending<S> {
    slot: Arc<Mutex<Option<Answer>>>,
    name: Arc<str>,
    of: PhantomData<fn() -> S>,
}

impl<S: Service> Pending<S> {
    /// The answer, once, when it is there.
    #[must_use]
    pub fn take(&self) -> Option<Result<Arc<S::Response>, CallError>> {
        let answer = lock(&self.slot).take()?;
        Some(read_answer::<S>(answer, &self.name))
    }
}

/// The answer as a value.
pub(crate) fn read_answer<S: Service>(
    answer: Answer,
    service: &str,
) -> Result<Arc<S::Response>, CallError> {
    answer?.message().map_err(|error| CallError::Undecodable {
        service: service.to_owned(),
        reason: error.to_string(),
    })
}
