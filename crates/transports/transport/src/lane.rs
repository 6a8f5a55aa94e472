//! A thread that sends for all publishers of a transport, so that these do not wait, and the queue of each publisher.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

use periplus_graph::Sample;

use crate::lock;

/// Handle of a thread that does jobs in their order.
#[derive(Debug)]
pub struct Lane<J> {
    jobs: Sender<Option<J>>,
    waiting: Arc<AtomicUsize>,
}

impl<J> Clone for Lane<J> {
    fn clone(&self) -> Self {
        Self { jobs: self.jobs.clone(), waiting: self.waiting.clone() }
    }
}

impl<J: Send + 'static> Lane<J> {
    /// Starts the thread under a name; it ends with [`Lane::end`], or when all handles are dropped.
    ///
    /// # Panics
    /// If the system starts no thread.
    #[must_use]
    pub fn start(name: &str, work: fn(J)) -> (Self, JoinHandle<()>) {
        let (jobs, queue) = channel::<Option<J>>();
        let lane = Self { jobs, waiting: Arc::default() };
        let waiting = lane.waiting.clone();
        let thread = std::thread::Builder::new().name(name.to_owned());
        let thread = thread.spawn(move || {
            while let Ok(Some(job)) = queue.recv() {
                work(job);
                waiting.fetch_sub(1, Ordering::AcqRel);
            }
        });
        (lane, thread.expect("the system starts a thread"))
    }

    /// Adds a job. Those after [`Lane::end`] are dropped.
    pub fn schedule(&self, job: J) {
        self.waiting.fetch_add(1, Ordering::AcqRel);
        // Fails only after the transport is closed.
        let _ = self.jobs.send(Some(job));
    }

    /// True if every job is done.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        self.waiting.load(Ordering::Acquire) == 0
    }

    /// Ends the thread after the jobs so far.
    pub fn end(&self) {
        let _ = self.jobs.send(None);
    }
}

/// Queue of a publisher whose messages a [`Lane`] sends one at a time, in turn with those of others.
#[derive(Debug)]
pub struct SendQueue {
    /// The oldest message is dropped when it is exceeded.
    depth: usize,
    inner: Mutex<Inner>,
}

#[derive(Debug, Default)]
struct Inner {
    samples: VecDeque<Sample>,
    /// True if the thread is scheduled for it.
    is_scheduled: bool,
    dropped: u64,
}

impl SendQueue {
    /// Queue for `depth` messages, at least one.
    #[must_use]
    pub fn new(depth: usize) -> Self {
        Self { depth: depth.max(1), inner: Mutex::default() }
    }

    /// Adds a message; true if the thread has to be scheduled for this queue.
    #[must_use]
    pub fn push(&self, sample: Sample) -> bool {
        let mut inner = lock(&self.inner);
        if inner.samples.len() == self.depth {
            inner.samples.pop_front();
            inner.dropped += 1;
        }
        inner.samples.push_back(sample);
        !std::mem::replace(&mut inner.is_scheduled, true)
    }

    /// Removes the oldest message.
    #[must_use]
    pub fn pop(&self) -> Option<Sample> {
        lock(&self.inner).samples.pop_front()
    }

    /// Ends the sending of a message; true if the thread has to be scheduled for the next one.
    #[must_use]
    pub fn finish(&self) -> bool {
        let mut inner = lock(&self.inner);
        inner.is_scheduled = !inner.samples.is_empty();
        inner.is_scheduled
    }

    /// Number of messages dropped because the queue was full.
    #[must_use]
    pub fn dropped(&self) -> u64 {
        lock(&self.inner).dropped
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicU64;

    use super::*;

    static SUM: AtomicU64 = AtomicU64::new(0);

    #[test]
    fn jobs_are_done_before_the_end() {
        let (lane, thread) = Lane::start("sum", |number: u64| {
            SUM.fetch_add(number, Ordering::Relaxed);
        });
        for number in 1..=10 {
            lane.schedule(number);
        }
        lane.end();
        thread.join().expect("it ends");
        assert!(lane.is_idle());
        assert_eq!(SUM.load(Ordering::Relaxed), 55);
    }
}
