//! Taps: recorders, wires and viewers, which see the topics that they choose.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, TryLockError};

use crate::common::lock;
use crate::info::TopicInfo;
use crate::sample::Sample;

/// Takes the messages of chosen topics, in the order of their publication.
pub trait Sink: Send + Sync {
    /// Whether it takes this topic. It then counts as a listener. Asked once for each topic, when
    /// the topic or the tap is new; it must not call the graph.
    fn wants(&self, topic: &TopicInfo) -> bool;

    /// A message. In lockstep it is called before the publisher goes on, so that nothing is ever
    /// lost; never by two threads at once.
    fn take(&self, topic: &TopicInfo, sample: &Sample);
}

/// Names a tap, to end it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TapId(pub(crate) u64);

pub(crate) struct Tap {
    pub(crate) id: TapId,
    pub(crate) sink: Box<dyn Sink>,
    queue: Mutex<VecDeque<(Arc<TopicInfo>, Sample)>>,
    /// Held by whoever feeds the sink.
    feeding: Mutex<()>,
}

impl Tap {
    pub(crate) fn new(id: TapId, sink: Box<dyn Sink>) -> Self {
        Self { id, sink, queue: Mutex::default(), feeding: Mutex::default() }
    }

    pub(crate) fn push(&self, topic: &Arc<TopicInfo>, sample: &Sample) {
        lock(&self.queue).push_back((topic.clone(), sample.clone()));
    }

    /// Feeds the sink, unless somebody does already: then that one goes on until all is taken.
    pub(crate) fn flush(&self) {
        while !lock(&self.queue).is_empty() {
            let _feeding = match self.feeding.try_lock() {
                Ok(feeding) => feeding,
                Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
                Err(TryLockError::WouldBlock) => return,
            };
            loop {
                let Some((topic, sample)) = lock(&self.queue).pop_front() else { break };
                self.sink.take(&topic, &sample);
            }
        }
    }
}
