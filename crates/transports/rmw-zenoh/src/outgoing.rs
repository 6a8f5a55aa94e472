//! Send queues of publishers. One thread of the transport sends everything, so that a slow peer
//! does not block publishers.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI64, Ordering};

use periplus_graph::Sample;
use periplus_transport::{SendQueue, Way, unix_ns};
use zenoh::Wait;
use zenoh_ext::AdvancedPublisher;

use crate::attachment::{Attachment, Gid};

/// The send thread.
pub(crate) type Lane = periplus_transport::Lane<Job>;

/// A publisher with its queue.
pub(crate) struct Outgoing {
    publisher: AdvancedPublisher<'static>,
    gid: Gid,
    /// True if messages matter without subscribers (transient local).
    keeps: bool,
    /// True if there is a remote subscriber.
    is_heard: Arc<AtomicBool>,
    /// Sequence number of the last message.
    number: AtomicI64,
    queue: SendQueue,
    lane: Lane,
}

impl Outgoing {
    pub(crate) fn new(
        publisher: AdvancedPublisher<'static>,
        gid: Gid,
        depth: usize,
        keeps: bool,
        is_heard: Arc<AtomicBool>,
        lane: &Lane,
    ) -> Arc<Self> {
        let (number, queue, lane) = (AtomicI64::new(0), SendQueue::new(depth), lane.clone());
        Arc::new(Self { publisher, gid, keeps, is_heard, number, queue, lane })
    }

    /// Number of messages dropped because the queue was full.
    pub(crate) fn dropped(&self) -> u64 {
        self.queue.dropped()
    }

    /// Sends the oldest message.
    fn send(self: Arc<Self>) {
        let Some(sample) = self.queue.pop() else { return };
        let number = self.number.fetch_add(1, Ordering::Relaxed) + 1;
        let beside = Attachment { number, time_ns: unix_ns(), gid: self.gid }.write();
        // Messages that violate their type, and messages on a closed session, are dropped.
        if let Ok(bytes) = sample.cdr() {
            let _ = self.publisher.put(bytes).attachment(beside).wait();
        }
        if self.queue.finish() {
            self.lane.clone().schedule(Job::Message(self));
        }
    }
}

impl Way for Outgoing {
    fn is_wanted(&self) -> bool {
        self.keeps || self.is_heard.load(Ordering::Relaxed)
    }

    fn push(self: &Arc<Self>, sample: Sample) {
        if self.queue.push(sample) {
            self.lane.schedule(Job::Message(self.clone()));
        }
    }
}

/// A job of the send thread.
pub(crate) enum Job {
    /// The next message of a publisher, after those of others.
    Message(Arc<Outgoing>),
    /// A request or a response.
    Once(Box<dyn FnOnce() + Send>),
}

impl Job {
    pub(crate) fn perform(self) {
        match self {
            Self::Message(outgoing) => outgoing.send(),
            Self::Once(job) => job(),
        }
    }
}
