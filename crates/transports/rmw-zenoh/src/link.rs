//! The thread of a wire: keeps the ends on the network as the graph has them, and lets what others
//! have stand in the graph.

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
use crate::{Kind, Settings};

use net::Net;
use report::Told;
use services::Services;
use topics::Topics;

/// How often it looks what has changed in the graph, if nothing else wakes it.
const LOOK: Duration = Duration::from_millis(25);

pub(crate) struct Link {
    net: Net,
    /// Changes of the others that were looked at.
    seen: u64,
    attached: Option<Attached>,
}

/// A graph that takes part.
struct Attached {
    graph: Graph,
    /// The node that stands for all others.
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

    /// Keeps the network as the graph is, and the graph as the network is.
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
    /// Makes and drops ends as the graph has them.
    fn sync(&mut self, net: &Net) {
        let own = Own::of(&self.graph);
        self.nodes.retain(|name, _| own.nodes.contains(name));
        for name in own.nodes {
            if !self.nodes.contains_key(&name)
                && let Some((_, token)) = net.token(Kind::Node, &name, None)
            {
                self.nodes.insert(name, token);
            }
        }
        self.topics.sync(net, &own.topics);
        self.services.sync(net, &self.node, &own.services);
    }
}
