//! Taps: recorders, transports and viewers that receive the messages of selected topics.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, PoisonError, TryLockError};

use periplus_diagnostics::Diagnostic;

use crate::common::{Common, lock};
use crate::info::TopicInfo;
use crate::sample::Sample;

/// Receives the messages of selected topics in the order of publication.
pub trait Sink: Send + Sync {
    /// Returns true to receive this topic. The tap then counts as a subscriber. Called once for
    /// each topic, when the topic or the tap is new; it must not call the graph.
    fn wants(&self, topic: &TopicInfo) -> bool;

    /// Maximum queue length in live mode, where the sink has its own thread; when it is exceeded,
    /// the oldest messages are dropped with a warning.
    fn depth(&self) -> usize {
        10_000
    }

    /// True if the sink never blocks. In live mode the publisher then calls it directly, which
    /// saves a thread and its wake-ups.
    fn is_quick(&self) -> bool {
        false
    }

    /// Receives a message. In lockstep, and for a quick sink, the publisher waits for this call, so
    /// that nothing is lost; calls are never concurrent.
    fn take(&self, topic: &TopicInfo, sample: &Sample);
}

/// Id of a tap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TapId(pub(crate) u64);

pub(crate) struct Tap {
    pub(crate) id: TapId,
    pub(crate) sink: Box<dyn Sink>,
    queue: Mutex<Queue>,
    /// Wakes the thread that feeds the sink, in live mode, unless the sink is quick.
    filled: Option<Condvar>,
    /// Locked by the thread that feeds the sink.
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

    /// Number of messages lost.
    pub(crate) fn dropped(&self) -> u64 {
        lock(&self.queue).dropped
    }

    /// Closes the queue; queued messages are still delivered.
    pub(crate) fn close(&self) {
        lock(&self.queue).is_closed = true;
        if let Some(filled) = &self.filled {
            filled.notify_one();
        }
    }

    /// True if [`Tap::feed`] needs a thread.
    pub(crate) fn has_thread(&self) -> bool {
        self.filled.is_some()
    }

    /// Feeds the sink in its own thread until the tap is closed.
    pub(crate) fn feed(&self, common: &Common) {
        let Some(filled) = &self.filled else { return };
        let mut is_reported = false;
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
            if is_slow && !is_reported {
                is_reported = true;
                let message = "a recorder or transport is too slow and loses messages".to_owned();
                common.report(Diagnostic::warning("slow-tap", message).help(
                    "choose fewer topics for it, lower the rates, or run in lockstep, where it \
                     is waited for",
                ));
            }
            self.sink.take(&topic, &sample);
        }
    }

    /// Feeds the sink, unless another thread already does; that one then delivers everything.
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
