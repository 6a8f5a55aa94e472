//! What a hub knows.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_graph::{EndpointId, Graph, Mailbox, RawMailbox};
use periplus_msgs::rcl_interfaces::ParameterEvent;
use periplus_transport::Taps;

use super::Shared;
use super::calls::Waiting;
use super::channels::Channel;
use super::clients::Client;
use super::connections::Connections;
use super::parameters::Jobs;
use super::services::Offered;
use crate::foxglove::far::Far;
use crate::foxglove::frame::Frame;
use crate::foxglove::outgoing::Outgoing;

/// What a hub knows.
#[derive(Default)]
pub(crate) struct State {
    next_id: u32,
    next_client: u64,
    generation: Option<u64>,
    told_ns: Option<i64>,
    /// By topic.
    pub(super) channels: BTreeMap<String, Channel>,
    /// The way of each publisher, with its topic.
    pub(super) ways: BTreeMap<EndpointId, (String, Arc<Outgoing>)>,
    pub(super) taps: Taps<Outgoing>,
    /// By name.
    pub(super) services: BTreeMap<String, Offered>,
    pub(super) clients: BTreeMap<u64, Client>,
    /// Calls that wait for who answers them.
    pub(super) waiting: Vec<Waiting>,
    /// What who wants to know was told last.
    pub(super) connections: Connections,
    /// Wishes about parameters.
    pub(super) jobs: Jobs,
    /// Changes of parameters, while somebody wants to hear of them.
    pub(super) events: Option<Mailbox<ParameterEvent>>,
    /// What others have on a network.
    pub(super) far: Far,
    /// Topics of others that somebody hears: what makes the network bring them.
    pub(super) heard: BTreeMap<String, RawMailbox>,
}

impl State {
    /// A number that was never used.
    pub(super) fn number(&mut self) -> u32 {
        self.next_id += 1;
        self.next_id
    }

    pub(super) fn client_number(&mut self) -> u64 {
        self.next_client += 1;
        self.next_client
    }

    /// Looks what came and went in the graph.
    pub(super) fn look(&mut self, shared: &Shared) {
        let generation = shared.graph.generation();
        if self.generation.replace(generation) == Some(generation) {
            return;
        }
        self.look_at_topics(shared);
        self.look_at_services(shared);
        self.look_at_connections(shared);
    }

    /// What others have is other than it was.
    pub(super) fn set_far(&mut self, shared: &Shared, far: Far) {
        if self.far != far {
            self.far = far;
            self.generation = None;
            self.look(shared);
        }
    }

    /// Goes on with what clients asked for.
    pub(super) fn go_on(&mut self, shared: &Shared) {
        self.go_on_calling();
        self.go_on_with_parameters(shared);
        // Nobody reads them here: the tap has what they bring.
        self.heard.values().for_each(|mailbox| drop(mailbox.drain()));
    }

    pub(super) fn tell_all(&self, frame: &Frame) {
        for client in self.clients.values() {
            client.outbox.push(frame.clone());
        }
    }

    /// Tells the time where it is another.
    pub(super) fn tell_time(&mut self, now_ns: i64) {
        if self.told_ns.replace(now_ns) == Some(now_ns) {
            return;
        }
        for client in self.clients.values() {
            client.outbox.tell_time(now_ns);
        }
    }

    /// Listens to what clients hear, and to nothing else.
    pub(super) fn listen(&mut self, graph: &Graph) {
        let ways = self.ways.iter().map(|(id, (topic, way))| (topic.as_str(), *id, way));
        self.taps.listen(graph, ways);
    }

    /// All is over.
    pub(super) fn end(&mut self, graph: &Graph) {
        for client in self.clients.values() {
            client.outbox.end("the run is over");
        }
        self.ways.clear();
        self.listen(graph);
        self.services.clear();
        self.heard.clear();
        self.waiting.clear();
        self.events = None;
    }
}
