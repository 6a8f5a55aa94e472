//! Publishers.

use std::sync::{Arc, Mutex};

use periplus::graph::{Qos, RawPublisher};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use super::super::backend::{Backend, Shared, link_error};
use super::super::node::Place;
use super::{Kind, closed, incompatible, link, matched};
use crate::errors::value_error;
use crate::messages::{bytes_of, from_python};
use crate::work::{lock, released};

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
