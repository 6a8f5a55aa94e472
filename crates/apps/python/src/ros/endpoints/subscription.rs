//! Subscriptions.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use periplus::graph::{Qos, RawMailbox};
use periplus::msgs::Format;
use periplus::os::unix_ns;
use periplus_lockstep::Inbox;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use super::super::backend::{Backend, Shared, link_error};
use super::super::node::Place;
use super::{closed, incompatible, link, matched};
use crate::errors::{runtime_error, value_error};
use crate::messages::{TypeHandle, decode_message};
use crate::work::{lock, released};

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
