//! Who is there: nodes, topics with their ends, services with theirs, taps.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::Ordering;

use periplus_diagnostics::Diagnostic;

use crate::common::{Common, lock};
use crate::info::{
    EndpointInfo, Mismatch, PublisherTraffic, ServiceInfo, SubscriptionTraffic, TopicInfo, Traffic,
};
use crate::inlet::Inlet;
use crate::outlet::{Outlet, Topic};
use crate::sample::EndpointId;
use crate::service::Server;
use crate::tap::{Sink, Tap, TapId};
use crate::{Durability, GraphError, Qos, Sample, TypeClash};

#[derive(Default)]
pub(crate) struct Registry {
    pub(crate) nodes: BTreeSet<Arc<str>>,
    pub(crate) topics: BTreeMap<Arc<str>, TopicEntry>,
    pub(crate) services: BTreeMap<Arc<str>, ServiceEntry>,
    pub(crate) taps: Vec<Arc<Tap>>,
    next_id: u64,
}

/// The type of a topic or service.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TypeOf {
    pub(crate) name: String,
    pub(crate) hash: Option<String>,
}

pub(crate) struct TopicEntry {
    topic: Arc<Topic>,
    type_of: TypeOf,
    /// The node that brought the type.
    type_from: Arc<str>,
    outlets: Vec<Arc<Outlet>>,
    inlets: Vec<Arc<Inlet>>,
    taps: Arc<[Arc<Tap>]>,
    /// Pairs whose QoS do not fit, as far as they were reported.
    reported: BTreeSet<(Arc<str>, Arc<str>)>,
}

pub(crate) struct ServiceEntry {
    type_of: TypeOf,
    type_from: Arc<str>,
    pub(crate) server: Option<Arc<Server>>,
    clients: Vec<(EndpointId, Arc<str>)>,
}

impl TypeOf {
    /// Refuses another type. A hash counts where both are known.
    fn check(
        &self,
        what: &'static str,
        name: &str,
        from: &str,
        asked: &Self,
        node: &str,
    ) -> Result<(), GraphError> {
        let same_hash = match (&self.hash, &asked.hash) {
            (Some(has), Some(asked)) => has == asked,
            _ => true,
        };
        if self.name == asked.name && same_hash {
            return Ok(());
        }
        let tell = |type_of: &Self| match (&type_of.hash, same_hash) {
            (Some(hash), false) if self.name == asked.name => {
                format!("{} with the hash {hash}", type_of.name)
            }
            _ => type_of.name.clone(),
        };
        Err(GraphError::Type(Box::new(TypeClash {
            what,
            name: name.to_owned(),
            has: tell(self),
            has_node: from.to_owned(),
            asked: tell(asked),
            asked_node: node.to_owned(),
        })))
    }
}

impl Registry {
    pub(crate) fn next_id(&mut self) -> EndpointId {
        self.next_id += 1;
        EndpointId(self.next_id)
    }

    /// The entry of a topic, made or checked.
    fn topic(
        &mut self,
        name: &str,
        type_of: TypeOf,
        node: &Arc<str>,
    ) -> Result<&mut TopicEntry, GraphError> {
        if !self.topics.contains_key(name) {
            let name: Arc<str> = name.into();
            let entry = TopicEntry {
                topic: Arc::new(Topic { name: name.clone(), sequence: 0.into() }),
                type_of: type_of.clone(),
                type_from: node.clone(),
                outlets: Vec::new(),
                inlets: Vec::new(),
                taps: Arc::new([]),
                reported: BTreeSet::new(),
            };
            self.topics.insert(name, entry);
        }
        let entry = self.topics.get_mut(name).expect("it is there by now");
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

    pub(crate) fn add_outlet(
        &mut self,
        node: &Arc<str>,
        name: &str,
        type_of: TypeOf,
        make: impl FnOnce(EndpointId, Arc<Topic>) -> Outlet,
        common: &Common,
    ) -> Result<Arc<Outlet>, GraphError> {
        let id = self.next_id();
        let taps = self.taps.clone();
        let entry = self.topic(name, type_of, node)?;
        let is_new = !entry.is_used();
        let outlet = Arc::new(make(id, entry.topic.clone()));
        entry.outlets.push(outlet.clone());
        if is_new {
            entry.ask(&taps);
        }
        entry.connect(common);
        Ok(outlet)
    }

    pub(crate) fn add_inlet(
        &mut self,
        node: &Arc<str>,
        name: &str,
        type_of: TypeOf,
        make: impl FnOnce(EndpointId, Arc<str>) -> Inlet,
        common: &Common,
    ) -> Result<Arc<Inlet>, GraphError> {
        let id = self.next_id();
        let taps = self.taps.clone();
        let entry = self.topic(name, type_of, node)?;
        let is_new = !entry.is_used();
        let inlet = Arc::new(make(id, entry.topic.name.clone()));
        entry.inlets.push(inlet.clone());
        if is_new {
            entry.ask(&taps);
        }
        let kept = entry.connect(common);
        if inlet.qos.durability == Durability::TransientLocal {
            for (outlet, sample) in kept {
                if outlet.qos.lacks(&inlet.qos).is_empty() {
                    inlet.push(&sample);
                }
            }
        }
        Ok(inlet)
    }

    /// Takes an end out. What comes back must be dropped without the lock: it may own others.
    #[must_use]
    pub(crate) fn remove_outlet(
        &mut self,
        outlet: &Outlet,
        common: &Common,
    ) -> Option<Arc<Outlet>> {
        let entry = self.topics.get_mut(&outlet.topic.name)?;
        let place = entry.outlets.iter().position(|other| other.id == outlet.id)?;
        let gone = entry.outlets.remove(place);
        entry.connect(common);
        gone.connect(Vec::new(), Arc::new([]), Arc::default());
        Some(gone)
    }

    /// As [`Registry::remove_outlet`].
    #[must_use]
    pub(crate) fn remove_inlet(&mut self, inlet: &Inlet, common: &Common) -> Option<Arc<Inlet>> {
        let entry = self.topics.get_mut(&inlet.topic)?;
        let place = entry.inlets.iter().position(|other| other.id == inlet.id)?;
        let gone = entry.inlets.remove(place);
        entry.connect(common);
        Some(gone)
    }

    /// Adds a tap; it gets what the topics keep for latecomers.
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

    #[must_use]
    pub(crate) fn remove_tap(&mut self, id: TapId, common: &Common) -> Option<Arc<Tap>> {
        for entry in self.topics.values_mut() {
            if entry.taps.iter().any(|tap| tap.id == id) {
                entry.taps = entry.taps.iter().filter(|tap| tap.id != id).cloned().collect();
                entry.connect(common);
            }
        }
        let place = self.taps.iter().position(|tap| tap.id == id);
        place.map(|place| self.taps.remove(place))
    }

    /// The entry of a service, made or checked.
    pub(crate) fn service(
        &mut self,
        name: &str,
        type_of: TypeOf,
        node: &Arc<str>,
    ) -> Result<&mut ServiceEntry, GraphError> {
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

impl TopicEntry {
    fn is_used(&self) -> bool {
        !(self.outlets.is_empty() && self.inlets.is_empty())
    }

    /// Adds the taps that want this topic; whether any does.
    fn ask(&mut self, taps: &[Arc<Tap>]) -> bool {
        let info = self.info();
        let had: Vec<TapId> = self.taps.iter().map(|tap| tap.id).collect();
        let new = |tap: &&Arc<Tap>| !had.contains(&tap.id) && tap.sink.wants(&info);
        let wanting: Vec<Arc<Tap>> = taps.iter().filter(new).cloned().collect();
        let any = !wanting.is_empty();
        self.taps = self.taps.iter().cloned().chain(wanting).collect();
        any
    }

    /// Tells every outlet who listens; gives what they keep, in the order of publication.
    fn connect(&mut self, common: &Common) -> Vec<(Arc<Outlet>, Sample)> {
        self.outlets.sort_by(|a, b| (&a.node, a.id).cmp(&(&b.node, b.id)));
        self.inlets.sort_by(|a, b| (&a.node, a.id).cmp(&(&b.node, b.id)));
        let info = Arc::new(self.info());
        let mut kept = Vec::new();
        for outlet in &self.outlets {
            let fits = |inlet: &&Arc<Inlet>| outlet.qos.lacks(&inlet.qos).is_empty();
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
                let lacks = outlet.qos.lacks(&inlet.qos);
                let pair = (outlet.node.clone(), inlet.node.clone());
                if lacks.is_empty() || !self.reported.insert(pair) {
                    continue;
                }
                let policies: Vec<String> = lacks
                    .iter()
                    .map(|policy| {
                        let (offer, asked) =
                            (outlet.qos.spelled(*policy), inlet.qos.spelled(*policy));
                        format!("offers {policy} {offer}, asked for is {asked}")
                    })
                    .collect();
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

    fn info(&self) -> TopicInfo {
        let mismatches = self.outlets.iter().flat_map(|outlet| {
            self.inlets.iter().filter_map(|inlet| {
                let policies = outlet.qos.lacks(&inlet.qos);
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
                .map(|end| endpoint(end.id, &end.node, end.qos))
                .collect(),
            subscriptions: self
                .inlets
                .iter()
                .map(|end| endpoint(end.id, &end.node, end.qos))
                .collect(),
            mismatches: mismatches.collect(),
            taps: self.taps.len(),
        }
    }

    fn traffic(&self, now_ns: i64) -> Traffic {
        let publishers = self.outlets.iter().map(|outlet| PublisherTraffic {
            id: outlet.id,
            node: outlet.node.to_string(),
            published: outlet.published.load(Ordering::Relaxed),
            missed_deadlines: outlet.missed_deadlines(),
        });
        let subscriptions = self.inlets.iter().map(|inlet| SubscriptionTraffic {
            id: inlet.id,
            node: inlet.node.to_string(),
            counts: lock(&inlet.waiting).counts,
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

impl ServiceEntry {
    fn is_used(&self) -> bool {
        self.server.is_some() || !self.clients.is_empty()
    }

    pub(crate) fn set_server(&mut self, server: Arc<Server>) -> Result<(), GraphError> {
        if let Some(other) = &self.server {
            return Err(GraphError::ServerExists {
                service: server.name.to_string(),
                node: other.node.to_string(),
                asked: server.node.to_string(),
            });
        }
        self.server = Some(server);
        Ok(())
    }

    pub(crate) fn add_client(&mut self, id: EndpointId, node: Arc<str>) {
        self.clients.push((id, node));
    }

    pub(crate) fn remove_client(&mut self, id: EndpointId) {
        self.clients.retain(|(other, _)| *other != id);
    }

    fn info(&self, name: &str) -> ServiceInfo {
        let mut clients: Vec<String> =
            self.clients.iter().map(|(_, node)| node.to_string()).collect();
        clients.sort();
        clients.dedup();
        ServiceInfo {
            name: name.to_owned(),
            type_name: self.type_of.name.clone(),
            type_hash: self.type_of.hash.clone(),
            server: self.server.as_ref().map(|server| server.node.to_string()),
            clients,
        }
    }
}
