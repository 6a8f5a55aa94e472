//! Queue of received messages behind a subscription.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, OnceLock};

use periplus_diagnostics::Diagnostic;
use periplus_msgs::DecodeError;

use crate::common::{Common, lock};
use crate::event_queue::{Event, EventQueue, Key, Rank};
use crate::parallel::{self, ParallelNamespace};
use crate::publisher_core::missed;
use crate::qos::{History, KEEP_ALL_MAX_MESSAGES, Qos};
use crate::qos_event::ReportedEvents;
use crate::sample::{EndpointId, Sample};

pub(crate) struct SubscriptionCore {
    pub(crate) id: EndpointId,
    pub(crate) node: Arc<str>,
    /// The namespace of the node that runs beside others.
    pub(crate) namespace: Option<Arc<ParallelNamespace>>,
    pub(crate) topic: Arc<str>,
    pub(crate) common: Arc<Common>,
    /// Callback for messages; none if the subscription is polled.
    pub(crate) reaction: Option<Reaction>,
    pub(crate) waiting: Mutex<Waiting>,
    /// Called from the thread of the publisher when a message arrives.
    pub(crate) wake: OnceLock<Box<dyn Fn() + Send + Sync>>,
    /// QoS events already reported.
    pub(crate) reported: Mutex<ReportedEvents>,
}

pub(crate) struct Reaction {
    pub(crate) event_queue: Arc<EventQueue>,
    /// Distinguishes subscriptions of one node to one topic.
    pub(crate) ordinal: u64,
    pub(crate) react: React,
}

/// Handles a sample; fails if it cannot be decoded as its type.
pub(crate) type React = Box<dyn Fn(&Sample) -> Result<(), DecodeError> + Send + Sync>;

#[derive(Default)]
pub(crate) struct Waiting {
    qos: Qos,
    samples: VecDeque<Sample>,
    last_ns: Option<i64>,
    pub(crate) counts: SubscriptionCounts,
}

/// Message counts of a subscription.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SubscriptionCounts {
    /// Messages received.
    pub received: u64,
    /// Received messages that were dropped because the history was full.
    pub dropped: u64,
    /// Received messages that were older than their lifespan when they were read.
    pub stale: u64,
    /// Received messages that could not be decoded.
    pub undecodable: u64,
    /// Deadlines that passed without a message.
    pub missed_deadlines: u64,
}

impl Waiting {
    pub(crate) fn new(qos: Qos) -> Self {
        Self { qos, ..Self::default() }
    }
}

impl SubscriptionCore {
    /// The requested QoS.
    pub(crate) fn qos(&self) -> Qos {
        lock(&self.waiting).qos
    }

    /// Changes the requested QoS. The caller reconnects the topic.
    pub(crate) fn set_qos(&self, qos: Qos) {
        lock(&self.waiting).qos = qos;
    }

    /// Counts so far, including deadlines that have passed by now.
    pub(crate) fn counts(&self) -> SubscriptionCounts {
        let now_ns = self.common.clock.now_ns();
        let waiting = lock(&self.waiting);
        let since =
            waiting.qos.deadline_ns.map(|deadline_ns| missed(waiting.last_ns, now_ns, deadline_ns));
        let missed_deadlines = waiting.counts.missed_deadlines + since.unwrap_or_default();
        SubscriptionCounts { missed_deadlines, ..waiting.counts }
    }

    /// Warns once when a `KEEP_ALL` history overflows.
    fn overflows(&self) {
        let Self { node, topic, .. } = self;
        let message = format!(
            "`{node}` keeps all messages of the topic `{topic}` but does not read them, and loses \
             the oldest: {KEEP_ALL_MAX_MESSAGES} wait"
        );
        let finding = Diagnostic::warning("slow-subscription", message);
        self.common
            .report(finding.help("read the messages more often, or use history `KEEP_LAST`"));
    }

    /// Receives a message of a publisher on this thread.
    pub(crate) fn receive(self: &Arc<Self>, sample: &Sample) {
        // What is polled outside of all namespaces is polled when none runs.
        let is_polled =
            self.namespace.is_none() && self.reaction.is_none() && self.wake.get().is_none();
        if is_polled || parallel::may_change(self.namespace.as_ref()) {
            return self.push(sample);
        }
        let (this, sample) = (self.clone(), sample.clone());
        parallel::after_all(move || this.push(&sample));
    }

    pub(crate) fn push(self: &Arc<Self>, sample: &Sample) {
        let mut waiting = lock(&self.waiting);
        waiting.counts.received += 1;
        if let Some(deadline_ns) = waiting.qos.deadline_ns {
            waiting.counts.missed_deadlines += missed(waiting.last_ns, sample.time_ns, deadline_ns);
            waiting.last_ns = Some(sample.time_ns);
        }
        let oldest = if waiting.samples.len() >= waiting.qos.capacity() {
            waiting.counts.dropped += 1;
            if waiting.qos.history == History::KeepAll && waiting.counts.dropped == 1 {
                self.overflows();
            }
            waiting.samples.pop_front()
        } else {
            None
        };
        waiting.samples.push_back(sample.clone());
        if let Some(reaction) = &self.reaction {
            if let Some(oldest) = &oldest {
                reaction.event_queue.remove(&self.key(reaction, oldest));
            }
            reaction.event_queue.add(self.key(reaction, sample), self.clone());
        }
        drop(waiting);
        if let Some(wake) = self.wake.get() {
            wake();
        }
    }

    fn key(&self, reaction: &Reaction, sample: &Sample) -> Key {
        Key {
            time_ns: sample.time_ns,
            node: self.node.clone(),
            rank: Rank::Message,
            name: self.topic.clone(),
            sequence: sample.sequence,
            ordinal: reaction.ordinal,
        }
    }

    /// Removes and returns all messages, oldest first.
    pub(crate) fn drain(&self) -> VecDeque<Sample> {
        let now_ns = self.common.clock.now_ns();
        let mut waiting = lock(&self.waiting);
        let mut samples = std::mem::take(&mut waiting.samples);
        let before = samples.len();
        samples.retain(|sample| !sample.is_stale(now_ns));
        waiting.counts.stale += (before - samples.len()) as u64;
        samples
    }

    /// Removes and returns the oldest message.
    pub(crate) fn take_oldest(&self) -> Option<Sample> {
        let now_ns = self.common.clock.now_ns();
        let mut waiting = lock(&self.waiting);
        while let Some(sample) = waiting.samples.pop_front() {
            if !sample.is_stale(now_ns) {
                return Some(sample);
            }
            waiting.counts.stale += 1;
        }
        None
    }

    /// True if a message waits.
    pub(crate) fn has_messages(&self) -> bool {
        !lock(&self.waiting).samples.is_empty()
    }

    /// Removes and returns the message with this sequence number.
    fn take(&self, sequence: u64) -> Option<Sample> {
        let now_ns = self.common.clock.now_ns();
        let mut waiting = lock(&self.waiting);
        let index = waiting.samples.iter().position(|sample| sample.sequence == sequence)?;
        let sample = waiting.samples.remove(index)?;
        if sample.is_stale(now_ns) {
            waiting.counts.stale += 1;
            return None;
        }
        Some(sample)
    }

    /// Discards all messages.
    pub(crate) fn withdraw(&self) {
        let samples = std::mem::take(&mut lock(&self.waiting).samples);
        if let Some(reaction) = &self.reaction {
            for sample in &samples {
                reaction.event_queue.remove(&self.key(reaction, sample));
            }
        }
    }

    /// Returns the messages that wait, oldest first; they stay.
    pub(crate) fn pending(&self) -> Vec<Sample> {
        lock(&self.waiting).samples.iter().cloned().collect()
    }

    /// Replaces the messages that wait. The counts do not change.
    pub(crate) fn set_pending(self: &Arc<Self>, samples: &[Sample]) {
        self.withdraw();
        lock(&self.waiting).samples = samples.iter().cloned().collect();
        if let Some(reaction) = &self.reaction {
            for sample in samples {
                reaction.event_queue.add(self.key(reaction, sample), self.clone());
            }
        }
    }

    /// Counts a message that cannot be decoded and warns the first time.
    pub(crate) fn reject(&self, error: &DecodeError) {
        let mut waiting = lock(&self.waiting);
        waiting.counts.undecodable += 1;
        if waiting.counts.undecodable > 1 {
            return;
        }
        drop(waiting);
        let Self { node, topic, .. } = self;
        let finding = Diagnostic::warning(
            "undecodable-message",
            format!("`{node}` cannot decode a message of the topic `{topic}`: {error}"),
        );
        self.common.report(finding.help(
            "the publisher uses another definition of its type; compare both with \
             `ros2 interface show`, and check that both come from the same release",
        ));
    }
}

impl Event for SubscriptionCore {
    fn happen(&self, key: &Key) {
        let (Some(reaction), Some(sample)) = (&self.reaction, self.take(key.sequence)) else {
            return;
        };
        if let Err(error) = (reaction.react)(&sample) {
            self.reject(&error);
        }
    }

    fn forget(&self, key: &Key) {
        if self.take(key.sequence).is_some() {
            lock(&self.waiting).counts.dropped += 1;
        }
    }
}
