//! Counter of what has arrived for a program, on which its threads wait.

#![allow(
    clippy::disallowed_methods,
    reason = "an edge: time of the machine for waits without a simulation"
)]

use std::sync::{Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::work::lock;

/// Counter of messages, requests, responses and wake-ups.
#[derive(Default)]
pub(crate) struct Arrivals {
    count: Mutex<u64>,
    changed: Condvar,
}

impl Arrivals {
    /// Counts one more, and wakes all that wait.
    pub(crate) fn add(&self) {
        *lock(&self.count) += 1;
        self.changed.notify_all();
    }

    pub(crate) fn count(&self) -> u64 {
        *lock(&self.count)
    }

    /// Waits until the count differs from `seen`, at most until `end`; returns the count.
    pub(crate) fn wait(&self, seen: u64, end: Instant) -> u64 {
        let mut count = lock(&self.count);
        while *count == seen {
            let rest = end.saturating_duration_since(Instant::now());
            if rest == Duration::ZERO {
                break;
            }
            let waited = self.changed.wait_timeout(count, rest);
            count = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        *count
    }
}
