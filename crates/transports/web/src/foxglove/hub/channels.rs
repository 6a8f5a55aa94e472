//! Topics as channels.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use periplus_graph::{EndpointId, TopicInfo};

use super::{Shared, State};
use crate::foxglove::outgoing::{Hearer, Outgoing};
use crate::foxglove::protocol::{self, ChannelText};

/// Message type of maps; the hub makes their updates if no node publishes any.
const MAP: &str = "nav_msgs/msg/OccupancyGrid";
const UPDATE: &str = "map_msgs/msg/OccupancyGridUpdate";

/// A topic as announced to clients.
pub(super) struct Channel {
    id: u32,
    published: Published,
}

/// A published topic.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Published {
    type_name: String,
    /// For updates made by the hub: the topic of the map.
    of: Option<String>,
}

impl Channel {
    fn announce<'a>(&'a self, topic: &'a str) -> ChannelText<'a> {
        ChannelText {
            id: self.id,
            topic,
            encoding: "cdr",
            schema_name: &self.published.type_name,
            schema: protocol::schema_of(&self.published.type_name),
            schema_encoding: "ros2msg",
        }
    }
}

impl State {
    /// All channels in the form in which they are announced.
    pub(super) fn channel_texts(&self) -> Vec<ChannelText<'_>> {
        self.channels.iter().map(|(topic, channel)| channel.announce(topic)).collect()
    }

    /// Topic of a channel.
    pub(super) fn topic_of(&self, channel_id: u32) -> Option<String> {
        let mut channels = self.channels.iter();
        channels.find(|(_, channel)| channel.id == channel_id).map(|(topic, _)| topic.clone())
    }

    /// Updates channels and publishers from the graph and the remote endpoints.
    pub(super) fn look_at_topics(&mut self, shared: &Shared) {
        let topics = shared.graph.topics();
        let published = self.published(&topics);
        self.drop_channels(&published);
        self.add_channels(&published);
        let mut gone: BTreeSet<EndpointId> = self.ways.keys().copied().collect();
        for topic in &topics {
            for end in &topic.publishers {
                if !gone.remove(&end.id) {
                    let way = Arc::new(Outgoing::new(&topic.name, &end.qos));
                    self.hearers_of(&topic.name).into_iter().for_each(|one| way.add(one));
                    self.ways.insert(end.id, (topic.name.clone(), way));
                }
            }
        }
        self.ways.retain(|id, _| !gone.contains(id));
        self.subscribe_to_network(shared);
        self.listen(&shared.graph);
    }

    /// Published topics with their types.
    fn published(&self, topics: &[TopicInfo]) -> BTreeMap<String, Published> {
        let network = self.network.topics.iter().filter(|topic| !topic.publishers.is_empty());
        let network = network.map(|topic| (&topic.name, &topic.type_name));
        let own = topics.iter().filter(|topic| !topic.publishers.is_empty());
        let own = own.map(|topic| (&topic.name, &topic.type_name));
        let mut all: BTreeMap<String, Published> = network
            .chain(own)
            .map(|(name, type_name)| {
                (name.clone(), Published { type_name: type_name.clone(), of: None })
            })
            .collect();
        let maps = all.iter().filter(|(_, one)| one.type_name == MAP);
        let maps: Vec<String> = maps.map(|(name, _)| name.clone()).collect();
        for map in maps {
            let made = Published { type_name: UPDATE.to_owned(), of: Some(map.clone()) };
            all.entry(format!("{map}_updates")).or_insert(made);
        }
        all
    }

    fn drop_channels(&mut self, published: &BTreeMap<String, Published>) {
        let stays = |(topic, channel): &(&String, &Channel)| {
            published.get(*topic).is_some_and(|found| found == &channel.published)
        };
        let gone = self.channels.iter().filter(|one| !stays(one));
        let gone: Vec<(String, u32)> = gone.map(|(topic, one)| (topic.clone(), one.id)).collect();
        if gone.is_empty() {
            return;
        }
        let ids: Vec<u32> = gone.iter().map(|(_, id)| *id).collect();
        self.tell_all(&protocol::unadvertise(&ids));
        for (topic, _) in gone {
            self.channels.remove(&topic);
            self.forget_topic(&topic);
        }
    }

    fn add_channels(&mut self, published: &BTreeMap<String, Published>) {
        let mut new: Vec<&String> = Vec::new();
        for (topic, found) in published {
            if !self.channels.contains_key(topic) {
                let channel = Channel { id: self.number(), published: found.clone() };
                self.channels.insert(topic.clone(), channel);
                new.push(topic);
            }
        }
        if new.is_empty() {
            return;
        }
        let texts = new.iter().map(|topic| self.channels[*topic].announce(topic));
        let texts: Vec<ChannelText<'_>> = texts.collect();
        self.tell_all(&protocol::advertise(&texts));
    }

    /// Topic of the updates that the hub makes for a map.
    pub(super) fn updates_of(&self, map: &str) -> Option<String> {
        let name = format!("{map}_updates");
        let of = self.channels.get(&name)?.published.of.as_deref();
        (of == Some(map)).then_some(name)
    }

    /// Subscribes the graph to the remote topics that clients use.
    pub(super) fn subscribe_to_network(&mut self, shared: &Shared) {
        let hears = |topic: &str| {
            let mut clients = self.clients.values();
            self.records_network
                || clients.any(|client| client.subscriptions.values().any(|heard| heard == topic))
        };
        let wanted = self.network.topics.iter();
        let wanted = wanted.filter(|topic| !topic.publishers.is_empty() && hears(&topic.name));
        let mut heard = BTreeMap::new();
        for topic in wanted {
            let (hash, qos) = (topic.type_hash.as_deref(), topic.wanted());
            let mailbox = match self.heard.remove(&topic.name) {
                // The offers may have changed.
                Some(mailbox) => {
                    if mailbox.qos() != qos {
                        shared.graph.set_qos(mailbox.id(), qos);
                    }
                    Some(mailbox)
                }
                None => shared.node.raw_mailbox(&topic.name, &topic.type_name, hash, qos).ok(),
            };
            heard.extend(mailbox.map(|mailbox| (topic.name.clone(), mailbox)));
        }
        self.heard = heard;
    }

    /// Subscribes to all remote topics while the graph is recorded.
    pub(super) fn record_network(&mut self, shared: &Shared, is_recording: bool) {
        if self.records_network != is_recording {
            self.records_network = is_recording;
            self.subscribe_to_network(shared);
        }
    }

    /// Subscriptions of clients to a topic.
    fn hearers_of(&self, topic: &str) -> Vec<Hearer> {
        let of_client = |(id, client): (&u64, &super::clients::Client)| {
            let heard = client.subscriptions.iter().filter(|(_, heard)| *heard == topic);
            let (client_id, outbox) = (*id, client.outbox.clone());
            heard
                .map(|(subscription_id, _)| Hearer {
                    client: client_id,
                    subscription_id: *subscription_id,
                    outbox: outbox.clone(),
                })
                .collect::<Vec<_>>()
        };
        self.clients.iter().flat_map(of_client).collect()
    }
}
