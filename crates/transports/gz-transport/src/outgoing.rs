//! Conversion and sending of messages of the graph. One thread does it for all topics, so that
//! publishers do not wait.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use periplus_graph::{EndpointId, Sample, Sink, TopicInfo};
use periplus_transport::{SendQueue, lock};

use crate::GzPublisher;
use crate::convert::Convert;

/// The send thread.
pub(crate) type Lane = periplus_transport::Lane<Arc<Outgoing>>;

/// Send queue of one topic.
pub(crate) struct Outgoing {
    topic: String,
    publisher: GzPublisher,
    convert: Box<dyn Convert>,
    /// Filter of publishers.
    who: Mutex<Who>,
    queue: SendQueue,
    /// Number of messages without an equivalent in Gazebo.
    unsaid: AtomicU64,
    lane: Lane,
}

/// Publishers whose messages are sent.
#[derive(Clone, Debug)]
pub(crate) enum Who {
    /// All but these.
    AllBut(BTreeSet<EndpointId>),
    /// Only these.
    Only(BTreeSet<EndpointId>),
}

impl Outgoing {
    pub(crate) fn new(
        topic: &str,
        publisher: GzPublisher,
        convert: Box<dyn Convert>,
        depth: usize,
        who: Who,
        lane: &Lane,
    ) -> Arc<Self> {
        Arc::new(Self {
            topic: topic.to_owned(),
            publisher,
            convert,
            who: Mutex::new(who),
            queue: SendQueue::new(depth),
            unsaid: AtomicU64::new(0),
            lane: lane.clone(),
        })
    }

    pub(crate) fn is_heard(&self) -> bool {
        self.publisher.is_heard()
    }

    pub(crate) fn set_who(&self, who: Who) {
        *lock(&self.who) = who;
    }

    /// Number of messages without an equivalent in Gazebo.
    pub(crate) fn unsaid(&self) -> u64 {
        self.unsaid.load(Ordering::Relaxed)
    }

    fn goes(&self, publisher: EndpointId) -> bool {
        match &*lock(&self.who) {
            Who::AllBut(these) => !these.contains(&publisher),
            Who::Only(these) => these.contains(&publisher),
        }
    }

    /// Converts and sends the oldest message.
    pub(crate) fn send(self: Arc<Self>) {
        let Some(sample) = self.queue.pop() else { return };
        match self.convert.to_gazebo(&sample) {
            Some(bytes) => self.publisher.publish(&bytes),
            None => _ = self.unsaid.fetch_add(1, Ordering::Relaxed),
        }
        if self.queue.finish() {
            self.lane.clone().schedule(self);
        }
    }
}

/// Sink of a tap on a topic of the graph.
pub(crate) struct Ear(pub(crate) Arc<Outgoing>);

impl Sink for Ear {
    fn wants(&self, topic: &TopicInfo) -> bool {
        topic.name == self.0.topic
    }

    fn is_quick(&self) -> bool {
        true
    }

    fn take(&self, _: &TopicInfo, sample: &Sample) {
        if !self.0.goes(sample.publisher) {
            return;
        }
        if self.0.queue.push(sample.clone()) {
            self.0.lane.schedule(self.0.clone());
        }
    }
}
