//! State of a hub.

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
use crate::foxglove::frame::WebSocketFrame;
use crate::foxglove::network_endpoints::NetworkEndpoints;
use crate::foxglove::outgoing::Outgoing;

/// State of a hub.
#[derive(Default)]
pub(crate) struct State {
    next_id: u32,
    next_client: u64,
    generation: Option<u64>,
    told_ns: Option<i64>,
    /// Channels by topic.
    pub(super) channels: BTreeMap<String, Channel>,
    /// Send path of each publisher, with its topic.
    pub(super) ways: BTreeMap<EndpointId, (String, Arc<Outgoing>)>,
    pub(super) taps: Taps<Outgoing>,
    /// Services by name.
    pub(super) services: BTreeMap<String, Offered>,
    pub(super) clients: BTreeMap<u64, Client>,
    /// Calls that wait for their servers.
    pub(super) waiting: Vec<Waiting>,
    /// Connection graph as last sent.
    pub(super) connections: Connections,
    /// Pending parameter requests.
    pub(super) jobs: Jobs,
    /// Subscription to parameter events, while a client needs it.
    pub(super) events: Option<Mailbox<ParameterEvent>>,
    /// Remote endpoints.
    pub(super) network: NetworkEndpoints,
    /// Subscriptions to remote topics that clients use; they make the transport receive these
    /// topics.
    pub(super) heard: BTreeMap<String, RawMailbox>,
    /// True while all remote topics are received for a recording.
    pub(super) records_network: bool,
}

impl State {
    /// Returns an id that was never used.
    pub(super) fn number(&mut self) -> u32 {
        self.next_id += 1;
        self.next_id
    }

    pub(super) fn client_number(&mut self) -> u64 {
        self.next_client += 1;
        self.next_client
    }

    /// Updates everything from the graph.
    pub(super) fn look(&mut self, shared: &Shared) {
        let generation = shared.graph.generation();
        if self.generation.replace(generation) == Some(generation) {
            return;
        }
        self.look_at_topics(shared);
        self.look_at_services(shared);
        self.look_at_connections(shared);
    }

    /// Replaces the remote endpoints.
    pub(super) fn set_network_endpoints(&mut self, shared: &Shared, network: NetworkEndpoints) {
        if self.network != network {
            self.network = network;
            self.generation = None;
            self.look(shared);
        }
    }

    /// Advances pending requests.
    pub(super) fn go_on(&mut self, shared: &Shared) {
        self.go_on_calling();
        self.go_on_with_parameters(shared);
        // The tap receives the messages; the mailboxes are only emptied.
        self.heard.values().for_each(|mailbox| drop(mailbox.drain()));
    }

    pub(super) fn tell_all(&self, frame: &WebSocketFrame) {
        for client in self.clients.values() {
            client.outbox.push(frame.clone());
        }
    }

    /// Sends the time if it has changed.
    pub(super) fn tell_time(&mut self, now_ns: i64) {
        if self.told_ns.replace(now_ns) == Some(now_ns) {
            return;
        }
        for client in self.clients.values() {
            client.outbox.tell_time(now_ns);
        }
    }

    /// Taps exactly the topics that clients subscribe to.
    pub(super) fn listen(&mut self, graph: &Graph) {
        let ways = self.ways.iter().map(|(id, (topic, way))| (topic.as_str(), *id, way));
        self.taps.listen(graph, ways);
    }

    /// Disconnects all clients.
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
