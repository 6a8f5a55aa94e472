//! Servers of services and their calls.

use std::sync::{Arc, Mutex};

use periplus::graph::{GraphError, RawCall, RawCalls};
use periplus::msgs::Format;
use periplus_lockstep::Inbox;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use super::super::backend::{Backend, Shared, link_error};
use super::super::node::Place;
use super::{Kind, closed, link};
use crate::errors::{runtime_error, value_error};
use crate::messages::{TypeHandle, decode_message, from_python};
use crate::work::{lock, released};

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
