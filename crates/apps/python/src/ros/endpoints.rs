//! Publishers, subscriptions, clients and servers.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use periplus::graph::{
    GraphError, Policy, Qos, QosEvent, RawCall, RawCalls, RawClient, RawMailbox, RawPublisher,
};
use periplus::msgs::Format;
use periplus::os::unix_ns;
use periplus_lockstep::{Inbox, LockstepClient};
use pyo3::exceptions::{PyRuntimeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use super::graph::{Backend, Shared, endpoints, link_error};
use super::node::Place;
use crate::errors::{runtime_error, value_error};
use crate::messages::{TypeHandle, bytes_of, decode_message, from_python};
use crate::work::{lock, released};

type Kind<'a> = (&'a str, Option<String>);

fn closed() -> PyErr {
    PyRuntimeError::new_err("the node or endpoint was destroyed")
}

/// The part of the backend of an endpoint in step.
fn link(shared: &Shared) -> PyResult<&LockstepClient> {
    match &shared.backend {
        Backend::Lockstep(client) => Ok(client),
        Backend::Live { .. } => Err(closed()),
    }
}

enum PublisherEnd {
    Live(RawPublisher),
    Lockstep(u32),
}

/// A publisher.
#[pyclass(frozen, module = "periplus._native")]
pub(crate) struct RosPublisher {
    shared: Arc<Shared>,
    topic: String,
    type_name: String,
    qos: Qos,
    end: Mutex<Option<PublisherEnd>>,
}

impl RosPublisher {
    pub(crate) fn new(
        py: Python<'_>,
        shared: &Arc<Shared>,
        place: &Place,
        topic: &str,
        (type_name, hash): Kind<'_>,
        qos: Qos,
    ) -> PyResult<Self> {
        let hash = hash.as_deref();
        let end = match place {
            Place::Live(node) => PublisherEnd::Live(
                node.raw_publisher(topic, type_name, hash, qos).map_err(value_error)?,
            ),
            Place::Lockstep(node) => {
                let client = link(shared)?;
                let made = released(py, "creating a publisher", || {
                    client.publisher(*node, topic, type_name, hash, qos)
                })?;
                PublisherEnd::Lockstep(made.map_err(link_error)?)
            }
            Place::Closed => return Err(closed()),
        };
        Ok(Self {
            shared: shared.clone(),
            topic: topic.to_owned(),
            type_name: type_name.to_owned(),
            qos,
            end: Mutex::new(Some(end)),
        })
    }

    fn send(&self, py: Python<'_>, cdr: Vec<u8>) -> PyResult<()> {
        let shared = &self.shared;
        // Large messages are copied and compressed by readers without the interpreter.
        let send = || match lock(&self.end).as_ref() {
            Some(PublisherEnd::Live(publisher)) => {
                shared.tick();
                publisher.publish(cdr);
                Ok(())
            }
            Some(PublisherEnd::Lockstep(id)) => {
                link(shared)?.publish(*id, &cdr).map_err(link_error)
            }
            None => Err(closed()),
        };
        py.detach(send)
    }
}

#[pymethods]
impl RosPublisher {
    /// Full name of the topic.
    #[getter]
    fn topic(&self) -> &str {
        &self.topic
    }

    /// Publishes a message.
    fn publish(&self, py: Python<'_>, message: &Bound<'_, PyAny>) -> PyResult<()> {
        let (type_name, cdr) = from_python(message)?;
        if type_name != self.type_name {
            return Err(PyTypeError::new_err(format!(
                "{} has the type {}, not {type_name}",
                self.topic, self.type_name
            )));
        }
        self.send(py, cdr)
    }

    /// Publishes a serialized message.
    fn publish_raw(&self, py: Python<'_>, data: &Bound<'_, PyAny>) -> PyResult<()> {
        let bytes = bytes_of(data).ok_or_else(|| PyTypeError::new_err("`data` must be bytes"))?;
        self.send(py, bytes)
    }

    /// Number of matching subscriptions of all programs.
    #[getter]
    fn subscription_count(&self, py: Python<'_>) -> PyResult<usize> {
        matched(py, &self.shared, &self.topic, false, |end| {
            end.type_name == self.type_name && self.qos.incompatible_policies(&end.qos).is_empty()
        })
    }

    /// Policies by which subscriptions are incompatible, since the last call.
    fn take_events(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let shared = &self.shared;
        released(py, "events", || match lock(&self.end).as_ref() {
            Some(PublisherEnd::Live(publisher)) => Ok(incompatible(publisher.events())),
            Some(PublisherEnd::Lockstep(id)) => link(shared)?.events(*id).map_err(link_error),
            None => Ok(Vec::new()),
        })?
    }

    /// Asserts that the publisher is alive.
    fn assert_liveliness(&self) {
        if let Some(PublisherEnd::Live(publisher)) = lock(&self.end).as_ref() {
            self.shared.tick();
            publisher.assert_liveliness();
        }
    }

    /// Removes the publisher.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let end = lock(&self.end).take();
        let shared = &self.shared;
        released(py, "removing a publisher", || match (end, &shared.backend) {
            (Some(PublisherEnd::Lockstep(id)), Backend::Lockstep(client)) => client.remove(id),
            (end, _) => drop(end),
        })
    }
}

fn matched(
    py: Python<'_>,
    shared: &Arc<Shared>,
    topic: &str,
    publishers: bool,
    fits: impl Fn(&super::graph::End) -> bool + Send,
) -> PyResult<usize> {
    let ends = released(py, "endpoints", || endpoints(&shared.backend, topic, publishers))?;
    Ok(ends.map_err(link_error)?.iter().filter(|end| fits(end)).count())
}

fn incompatible(events: Vec<QosEvent>) -> Vec<String> {
    let events = events.into_iter().filter_map(|event| match event {
        QosEvent::Incompatible { policies, .. } => {
            // As Fast DDS, which names the reliability first.
            let reliability = policies.iter().find(|one| one.policy == Policy::Reliability);
            Some(reliability.or(policies.last())?.policy.to_string())
        }
        _ => None,
    });
    events.collect()
}

/// A message, times of its source and its arrival, and its numbers.
type Taken<'py> = (Bound<'py, PyAny>, i64, i64, u64, u64);

enum SubscriptionEnd {
    Live(RawMailbox),
    Lockstep(u32, Arc<Inbox>),
}

/// A subscription.
#[pyclass(frozen, module = "periplus._native")]
pub(crate) struct RosSubscription {
    shared: Arc<Shared>,
    topic: String,
    kind: TypeHandle,
    qos: Qos,
    received: AtomicU64,
    end: Mutex<Option<SubscriptionEnd>>,
}

impl RosSubscription {
    pub(crate) fn new(
        py: Python<'_>,
        shared: &Arc<Shared>,
        place: &Place,
        topic: &str,
        kind: TypeHandle,
        qos: Qos,
    ) -> PyResult<Self> {
        let (type_name, hash) = (kind.0.type_name.as_str(), kind.0.hash.as_deref());
        let end = match place {
            Place::Live(node) => {
                let mailbox = node.raw_mailbox(topic, type_name, hash, qos).map_err(value_error)?;
                let arrivals = shared.arrivals.clone();
                mailbox.on_message(move || arrivals.add());
                if mailbox.has_messages() {
                    shared.arrivals.add();
                }
                SubscriptionEnd::Live(mailbox)
            }
            Place::Lockstep(node) => {
                let client = link(shared)?;
                let made = released(py, "creating a subscription", || {
                    client.subscription(*node, topic, type_name, hash, qos)
                })?;
                let (id, inbox) = made.map_err(link_error)?;
                SubscriptionEnd::Lockstep(id, inbox)
            }
            Place::Closed => return Err(closed()),
        };
        Ok(Self {
            shared: shared.clone(),
            topic: topic.to_owned(),
            kind,
            qos,
            received: 0.into(),
            end: Mutex::new(Some(end)),
        })
    }

    fn take_with<'py>(
        &self,
        make: impl FnOnce(&[u8]) -> PyResult<Bound<'py, PyAny>>,
    ) -> PyResult<Option<Taken<'py>>> {
        let end = lock(&self.end);
        match end.as_ref() {
            Some(SubscriptionEnd::Live(mailbox)) => {
                self.shared.tick();
                let Some(sample) = mailbox.take() else { return Ok(None) };
                drop(end);
                let number = self.received.fetch_add(1, Ordering::Relaxed) + 1;
                let message = make(sample.cdr().map_err(runtime_error)?)?;
                Ok(Some((message, sample.time_ns, unix_ns(), sample.sequence, number)))
            }
            Some(SubscriptionEnd::Lockstep(_, inbox)) => {
                let Some(received) = inbox.take() else { return Ok(None) };
                drop(end);
                let number = self.received.fetch_add(1, Ordering::Relaxed) + 1;
                let message = make(&received.cdr)?;
                let now_ns = link(&self.shared)?.now_ns();
                Ok(Some((message, received.time_ns, now_ns, received.number, number)))
            }
            None => Ok(None),
        }
    }
}

#[pymethods]
impl RosSubscription {
    /// Full name of the topic.
    #[getter]
    fn topic(&self) -> &str {
        &self.topic
    }

    /// True if a message waits.
    #[getter]
    fn has_data(&self) -> bool {
        match lock(&self.end).as_ref() {
            Some(SubscriptionEnd::Live(mailbox)) => mailbox.has_messages(),
            Some(SubscriptionEnd::Lockstep(_, inbox)) => !inbox.is_empty(),
            None => false,
        }
    }

    /// Oldest message with its times and numbers, or None.
    fn take<'py>(&self, py: Python<'py>) -> PyResult<Option<Taken<'py>>> {
        self.take_with(|cdr| decode_message(py, &self.kind.0, Format::CDR, cdr))
    }

    /// Same as `take`, with the serialized message.
    fn take_raw<'py>(&self, py: Python<'py>) -> PyResult<Option<Taken<'py>>> {
        self.take_with(|cdr| Ok(PyBytes::new(py, cdr).into_any()))
    }

    /// Number of matching publishers of all programs.
    #[getter]
    fn publisher_count(&self, py: Python<'_>) -> PyResult<usize> {
        matched(py, &self.shared, &self.topic, true, |end| {
            end.type_name == self.kind.0.type_name
                && end.qos.incompatible_policies(&self.qos).is_empty()
        })
    }

    /// Policies by which publishers are incompatible, since the last call.
    fn take_events(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let shared = &self.shared;
        released(py, "events", || match lock(&self.end).as_ref() {
            Some(SubscriptionEnd::Live(mailbox)) => Ok(incompatible(mailbox.events())),
            Some(SubscriptionEnd::Lockstep(id, _)) => link(shared)?.events(*id).map_err(link_error),
            None => Ok(Vec::new()),
        })?
    }

    /// Removes the subscription.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let end = lock(&self.end).take();
        let shared = &self.shared;
        released(py, "removing a subscription", || match (end, &shared.backend) {
            (Some(SubscriptionEnd::Lockstep(id, _)), Backend::Lockstep(client)) => {
                client.remove(id);
            }
            (end, _) => drop(end),
        })
    }
}

/// Responses of live services, by the number of their request.
type Responses = Arc<Mutex<std::collections::VecDeque<(u64, Vec<u8>)>>>;

enum ClientEnd {
    Live { client: RawClient, responses: Responses, last: u64 },
    Lockstep(u32, Arc<Inbox>),
}

/// A client of a service.
#[pyclass(frozen, module = "periplus._native")]
pub(crate) struct RosClient {
    shared: Arc<Shared>,
    service: String,
    response: TypeHandle,
    end: Mutex<Option<ClientEnd>>,
}

impl RosClient {
    pub(crate) fn new(
        py: Python<'_>,
        shared: &Arc<Shared>,
        place: &Place,
        service: &str,
        (type_name, hash): Kind<'_>,
        response: TypeHandle,
    ) -> PyResult<Self> {
        let hash = hash.as_deref();
        let end = match place {
            Place::Live(node) => ClientEnd::Live {
                client: node.raw_client(service, type_name, hash).map_err(value_error)?,
                responses: Responses::default(),
                last: 0,
            },
            Place::Lockstep(node) => {
                let client = link(shared)?;
                let made = released(py, "creating a client", || {
                    client.client(*node, service, type_name, hash)
                })?;
                let (id, inbox) = made.map_err(link_error)?;
                ClientEnd::Lockstep(id, inbox)
            }
            Place::Closed => return Err(closed()),
        };
        Ok(Self {
            shared: shared.clone(),
            service: service.to_owned(),
            response,
            end: Mutex::new(Some(end)),
        })
    }
}

#[pymethods]
impl RosClient {
    /// Full name of the service.
    #[getter]
    fn service(&self) -> &str {
        &self.service
    }

    /// True if there is a server.
    #[getter]
    fn is_ready(&self, py: Python<'_>) -> PyResult<bool> {
        let shared = &self.shared;
        released(py, "is_ready", || match lock(&self.end).as_ref() {
            Some(ClientEnd::Live { client, .. }) => Ok(client.is_ready()),
            Some(ClientEnd::Lockstep(id, _)) => {
                link(shared)?.matched(*id).map(|count| count > 0).map_err(link_error)
            }
            None => Ok(false),
        })?
    }

    /// Sends a request; returns its number.
    fn call(&self, py: Python<'_>, request: &Bound<'_, PyAny>) -> PyResult<u64> {
        let (_, cdr) = from_python(request)?;
        let shared = &self.shared;
        py.detach(|| match lock(&self.end).as_mut() {
            Some(ClientEnd::Live { client, responses, last }) => {
                *last += 1;
                let (number, arrivals) = (*last, shared.arrivals.clone());
                let responses = responses.clone();
                client.call(cdr, move |answer| {
                    // As in ROS 2, a client never hears of a call that failed.
                    let Ok(answer) = answer else { return };
                    let Ok(cdr) = answer.cdr() else { return };
                    lock(&responses).push_back((number, cdr.to_vec()));
                    arrivals.add();
                });
                Ok(number)
            }
            Some(ClientEnd::Lockstep(id, _)) => link(shared)?.call(*id, &cdr).map_err(link_error),
            None => Err(closed()),
        })
    }

    /// True if a response waits.
    #[getter]
    fn has_data(&self) -> bool {
        match lock(&self.end).as_ref() {
            Some(ClientEnd::Live { responses, .. }) => !lock(responses).is_empty(),
            Some(ClientEnd::Lockstep(_, inbox)) => !inbox.is_empty(),
            None => false,
        }
    }

    /// Number of a request and its response, or None.
    fn take<'py>(&self, py: Python<'py>) -> PyResult<Option<(u64, Bound<'py, PyAny>)>> {
        let taken = match lock(&self.end).as_ref() {
            Some(ClientEnd::Live { responses, .. }) => lock(responses).pop_front(),
            Some(ClientEnd::Lockstep(_, inbox)) => inbox.take().map(|it| (it.number, it.cdr)),
            None => None,
        };
        let Some((number, cdr)) = taken else { return Ok(None) };
        Ok(Some((number, decode_message(py, &self.response.0, Format::CDR, &cdr)?)))
    }

    /// Removes the client.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let end = lock(&self.end).take();
        let shared = &self.shared;
        released(py, "removing a client", || match (end, &shared.backend) {
            (Some(ClientEnd::Lockstep(id, _)), Backend::Lockstep(client)) => client.remove(id),
            (end, _) => drop(end),
        })
    }
}

enum ServerEnd {
    Live(RawCalls),
    /// Another server of the service answers.
    Second,
    Lockstep(u32, Arc<Inbox>),
}

/// A server of a service.
#[pyclass(frozen, module = "periplus._native")]
pub(crate) struct RosServer {
    shared: Arc<Shared>,
    service: String,
    request: TypeHandle,
    end: Mutex<Option<ServerEnd>>,
}

impl RosServer {
    pub(crate) fn new(
        py: Python<'_>,
        shared: &Arc<Shared>,
        place: &Place,
        service: &str,
        (type_name, hash): Kind<'_>,
        request: TypeHandle,
    ) -> PyResult<Self> {
        let hash = hash.as_deref();
        let end = match place {
            Place::Live(node) => {
                match node.raw_server(service, type_name, hash) {
                    Ok(calls) => {
                        let arrivals = shared.arrivals.clone();
                        calls.on_call(move || arrivals.add());
                        ServerEnd::Live(calls)
                    }
                    // Two nodes of one name have the same services, as in ROS 2.
                    Err(GraphError::ServerExists { .. }) => ServerEnd::Second,
                    Err(error) => return Err(value_error(error)),
                }
            }
            Place::Lockstep(node) => {
                let client = link(shared)?;
                let made = released(py, "creating a server", || {
                    client.server(*node, service, type_name, hash)
                })?;
                let (id, inbox) = made.map_err(link_error)?;
                ServerEnd::Lockstep(id, inbox)
            }
            Place::Closed => return Err(closed()),
        };
        Ok(Self {
            shared: shared.clone(),
            service: service.to_owned(),
            request,
            end: Mutex::new(Some(end)),
        })
    }
}

#[pymethods]
impl RosServer {
    /// Full name of the service.
    #[getter]
    fn service(&self) -> &str {
        &self.service
    }

    /// True if a request waits.
    #[getter]
    fn has_data(&self) -> bool {
        match lock(&self.end).as_ref() {
            Some(ServerEnd::Live(calls)) => calls.has_requests(),
            Some(ServerEnd::Lockstep(_, inbox)) => !inbox.is_empty(),
            Some(ServerEnd::Second) | None => false,
        }
    }

    /// A call, and its request, or None.
    fn take<'py>(&self, py: Python<'py>) -> PyResult<Option<(RosCall, Bound<'py, PyAny>)>> {
        let shared = self.shared.clone();
        let (call, cdr) = match lock(&self.end).as_ref() {
            Some(ServerEnd::Live(calls)) => {
                let Some(call) = calls.take() else { return Ok(None) };
                let cdr = call.request.cdr().map_err(runtime_error)?.to_vec();
                (CallEnd::Live(call), cdr)
            }
            Some(ServerEnd::Lockstep(_, inbox)) => {
                let Some(received) = inbox.take() else { return Ok(None) };
                (CallEnd::Lockstep(received.number), received.cdr)
            }
            Some(ServerEnd::Second) | None => return Ok(None),
        };
        let call = RosCall { shared, end: Mutex::new(Some(call)) };
        Ok(Some((call, decode_message(py, &self.request.0, Format::CDR, &cdr)?)))
    }

    /// Removes the server.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let end = lock(&self.end).take();
        let shared = &self.shared;
        released(py, "removing a server", || match (end, &shared.backend) {
            (Some(ServerEnd::Lockstep(id, _)), Backend::Lockstep(client)) => client.remove(id),
            (end, _) => drop(end),
        })
    }
}

enum CallEnd {
    Live(RawCall),
    Lockstep(u64),
}

/// A call that waits for its response.
#[pyclass(frozen, module = "periplus._native")]
pub(crate) struct RosCall {
    shared: Arc<Shared>,
    end: Mutex<Option<CallEnd>>,
}

#[pymethods]
impl RosCall {
    /// Sends the response, once.
    fn respond(&self, py: Python<'_>, response: &Bound<'_, PyAny>) -> PyResult<()> {
        let (_, cdr) = from_python(response)?;
        let end = lock(&self.end).take();
        let shared = &self.shared;
        py.detach(|| match end {
            Some(CallEnd::Live(call)) => {
                shared.tick();
                call.answer(cdr);
                Ok(())
            }
            Some(CallEnd::Lockstep(number)) => {
                link(shared)?.answer(number, Some(&cdr)).map_err(link_error)
            }
            None => Err(PyRuntimeError::new_err("the call has its response")),
        })
    }
}
