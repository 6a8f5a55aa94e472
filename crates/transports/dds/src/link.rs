//! Thread of the transport: handles discovery, receives data, and keeps the DDS endpoints in sync
//! with the graph.

mod net;
mod report;
mod services;
mod topics;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use periplus_cyclonedds_sys::{
    BuiltinTopic, DataReader, DataWriter, DdsDurability, DdsQos, Discovery, Error, Participant,
    WaitToken, Waker,
};
use periplus_graph::{Graph, Node};
use periplus_transport::{Own, SteadyClock, lock};

use crate::entities::{self, Entities, NodeEntities};
use crate::user_data;
use crate::wire::Shared;

use net::Net;
use report::Told;
use services::Services;
use topics::Topics;

/// Period at which changes of the graph are checked \[ns\], unless something else wakes the thread.
const LOOK_NS: i64 = 25_000_000;

const KINDS: [BuiltinTopic; 3] =
    [BuiltinTopic::Participants, BuiltinTopic::Writers, BuiltinTopic::Readers];

pub(crate) struct Link {
    net: Net,
    discoveries: [Discovery; 3],
    /// Tokens of `discoveries` and of `info_reader`.
    discovery_tokens: Vec<WaitToken>,
    info_reader: DataReader,
    info_writer: DataWriter,
    info_written: Vec<u8>,
    /// Change counter of the peers at the last check.
    seen: u64,
    attached: Option<Attached>,
}

/// The attached graph.
struct Attached {
    graph: Graph,
    /// The node that represents all remote participants.
    node: Node,
    generation: Option<u64>,
    /// Full names of the participant's nodes.
    nodes: Vec<String>,
    topics: Topics,
    services: Services,
    told: Told,
    steady: SteadyClock,
}

impl Link {
    pub(crate) fn new(participant: &Participant, shared: Arc<Shared>) -> Result<Self, Error> {
        let net = Net::new(participant.clone(), participant.waitset()?, shared);
        let discover = |kind| participant.discovery(kind);
        let [participants, writers, readers] = KINDS.map(discover);
        let discoveries = [participants?, writers?, readers?];
        let mut discovery_tokens = Vec::new();
        for discovery in &discoveries {
            discovery_tokens.push(net.waitset.watch_discovery(discovery)?);
        }
        let qos = DdsQos {
            durability: DdsDurability::TransientLocal,
            depth: Some(1),
            ..DdsQos::default()
        };
        let said = user_data::type_hash(entities::HASH);
        let (topic, type_name) = (entities::TOPIC, entities::TYPE);
        let info_writer = participant.writer(topic, type_name, &qos, &said)?;
        // All participants write to one instance, and no sample may be lost.
        let all = DdsQos { depth: None, ..qos };
        let info_reader = participant.reader(topic, type_name, &all, &said)?;
        discovery_tokens.push(net.waitset.watch_reader(&info_reader)?);
        let info_written = Vec::new();
        Ok(Self {
            net,
            discoveries,
            discovery_tokens,
            info_reader,
            info_writer,
            info_written,
            seen: 0,
            attached: None,
        })
    }

    pub(crate) fn waker(&self) -> Waker {
        self.net.waitset.waker()
    }

    pub(crate) fn run(mut self) {
        self.tell_nodes();
        while !self.net.shared.is_closing.load(Ordering::Acquire) {
            let tokens = match self.net.waitset.wait(LOOK_NS) {
                Ok(tokens) => tokens,
                Err(error) => {
                    self.net.complain("wire", error.to_string());
                    return;
                }
            };
            if tokens.iter().any(|token| self.discovery_tokens.contains(token)) {
                self.discover();
            }
            if let Some((graph, node)) = lock(&self.net.shared.joining).take() {
                self.attached = Some(Attached::new(graph, node));
            }
            self.follow(&tokens);
        }
    }

    /// Processes discovery samples.
    fn discover(&mut self) {
        let mut peers = lock(&self.net.shared.peers);
        let before = peers.changes();
        for (kind, discovery) in KINDS.into_iter().zip(&self.discoveries) {
            while let Ok(Some(found)) = discovery.take() {
                peers.note(kind, found);
            }
        }
        let mut strange = None;
        while let Ok(Some(sample)) = self.info_reader.take() {
            if !peers.hear(&sample.bytes, sample.vendor) {
                strange = sample.source.map(|source| source.writer);
            }
        }
        let is_changed = peers.changes() != before;
        drop(peers);
        if is_changed {
            self.net.shared.changed.notify_all();
        }
        if let Some(writer) = strange {
            self.net.complain(
                "strange-discovery",
                format!(
                    "a program ({writer}) announces its nodes in a format that no ROS 2 uses; its \
                     nodes are listed without names"
                ),
            );
        }
    }

    /// Synchronizes the endpoints with the graph and receives data.
    fn follow(&mut self, tokens: &[WaitToken]) {
        let Some(attached) = &mut self.attached else { return };
        let changes = lock(&self.net.shared.peers).changes();
        let generation = attached.graph.generation();
        let is_new = attached.generation != Some(generation);
        if is_new {
            attached.generation = Some(generation);
            attached.sync(&self.net);
        }
        let is_changed = std::mem::replace(&mut self.seen, changes) != changes;
        if is_new || is_changed {
            let peers = lock(&self.net.shared.peers);
            attached.topics.feed(&self.net, &attached.node, &peers);
            attached.services.meet(&self.net, &attached.node, &peers);
        }
        attached.topics.take(&self.net, tokens);
        attached.services.take(&self.net, tokens);
        attached.services.answer();
        attached.steady.advance();
        attached.topics.notice(&attached.graph, tokens);
        if is_new || is_changed || attached.told.is_waiting() {
            let peers = lock(&self.net.shared.peers);
            attached.told.look(&self.net, &attached.topics, &peers);
        }
        attached.told.look_at_traffic(&self.net, &attached.topics);
        if is_new || is_changed {
            self.tell_nodes();
        }
    }

    /// Publishes the list of nodes if it has changed.
    fn tell_nodes(&mut self) {
        let participant = self.net.participant.guid().0;
        let nodes = self.attached.as_ref().map_or(Vec::new(), Attached::entities);
        let form = lock(&self.net.shared.peers).form();
        let said = entities::encode(&Entities { participant, nodes }, form);
        if said == self.info_written {
            return;
        }
        match self.info_writer.write(said.clone(), None) {
            Ok(_) => self.info_written = said,
            Err(error) => self.net.complain("wire", error.to_string()),
        }
    }
}

impl Attached {
    fn new(graph: Graph, node: Node) -> Self {
        Self {
            steady: SteadyClock::new(&graph),
            graph,
            node,
            generation: None,
            nodes: Vec::new(),
            topics: Topics::default(),
            services: Services::default(),
            told: Told::default(),
        }
    }

    /// Creates and removes endpoints to match the graph.
    fn sync(&mut self, net: &Net) {
        let own = Own::of(&self.graph);
        self.topics.sync(net, &self.graph, &own.topics);
        self.services.sync(net, &self.node, &own.services);
        self.nodes = own.nodes;
    }

    /// Nodes with their endpoints.
    fn entities(&self) -> Vec<NodeEntities> {
        let mut nodes: BTreeMap<&String, NodeEntities> = self
            .nodes
            .iter()
            .map(|name| (name, NodeEntities { name: name.clone(), ..NodeEntities::default() }))
            .collect();
        let ends = self.topics.ends().chain(self.services.ends());
        for (node, guid, is_writer) in ends {
            let Some(node) = nodes.get_mut(&node.to_owned()) else { continue };
            let ends = if is_writer { &mut node.writers } else { &mut node.readers };
            ends.push(guid.0);
        }
        nodes.into_values().collect()
    }
}
