//! Wall time, for those who follow or measure it.
#![allow(clippy::disallowed_methods, reason = "this is the edge that all others ask")]

use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// Measures wall time.
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch(Instant);

impl Stopwatch {
    /// Starts one.
    #[must_use]
    pub fn start() -> Self {
        Self(Instant::now())
    }

    /// Time since it was started.
    #[must_use]
    pub fn elapsed(&self) -> Duration {
        self.0.elapsed()
    }

    /// Time since it was started, and starts it again.
    pub fn lap(&mut self) -> Duration {
        let now = Instant::now();
        let lap = now - self.0;
        self.0 = now;
        lap
    }
}

/// What the machine's clock shows \[ns since 1970\].
#[must_use]
pub fn unix_ns() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_nanos()).unwrap_or(i64::MAX)
}

/// Waits.
pub fn sleep(time: Duration) {
    std::thread::sleep(time);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lap_starts_anew() {
        let mut stopwatch = Stopwatch::start();
        sleep(Duration::from_millis(2));
        assert!(stopwatch.lap() >= Duration::from_millis(2));
        assert!(stopwatch.elapsed() < Duration::from_secs(10));
    }
}
