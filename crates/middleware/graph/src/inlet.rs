//! The end of a subscription: the messages that wait for it.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use periplus_diagnostics::Diagnostic;
use periplus_msgs::DecodeError;

use crate::agenda::{Agenda, Event, Key, Rank};
use crate::common::{Common, lock};
use crate::outlet::missed;
use crate::qos::{History, MOST_KEPT, Qos};
use crate::qos_event::Told;
use crate::sample::{EndpointId, Sample};

pub(crate) struct Inlet {
    pub(crate) id: EndpointId,
    pub(crate) node: Arc<str>,
    pub(crate) topic: Arc<str>,
    pub(crate) common: Arc<Common>,
    /// What a message sets off; without it somebody looks from time to time.
    pub(crate) reaction: Option<Reaction>,
    pub(crate) waiting: Mutex<Waiting>,
    /// What was told to who asks for events.
    pub(crate) told: Mutex<Told>,
}

pub(crate) struct Reaction {
    pub(crate) agenda: Arc<Agenda>,
    /// Tells subscriptions of one node to one topic apart.
    pub(crate) ordinal: u64,
    pub(crate) react: React,
}

/// What is done with a sample; it may turn out to be no message of its type.
pub(crate) type React = Box<dyn Fn(&Sample) -> Result<(), DecodeError> + Send + Sync>;

#[derive(Default)]
pub(crate) struct Waiting {
    qos: Qos,
    samples: VecDeque<Sample>,
    last_ns: Option<i64>,
    pub(crate) counts: InletCounts,
}

/// What happened at a subscription.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InletCounts {
    /// Messages that arrived.
    pub received: u64,
    /// Of these, how many were dropped because newer ones came and the history was full.
    pub dropped: u64,
    /// Of these, how many were too old when somebody looked.
    pub stale: u64,
    /// Of these, how many were no such message.
    pub undecodable: u64,
    /// Deadlines that passed without a message.
    pub missed_deadlines: u64,
}

impl Waiting {
    pub(crate) fn new(qos: Qos) -> Self {
        Self { qos, ..Self::default() }
    }
}

impl Inlet {
    /// What it asks for.
    pub(crate) fn qos(&self) -> Qos {
        lock(&self.waiting).qos
    }

    /// Asks for something else from now on. Whom it hears has to be told again.
    pub(crate) fn set_qos(&self, qos: Qos) {
        lock(&self.waiting).qos = qos;
    }

    /// What happened so far; deadlines that pass now count.
    pub(crate) fn counts(&self) -> InletCounts {
        let now_ns = self.common.clock.now_ns();
        let waiting = lock(&self.waiting);
        let since =
            waiting.qos.deadline_ns.map(|deadline_ns| missed(waiting.last_ns, now_ns, deadline_ns));
        let missed_deadlines = waiting.counts.missed_deadlines + since.unwrap_or_default();
        InletCounts { missed_deadlines, ..waiting.counts }
    }

    /// Says the first time that not all could be kept.
    fn overflows(&self) {
        let Self { node, topic, .. } = self;
        let message = format!(
            "`{node}` keeps all messages of the topic `{topic}`, does not look at them, and loses \
             the oldest: {MOST_KEPT} wait"
        );
        let finding = Diagnostic::warning("slow-subscription", message);
        self.common.report(finding.help("look more often, or keep only the last ones"));
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
                reaction.agenda.remove(&self.key(reaction, oldest));
            }
            reaction.agenda.add(self.key(reaction, sample), self.clone());
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

    /// All that wait, oldest first.
    pub(crate) fn drain(&self) -> VecDeque<Sample> {
        let now_ns = self.common.clock.now_ns();
        let mut waiting = lock(&self.waiting);
        let mut samples = std::mem::take(&mut waiting.samples);
        let before = samples.len();
        samples.retain(|sample| !sample.is_stale(now_ns));
        waiting.counts.stale += (before - samples.len()) as u64;
        samples
    }

    /// The one with this number, and none before it.
    fn take(&self, sequence: u64) -> Option<Sample> {
        let now_ns = self.common.clock.now_ns();
        let mut waiting = lock(&self.waiting);
        let place = waiting.samples.iter().position(|sample| sample.sequence == sequence)?;
        let sample = waiting.samples.remove(place)?;
        if sample.is_stale(now_ns) {
            waiting.counts.stale += 1;
            return None;
        }
        Some(sample)
    }

    /// Nothing that waits is wanted any more.
    pub(crate) fn withdraw(&self) {
        let samples = std::mem::take(&mut lock(&self.waiting).samples);
        if let Some(reaction) = &self.reaction {
            for sample in &samples {
                reaction.agenda.remove(&self.key(reaction, sample));
            }
        }
    }

    /// Counts a message that was none, and says so the first time.
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
            format!("`{node}` cannot read a message of the topic `{topic}`: {error}"),
        );
        self.common.report(finding.help(
            "who sends it uses another definition of its type; compare both with \
             `ros2 interface show`, and see that both come from the same release",
        ));
    }
}

impl Event for Inlet {
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
