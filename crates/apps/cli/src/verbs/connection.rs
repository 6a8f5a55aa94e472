//! ROS 2 network connection of verbs.

use std::path::Path;
use std::time::Duration;

use periplus_dds::{DdsTransport, Remote, RemoteEndpoint, Settings, ports};
use periplus_diagnostics::Diagnostics;
use periplus_graph::Graph;
use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_ros2cli::{Network, Progress, Seen, SeenNode, SeenService, SeenTopic, TopicEndpoint};

/// Network connection and the graph of the command.
pub(crate) struct NetworkConnection {
    // Declared first, so that the network is left before the graph is dropped.
    wire: DdsTransport,
    graph: Graph,
    domain_id: u32,
    findings: Diagnostics,
}

impl NetworkConnection {
    /// Joins the network that the environment selects.
    ///
    /// # Errors
    /// A message when the network cannot be joined.
    pub(crate) fn open() -> Result<Self, String> {
        let (settings, findings) = Settings::from_environment(&Machine);
        let wire = DdsTransport::open(&settings).map_err(|error| error.to_string())?;
        let graph = Graph::live();
        wire.attach(&graph).map_err(|error| error.to_string())?;
        Ok(Self { wire, graph, domain_id: settings.domain_id, findings })
    }

    /// Returns the findings so far.
    pub(crate) fn take_findings(&mut self) -> Diagnostics {
        let mut findings = std::mem::take(&mut self.findings);
        findings.append(self.wire.take_findings());
        findings
    }
}

impl Network for NetworkConnection {
    fn graph(&self) -> &Graph {
        &self.graph
    }

    fn seen(&self) -> Seen {
        seen(&self.wire.remote())
    }

    fn progress(&self) -> Progress {
        let progress = self.wire.progress();
        // Linux alone has this file. Without it no missing participant is known.
        let ports = Machine.read(Path::new("/proc/net/udp")).unwrap_or_default();
        let here = ports::participants(&String::from_utf8_lossy(&ports), self.domain_id);
        Progress {
            changes: progress.changes,
            incomplete: progress.incomplete,
            // This program is one of them.
            unanswered: here.saturating_sub(progress.participants + 1),
        }
    }

    fn wait(&self, timeout: Duration, wanted: &mut dyn FnMut(&Seen) -> bool) -> bool {
        self.wire.wait_for(timeout, |remote| wanted(&seen(remote)))
    }

    fn flush(&self, timeout: Duration) -> bool {
        self.wire.flush(timeout)
    }
}

fn seen(remote: &Remote) -> Seen {
    let end = |end: &RemoteEndpoint| TopicEndpoint {
        node: end.node.clone(),
        type_name: end.type_name.clone(),
        type_hash: end.type_hash.clone(),
        gid: end.guid.to_string(),
        qos: end.qos,
    };
    let topics = remote.topics.iter().map(|topic| SeenTopic {
        name: topic.name.clone(),
        types: topic.type_names.clone(),
        publishers: topic.publishers.iter().map(end).collect(),
        subscriptions: topic.subscriptions.iter().map(end).collect(),
    });
    let services = remote.services.iter().map(|service| SeenService {
        name: service.name.clone(),
        types: service.type_names.clone(),
        servers: service.servers.clone(),
        clients: service.clients.clone(),
    });
    let nodes = remote.nodes.iter().map(|node| SeenNode { name: node.name.clone() });
    Seen { nodes: nodes.collect(), topics: topics.collect(), services: services.collect() }
}
