//! The way of one publisher's messages to all clients that hear them.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use periplus_graph::{Durability, Qos, Reliability, Sample};
use periplus_wire::{Way, lock};

use crate::outbox::{Outbox, Rule};

/// The way of one publisher's messages to all clients that hear them.
pub(crate) struct Outgoing {
    rule: Rule,
    hearers: Mutex<Hearers>,
}

#[derive(Default)]
struct Hearers {
    of: Vec<Hearer>,
    /// For clients that come later, while the topic is listened to.
    kept: VecDeque<Sample>,
}

/// A subscription of a client.
#[derive(Clone)]
pub(crate) struct Hearer {
    pub(crate) client: u64,
    pub(crate) subscription_id: u32,
    pub(crate) outbox: Arc<Outbox>,
}

impl Outgoing {
    pub(crate) fn new(qos: &Qos) -> Self {
        let is_latched = qos.durability == Durability::TransientLocal;
        let may_lose = qos.reliability == Reliability::BestEffort && !is_latched;
        let depth = if may_lose { 1 } else { qos.depth.max(1) };
        Self { rule: Rule { depth, is_latched }, hearers: Mutex::default() }
    }

    /// Another one hears; it gets what is kept.
    pub(crate) fn add(&self, hearer: Hearer) {
        let mut hearers = lock(&self.hearers);
        for sample in &hearers.kept {
            hearer.outbox.offer(hearer.subscription_id, sample, self.rule);
        }
        hearers.of.push(hearer);
    }

    /// It no longer hears.
    pub(crate) fn remove(&self, client: u64, subscription_id: u32) {
        let mut hearers = lock(&self.hearers);
        hearers.of.retain(|one| (one.client, one.subscription_id) != (client, subscription_id));
        if hearers.of.is_empty() {
            // Nobody listens from now on; who comes next gets all of it from the graph.
            hearers.kept.clear();
        }
    }
}

impl Way for Outgoing {
    fn is_wanted(&self) -> bool {
        !lock(&self.hearers).of.is_empty()
    }

    fn push(self: &Arc<Self>, sample: Sample) {
        let mut hearers = lock(&self.hearers);
        if hearers.of.is_empty() {
            return;
        }
        for hearer in &hearers.of {
            hearer.outbox.offer(hearer.subscription_id, &sample, self.rule);
        }
        if self.rule.is_latched {
            if hearers.kept.len() >= self.rule.depth {
                hearers.kept.pop_front();
            }
            hearers.kept.push_back(sample);
        }
    }
}
