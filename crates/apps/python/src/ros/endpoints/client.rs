//! Clients of services.

use std::sync::{Arc, Mutex};

use periplus::graph::RawClient;
use periplus::msgs::Format;
use periplus_lockstep::Inbox;
use pyo3::prelude::*;

use super::super::backend::{Backend, Shared, link_error};
use super::super::node::Place;
use super::{Kind, closed, link};
use crate::errors::value_error;
use crate::messages::{TypeHandle, decode_message, from_python};
use crate::work::{lock, released};

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
                    // As in ROS 2, a client gets no answer to a call that failed.
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
