//! Thread of the transport: keeps the endpoints on the network and in the graph in sync.

mod inbox;
mod net;
mod report;
mod services;
mod topics;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use periplus_graph::{Graph, Node};
use periplus_transport::{Own, SteadyClock};
use zenoh::Session;
use zenoh::liveliness::LivelinessToken;

use crate::outgoing::Lane;
use crate::wire::Shared;
use crate::{EntityKind, Settings};

use net::Net;
use report::Told;
use services::Services;
use topics::Topics;

/// Period at which changes of the graph are checked, unless something else wakes the thread.
const LOOK: Duration = Duration::from_millis(25);

pub(crate) struct Link {
    net: Net,
    /// Change counter of the remote tokens at the last check.
    seen: u64,
    attached: Option<Attached>,
}

/// The attached graph.
struct Attached {
    graph: Graph,
    /// The node that represents all remote programs.
    node: Node,
    generation: Option<u64>,
    nodes: BTreeMap<String, LivelinessToken>,
    topics: Topics,
    services: Services,
    told: Told,
    steady: SteadyClock,
}

impl Link {
    pub(crate) fn new(
        session: Session,
        shared: Arc<Shared>,
        lane: Lane,
        settings: &Settings,
    ) -> Self {
        let net = Net::new(session, shared, lane, settings);
        Self { net, seen: 0, attached: None }
    }

    pub(crate) fn run(mut self) {
        while self.net.shared.sleep(LOOK) {
            if let Some((graph, node)) = periplus_transport::lock(&self.net.shared.joining).take() {
                self.attached = Some(Attached {
                    steady: SteadyClock::new(&graph),
                    graph,
                    node,
                    generation: None,
                    nodes: BTreeMap::new(),
                    topics: Topics::default(),
                    services: Services::default(),
                    told: Told::default(),
                });
            }
            self.follow();
        }
    }

    /// Synchronizes the network with the graph, and the graph with the network.
    fn follow(&mut self) {
        let Some(attached) = &mut self.attached else { return };
        let changes = self.net.shared.others(|_, changes| changes);
        let generation = attached.graph.generation();
        let is_new = attached.generation.replace(generation) != Some(generation);
        if is_new {
            attached.sync(&self.net);
        }
        let is_changed = std::mem::replace(&mut self.seen, changes) != changes;
        if is_new || is_changed {
            attached.topics.feed(&self.net, &attached.node);
            attached.services.meet(&self.net, &attached.node);
            attached.told.look(&self.net, &attached.topics);
        }
        attached.topics.take_strangers(&self.net, &attached.node);
        attached.topics.listen(&attached.graph, is_new);
        attached.services.send_questions(&self.net);
        attached.steady.advance();
        attached.told.look_at_traffic(&self.net, &attached.topics);
    }
}

impl Attached {
    /// Creates and removes endpoints to match the graph.
    fn sync(&mut self, net: &Net) {
        let own = Own::of(&self.graph);
        self.nodes.retain(|name, _| own.nodes.contains(name));
        for name in own.nodes {
            if !self.nodes.contains_key(&name)
                && let Some((_, token)) = net.token(EntityKind::Node, &name, None)
            {
                self.nodes.insert(name, token);
            }
        }
        self.topics.sync(net, &own.topics);
        self.services.sync(net, &self.node, &own.services);
    }
}
