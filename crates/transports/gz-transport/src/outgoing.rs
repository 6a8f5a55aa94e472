//! Conversion and sending of messages of the graph. One thread does it for all topics, so that
//! publishers do not wait.

use std::collections::{BTreeSet, VecDeque};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

use periplus_graph::{EndpointId, Sample, Sink, TopicInfo};
use periplus_transport::lock;

use crate::GzPublisher;
use crate::convert::Convert;

/// Send queue of one topic.
pub(crate) struct Outgoing {
    topic: String,
    publisher: GzPublisher,
    convert: Box<dyn Convert>,
    /// Queue depth; the oldest message is dropped when it is exceeded.
    depth: usize,
    /// Filter of publishers.
    who: Mutex<Who>,
    queue: Mutex<Queue>,
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

#[derive(Default)]
struct Queue {
    samples: VecDeque<Sample>,
    is_scheduled: bool,
    /// Number of messages without an equivalent in Gazebo.
    unsaid: u64,
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
            depth: depth.max(1),
            who: Mutex::new(who),
            queue: Mutex::default(),
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
        lock(&self.queue).unsaid
    }

    fn goes(&self, publisher: EndpointId) -> bool {
        match &*lock(&self.who) {
            Who::AllBut(these) => !these.contains(&publisher),
            Who::Only(these) => these.contains(&publisher),
        }
    }

    /// Converts and sends the oldest message.
    fn send(self: Arc<Self>) {
        let sample = lock(&self.queue).samples.pop_front();
        let Some(sample) = sample else { return };
        let bytes = self.convert.to_gazebo(&sample);
        if let Some(bytes) = &bytes {
            self.publisher.publish(bytes);
        }
        let mut queue = lock(&self.queue);
        queue.unsaid += u64::from(bytes.is_none());
        queue.is_scheduled = !queue.samples.is_empty();
        if queue.is_scheduled {
            drop(queue);
            let lane = self.lane.clone();
            lane.schedule(self);
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
        let mut queue = lock(&self.0.queue);
        if queue.samples.len() == self.0.depth {
            queue.samples.pop_front();
        }
        queue.samples.push_back(sample.clone());
        if !std::mem::replace(&mut queue.is_scheduled, true) {
            drop(queue);
            self.0.lane.schedule(self.0.clone());
        }
    }
}

/// The send thread. It ends when all handles are dropped.
#[derive(Clone)]
pub(crate) struct Lane(Sender<Option<Arc<Outgoing>>>);

impl Lane {
    pub(crate) fn start() -> (Self, JoinHandle<()>) {
        let (jobs, work) = channel();
        let thread = std::thread::Builder::new().name("gz-convert".to_owned());
        let thread = thread.spawn(move || run(&work)).expect("the system starts a thread");
        (Self(jobs), thread)
    }

    fn schedule(&self, outgoing: Arc<Outgoing>) {
        // Fails only after the transport is closed.
        let _ = self.0.send(Some(outgoing));
    }

    pub(crate) fn end(&self) {
        let _ = self.0.send(None);
    }
}

fn run(work: &Receiver<Option<Arc<Outgoing>>>) {
    while let Ok(Some(outgoing)) = work.recv() {
        outgoing.send();
    }
}
