//! Topics, services and endpoints of all programs.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::sync::Mutex;

use periplus::graph::Graph;
use periplus_dds::DdsTransport;

use super::backend::Backend;
use crate::work::lock;

/// Kind of names that `RosGraph.topics` and its like lists.
#[derive(Clone, Copy)]
pub(crate) enum Names {
    Topics,
    Services,
}

/// Names of topics or services with their types.
pub(crate) fn live_names(
    graph: &Graph,
    wire: &Mutex<Option<DdsTransport>>,
    which: Names,
) -> Vec<(String, Vec<String>)> {
    let mut all: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let remote = remote(wire);
    match which {
        Names::Topics => {
            for topic in graph.topics() {
                if !topic.publishers.is_empty() || !topic.subscriptions.is_empty() {
                    all.entry(topic.name).or_default().insert(topic.type_name);
                }
            }
            for topic in remote.topics {
                all.entry(topic.name).or_default().extend(topic.type_names);
            }
        }
        Names::Services => {
            for service in graph.services() {
                if service.server.is_some() {
                    all.entry(service.name).or_default().insert(service.type_name);
                }
            }
            for service in remote.services {
                if !service.servers.is_empty() {
                    all.entry(service.name).or_default().extend(service.type_names);
                }
            }
        }
    }
    all.into_iter().map(|(name, types)| (name, types.into_iter().collect())).collect()
}

/// Nodes and endpoints of other programs.
pub(crate) fn remote(wire: &Mutex<Option<DdsTransport>>) -> periplus_dds::Remote {
    lock(wire).as_ref().map(DdsTransport::remote).unwrap_or_default()
}

/// A publisher or subscription of any program.
pub(crate) struct End {
    pub(crate) node: Option<String>,
    pub(crate) type_name: String,
    pub(crate) type_hash: Option<String>,
    pub(crate) gid: Vec<u8>,
    pub(crate) qos: periplus::graph::Qos,
}

/// Publishers or subscriptions of a topic.
///
/// # Errors
/// When the simulation has gone.
pub(crate) fn endpoints(backend: &Backend, topic: &str, publishers: bool) -> io::Result<Vec<End>> {
    match backend {
        Backend::Live { graph, wire, .. } => {
            let mut all = Vec::new();
            let mut is_sent = publishers;
            if let Some(found) = graph.topics().into_iter().find(|it| it.name == topic) {
                // A message before the tap is there would be lost: such subscriptions do not count yet.
                is_sent |= found.taps > 0 || found.publishers.is_empty();
                let ends = if publishers { found.publishers } else { found.subscriptions };
                let own = ends.into_iter().filter(|end| !end.node.starts_with("/_wire_"));
                all.extend(own.map(|end| End {
                    node: Some(end.node),
                    type_name: found.type_name.clone(),
                    type_hash: found.type_hash.clone(),
                    gid: vec![0; 16],
                    qos: end.qos,
                }));
            }
            if let Some(found) = remote(wire).topic(topic).filter(|_| is_sent) {
                let ends = if publishers { &found.publishers } else { &found.subscriptions };
                all.extend(ends.iter().map(|end| End {
                    node: end.node.clone(),
                    type_name: end.type_name.clone(),
                    type_hash: end.type_hash.clone(),
                    gid: end.guid.0.to_vec(),
                    qos: end.qos,
                }));
            }
            Ok(all)
        }
        Backend::Lockstep(client) => {
            let ends = client.endpoints(topic, publishers)?.into_iter();
            Ok(ends
                .map(|end| End {
                    node: Some(end.node),
                    type_name: end.type_name,
                    type_hash: end.type_hash,
                    gid: vec![0; 16],
                    qos: end.qos,
                })
                .collect())
        }
    }
}
