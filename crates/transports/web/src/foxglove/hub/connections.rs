//! Connection graph: publishers, subscribers and servers, for clients that subscribe to it.

use std::collections::{BTreeMap, BTreeSet};

use super::mismatches::{Mismatch, mismatches};
use super::{Shared, State};
use crate::foxglove::frame::WebSocketFrame;
use crate::foxglove::protocol::{self, ConnectionGraph};

type Names = BTreeMap<String, BTreeSet<String>>;

/// Topics and services by node.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Connections {
    published: Names,
    subscribed: Names,
    served: Names,
    mismatches: Vec<Mismatch>,
}

impl Connections {
    fn of(shared: &Shared, state: &State) -> Self {
        let mut all = Self::default();
        let topics = shared.graph.topics();
        all.mismatches = mismatches(&topics, &state.network);
        for topic in topics {
            let name = &topic.name;
            for end in topic.publishers {
                all.published.entry(name.clone()).or_default().insert(end.node);
            }
            for end in topic.subscriptions {
                all.subscribed.entry(name.clone()).or_default().insert(end.node);
            }
        }
        for service in shared.graph.services() {
            if let Some(server) = service.server {
                all.served.entry(service.name).or_default().insert(server);
            }
        }
        for topic in &state.network.topics {
            let sides = [
                (&mut all.published, &topic.publishers),
                (&mut all.subscribed, &topic.subscriptions),
            ];
            for (names, ends) in sides {
                let nodes = ends.iter().map(|end| end.node.clone());
                names.entry(topic.name.clone()).or_default().extend(nodes);
            }
        }
        for service in &state.network.services {
            all.served.entry(service.name.clone()).or_default().extend(service.servers.clone());
        }
        for names in [&mut all.published, &mut all.subscribed, &mut all.served] {
            // Nodes that represent remote programs are left out.
            names.values_mut().for_each(|nodes| nodes.retain(|node| !node.starts_with("/_wire")));
            names.retain(|_, nodes| !nodes.is_empty());
        }
        all
    }

    /// Changes since `before`; everything if there is none.
    fn since(&self, before: Option<&Self>) -> WebSocketFrame {
        let is_first = before.is_none();
        let nothing = Self::default();
        let before = before.unwrap_or(&nothing);
        let changed = |now: &Names, before: &Names| -> Names {
            let changed = now.iter().filter(|(name, nodes)| before.get(*name) != Some(nodes));
            changed.map(|(name, nodes)| (name.clone(), nodes.clone())).collect()
        };
        let mut published = changed(&self.published, &before.published);
        let mut subscribed = changed(&self.subscribed, &before.subscribed);
        let mut gone_topics = Vec::new();
        for name in before.published.keys().chain(before.subscribed.keys()) {
            let is_published = self.published.contains_key(name);
            let is_subscribed = self.subscribed.contains_key(name);
            if !is_published && !is_subscribed {
                if !gone_topics.contains(name) {
                    gone_topics.push(name.clone());
                }
            } else if !is_published && before.published.contains_key(name) {
                published.insert(name.clone(), BTreeSet::new());
            } else if !is_subscribed && before.subscribed.contains_key(name) {
                subscribed.insert(name.clone(), BTreeSet::new());
            }
        }
        let gone = before.served.keys().filter(|name| !self.served.contains_key(*name));
        let gone_services: Vec<String> = gone.cloned().collect();
        let served = changed(&self.served, &before.served);
        let is_new = is_first || self.mismatches != before.mismatches;
        protocol::connection_graph(&ConnectionGraph {
            published: &published,
            subscribed: &subscribed,
            served: &served,
            gone_topics: &gone_topics,
            gone_services: &gone_services,
            mismatches: is_new.then_some(&self.mismatches),
        })
    }
}

impl State {
    /// Subscribes a client to the connection graph, or ends that.
    pub(crate) fn want_connections(&mut self, shared: &Shared, client: u64, wants: bool) {
        self.look_at_connections(shared);
        let is_first = !self.clients.values().any(|one| one.wants_connections);
        if wants && is_first {
            self.connections = Connections::of(shared, self);
        }
        let Some(client) = self.clients.get_mut(&client) else { return };
        if wants && !client.wants_connections {
            client.outbox.push(self.connections.since(None));
        }
        client.wants_connections = wants;
    }

    /// Sends changes to the subscribed clients.
    pub(super) fn look_at_connections(&mut self, shared: &Shared) {
        if !self.clients.values().any(|client| client.wants_connections) {
            return;
        }
        let now = Connections::of(shared, self);
        if now == self.connections {
            return;
        }
        let frame = now.since(Some(&self.connections));
        self.connections = now;
        for client in self.clients.values().filter(|client| client.wants_connections) {
            client.outbox.push(frame.clone());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(topic: &str, node: &str) -> Names {
        BTreeMap::from([(topic.to_owned(), BTreeSet::from([node.to_owned()]))])
    }

    #[test]
    fn only_what_changed_is_told() {
        let before = Connections {
            published: one("/a", "/n"),
            subscribed: one("/a", "/m"),
            served: one("/s", "/n"),
            ..Connections::default()
        };
        let now = Connections {
            published: one("/a", "/n"),
            served: one("/t", "/n"),
            ..Connections::default()
        };
        let frame = now.since(Some(&before));
        let said: serde_json::Value = serde_json::from_slice(frame.parts()[0]).expect("JSON");
        assert_eq!(said["publishedTopics"], serde_json::json!([]));
        assert_eq!(
            said["subscribedTopics"],
            serde_json::json!([{"name": "/a", "subscriberIds": []}])
        );
        assert_eq!(
            said["advertisedServices"],
            serde_json::json!([{"name": "/t", "providerIds": ["/n"]}])
        );
        assert_eq!(said["removedServices"], serde_json::json!(["/s"]));
        assert_eq!(said.get("mismatches"), None, "they are as they were");
        let first = now.since(None);
        let said: serde_json::Value = serde_json::from_slice(first.parts()[0]).expect("JSON");
        assert_eq!(said["mismatches"], serde_json::json!([]));
        let none = Connections::default().since(Some(&before));
        let said: serde_json::Value = serde_json::from_slice(none.parts()[0]).expect("JSON");
        assert_eq!(said["removedTopics"], serde_json::json!(["/a"]));
    }
}
