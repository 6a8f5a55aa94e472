//! Registry of nodes, topics and services with their endpoints, and taps.

mod service;
mod topic;
mod type_of;

use std::collections::BTreeMap;
use std::sync::{Arc, Weak};

use crate::common::Common;
use crate::info::{ServiceInfo, TopicInfo, Traffic};
use crate::interceptor::Interceptor;
use crate::node::NodeCore;
use crate::parallel::{self, ParallelNamespace};
use crate::publisher_core::{PublisherCore, Topic};
use crate::sample::EndpointId;
use crate::subscription_core::SubscriptionCore;
use crate::tap::{Sink, Tap, TapId};
use crate::{Durability, GraphError, Qos, Sample};

use service::ServiceEntry;
pub(crate) use topic::TopicEntry;

pub(crate) use type_of::TypeOf;

#[derive(Default)]
pub(crate) struct Registry {
    pub(crate) nodes: BTreeMap<Arc<str>, Weak<NodeCore>>,
    pub(crate) topics: BTreeMap<Arc<str>, TopicEntry>,
    pub(crate) services: BTreeMap<Arc<str>, ServiceEntry>,
    pub(crate) taps: Vec<Arc<Tap>>,
    pub(crate) interceptor: Option<Arc<dyn Interceptor>>,
    /// Namespaces whose nodes run beside those of others.
    pub(crate) namespaces: Arc<[Arc<ParallelNamespace>]>,
    next_id: u64,
    /// Counts additions and removals.
    pub(crate) changes: u64,
}

impl Registry {
    pub(crate) fn next_id(&mut self) -> EndpointId {
        self.changes += 1;
        if let Some(id) = parallel::next_endpoint() {
            return id;
        }
        self.next_id += 1;
        EndpointId(self.next_id)
    }

    /// The namespace of a node, topic or service that runs beside others.
    pub(crate) fn namespace_of(&self, full_name: &str) -> Option<Arc<ParallelNamespace>> {
        ParallelNamespace::of(&self.namespaces, full_name).cloned()
    }

    /// Returns the entry of a topic after creating it or checking its type.
    fn topic(
        &mut self,
        name: &str,
        type_of: TypeOf,
        node: &Arc<str>,
    ) -> Result<&mut TopicEntry, GraphError> {
        if !self.topics.contains_key(name) {
            let name: Arc<str> = name.into();
            let namespace = self.namespace_of(&name);
            let mut entry = TopicEntry::new(name.clone(), namespace, type_of.clone(), node);
            entry.interceptor.clone_from(&self.interceptor);
            self.topics.insert(name, entry);
        }
        let entry = self.topics.get_mut(name).expect("inserted above");
        if entry.is_used() {
            entry.type_of.check("topic", name, &entry.type_from, &type_of, node)?;
            if entry.type_of.hash.is_none() {
                entry.type_of.hash = type_of.hash;
            }
        } else {
            entry.type_of = type_of;
            entry.type_from = node.clone();
        }
        Ok(entry)
    }

    pub(crate) fn add_publisher(
        &mut self,
        node: &Arc<str>,
        name: &str,
        type_of: TypeOf,
        make: impl FnOnce(EndpointId, Arc<Topic>) -> PublisherCore,
        common: &Common,
    ) -> Result<Arc<PublisherCore>, GraphError> {
        let id = self.next_id();
        let taps = self.taps.clone();
        let entry = self.topic(name, type_of, node)?;
        let is_new = !entry.is_used();
        let publisher = Arc::new(make(id, entry.topic.clone()));
        entry.add_publisher(&publisher, common);
        if is_new && entry.ask(&taps) {
            entry.connect(common);
        }
        Ok(publisher)
    }

    pub(crate) fn add_subscription(
        &mut self,
        node: &Arc<str>,
        name: &str,
        type_of: TypeOf,
        make: impl FnOnce(EndpointId, Arc<str>) -> SubscriptionCore,
        common: &Common,
    ) -> Result<Arc<SubscriptionCore>, GraphError> {
        let id = self.next_id();
        let taps = self.taps.clone();
        let entry = self.topic(name, type_of, node)?;
        let is_new = !entry.is_used();
        let subscription = Arc::new(make(id, entry.topic.name.clone()));
        entry.subscriptions.push(subscription.clone());
        if is_new {
            entry.ask(&taps);
        }
        let kept = entry.connect(common);
        let qos = subscription.qos();
        if qos.durability == Durability::TransientLocal {
            for (publisher, sample) in kept {
                if publisher.qos().incompatible_policies(&qos).is_empty() {
                    subscription.push(&sample);
                }
            }
        }
        Ok(subscription)
    }

    /// Changes the QoS of an endpoint; false if there is no such endpoint. A subscription gets the
    /// retained messages of the publishers that were incompatible before.
    pub(crate) fn set_qos(&mut self, id: EndpointId, qos: Qos, common: &Common) -> bool {
        for entry in self.topics.values_mut() {
            if let Some(publisher) = entry.publishers.iter().find(|publisher| publisher.id == id) {
                publisher.set_qos(qos);
                entry.connect(common);
                self.changes += 1;
                return true;
            }
            let Some(subscription) =
                entry.subscriptions.iter().find(|subscription| subscription.id == id).cloned()
            else {
                continue;
            };
            let before = subscription.qos();
            subscription.set_qos(qos);
            let kept = entry.connect(common);
            let is_new = |publisher: &PublisherCore| {
                let offered = publisher.qos();
                !offered.incompatible_policies(&before).is_empty()
                    && offered.incompatible_policies(&qos).is_empty()
            };
            if qos.durability == Durability::TransientLocal {
                let new = kept.iter().filter(|(publisher, _)| is_new(publisher));
                new.for_each(|(_, sample)| subscription.push(sample));
            }
            self.changes += 1;
            return true;
        }
        false
    }

    /// Removes an endpoint. The returned value must be dropped without the lock: it may own others.
    #[must_use]
    pub(crate) fn remove_publisher(
        &mut self,
        publisher: &PublisherCore,
        common: &Common,
    ) -> Option<Arc<PublisherCore>> {
        self.changes += 1;
        let entry = self.topics.get_mut(&publisher.topic.name)?;
        let gone = entry.remove_publisher(publisher.id, common)?;
        gone.connect(Vec::new(), Arc::new([]), Arc::default(), None);
        Some(gone)
    }

    /// Same as [`Registry::remove_publisher`].
    #[must_use]
    pub(crate) fn remove_subscription(
        &mut self,
        subscription: &SubscriptionCore,
        common: &Common,
    ) -> Option<Arc<SubscriptionCore>> {
        self.changes += 1;
        let entry = self.topics.get_mut(&subscription.topic)?;
        let index = entry.subscriptions.iter().position(|other| other.id == subscription.id)?;
        let gone = entry.subscriptions.remove(index);
        entry.connect(common);
        Some(gone)
    }

    /// Adds a tap; it gets the messages retained for late subscribers.
    pub(crate) fn add_tap(
        &mut self,
        sink: Box<dyn Sink>,
        is_live: bool,
        common: &Common,
    ) -> Arc<Tap> {
        let tap = Arc::new(Tap::new(TapId(self.next_id().0), sink, is_live));
        self.taps.push(tap.clone());
        let mut kept = Vec::new();
        for entry in self.topics.values_mut().filter(|entry| entry.is_used()) {
            if !entry.ask(std::slice::from_ref(&tap)) {
                continue;
            }
            let samples = entry.connect(common);
            let info = Arc::new(entry.info());
            kept.extend(samples.into_iter().map(|(_, sample)| (info.clone(), sample)));
        }
        kept.sort_by(|a, b| {
            let key = |(info, sample): &(Arc<TopicInfo>, Sample)| {
                (sample.time_ns, info.name.clone(), sample.sequence)
            };
            key(a).cmp(&key(b))
        });
        for (info, sample) in kept {
            tap.push(&info, &sample);
        }
        tap
    }

    /// Sets the interceptor of all topics, present and future.
    pub(crate) fn set_interceptor(
        &mut self,
        interceptor: Option<Arc<dyn Interceptor>>,
        common: &Common,
    ) {
        for entry in self.topics.values_mut() {
            entry.interceptor.clone_from(&interceptor);
            entry.connect(common);
        }
        self.interceptor = interceptor;
    }

    #[must_use]
    pub(crate) fn remove_tap(&mut self, id: TapId, common: &Common) -> Option<Arc<Tap>> {
        for entry in self.topics.values_mut() {
            if entry.taps.iter().any(|tap| tap.id == id) {
                entry.taps = entry.taps.iter().filter(|tap| tap.id != id).cloned().collect();
                entry.connect(common);
            }
        }
        let index = self.taps.iter().position(|tap| tap.id == id);
        index.map(|index| self.taps.remove(index))
    }

    /// Returns the entry of a service after creating it or checking its type.
    pub(crate) fn service(
        &mut self,
        name: &str,
        type_of: TypeOf,
        node: &Arc<str>,
    ) -> Result<&mut ServiceEntry, GraphError> {
        self.changes += 1;
        let entry = self.services.entry(name.into()).or_insert_with(|| ServiceEntry {
            type_of: type_of.clone(),
            type_from: node.clone(),
            server: None,
            clients: Vec::new(),
        });
        if entry.is_used() {
            entry.type_of.check("service", name, &entry.type_from, &type_of, node)?;
        } else {
            entry.type_of = type_of;
            entry.type_from = node.clone();
        }
        Ok(entry)
    }

    /// Types of all topics, services and actions of a node.
    pub(crate) fn types_of(&self, node: &str) -> Vec<TypeOf> {
        let topics = self.topics.values().filter(|entry| {
            let publisher = entry.publishers.iter().any(|publisher| *publisher.node == *node);
            publisher || entry.subscriptions.iter().any(|subscription| *subscription.node == *node)
        });
        let services = self.services.values().filter(|entry| entry.is_of(node));
        let services = services.map(|entry| entry.type_of.clone());
        let mut types: Vec<TypeOf> = topics.map(|entry| entry.type_of.clone()).collect();
        for one in services {
            if let Some(action) = one.name.strip_suffix("_SendGoal") {
                types.push(TypeOf { name: action.to_owned(), hash: None });
            }
            types.push(one);
        }
        types
    }

    pub(crate) fn topic_infos(&self) -> Vec<TopicInfo> {
        self.topics.values().filter(|entry| entry.is_used()).map(TopicEntry::info).collect()
    }

    pub(crate) fn service_infos(&self) -> Vec<ServiceInfo> {
        let used = self.services.iter().filter(|(_, entry)| entry.is_used());
        used.map(|(name, entry)| entry.info(name)).collect()
    }

    pub(crate) fn traffic(&self, now_ns: i64) -> Vec<Traffic> {
        let used = self.topics.values().filter(|entry| entry.is_used());
        used.map(|entry| entry.traffic(now_ns)).collect()
    }
}
