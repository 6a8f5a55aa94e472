//! A topic with its publishers, subscriptions and taps.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use periplus_diagnostics::Diagnostic;

use super::TypeOf;
use crate::common::Common;
use crate::info::{
    EndpointInfo, PublisherTraffic, QosMismatch, SubscriptionTraffic, TopicInfo, Traffic,
};
use crate::interceptor::Interceptor;
use crate::parallel::ParallelNamespace;
use crate::publisher_core::{PublisherCore, Topic};
use crate::sample::EndpointId;
use crate::subscription_core::SubscriptionCore;
use crate::tap::{Tap, TapId};
use crate::{IncompatiblePolicy, Qos, Sample};

/// A topic and its endpoints.
pub(crate) struct TopicEntry {
    pub(super) topic: Arc<Topic>,
    pub(super) type_of: TypeOf,
    /// The node that defined the type.
    pub(super) type_from: Arc<str>,
    pub(super) publishers: Vec<Arc<PublisherCore>>,
    pub(super) subscriptions: Vec<Arc<SubscriptionCore>>,
    pub(super) taps: Arc<[Arc<Tap>]>,
    pub(super) interceptor: Option<Arc<dyn Interceptor>>,
    /// Incompatible pairs that were reported.
    reported: BTreeSet<(Arc<str>, Arc<str>)>,
}

impl TopicEntry {
    pub(super) fn new(
        name: Arc<str>,
        namespace: Option<Arc<ParallelNamespace>>,
        type_of: TypeOf,
        node: &Arc<str>,
    ) -> Self {
        Self {
            topic: Arc::new(Topic { name, namespace, sequence: 0.into() }),
            type_of,
            type_from: node.clone(),
            publishers: Vec::new(),
            subscriptions: Vec::new(),
            taps: Arc::new([]),
            interceptor: None,
            reported: BTreeSet::new(),
        }
    }

    pub(crate) fn publishers(&self) -> &[Arc<PublisherCore>] {
        &self.publishers
    }

    pub(crate) fn subscriptions(&self) -> &[Arc<SubscriptionCore>] {
        &self.subscriptions
    }

    pub(super) fn is_used(&self) -> bool {
        !(self.publishers.is_empty() && self.subscriptions.is_empty())
    }

    /// Adds the taps that want this topic; true if any does.
    pub(super) fn ask(&mut self, taps: &[Arc<Tap>]) -> bool {
        let info = self.info();
        let had: Vec<TapId> = self.taps.iter().map(|tap| tap.id).collect();
        let new = |tap: &&Arc<Tap>| !had.contains(&tap.id) && tap.sink.wants(&info);
        let wanting: Vec<Arc<Tap>> = taps.iter().filter(new).cloned().collect();
        let any = !wanting.is_empty();
        self.taps = self.taps.iter().cloned().chain(wanting).collect();
        any
    }

    /// Adds a publisher. The others need to know it only if a tap or an interceptor has a description of the topic.
    pub(super) fn add_publisher(&mut self, publisher: &Arc<PublisherCore>, common: &Common) {
        let is_before =
            |it: &Arc<PublisherCore>| (&it.node, it.id) < (&publisher.node, publisher.id);
        let index = self.publishers.partition_point(is_before);
        self.publishers.insert(index, publisher.clone());
        if self.is_described() {
            self.connect(common);
        } else {
            self.connect_publisher(publisher, &Arc::default(), None);
            let subscriptions = self.subscriptions.clone();
            for subscription in &subscriptions {
                self.report_mismatch(publisher, subscription, common);
            }
        }
    }

    /// Removes a publisher.
    pub(super) fn remove_publisher(
        &mut self,
        id: EndpointId,
        common: &Common,
    ) -> Option<Arc<PublisherCore>> {
        let index = self.publishers.iter().position(|other| other.id == id)?;
        let gone = self.publishers.remove(index);
        if self.is_described() {
            self.connect(common);
        }
        Some(gone)
    }

    /// True if a tap or an interceptor has a description of the topic, which is long if there are many endpoints.
    fn is_described(&self) -> bool {
        !self.taps.is_empty() || self.interceptor.is_some()
    }

    /// Updates the connections of every publisher; returns the retained messages in the order of
    /// publication.
    pub(super) fn connect(&mut self, common: &Common) -> Vec<(Arc<PublisherCore>, Sample)> {
        self.publishers.sort_by(|a, b| (&a.node, a.id).cmp(&(&b.node, b.id)));
        self.subscriptions.sort_by(|a, b| (&a.node, a.id).cmp(&(&b.node, b.id)));
        let info = if self.is_described() { Arc::new(self.info()) } else { Arc::default() };
        let interceptor = self.interceptor.as_ref().filter(|it| it.wants(&info));
        let mut kept = Vec::new();
        for publisher in &self.publishers {
            let samples = self.connect_publisher(publisher, &info, interceptor);
            kept.extend(samples.into_iter().map(|sample| (publisher.clone(), sample)));
        }
        let (publishers, subscriptions) = (self.publishers.clone(), self.subscriptions.clone());
        for publisher in &publishers {
            for subscription in &subscriptions {
                self.report_mismatch(publisher, subscription, common);
            }
        }
        kept.sort_by_key(|(_, sample)| sample.sequence);
        kept
    }

    /// Updates the connections of a publisher; returns its retained messages.
    fn connect_publisher(
        &self,
        publisher: &PublisherCore,
        info: &Arc<TopicInfo>,
        interceptor: Option<&Arc<dyn Interceptor>>,
    ) -> Vec<Sample> {
        let offered = publisher.qos();
        let fits = |subscription: &&Arc<SubscriptionCore>| {
            offered.incompatible_policies(&subscription.qos()).is_empty()
        };
        let subscriptions = self.subscriptions.iter().filter(fits).cloned().collect();
        publisher.connect(subscriptions, self.taps.clone(), info.clone(), interceptor.cloned())
    }

    /// Reports an incompatible pair of nodes once.
    fn report_mismatch(
        &mut self,
        publisher: &PublisherCore,
        subscription: &SubscriptionCore,
        common: &Common,
    ) {
        let unfit = IncompatiblePolicy::between(&publisher.qos(), &subscription.qos());
        let pair = (publisher.node.clone(), subscription.node.clone());
        if unfit.is_empty() || !self.reported.insert(pair) {
            return;
        }
        let policies: Vec<String> = unfit.iter().map(ToString::to_string).collect();
        let message = format!(
            "`{}` receives nothing from `{}` on the topic `{}`: the publisher {}",
            subscription.node,
            publisher.node,
            self.topic.name,
            policies.join("; ")
        );
        let help = "make the QoS of the publisher stronger, or that of the subscription weaker";
        common.report(Diagnostic::warning("qos-mismatch", message).help(help));
    }

    pub(crate) fn is_subscribed(&self) -> bool {
        !self.subscriptions.is_empty()
    }

    pub(super) fn info(&self) -> TopicInfo {
        let mismatches = self.publishers.iter().flat_map(|publisher| {
            self.subscriptions.iter().filter_map(|subscription| {
                let policies = publisher.qos().incompatible_policies(&subscription.qos());
                (!policies.is_empty()).then(|| QosMismatch {
                    publisher: publisher.node.to_string(),
                    subscription: subscription.node.to_string(),
                    policies,
                })
            })
        });
        TopicInfo {
            name: self.topic.name.to_string(),
            type_name: self.type_of.name.clone(),
            type_hash: self.type_of.hash.clone(),
            publishers: self
                .publishers
                .iter()
                .map(|end| endpoint(end.id, &end.node, end.qos()))
                .collect(),
            subscriptions: self
                .subscriptions
                .iter()
                .map(|end| endpoint(end.id, &end.node, end.qos()))
                .collect(),
            mismatches: mismatches.collect(),
            taps: self.taps.len(),
        }
    }

    pub(super) fn traffic(&self, now_ns: i64) -> Traffic {
        let publishers = self.publishers.iter().map(|publisher| PublisherTraffic {
            id: publisher.id,
            node: publisher.node.to_string(),
            published: publisher.published.load(Ordering::Relaxed),
            missed_deadlines: publisher.missed_deadlines(),
        });
        let subscriptions = self.subscriptions.iter().map(|subscription| SubscriptionTraffic {
            id: subscription.id,
            node: subscription.node.to_string(),
            counts: subscription.counts(),
        });
        Traffic {
            topic: self.topic.name.to_string(),
            time_ns: now_ns,
            published: self.topic.sequence.load(Ordering::Relaxed),
            publishers: publishers.collect(),
            subscriptions: subscriptions.collect(),
        }
    }
}

fn endpoint(id: EndpointId, node: &str, qos: Qos) -> EndpointInfo {
    EndpointInfo { id, node: node.to_owned(), qos }
}
