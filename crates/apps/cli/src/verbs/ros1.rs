//! ROS 1 network of verbs: the state of the master, and a graph that is connected to its nodes.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use periplus_diagnostics::Diagnostics;
use periplus_graph::{Graph, Qos};
use periplus_os::{Machine, Stopwatch, sleep};
use periplus_ros1::{
    MasterUse, Ros1Reach, Ros1Transport, Settings, SystemState, node_name, ros1_type,
    ros2_service_type, ros2_type,
};
use periplus_ros2cli::{Network, Progress, Seen, SeenNode, SeenService, SeenTopic, TopicEndpoint};

/// Polling period of the master.
const POLL_PERIOD: Duration = Duration::from_millis(50);

/// Queue depth that `topic info` shows; ROS 1 does not have it.
const UNKNOWN_DEPTH: usize = 0;

/// Connection to a master and the graph of the command.
pub(crate) struct Ros1Connection {
    // Declared first, so that the master is left before the graph is dropped.
    wire: Ros1Transport,
    graph: Graph,
    findings: Diagnostics,
    state: Mutex<State>,
}

/// Last state of the master.
#[derive(Default)]
struct State {
    last: SystemState,
    changes: u64,
    /// Types of services by name, as their servers state them.
    service_types: BTreeMap<String, Option<String>>,
}

impl Ros1Connection {
    /// Joins the master that `ROS_MASTER_URI` names.
    ///
    /// # Errors
    /// A message when it does not answer.
    pub(crate) fn open() -> Result<Self, String> {
        let (settings, findings) = Settings::from_environment(&Machine, Ros1Reach::Machine);
        let wire = Ros1Transport::open(&settings, MasterUse::Join).map_err(|e| e.to_string())?;
        let graph = Graph::live();
        wire.attach(&graph).map_err(|error| error.to_string())?;
        Ok(Self { wire, graph, findings, state: Mutex::default() })
    }

    /// Returns the findings so far.
    pub(crate) fn take_findings(&mut self) -> Diagnostics {
        let mut findings = std::mem::take(&mut self.findings);
        findings.append(self.wire.take_findings());
        findings
    }

    /// Asks the master again.
    fn refresh(&self) -> std::sync::MutexGuard<'_, State> {
        let now = self.wire.client().system_state();
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        // A master that does not answer leaves what is known.
        if let Ok(now) = now.map(|now| now.without(&self.own_nodes()))
            && now != state.last
        {
            state.last = now;
            state.changes += 1;
        }
        state
    }

    /// Names of the command's own nodes in ROS 1.
    fn own_nodes(&self) -> BTreeSet<String> {
        let nodes = self.graph.nodes().into_iter();
        nodes.map(|node| node_name(&node.name)).collect()
    }
}

impl Network for Ros1Connection {
    fn graph(&self) -> &Graph {
        &self.graph
    }

    fn seen(&self) -> Seen {
        let mut state = self.refresh();
        let State { last, service_types, .. } = &mut *state;
        for (service, _) in &last.services {
            if !service_types.contains_key(service) {
                let of = self.wire.client().service_type(service).ok();
                let of = of.and_then(|of| ros2_service_type(&of));
                service_types.insert(service.clone(), of);
            }
        }
        let mut topics: BTreeMap<&str, SeenTopic> = BTreeMap::new();
        let mut nodes: BTreeSet<String> = BTreeSet::new();
        for (is_publisher, all) in [(true, &last.publishers), (false, &last.subscribers)] {
            for (name, ends) in all {
                let mut ends = ends.clone();
                if !is_publisher && let Some(connected) = self.wire.subscribers_of(name) {
                    // A subscriber that is not connected yet would miss a message.
                    ends.retain(|node| connected.contains(node));
                }
                if ends.is_empty() {
                    continue;
                }
                nodes.extend(ends.iter().cloned());
                let written = last.topic_types.get(name).map_or("*", String::as_str);
                let of = ros2_type(written).unwrap_or_else(|| written.to_owned());
                let topic = topics.entry(name).or_insert_with(|| SeenTopic {
                    name: name.clone(),
                    types: vec![of.clone()],
                    ..SeenTopic::default()
                });
                let ends = ends.into_iter().map(|node| TopicEndpoint {
                    node: Some(node),
                    type_name: of.clone(),
                    type_hash: None,
                    gid: String::new(),
                    qos: Qos { depth: UNKNOWN_DEPTH, ..Qos::reliable(1) },
                });
                if is_publisher {
                    topic.publishers.extend(ends);
                } else {
                    topic.subscriptions.extend(ends);
                }
            }
        }
        let mut services = Vec::new();
        for (name, servers) in &last.services {
            nodes.extend(servers.iter().cloned());
            let types = service_types.get(name).cloned().flatten().into_iter().collect();
            let (name, servers) = (name.clone(), servers.clone());
            services.push(SeenService { name, types, servers, clients: Vec::new() });
        }
        services.sort_by(|a, b| a.name.cmp(&b.name));
        let nodes = nodes.into_iter().map(|name| SeenNode { name });
        Seen { nodes: nodes.collect(), topics: topics.into_values().collect(), services }
    }

    fn progress(&self) -> Progress {
        Progress { changes: self.refresh().changes, incomplete: 0, unanswered: 0 }
    }

    fn wait(&self, timeout: Duration, wanted: &mut dyn FnMut(&Seen) -> bool) -> bool {
        let clock = Stopwatch::start();
        loop {
            if wanted(&self.seen()) {
                return true;
            }
            let rest = timeout.saturating_sub(clock.elapsed());
            if rest.is_zero() {
                return false;
            }
            sleep(POLL_PERIOD.min(rest));
        }
    }

    fn shown_type(&self, type_name: &str) -> String {
        ros1_type(type_name).unwrap_or_else(|| type_name.to_owned())
    }

    fn flush(&self, timeout: Duration) -> bool {
        self.wire.flush(timeout)
    }
}
