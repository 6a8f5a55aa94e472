//! Waiting for other threads.
#![allow(unreachable_pub, reason = "each test takes what it needs")]

use std::time::Duration;

use periplus_os::{Stopwatch, sleep};

/// Longest wait for something; usually it takes some milliseconds.
pub const PATIENCE: Duration = Duration::from_secs(20);

#[track_caller]
pub fn wait_for<T>(mut wanted: impl FnMut() -> Option<T>) -> T {
    let clock = Stopwatch::start();
    loop {
        if let Some(found) = wanted() {
            return found;
        }
        assert!(clock.elapsed() < PATIENCE, "it did not happen");
        sleep(Duration::from_millis(5));
    }
}
