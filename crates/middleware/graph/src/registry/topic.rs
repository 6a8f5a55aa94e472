//! One topic: who publishes, who subscribes, who taps, and who does not fit whom.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use periplus_diagnostics::Diagnostic;

use super::TypeOf;
use crate::common::Common;
use crate::info::{
    EndpointInfo, Mismatch, PublisherTraffic, SubscriptionTraffic, TopicInfo, Traffic,
};
use crate::inlet::Inlet;
use crate::outlet::{Outlet, Topic};
use crate::sample::EndpointId;
use crate::tap::{Tap, TapId};
use crate::{Qos, Sample, Unfit};

/// A topic and its ends.
pub(crate) struct TopicEntry {
    pub(super) topic: Arc<Topic>,
    pub(super) type_of: TypeOf,
    /// The node that brought the type.
    pub(super) type_from: Arc<str>,
    pub(super) outlets: Vec<Arc<Outlet>>,
    pub(super) inlets: Vec<Arc<Inlet>>,
    pub(super) taps: Arc<[Arc<Tap>]>,
    /// Pairs whose QoS do not fit, as far as they were reported.
    reported: BTreeSet<(Arc<str>, Arc<str>)>,
}

impl TopicEntry {
    pub(super) fn new(name: Arc<str>, type_of: TypeOf, node: &Arc<str>) -> Self {
        Self {
            topic: Arc::new(Topic { name, sequence: 0.into() }),
            type_of,
            type_from: node.clone(),
            outlets: Vec::new(),
            inlets: Vec::new(),
            taps: Arc::new([]),
            reported: BTreeSet::new(),
        }
    }

    pub(crate) fn outlets(&self) -> &[Arc<Outlet>] {
        &self.outlets
    }

    pub(crate) fn inlets(&self) -> &[Arc<Inlet>] {
        &self.inlets
    }

    pub(super) fn is_used(&self) -> bool {
        !(self.outlets.is_empty() && self.inlets.is_empty())
    }

    /// Adds the taps that want this topic; whether any does.
    pub(super) fn ask(&mut self, taps: &[Arc<Tap>]) -> bool {
        let info = self.info();
        let had: Vec<TapId> = self.taps.iter().map(|tap| tap.id).collect();
        let new = |tap: &&Arc<Tap>| !had.contains(&tap.id) && tap.sink.wants(&info);
        let wanting: Vec<Arc<Tap>> = taps.iter().filter(new).cloned().collect();
        let any = !wanting.is_empty();
        self.taps = self.taps.iter().cloned().chain(wanting).collect();
        any
    }

    /// Tells every outlet who listens; gives what they keep, in the order of publication.
    pub(super) fn connect(&mut self, common: &Common) -> Vec<(Arc<Outlet>, Sample)> {
        self.outlets.sort_by(|a, b| (&a.node, a.id).cmp(&(&b.node, b.id)));
        self.inlets.sort_by(|a, b| (&a.node, a.id).cmp(&(&b.node, b.id)));
        // Only taps look at it, and on topics with many ends it is long.
        let info = if self.taps.is_empty() { Arc::default() } else { Arc::new(self.info()) };
        let mut kept = Vec::new();
        for outlet in &self.outlets {
            let offered = outlet.qos();
            let fits = |inlet: &&Arc<Inlet>| offered.lacks(&inlet.qos()).is_empty();
            let inlets = self.inlets.iter().filter(fits).cloned().collect();
            let samples = outlet.connect(inlets, self.taps.clone(), info.clone());
            kept.extend(samples.into_iter().map(|sample| (outlet.clone(), sample)));
        }
        self.report_mismatches(common);
        kept.sort_by_key(|(_, sample)| sample.sequence);
        kept
    }

    /// Says once for each pair of nodes that nothing will flow between them.
    fn report_mismatches(&mut self, common: &Common) {
        for outlet in &self.outlets {
            for inlet in &self.inlets {
                let unfit = Unfit::between(&outlet.qos(), &inlet.qos());
                let pair = (outlet.node.clone(), inlet.node.clone());
                if unfit.is_empty() || !self.reported.insert(pair) {
                    continue;
                }
                let policies: Vec<String> = unfit.iter().map(ToString::to_string).collect();
                let message = format!(
                    "`{}` gets nothing from `{}` on the topic `{}`: the publisher {}",
                    inlet.node,
                    outlet.node,
                    self.topic.name,
                    policies.join("; ")
                );
                let help = "let the publisher offer more, or the subscription ask for less";
                common.report(Diagnostic::warning("qos-mismatch", message).help(help));
            }
        }
    }

    pub(super) fn info(&self) -> TopicInfo {
        let mismatches = self.outlets.iter().flat_map(|outlet| {
            self.inlets.iter().filter_map(|inlet| {
                let policies = outlet.qos().lacks(&inlet.qos());
                (!policies.is_empty()).then(|| Mismatch {
                    publisher: outlet.node.to_string(),
                    subscription: inlet.node.to_string(),
                    policies,
                })
            })
        });
        TopicInfo {
            name: self.topic.name.to_string(),
            type_name: self.type_of.name.clone(),
            type_hash: self.type_of.hash.clone(),
            publishers: self
                .outlets
                .iter()
                .map(|end| endpoint(end.id, &end.node, end.qos()))
                .collect(),
            subscriptions: self
                .inlets
                .iter()
                .map(|end| endpoint(end.id, &end.node, end.qos()))
                .collect(),
            mismatches: mismatches.collect(),
            taps: self.taps.len(),
        }
    }

    pub(super) fn traffic(&self, now_ns: i64) -> Traffic {
        let publishers = self.outlets.iter().map(|outlet| PublisherTraffic {
            id: outlet.id,
            node: outlet.node.to_string(),
            published: outlet.published.load(Ordering::Relaxed),
            missed_deadlines: outlet.missed_deadlines(),
        });
        let subscriptions = self.inlets.iter().map(|inlet| SubscriptionTraffic {
            id: inlet.id,
            node: inlet.node.to_string(),
            counts: inlet.counts(),
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
