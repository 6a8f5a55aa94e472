//! Messages, requests and responses that have arrived for an endpoint of a process.

use std::collections::VecDeque;
use std::sync::Mutex;

use crate::lock;

/// Something that has arrived.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Received {
    /// For a message: time of publication on the clock of the graph \[ns\].
    pub time_ns: i64,
    /// For a message: sequence number on its topic. For a request: number of the call. For a response: number of
    /// the request.
    pub number: u64,
    /// CDR, with the four-byte encapsulation header.
    pub cdr: Vec<u8>,
}

/// Messages, requests or responses for one endpoint, oldest first.
#[derive(Debug)]
pub struct Inbox {
    /// Number of entries that are kept; older ones are dropped.
    capacity: usize,
    entries: Mutex<VecDeque<Received>>,
}

impl Inbox {
    pub(crate) fn new(capacity: usize) -> Self {
        Self { capacity: capacity.max(1), entries: Mutex::default() }
    }

    pub(crate) fn push(&self, received: Received) {
        let mut entries = lock(&self.entries);
        if entries.len() == self.capacity {
            entries.pop_front();
        }
        entries.push_back(received);
    }

    /// Removes and returns the oldest entry.
    pub fn take(&self) -> Option<Received> {
        lock(&self.entries).pop_front()
    }

    /// True if there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        lock(&self.entries).is_empty()
    }
}
