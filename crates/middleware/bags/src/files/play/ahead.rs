//! Read-ahead thread, so that a slow disk does not delay playback.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use crate::files::BagError;
use crate::files::stream::BagMessages;

/// A message in the queue.
pub(super) struct Waiting {
    pub(super) topic: usize,
    pub(super) time_ns: i64,
    pub(super) data: Vec<u8>,
}

/// Queue between the reading thread and the player.
pub(super) struct Ahead(Arc<Shared>);

#[derive(Default)]
struct Shared {
    queue: Mutex<Queue>,
    /// Notified on a new message and at the end.
    filled: Condvar,
    /// Notified when there is space or the player is dropped.
    drained: Condvar,
}

#[derive(Default)]
struct Queue {
    messages: VecDeque<Waiting>,
    bytes: usize,
    is_ended: bool,
    is_unwanted: bool,
    error: Option<BagError>,
}

/// Maximum size of messages read ahead \[bytes\].
const MOST_BYTES: usize = 256 << 20;

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Reads until the end or until the player is dropped.
    fn feed(&self, mut messages: BagMessages, most: usize) {
        loop {
            let next = match messages.next() {
                Ok(Some(message)) => Waiting {
                    topic: message.topic,
                    time_ns: message.log_ns,
                    data: message.data.to_vec(),
                },
                end => {
                    let mut queue = self.lock();
                    queue.is_ended = true;
                    queue.error = end.err();
                    self.filled.notify_all();
                    return;
                }
            };
            let mut queue = self.lock();
            while !queue.is_unwanted
                && !queue.messages.is_empty()
                && (queue.messages.len() >= most || queue.bytes + next.data.len() > MOST_BYTES)
            {
                queue = self.drained.wait(queue).unwrap_or_else(PoisonError::into_inner);
            }
            if queue.is_unwanted {
                return;
            }
            queue.bytes += next.data.len();
            queue.messages.push_back(next);
            self.filled.notify_all();
        }
    }

    /// Waits until the queue has a message or has ended.
    fn wait(&self) -> Result<MutexGuard<'_, Queue>, BagError> {
        let mut queue = self.lock();
        while queue.messages.is_empty() && !queue.is_ended {
            queue = self.filled.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
        match queue.error.take() {
            Some(error) if queue.messages.is_empty() => Err(error),
            error => {
                queue.error = error;
                Ok(queue)
            }
        }
    }
}

impl Ahead {
    pub(super) fn start(messages: BagMessages, most: usize) -> Self {
        let shared = Arc::new(Shared::default());
        let feeding = shared.clone();
        std::thread::spawn(move || feeding.feed(messages, most.max(1)));
        Self(shared)
    }

    /// Time of the next message \[ns\]; none at the end.
    pub(super) fn peek_ns(&self) -> Result<Option<i64>, BagError> {
        Ok(self.0.wait()?.messages.front().map(|message| message.time_ns))
    }

    /// Removes and returns the next message.
    pub(super) fn next(&self) -> Result<Option<Waiting>, BagError> {
        let mut queue = self.0.wait()?;
        let message = queue.messages.pop_front();
        if let Some(message) = &message {
            queue.bytes -= message.data.len();
            self.0.drained.notify_all();
        }
        Ok(message)
    }
}

impl Drop for Ahead {
    fn drop(&mut self) {
        self.0.lock().is_unwanted = true;
        self.0.drained.notify_all();
    }
}
