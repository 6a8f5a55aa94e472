//! Backend of a program of nodes: the ROS 2 network, or a simulation in step.

#![allow(clippy::print_stderr, reason = "an edge: findings about the environment")]

use std::collections::BTreeMap;
use std::io;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, Weak};
use std::time::Instant;

use periplus::graph::{Arguments, Graph};
use periplus::os::{Machine, unix_ns};
use periplus_dds::{DdsTransport, DiscoveryRange, Settings};
use periplus_lockstep::LockstepClient;
use pyo3::exceptions::PyConnectionError;
use pyo3::prelude::*;

use super::arrivals::Arrivals;
use crate::errors::runtime_error;
use crate::work::lock;

/// Graph of the nodes of a program.
pub(crate) enum Backend {
    /// `keeps_time`: the program sets the clock of the graph; false beside a simulation, which sets it.
    Live {
        graph: Graph,
        wire: Mutex<Option<DdsTransport>>,
        keeps_time: bool,
    },
    Lockstep(Arc<LockstepClient>),
}

/// State that all objects of a program share.
pub(crate) struct Shared {
    pub(crate) backend: Backend,
    pub(crate) arrivals: Arc<Arrivals>,
    pub(crate) arguments: Arguments,
    pub(crate) domain_id: u32,
    pub(crate) start: Instant,
}

impl Shared {
    /// Sets the clock of a live graph, which stamps messages.
    pub(crate) fn tick(&self) {
        if let Backend::Live { graph, keeps_time: true, .. } = &self.backend {
            graph.advance_to(unix_ns());
        }
    }
}

/// Error of a simulation in step; the exception of a signal that ended the call stays as it is.
pub(crate) fn link_error(error: io::Error) -> PyErr {
    let kind = error.kind();
    match error.downcast::<PyErr>() {
        Ok(raised) => raised,
        Err(error) => match kind {
            io::ErrorKind::Other => runtime_error(error),
            _ => PyConnectionError::new_err(format!("the simulation has ended ({error})")),
        },
    }
}

/// Number of wake-ups of all graphs, and that at the start of the wait for the simulation.
pub(crate) static WAKES: AtomicU64 = AtomicU64::new(0);
pub(crate) static SEEN_WAKES: AtomicU64 = AtomicU64::new(0);

/// Connections of this process: programs join a simulation once, and may have several graphs.
static LINKS: Mutex<BTreeMap<String, Weak<LockstepClient>>> = Mutex::new(BTreeMap::new());

/// Joins a simulation.
pub(crate) fn connect(link: String) -> io::Result<Arc<LockstepClient>> {
    let mut links = lock(&LINKS);
    if let Some(client) = links.get(&link).and_then(Weak::upgrade) {
        return Ok(client);
    }
    let pause = || {
        Python::attach(|py| py.check_signals()).map_err(io::Error::other)?;
        match WAKES.load(Ordering::Acquire) == SEEN_WAKES.load(Ordering::Acquire) {
            true => Ok(()),
            false => Err(io::ErrorKind::Interrupted.into()),
        }
    };
    let client = Arc::new(LockstepClient::connect_with(&link, pause)?);
    links.insert(link, Arc::downgrade(&client));
    Ok(client)
}

/// Nodes among those of a simulation in this process.
pub(crate) fn beside(graph: Graph) -> Backend {
    Backend::Live { graph, wire: Mutex::new(None), keeps_time: false }
}

/// Joins the ROS 2 network.
pub(crate) fn live(domain_id: Option<u32>, network: bool) -> PyResult<Backend> {
    let graph = Graph::live();
    graph.set_simulated_time(false);
    graph.advance_to(unix_ns());
    let mut wire = None;
    if network {
        let (mut settings, findings) = Settings::from_environment(&Machine);
        for finding in findings.iter() {
            eprintln!("warning: {}", finding.message);
        }
        settings.domain_id = domain_id.unwrap_or(settings.domain_id);
        if settings.range != DiscoveryRange::Off {
            let joined = DdsTransport::open(&settings).map_err(runtime_error)?;
            joined.attach(&graph).map_err(runtime_error)?;
            wire = Some(joined);
        }
    }
    Ok(Backend::Live { graph, wire: Mutex::new(wire), keeps_time: true })
}
