//! Conversion of messages of the graph. One thread does it for all topics, so that publishers do not wait; each
//! subscriber has a thread that sends.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

use periplus_graph::Sample;
use periplus_transport::{Way, lock};

use crate::codec::Codec;
use crate::tcpros::Publication;

/// A publisher of the graph with its queue.
pub(crate) struct Outgoing {
    pub(crate) publication: Arc<Publication>,
    codec: Codec,
    /// True if a message begins with a header, whose sequence number the publisher of ROS 1 counts.
    has_header: bool,
    /// Queue depth; the oldest message is dropped when it is exceeded.
    depth: usize,
    queue: Mutex<Queue>,
    lane: Lane,
}

#[derive(Default)]
struct Queue {
    samples: VecDeque<Sample>,
    /// True if the thread is scheduled for it.
    is_scheduled: bool,
    dropped: u64,
    /// Sequence number of the next message.
    number: u32,
}

impl Outgoing {
    pub(crate) fn new(
        publication: Arc<Publication>,
        codec: Codec,
        depth: usize,
        lane: &Lane,
    ) -> Arc<Self> {
        let (depth, queue, lane) = (depth.max(1), Mutex::default(), lane.clone());
        let has_header = has_header(&publication.of.definition);
        Arc::new(Self { publication, codec, has_header, depth, queue, lane })
    }

    /// Number of messages dropped, here or for a slow subscriber.
    pub(crate) fn dropped(&self) -> u64 {
        lock(&self.queue).dropped + self.publication.dropped()
    }

    /// Converts the oldest message and gives it to the subscribers.
    fn send(self: Arc<Self>) {
        let sample = lock(&self.queue).samples.pop_front();
        let Some(sample) = sample else { return };
        // Messages that violate their type are dropped.
        if let Ok(cdr) = sample.cdr() {
            let mut frame = Vec::with_capacity(cdr.len() + 8);
            frame.extend_from_slice(&[0; 4]);
            if self.codec.convert(cdr, &mut frame).is_ok()
                && let Ok(length) = u32::try_from(frame.len() - 4)
            {
                frame[..4].copy_from_slice(&length.to_le_bytes());
                if self.has_header && frame.len() >= 8 {
                    let mut queue = lock(&self.queue);
                    frame[4..8].copy_from_slice(&queue.number.to_le_bytes());
                    queue.number = queue.number.wrapping_add(1);
                }
                self.publication.send(&Arc::new(frame));
            }
        }
        let mut queue = lock(&self.queue);
        queue.is_scheduled = !queue.samples.is_empty();
        if queue.is_scheduled {
            drop(queue);
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
        let mut queue = lock(&self.queue);
        if queue.samples.len() == self.depth {
            queue.samples.pop_front();
            queue.dropped += 1;
        }
        queue.samples.push_back(sample);
        if !std::mem::replace(&mut queue.is_scheduled, true) {
            drop(queue);
            self.lane.schedule(self.clone());
        }
    }
}

/// The thread that converts.
#[derive(Clone)]
pub(crate) struct Lane {
    jobs: Sender<Option<Arc<Outgoing>>>,
    waiting: Arc<AtomicUsize>,
}

impl Lane {
    /// Starts the thread.
    pub(crate) fn start() -> (Self, JoinHandle<()>) {
        let (jobs, work) = channel();
        let lane = Self { jobs, waiting: Arc::default() };
        let waiting = lane.waiting.clone();
        let thread = std::thread::Builder::new().name("ros1-convert".to_owned());
        let thread =
            thread.spawn(move || run(&work, &waiting)).expect("the system starts a thread");
        (lane, thread)
    }

    fn schedule(&self, outgoing: Arc<Outgoing>) {
        self.waiting.fetch_add(1, Ordering::AcqRel);
        // Fails only after the transport is closed.
        let _ = self.jobs.send(Some(outgoing));
    }

    /// True if nothing waits to be converted.
    pub(crate) fn is_idle(&self) -> bool {
        self.waiting.load(Ordering::Acquire) == 0
    }

    /// Ends the thread after what is scheduled.
    pub(crate) fn end(&self) {
        let _ = self.jobs.send(None);
    }
}

fn run(work: &Receiver<Option<Arc<Outgoing>>>, waiting: &AtomicUsize) {
    while let Ok(Some(outgoing)) = work.recv() {
        outgoing.send();
        waiting.fetch_sub(1, Ordering::AcqRel);
    }
}
