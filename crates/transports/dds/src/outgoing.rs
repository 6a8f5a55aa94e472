//! Send queues of writers. A small sample is sent by the publishing thread if that is possible
//! without blocking; the threads of the transport send the others, so that a slow or dead peer
//! blocks no publisher.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_cyclonedds_sys::{Bytes, DataWriter, Guid, SampleIdentity};
use periplus_graph::Sample;
use periplus_transport::{Way, lock};

/// Samples above this size use a separate thread, so that small ones do not wait for them
/// \[bytes\].
const LARGE: usize = 64 << 10;

/// Maximum size of samples sent by the publishing thread \[bytes\]: waking a thread costs more than
/// sending them.
const SMALL: usize = 8 << 10;

/// Pause for a writer without buffer space.
const PAUSE: Duration = Duration::from_millis(2);

/// Data to send.
pub(crate) enum Parcel {
    /// A message of the graph, encoded when it is sent.
    Sample(Sample),
    /// A service response for one participant.
    Response(Response),
}

/// A service response.
pub(crate) struct Response {
    pub(crate) bytes: Vec<u8>,
    /// SampleIdentity of the request, for Fast DDS.
    pub(crate) related: Option<SampleIdentity>,
    /// Participant of the client.
    pub(crate) client: Guid,
}

/// Keeps the message alive while DDS sends from it.
struct Held(Sample);

impl Bytes for Held {
    fn bytes(&self) -> &[u8] {
        // Encoded before.
        self.0.cdr().unwrap_or_default()
    }
}

/// A writer with its queue.
pub(crate) struct Outgoing {
    pub(crate) writer: DataWriter,
    /// Queue depth; the oldest sample is dropped when it is exceeded.
    depth: usize,
    /// True if samples matter without matched readers (transient local).
    keeps: bool,
    readers: AtomicUsize,
    largest: AtomicUsize,
    queue: Mutex<Queue>,
    lanes: Arc<Lanes>,
}

#[derive(Default)]
struct Queue {
    parcels: VecDeque<Parcel>,
    /// True if a send thread is scheduled for it.
    is_scheduled: bool,
    dropped: u64,
    refused: u64,
}

impl Outgoing {
    pub(crate) fn new(
        writer: DataWriter,
        depth: usize,
        keeps: bool,
        lanes: &Arc<Lanes>,
    ) -> Arc<Self> {
        Arc::new(Self {
            writer,
            depth: depth.max(1),
            keeps,
            readers: AtomicUsize::new(0),
            largest: AtomicUsize::new(0),
            queue: Mutex::default(),
            lanes: lanes.clone(),
        })
    }

    /// Current number of readers.
    pub(crate) fn count_readers(&self) -> usize {
        let readers = self.writer.readers();
        self.readers.store(readers, Ordering::Relaxed);
        readers
    }

    /// Size of the largest sample so far \[bytes\].
    pub(crate) fn largest(&self) -> usize {
        self.largest.load(Ordering::Relaxed)
    }

    /// Sends a sample or queues it. The oldest is dropped when the queue is full.
    pub(crate) fn put(self: &Arc<Self>, parcel: Parcel) {
        // The size is known only after encoding; the size of earlier samples is used.
        let is_small = (1..=SMALL).contains(&self.largest());
        let pace = match &parcel {
            Parcel::Sample(_) if is_small => Pace::AtOnce,
            _ if self.largest() > LARGE => Pace::Bulk,
            _ => Pace::Normal,
        };
        let mut queue = lock(&self.queue);
        if queue.parcels.len() == self.depth {
            queue.parcels.pop_front();
            queue.dropped += 1;
        } else {
            self.lanes.waiting.fetch_add(1, Ordering::Relaxed);
        }
        queue.parcels.push_back(parcel);
        // Samples that arrive during a send are queued to keep the order.
        if std::mem::replace(&mut queue.is_scheduled, true) {
            return;
        }
        drop(queue);
        match pace {
            Pace::AtOnce => match self.send(Pace::AtOnce) {
                Next::Done => {}
                Next::Again | Next::Later => self.lanes.schedule(self.clone(), false),
                Next::Bulk => self.lanes.schedule(self.clone(), true),
            },
            Pace::Normal => self.lanes.schedule(self.clone(), false),
            Pace::Bulk => self.lanes.schedule(self.clone(), true),
        }
    }

    /// Sends the oldest sample; returns the next step for this writer.
    fn send(self: &Arc<Self>, pace: Pace) -> Next {
        let Some(parcel) = lock(&self.queue).parcels.pop_front() else { return Next::Done };
        let sample = match parcel {
            Parcel::Response(Response { bytes, related, client }) => {
                let size = bytes.len();
                let result = self.writer.write_to(client, bytes, related);
                return self.sent(size, result.map(drop).err(), None);
            }
            Parcel::Sample(sample) => sample,
        };
        let size = match sample.cdr() {
            Ok(bytes) => bytes.len(),
            // The message violates the limits of its type.
            Err(_) => return self.sent(0, None, None),
        };
        let most = match pace {
            Pace::AtOnce => SMALL,
            Pace::Normal => LARGE,
            Pace::Bulk => usize::MAX,
        };
        if size > most {
            self.largest.fetch_max(size, Ordering::Relaxed);
            lock(&self.queue).parcels.push_front(Parcel::Sample(sample));
            return if size > LARGE { Next::Bulk } else { Next::Again };
        }
        let held = Held(sample.clone());
        let result = match pace {
            Pace::AtOnce => self.writer.write_at_once(held),
            Pace::Normal | Pace::Bulk => self.writer.write(held, None),
        };
        self.sent(size, result.map(drop).err(), Some(sample))
    }

    fn sent(
        &self,
        size: usize,
        error: Option<periplus_cyclonedds_sys::Error>,
        sample: Option<Sample>,
    ) -> Next {
        self.largest.fetch_max(size, Ordering::Relaxed);
        let mut queue = lock(&self.queue);
        match (error, sample) {
            // Retry unless newer samples have filled the queue.
            (Some(error), Some(sample))
                if error.is_timeout() && queue.parcels.len() < self.depth =>
            {
                queue.parcels.push_front(Parcel::Sample(sample));
                return Next::Later;
            }
            (Some(error), _) if error.is_timeout() => queue.dropped += 1,
            (Some(_), _) => queue.refused += 1,
            (None, _) => {}
        }
        self.lanes.waiting.fetch_sub(1, Ordering::Relaxed);
        if queue.parcels.is_empty() {
            queue.is_scheduled = false;
            return Next::Done;
        }
        if self.largest() > LARGE { Next::Bulk } else { Next::Again }
    }

    /// Numbers of samples dropped because the queue was full, and refused by DDS.
    pub(crate) fn losses(&self) -> (u64, u64) {
        let queue = lock(&self.queue);
        (queue.dropped, queue.refused)
    }
}

impl Way for Outgoing {
    fn is_wanted(&self) -> bool {
        self.keeps || self.readers.load(Ordering::Relaxed) > 0
    }

    fn push(self: &Arc<Self>, sample: Sample) {
        self.put(Parcel::Sample(sample));
    }
}

impl Drop for Outgoing {
    fn drop(&mut self) {
        let left = lock(&self.queue).parcels.len();
        self.lanes.waiting.fetch_sub(left, Ordering::Relaxed);
    }
}

/// Send mode of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pace {
    /// By the publishing thread, without blocking.
    AtOnce,
    /// By the thread for small samples.
    Normal,
    /// By the thread for large samples.
    Bulk,
}

/// Next step for a writer.
enum Next {
    /// Wait for samples.
    Done,
    /// Send the next sample after those of other writers.
    Again,
    /// Send the next sample on the thread for large samples.
    Bulk,
    /// Retry after a pause: no buffer space.
    Later,
}

/// The two send threads, for small and for large samples.
pub(crate) struct Lanes {
    lanes: [Lane; 2],
    /// Number of queued samples of all writers.
    waiting: AtomicUsize,
    is_closed: AtomicBool,
}

#[derive(Default)]
struct Lane {
    ready: Mutex<VecDeque<Arc<Outgoing>>>,
    filled: Condvar,
}

impl Lanes {
    /// Starts the threads.
    pub(crate) fn start() -> (Arc<Self>, Vec<JoinHandle<()>>) {
        let lanes = Arc::new(Self {
            lanes: Default::default(),
            waiting: AtomicUsize::new(0),
            is_closed: AtomicBool::new(false),
        });
        let threads = [("wire-send", false), ("wire-send-bulk", true)].map(|(name, is_bulk)| {
            let lanes = lanes.clone();
            let thread = std::thread::Builder::new().name(name.to_owned());
            thread.spawn(move || lanes.run(is_bulk)).expect("the system starts a thread")
        });
        (lanes, threads.into())
    }

    fn schedule(&self, writer: Arc<Outgoing>, is_bulk: bool) {
        let lane = &self.lanes[usize::from(is_bulk)];
        lock(&lane.ready).push_back(writer);
        lane.filled.notify_one();
    }

    /// Number of queued samples.
    pub(crate) fn waiting(&self) -> usize {
        self.waiting.load(Ordering::Relaxed)
    }

    /// Ends the threads.
    pub(crate) fn close(&self) {
        self.is_closed.store(true, Ordering::Release);
        for lane in &self.lanes {
            // Locked so that a thread that is about to wait does not miss the notification.
            let mut ready = lock(&lane.ready);
            ready.clear();
            lane.filled.notify_all();
        }
    }

    fn run(&self, is_bulk: bool) {
        let lane = &self.lanes[usize::from(is_bulk)];
        // Writers without buffer space, retried after the others.
        let mut pausing: Vec<Arc<Outgoing>> = Vec::new();
        loop {
            let mut ready = lock(&lane.ready);
            while ready.is_empty() && !self.is_closed.load(Ordering::Acquire) {
                if pausing.is_empty() {
                    ready = lane.filled.wait(ready).unwrap_or_else(PoisonError::into_inner);
                } else {
                    let woken = lane.filled.wait_timeout(ready, PAUSE);
                    ready = woken.unwrap_or_else(PoisonError::into_inner).0;
                    ready.extend(pausing.drain(..));
                }
            }
            if self.is_closed.load(Ordering::Acquire) {
                return;
            }
            let next = ready.pop_front();
            drop(ready);
            let Some(writer) = next else { continue };
            match writer.send(if is_bulk { Pace::Bulk } else { Pace::Normal }) {
                Next::Done => {}
                Next::Again => self.schedule(writer, is_bulk),
                Next::Bulk => self.schedule(writer, true),
                Next::Later => pausing.push(writer),
            }
        }
    }
}
