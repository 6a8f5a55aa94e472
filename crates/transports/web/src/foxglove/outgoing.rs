//! Send path of a publisher to its clients.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use periplus_graph::{Durability, Qos, Reliability, Sample};
use periplus_msgs::Message as _;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_transport::{Way, lock};

use crate::foxglove::frame::WebSocketFrame;
use crate::foxglove::outbox::{Outbox, Rule};
use crate::foxglove::protocol;
use crate::foxglove::recent_frames::RecentFrames;

/// The topic of dynamic transforms. The newest ones are kept for late clients, which could draw
/// nothing while time is paused without them.
const TRANSFORMS: &str = "/tf";

/// Send path of a publisher to its clients.
pub(crate) struct Outgoing {
    rule: Rule,
    hearers: Mutex<Hearers>,
}

#[derive(Default)]
struct Hearers {
    of: Vec<Hearer>,
    /// Messages retained for late clients while the topic is tapped.
    kept: VecDeque<Sample>,
    /// The newest transforms, for `/tf`.
    frames: Option<RecentFrames>,
}

/// A client's subscription.
#[derive(Clone)]
pub(crate) struct Hearer {
    pub(crate) client: u64,
    pub(crate) subscription_id: u32,
    pub(crate) outbox: Arc<Outbox>,
}

impl Outgoing {
    pub(crate) fn new(topic: &str, qos: &Qos) -> Self {
        let is_latched = qos.durability == Durability::TransientLocal;
        let may_lose = qos.reliability == Reliability::BestEffort && !is_latched;
        let depth = if may_lose { 1 } else { qos.depth.max(1) };
        let frames = (topic == TRANSFORMS).then(RecentFrames::default);
        let hearers = Mutex::new(Hearers { frames, ..Hearers::default() });
        Self { rule: Rule { depth, is_latched }, hearers }
    }

    /// Adds a subscription; it gets the retained messages.
    pub(crate) fn add(&self, hearer: Hearer) {
        let mut hearers = lock(&self.hearers);
        for sample in &hearers.kept {
            hearer.outbox.offer(hearer.subscription_id, sample, self.rule);
        }
        let frames = hearers.frames.as_ref().and_then(RecentFrames::message);
        if let Some(message) = frames
            && let Ok(cdr) = message.to_cdr()
        {
            let time_ns = message.transforms.iter().map(|one| one.header.stamp.ns()).max();
            let mut bytes =
                protocol::message_head(hearer.subscription_id, time_ns.unwrap_or_default());
            bytes.extend(cdr);
            hearer.outbox.push(WebSocketFrame::binary(bytes));
        }
        hearers.of.push(hearer);
    }

    /// Removes a subscription.
    pub(crate) fn remove(&self, client: u64, subscription_id: u32) {
        let mut hearers = lock(&self.hearers);
        hearers.of.retain(|one| (one.client, one.subscription_id) != (client, subscription_id));
        if hearers.of.is_empty() {
            // The tap ends; the next subscriber gets the retained messages from the graph.
            hearers.kept.clear();
        }
    }
}

impl Way for Outgoing {
    fn is_wanted(&self) -> bool {
        let hearers = lock(&self.hearers);
        hearers.frames.is_some() || !hearers.of.is_empty()
    }

    fn push(self: &Arc<Self>, sample: Sample) {
        let mut hearers = lock(&self.hearers);
        if let Some(frames) = &mut hearers.frames
            && let Ok(message) = sample.message::<TFMessage>()
        {
            frames.add(&message);
        }
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
