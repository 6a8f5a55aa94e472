//! Clients and their subscriptions.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::parameters::Followed;
use super::{Shared, State};
use crate::foxglove::outbox::Outbox;
use crate::foxglove::outgoing::Hearer;
use crate::foxglove::protocol::{self, ChannelSubscription};

/// A client.
pub(crate) struct Client {
    pub(super) outbox: Arc<Outbox>,
    /// Topic of each subscription.
    pub(super) subscriptions: BTreeMap<u32, String>,
    pub(super) wants_connections: bool,
    pub(super) followed: Followed,
}

impl State {
    /// Adds a client and sends it the server info and all announcements.
    pub(super) fn join(&mut self, shared: &Shared, outbox: &Arc<Outbox>) -> Option<u64> {
        let settings = &shared.settings;
        if self.clients.len() >= settings.limits.clients {
            return None;
        }
        outbox.push(protocol::server_info(
            &settings.name,
            &settings.session_id,
            &settings.metadata,
            shared.recordings.get().is_some(),
        ));
        outbox.push(protocol::advertise(&self.channel_texts()));
        outbox.push(protocol::advertise_services(&self.service_texts()));
        outbox.tell_time(shared.graph.now_ns());
        let id = self.client_number();
        let client = Client {
            outbox: outbox.clone(),
            subscriptions: BTreeMap::new(),
            wants_connections: false,
            followed: Followed::default(),
        };
        self.clients.insert(id, client);
        Some(id)
    }

    /// Removes a client.
    pub(crate) fn leave(&mut self, shared: &Shared, id: u64) {
        let Some(client) = self.clients.remove(&id) else { return };
        for (subscription_id, topic) in &client.subscriptions {
            self.stop(id, *subscription_id, topic);
        }
        self.forget_events();
        self.subscribe_to_network(shared);
        self.listen(&shared.graph);
    }

    /// Subscribes a client to channels. Failures are sent to the client.
    pub(crate) fn subscribe(
        &mut self,
        shared: &Shared,
        client: u64,
        wanted: &[ChannelSubscription],
    ) -> Vec<String> {
        let mut refused = Vec::new();
        for one in wanted {
            let Some(topic) = self.topic_of(one.channel_id) else {
                refused.push(format!("there is no channel {}", one.channel_id));
                continue;
            };
            let Some(known) = self.clients.get_mut(&client) else { continue };
            if known.subscriptions.contains_key(&one.id) {
                refused.push(format!("subscription {} is in use", one.id));
                continue;
            }
            if known.subscriptions.len() >= shared.settings.limits.entries {
                refused.push("there are too many subscriptions".to_owned());
                break;
            }
            known.outbox.open(one.id);
            known.subscriptions.insert(one.id, topic.clone());
            let hearer = Hearer { client, subscription_id: one.id, outbox: known.outbox.clone() };
            for (of, way) in self.ways.values() {
                if *of == topic {
                    way.add(hearer.clone());
                }
            }
        }
        self.pair(client);
        self.subscribe_to_network(shared);
        self.listen(&shared.graph);
        refused
    }

    /// Ends subscriptions of a client.
    pub(crate) fn unsubscribe(&mut self, shared: &Shared, client: u64, ids: &[u32]) {
        for id in ids {
            let Some(known) = self.clients.get_mut(&client) else { return };
            let Some(topic) = known.subscriptions.remove(id) else { continue };
            known.outbox.shut(*id);
            self.stop(client, *id, &topic);
        }
        self.pair(client);
        self.subscribe_to_network(shared);
        self.listen(&shared.graph);
    }

    fn stop(&self, client: u64, subscription_id: u32, topic: &str) {
        for (of, way) in self.ways.values() {
            if of == topic {
                way.remove(client, subscription_id);
            }
        }
    }

    /// A client that subscribes to a map and its updates gets the map once, then only updates.
    fn pair(&self, client: u64) {
        let Some(client) = self.clients.get(&client) else { return };
        for (id, topic) in &client.subscriptions {
            let updates = self.updates_of(topic);
            let mut others = client.subscriptions.iter();
            let other = updates.and_then(|updates| others.find(|(_, other)| **other == updates));
            client.outbox.pair(*id, other.map(|(id, _)| *id));
        }
    }

    /// Removes a topic with all its subscriptions.
    pub(super) fn forget_topic(&mut self, topic: &str) {
        for client in self.clients.values_mut() {
            let outbox = &client.outbox;
            client.subscriptions.retain(|id, heard| {
                let stays = heard != topic;
                if !stays {
                    outbox.shut(*id);
                }
                stays
            });
        }
    }
}
