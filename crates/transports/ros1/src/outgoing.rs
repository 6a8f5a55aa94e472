//! Conversion of messages of the graph. One thread does it for all topics, so that publishers do not wait; each
//! subscriber has a thread that sends.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use periplus_graph::Sample;
use periplus_transport::{SendQueue, Way};

use crate::codec::Codec;
use crate::tcpros::Publication;

/// The thread that converts.
pub(crate) type Lane = periplus_transport::Lane<Arc<Outgoing>>;

/// A publisher of the graph with its queue.
pub(crate) struct Outgoing {
    pub(crate) publication: Arc<Publication>,
    codec: Codec,
    /// True if a message begins with a header, whose sequence number the publisher of ROS 1 counts.
    has_header: bool,
    /// Sequence number of the next message.
    number: AtomicU32,
    queue: SendQueue,
    lane: Lane,
}

impl Outgoing {
    pub(crate) fn new(
        publication: Arc<Publication>,
        codec: Codec,
        depth: usize,
        lane: &Lane,
    ) -> Arc<Self> {
        let (number, queue, lane) = (AtomicU32::new(0), SendQueue::new(depth), lane.clone());
        let has_header = has_header(&publication.of.definition);
        Arc::new(Self { publication, codec, has_header, number, queue, lane })
    }

    /// Number of messages dropped, here or for a slow subscriber.
    pub(crate) fn dropped(&self) -> u64 {
        self.queue.dropped() + self.publication.dropped()
    }

    /// Converts the oldest message and gives it to the subscribers.
    pub(crate) fn send(self: Arc<Self>) {
        let Some(sample) = self.queue.pop() else { return };
        // Messages that violate their type are dropped.
        if let Ok(cdr) = sample.cdr() {
            let mut frame = Vec::with_capacity(cdr.len() + 8);
            frame.extend_from_slice(&[0; 4]);
            if self.codec.convert(cdr, &mut frame).is_ok()
                && let Ok(length) = u32::try_from(frame.len() - 4)
            {
                frame[..4].copy_from_slice(&length.to_le_bytes());
                if self.has_header && frame.len() >= 8 {
                    // It wraps around at the end of its range.
                    let number = self.number.fetch_add(1, Ordering::Relaxed);
                    frame[4..8].copy_from_slice(&number.to_le_bytes());
                }
                self.publication.send(&Arc::new(frame));
            }
        }
        if self.queue.finish() {
            self.lane.clone().schedule(self);
        }
    }
}

/// True if the first field of a definition is a header.
fn has_header(definition: &str) -> bool {
    let first = definition.lines().find(|line| !line.contains('='));
    first.is_some_and(|line| line.starts_with("std_msgs/Header "))
}

impl Way for Outgoing {
    fn is_wanted(&self) -> bool {
        self.publication.is_wanted()
    }

    fn push(self: &Arc<Self>, sample: Sample) {
        if self.queue.push(sample) {
            self.lane.schedule(self.clone());
        }
    }
}
