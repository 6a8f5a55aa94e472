//! A program of nodes.

#![allow(
    clippy::disallowed_methods,
    reason = "an edge: time of the machine for waits without a simulation"
)]

use std::collections::BTreeSet;
use std::io;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use periplus::graph::Arguments;
use periplus::os::{Machine, unix_ns};
use periplus_dds::{DdsTransport, Settings};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use super::arguments;
use super::arrivals::Arrivals;
use super::backend::{Backend, SEEN_WAKES, Shared, WAKES, beside, connect, link_error, live};
use super::discovery::{Names, endpoints, live_names, remote};
use super::node::{RosNode, new_node};
use super::qos;
use crate::work::{lock, released};

/// Slice of a wait, after which signals are handled.
const SLICE: Duration = Duration::from_millis(100);
/// A program of nodes: live on the ROS 2 network, or in step with a simulation.
///
/// Parameters
/// ----------
/// arguments : list of str
///     Words after ``--ros-args``, for all nodes.
/// domain_id : int, optional
///     ROS 2 domain, instead of ``ROS_DOMAIN_ID``.
/// network : bool
///     False: other programs do not see the nodes.
/// link : str, optional
///     Link to a simulation to run in step with.
///
/// Raises ``RosArgumentsError`` for arguments that cannot be used, and ``RuntimeError`` when there is no network.
///
/// >>> import periplus
/// >>> from periplus._native import RosGraph
/// >>> graph = RosGraph(network=False)
/// >>> graph.node("talker", "demo").name
/// 'talker'
#[pyclass(frozen, module = "periplus._native")]
pub(crate) struct RosGraph(Arc<Shared>);

#[pymethods]
impl RosGraph {
    #[new]
    #[pyo3(signature = (arguments=Vec::new(), *, domain_id=None, network=true, link=None))]
    fn new(
        py: Python<'_>,
        arguments: Vec<String>,
        domain_id: Option<u32>,
        network: bool,
        link: Option<String>,
    ) -> PyResult<Self> {
        let arguments = arguments::read(py, &arguments)?;
        let backend = match link {
            Some(link) => {
                let connect = move || connect(link);
                let client = released(py, "joining the simulation", connect)?;
                Backend::Lockstep(client.map_err(link_error)?)
            }
            None => released(py, "joining the network", || live(domain_id, network))??,
        };
        Ok(Self::of(backend, arguments, domain_id))
    }

    /// ROS 2 domain.
    #[getter]
    fn domain_id(&self) -> u32 {
        self.0.domain_id
    }

    /// True in step with a simulation.
    #[getter]
    fn is_lockstep(&self) -> bool {
        matches!(self.0.backend, Backend::Lockstep(_))
    }

    /// System time, or the time of the simulation in step [ns].
    fn now_ns(&self) -> i64 {
        match &self.0.backend {
            Backend::Live { keeps_time: true, .. } => unix_ns(),
            Backend::Live { graph, .. } => graph.now_ns(),
            Backend::Lockstep(client) => client.now_ns(),
        }
    }

    /// Monotonic time, or the time of the simulation in step [ns].
    fn steady_ns(&self) -> i64 {
        match &self.0.backend {
            Backend::Live { .. } => {
                i64::try_from(self.0.start.elapsed().as_nanos()).unwrap_or(i64::MAX)
            }
            Backend::Lockstep(client) => client.now_ns(),
        }
    }

    /// Number of messages, requests, responses and wake-ups so far.
    #[getter]
    fn events(&self) -> u64 {
        let arrived = match &self.0.backend {
            Backend::Live { .. } => 0,
            Backend::Lockstep(client) => client.arrivals(),
        };
        self.0.arrivals.count() + arrived
    }

    /// Waits until `events` differs from `seen`, at most for a time [ns]; returns it.
    #[pyo3(signature = (seen, timeout_ns=None))]
    fn wait(&self, py: Python<'_>, seen: u64, timeout_ns: Option<i64>) -> PyResult<u64> {
        if let Backend::Lockstep(client) = &self.0.backend {
            if self.events() != seen {
                return Ok(self.events());
            }
            let wake_ns = timeout_ns.map(|timeout_ns| client.now_ns().saturating_add(timeout_ns));
            self.exchange(py, wake_ns, true)?;
            return Ok(self.events());
        }
        let timeout = timeout_ns.map(|it| Duration::from_nanos(it.max(0).unsigned_abs()));
        let start = Instant::now();
        loop {
            let rest = timeout.map_or(SLICE, |timeout| timeout.saturating_sub(start.elapsed()));
            let arrivals = &self.0.arrivals;
            let count = py.detach(|| arrivals.wait(seen, Instant::now() + rest.min(SLICE)));
            if count != seen || rest == Duration::ZERO {
                return Ok(count);
            }
            py.check_signals()?;
        }
    }

    /// Wakes everything that waits.
    fn wake(&self) {
        WAKES.fetch_add(1, Ordering::AcqRel);
        self.0.arrivals.add();
    }

    /// In step: waits until the simulation has come to a time [ns], or, if asked, until something has arrived.
    #[pyo3(signature = (wake_ns, wants_messages))]
    fn exchange(&self, py: Python<'_>, wake_ns: Option<i64>, wants_messages: bool) -> PyResult<()> {
        let Backend::Lockstep(client) = &self.0.backend else { return Ok(()) };
        SEEN_WAKES.store(WAKES.load(Ordering::Acquire), Ordering::Release);
        match py.detach(|| client.wait(wake_ns, wants_messages)) {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => Ok(()),
            waited => waited.map_err(link_error),
        }
    }

    /// Creates a node.
    #[pyo3(signature = (name, namespace="", *, use_global_arguments=true, arguments=Vec::new()))]
    fn node(
        &self,
        py: Python<'_>,
        name: &str,
        namespace: &str,
        use_global_arguments: bool,
        arguments: Vec<String>,
    ) -> PyResult<RosNode> {
        new_node(py, &self.0, name, namespace, use_global_arguments, &arguments)
    }

    /// Number of the log level that the arguments give to a logger; 0 for none.
    fn log_level(&self, logger: &str) -> u8 {
        self.0.arguments.given_level_of(logger).map_or(0, |level| level.number())
    }

    /// Topics of all programs with their types.
    fn topics(&self, py: Python<'_>) -> PyResult<Vec<(String, Vec<String>)>> {
        self.names(py, Names::Topics)
    }

    /// Services of all programs with their types.
    fn services(&self, py: Python<'_>) -> PyResult<Vec<(String, Vec<String>)>> {
        self.names(py, Names::Services)
    }

    /// Names and namespaces of the nodes of all programs.
    fn nodes(&self, py: Python<'_>) -> PyResult<Vec<(String, String)>> {
        let shared = &self.0;
        released(py, "nodes", || match &shared.backend {
            Backend::Live { graph, wire, .. } => {
                let own = graph.nodes().into_iter().map(|node| node.name);
                let remote = remote(wire).nodes.into_iter().map(|node| node.name);
                let own = own.filter(|name| !name.starts_with("/_wire_"));
                let split = own.chain(remote).filter_map(|full| {
                    let (namespace, name) = full.rsplit_once('/')?;
                    Some((name.to_owned(), format!("/{}", namespace.trim_start_matches('/'))))
                });
                Ok(split.collect())
            }
            Backend::Lockstep(client) => {
                let nodes = client.nodes()?.into_iter();
                let hidden = |name: &str| name.starts_with("_process_");
                Ok(nodes
                    .filter(|node| !hidden(&node.name))
                    .map(|node| (node.name, format!("/{}", node.namespace.trim_start_matches('/'))))
                    .collect())
            }
        })?
        .map_err(link_error)
    }

    /// Publishers or subscriptions of a topic.
    fn endpoints<'py>(
        &self,
        py: Python<'py>,
        topic: &str,
        publishers: bool,
    ) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let shared = &self.0;
        let found = released(py, "endpoints", || endpoints(&shared.backend, topic, publishers))?;
        let mut list = Vec::new();
        for end in found.map_err(link_error)? {
            let words = PyDict::new(py);
            let full = end.node.unwrap_or_else(|| "/_NODE_NAME_UNKNOWN_".to_owned());
            let (namespace, name) = full.rsplit_once('/').unwrap_or(("", &full));
            words.set_item("node_name", name)?;
            words.set_item("node_namespace", format!("/{}", namespace.trim_start_matches('/')))?;
            words.set_item("topic_type", end.type_name)?;
            words.set_item("topic_type_hash", end.type_hash)?;
            words.set_item("endpoint_gid", end.gid)?;
            words.set_item("qos", qos::words(&end.qos))?;
            list.push(words);
        }
        Ok(list)
    }

    /// Topics that a node publishes or subscribes to, with their types.
    fn node_topics(
        &self,
        py: Python<'_>,
        name: &str,
        namespace: &str,
        publishers: bool,
    ) -> PyResult<Vec<(String, Vec<String>)>> {
        let full = format!("{}/{name}", namespace.trim_end_matches('/'));
        let shared = &self.0;
        let mut found = Vec::new();
        for (topic, _) in self.topics(py)? {
            let ends =
                released(py, "endpoints", || endpoints(&shared.backend, &topic, publishers))?;
            let ends = ends.map_err(link_error)?;
            let mine = ends.into_iter().filter(|end| end.node.as_deref() == Some(&full));
            let types: BTreeSet<String> = mine.map(|end| end.type_name).collect();
            if !types.is_empty() {
                found.push((topic, types.into_iter().collect()));
            }
        }
        Ok(found)
    }

    /// Services that a node serves or calls, with their types.
    fn node_services(
        &self,
        py: Python<'_>,
        name: &str,
        namespace: &str,
        servers: bool,
    ) -> PyResult<Vec<(String, Vec<String>)>> {
        let full = format!("{}/{name}", namespace.trim_end_matches('/'));
        let shared = &self.0;
        released(py, "services", || {
            let Backend::Live { graph, wire, .. } = &shared.backend else { return Vec::new() };
            let mut found: Vec<(String, Vec<String>)> = Vec::new();
            for service in graph.services() {
                let is_its = match servers {
                    true => service.server.as_deref() == Some(&full),
                    false => service.clients.contains(&full),
                };
                if is_its {
                    found.push((service.name, vec![service.type_name]));
                }
            }
            for service in remote(wire).services {
                let nodes = if servers { &service.servers } else { &service.clients };
                if nodes.contains(&full) {
                    found.push((service.name, service.type_names));
                }
            }
            found
        })
    }

    /// Texts of what went wrong on the network since the last call.
    fn findings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let shared = &self.0;
        released(py, "findings", || {
            let Backend::Live { graph, wire, .. } = &shared.backend else { return Vec::new() };
            let wire = lock(wire).as_ref().map(DdsTransport::take_findings).unwrap_or_default();
            let own = graph.take_findings();
            wire.iter().chain(own.iter()).map(|finding| finding.message.clone()).collect()
        })
    }

    /// Waits until others have got everything that was published, at most for a time [ns].
    fn flush(&self, py: Python<'_>, timeout_ns: i64) -> PyResult<bool> {
        let shared = &self.0;
        released(py, "flush", || match &shared.backend {
            Backend::Live { wire, .. } => {
                let timeout = Duration::from_nanos(timeout_ns.max(0).unsigned_abs());
                lock(wire).as_ref().is_none_or(|wire| wire.flush(timeout))
            }
            Backend::Lockstep(_) => true,
        })
    }

    /// Leaves the network.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let shared = &self.0;
        released(py, "leaving the network", || {
            if let Backend::Live { wire, .. } = &shared.backend {
                let left = lock(wire).take();
                drop(left);
            }
            shared.arrivals.add();
        })
    }

    fn __repr__(&self) -> PyResult<String> {
        Python::attach(|py| {
            let kind = if self.is_lockstep() { "in step" } else { "live" };
            Ok(PyString::new(py, &format!("RosGraph({kind})")).to_string())
        })
    }
}

impl RosGraph {
    /// Nodes among those of a simulation in this process.
    pub(crate) fn beside(
        py: Python<'_>,
        graph: periplus::graph::Graph,
        arguments: &[String],
    ) -> PyResult<Self> {
        Ok(Self::of(beside(graph), arguments::read(py, arguments)?, None))
    }

    fn of(backend: Backend, arguments: Arguments, domain_id: Option<u32>) -> Self {
        let arrivals = Arc::new(Arrivals::default());
        let (settings, _) = Settings::from_environment(&Machine);
        let domain_id = domain_id.unwrap_or(settings.domain_id);
        let start = Instant::now();
        Self(Arc::new(Shared { backend, arrivals, arguments, domain_id, start }))
    }

    fn names(&self, py: Python<'_>, which: Names) -> PyResult<Vec<(String, Vec<String>)>> {
        let shared = &self.0;
        let listed = released(py, "names", || match &shared.backend {
            Backend::Live { graph, wire, .. } => Ok(live_names(graph, wire, which)),
            Backend::Lockstep(client) => {
                let names = match which {
                    Names::Topics => client.topics()?,
                    Names::Services => client.services()?,
                };
                Ok(names.into_iter().map(|(name, of)| (name, vec![of])).collect())
            }
        })?;
        listed.map_err(link_error)
    }
}
