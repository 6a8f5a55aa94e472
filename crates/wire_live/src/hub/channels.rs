//! Topics as channels.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use periplus_graph::{EndpointId, TopicInfo};

use super::{Shared, State};
use crate::outgoing::{Hearer, Outgoing};
use crate::protocol::{self, ChannelText};

/// A topic that somebody publishes.
pub(super) struct Channel {
    id: u32,
    type_name: String,
}

impl Channel {
    fn announce<'a>(&'a self, topic: &'a str) -> ChannelText<'a> {
        ChannelText {
            id: self.id,
            topic,
            encoding: "cdr",
            schema_name: &self.type_name,
            schema: protocol::schema_of(&self.type_name),
            schema_encoding: "ros2msg",
        }
    }
}

impl State {
    /// All channels, as they are announced.
    pub(super) fn channel_texts(&self) -> Vec<ChannelText<'_>> {
        self.channels.iter().map(|(topic, channel)| channel.announce(topic)).collect()
    }

    /// The topic of a channel.
    pub(super) fn topic_of(&self, channel_id: u32) -> Option<String> {
        let mut channels = self.channels.iter();
        channels.find(|(_, channel)| channel.id == channel_id).map(|(topic, _)| topic.clone())
    }

    /// Channels and publishers as the graph has them.
    pub(super) fn look_at_topics(&mut self, shared: &Shared) {
        let topics = shared.graph.topics();
        let published = topics.iter().filter(|topic| !topic.publishers.is_empty());
        let published: BTreeMap<&str, &TopicInfo> =
            published.map(|topic| (topic.name.as_str(), topic)).collect();
        self.drop_channels(&published);
        self.add_channels(&published);
        let mut gone: BTreeSet<EndpointId> = self.ways.keys().copied().collect();
        for topic in published.values() {
            for end in &topic.publishers {
                if !gone.remove(&end.id) {
                    let way = Arc::new(Outgoing::new(&end.qos));
                    self.hearers_of(&topic.name).into_iter().for_each(|one| way.add(one));
                    self.ways.insert(end.id, (topic.name.clone(), way));
                }
            }
        }
        self.ways.retain(|id, _| !gone.contains(id));
        self.listen(&shared.graph);
    }

    fn drop_channels(&mut self, published: &BTreeMap<&str, &TopicInfo>) {
        let stays = |(topic, channel): &(&String, &Channel)| {
            published.get(topic.as_str()).is_some_and(|info| info.type_name == channel.type_name)
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

    fn add_channels(&mut self, published: &BTreeMap<&str, &TopicInfo>) {
        let mut new: Vec<&str> = Vec::new();
        for (topic, info) in published {
            if !self.channels.contains_key(*topic) {
                let channel = Channel { id: self.number(), type_name: info.type_name.clone() };
                self.channels.insert((*topic).to_owned(), channel);
                new.push(topic);
            }
        }
        if new.is_empty() {
            return;
        }
        let texts: Vec<ChannelText<'_>> =
            new.iter().map(|topic| self.channels[*topic].announce(topic)).collect();
        self.tell_all(&protocol::advertise(&texts));
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
