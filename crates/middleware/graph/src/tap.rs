//! Taps: recorders, wires and viewers, which see the topics that they choose.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, PoisonError, TryLockError};

use periplus_diagnostics::Diagnostic;

use crate::common::{Common, lock};
use crate::info::TopicInfo;
use crate::sample::Sample;

/// Takes the messages of chosen topics, in the order of their publication.
pub trait Sink: Send + Sync {
    /// Whether it takes this topic. It then counts as a listener. Asked once for each topic, when
    /// the topic or the tap is new; it must not call the graph.
    fn wants(&self, topic: &TopicInfo) -> bool;

    /// How many messages may wait for it in live, where it has a thread of its own; when more come,
    /// the oldest are dropped and a finding says so.
    fn depth(&self) -> usize {
        10_000
    }

    /// Whether it never waits for anything: it only hands messages on. In live the publisher itself
    /// then calls it, which saves a thread, its waking for every message, and the wait for it.
    fn is_quick(&self) -> bool {
        false
    }

    /// A message. In lockstep, and to a quick sink, it is given before the publisher goes on, so that
    /// nothing is ever lost; never by two threads at once.
    fn take(&self, topic: &TopicInfo, sample: &Sample);
}

/// Names a tap, to end it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TapId(pub(crate) u64);

pub(crate) struct Tap {
    pub(crate) id: TapId,
    pub(crate) sink: Box<dyn Sink>,
    queue: Mutex<Queue>,
    /// Wakes the thread that feeds the sink, where it has one: in live, unless it is quick.
    filled: Option<Condvar>,
    /// Held by whoever feeds the sink.
    feeding: Mutex<()>,
}

#[derive(Default)]
struct Queue {
    samples: VecDeque<(Arc<TopicInfo>, Sample)>,
    dropped: u64,
    is_closed: bool,
}

impl Tap {
    pub(crate) fn new(id: TapId, sink: Box<dyn Sink>, is_live: bool) -> Self {
        let filled = (is_live && !sink.is_quick()).then(Condvar::new);
        Self { id, sink, queue: Mutex::default(), filled, feeding: Mutex::default() }
    }

    pub(crate) fn push(&self, topic: &Arc<TopicInfo>, sample: &Sample) {
        let mut queue = lock(&self.queue);
        if self.filled.is_some() && queue.samples.len() >= self.sink.depth().max(1) {
            queue.samples.pop_front();
            queue.dropped += 1;
        }
        queue.samples.push_back((topic.clone(), sample.clone()));
    }

    /// How many messages it lost.
    pub(crate) fn dropped(&self) -> u64 {
        lock(&self.queue).dropped
    }

    /// No more will come; what waits is still taken.
    pub(crate) fn close(&self) {
        lock(&self.queue).is_closed = true;
        if let Some(filled) = &self.filled {
            filled.notify_one();
        }
    }

    /// Whether somebody has to call [`Tap::feed`].
    pub(crate) fn has_thread(&self) -> bool {
        self.filled.is_some()
    }

    /// Feeds the sink in a thread of its own until the tap is closed.
    pub(crate) fn feed(&self, common: &Common) {
        let Some(filled) = &self.filled else { return };
        let mut told = false;
        loop {
            let mut queue = lock(&self.queue);
            let (topic, sample) = loop {
                match queue.samples.pop_front() {
                    Some(next) => break next,
                    None if queue.is_closed => return,
                    None => queue = filled.wait(queue).unwrap_or_else(PoisonError::into_inner),
                }
            };
            let is_slow = queue.dropped > 0;
            drop(queue);
            if is_slow && !told {
                told = true;
                let message = "a recorder or wire is too slow and loses messages".to_owned();
                common.report(Diagnostic::warning("slow-tap", message).help(
                    "choose fewer topics for it, lower the rates, or run in lockstep, where it \
                     is waited for",
                ));
            }
            self.sink.take(&topic, &sample);
        }
    }

    /// Feeds the sink, unless somebody does already: then that one goes on until all is taken.
    pub(crate) fn flush(&self) {
        if let Some(filled) = &self.filled {
            filled.notify_one();
            return;
        }
        while !lock(&self.queue).samples.is_empty() {
            let _feeding = match self.feeding.try_lock() {
                Ok(feeding) => feeding,
                Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
                Err(TryLockError::WouldBlock) => return,
            };
            loop {
                let Some((topic, sample)) = lock(&self.queue).samples.pop_front() else { break };
                self.sink.take(&topic, &sample);
            }
        }
    }
}
