//! Send queues of publishers. One thread of the transport sends everything, so that a slow peer
//! does not block publishers.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

use periplus_graph::Sample;
use periplus_transport::{Way, lock, unix_ns};
use zenoh::Wait;
use zenoh_ext::AdvancedPublisher;

use crate::attachment::{Attachment, Gid};

/// A publisher with its queue.
pub(crate) struct Outgoing {
    publisher: AdvancedPublisher<'static>,
    gid: Gid,
    /// Queue depth; the oldest message is dropped when it is exceeded.
    depth: usize,
    /// True if messages matter without subscribers (transient local).
    keeps: bool,
    /// True if there is a remote subscriber.
    is_heard: Arc<AtomicBool>,
    queue: Mutex<Queue>,
    lane: Lane,
}

#[derive(Default)]
struct Queue {
    samples: VecDeque<Sample>,
    /// True if the send thread is scheduled for it.
    is_scheduled: bool,
    /// Sequence number of the last message.
    number: i64,
    dropped: u64,
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
        let (depth, queue, lane) = (depth.max(1), Mutex::default(), lane.clone());
        Arc::new(Self { publisher, gid, depth, keeps, is_heard, queue, lane })
    }

    /// Number of messages dropped because the queue was full.
    pub(crate) fn dropped(&self) -> u64 {
        lock(&self.queue).dropped
    }

    /// Sends the oldest message.
    fn send(self: Arc<Self>) {
        let mut queue = lock(&self.queue);
        let Some(sample) = queue.samples.pop_front() else { return };
        queue.number += 1;
        let (number, time_ns, gid) = (queue.number, unix_ns(), self.gid);
        drop(queue);
        let beside = Attachment { number, time_ns, gid }.write();
        // Messages that violate their type, and messages on a closed session, are dropped.
        if let Ok(bytes) = sample.cdr() {
            let _ = self.publisher.put(bytes).attachment(beside).wait();
        }
        let mut queue = lock(&self.queue);
        if queue.samples.is_empty() {
            queue.is_scheduled = false;
            return;
        }
        drop(queue);
        self.lane.clone().schedule(Job::Message(self));
    }
}

impl Way for Outgoing {
    fn is_wanted(&self) -> bool {
        self.keeps || self.is_heard.load(Ordering::Relaxed)
    }

    fn push(self: &Arc<Self>, sample: Sample) {
        let mut queue = lock(&self.queue);
        if queue.samples.len() == self.depth {
            queue.samples.pop_front();
            queue.dropped += 1;
        }
        queue.samples.push_back(sample);
        if !std::mem::replace(&mut queue.is_scheduled, true) {
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
    /// Ends the thread.
    End,
}

/// The send thread.
#[derive(Clone)]
pub(crate) struct Lane {
    jobs: Sender<Job>,
    waiting: Arc<AtomicUsize>,
}

impl Lane {
    /// Starts the thread.
    pub(crate) fn start() -> (Self, JoinHandle<()>) {
        let (jobs, work) = channel();
        let lane = Self { jobs, waiting: Arc::default() };
        let waiting = lane.waiting.clone();
        let thread = std::thread::Builder::new().name("zenoh-send".to_owned());
        let thread =
            thread.spawn(move || run(&work, &waiting)).expect("the system starts a thread");
        (lane, thread)
    }

    pub(crate) fn schedule(&self, job: Job) {
        self.waiting.fetch_add(1, Ordering::AcqRel);
        // Fails only after the transport is closed.
        let _ = self.jobs.send(job);
    }

    /// True if everything was sent.
    pub(crate) fn is_idle(&self) -> bool {
        self.waiting.load(Ordering::Acquire) == 0
    }
}

fn run(work: &Receiver<Job>, waiting: &AtomicUsize) {
    for job in work {
        match job {
            Job::Message(outgoing) => outgoing.send(),
            Job::Once(job) => job(),
            Job::End => return,
        }
        waiting.fetch_sub(1, Ordering::AcqRel);
    }
}
