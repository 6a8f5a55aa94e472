//! Who is there: nodes, topics with their ends, services with theirs, taps.

mod service;
mod topic;
mod type_of;

use std::collections::BTreeMap;
use std::sync::{Arc, Weak};

use crate::common::Common;
use crate::info::{ServiceInfo, TopicInfo, Traffic};
use crate::inlet::Inlet;
use crate::node::NodeCore;
use crate::outlet::{Outlet, Topic};
use crate::sample::EndpointId;
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
    next_id: u64,
    /// Counts what comes and goes.
    pub(crate) changes: u64,
}

impl Registry {
    pub(crate) fn next_id(&mut self) -> EndpointId {
        self.next_id += 1;
        self.changes += 1;
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
            let entry = TopicEntry::new(name.clone(), type_of.clone(), node);
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
        let qos = inlet.qos();
        if qos.durability == Durability::TransientLocal {
            for (outlet, sample) in kept {
                if outlet.qos().lacks(&qos).is_empty() {
                    inlet.push(&sample);
                }
            }
        }
        Ok(inlet)
    }

    /// Gives an end another QoS; false where there is no such end. A subscription gets what those
    /// publishers keep that did not fit before.
    pub(crate) fn set_qos(&mut self, id: EndpointId, qos: Qos, common: &Common) -> bool {
        for entry in self.topics.values_mut() {
            if let Some(outlet) = entry.outlets.iter().find(|outlet| outlet.id == id) {
                outlet.set_qos(qos);
                entry.connect(common);
                self.changes += 1;
                return true;
            }
            let Some(inlet) = entry.inlets.iter().find(|inlet| inlet.id == id).cloned() else {
                continue;
            };
            let before = inlet.qos();
            inlet.set_qos(qos);
            let kept = entry.connect(common);
            let is_new = |outlet: &Outlet| {
                let offered = outlet.qos();
                !offered.lacks(&before).is_empty() && offered.lacks(&qos).is_empty()
            };
            if qos.durability == Durability::TransientLocal {
                let new = kept.iter().filter(|(outlet, _)| is_new(outlet));
                new.for_each(|(_, sample)| inlet.push(sample));
            }
            self.changes += 1;
            return true;
        }
        false
    }

    /// Takes an end out. What comes back must be dropped without the lock: it may own others.
    #[must_use]
    pub(crate) fn remove_outlet(
        &mut self,
        outlet: &Outlet,
        common: &Common,
    ) -> Option<Arc<Outlet>> {
        self.changes += 1;
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
        self.changes += 1;
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

    /// The types of all topics, services and actions of a node.
    pub(crate) fn types_of(&self, node: &str) -> Vec<TypeOf> {
        let topics = self.topics.values().filter(|entry| {
            let outlet = entry.outlets.iter().any(|outlet| *outlet.node == *node);
            outlet || entry.inlets.iter().any(|inlet| *inlet.node == *node)
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
