//! Waking of a thread that sleeps until it has work.

use std::sync::{Condvar, Mutex, PoisonError};
use std::time::Duration;

use crate::{Since, lock};

/// Wakes one thread. Calls of [`Bell::ring`] while it works are not lost.
#[derive(Debug, Default)]
pub struct Bell {
    is_due: Mutex<bool>,
    rung: Condvar,
}

impl Bell {
    /// Wakes the thread, or keeps it from sleeping next time.
    pub fn ring(&self) {
        *lock(&self.is_due) = true;
        self.rung.notify_one();
    }

    /// Sleeps until the bell rings, at most for the timeout.
    pub fn wait(&self, timeout: Duration) {
        let is_due = lock(&self.is_due);
        let waited = self.rung.wait_timeout_while(is_due, timeout, |is_due| !*is_due);
        *waited.unwrap_or_else(PoisonError::into_inner).0 = false;
    }
}

/// Period at which [`wait_until`] checks.
const LOOK_AGAIN: Duration = Duration::from_millis(5);

/// Waits until a condition holds that nothing signals, at most for the timeout; true if it holds.
#[must_use]
pub fn wait_until(timeout: Duration, is_done: impl Fn() -> bool) -> bool {
    let start = Since::now();
    loop {
        if is_done() {
            return true;
        }
        if start.elapsed() >= timeout {
            return false;
        }
        std::thread::sleep(LOOK_AGAIN);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_before_the_wait_is_not_lost() {
        let bell = Bell::default();
        bell.ring();
        bell.ring();
        // Returns at once; the test would last for an hour otherwise.
        bell.wait(Duration::from_secs(3600));
        bell.wait(Duration::ZERO);
    }

    #[test]
    fn a_condition_is_checked_before_the_timeout() {
        assert!(wait_until(Duration::ZERO, || true));
        assert!(!wait_until(Duration::ZERO, || false));
    }
}
