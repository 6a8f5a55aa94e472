//! Wall time, for pacing and measurements.
#![allow(
    clippy::disallowed_methods,
    reason = "the edge through which all other code reads the clock"
)]

use std::time::Duration;

use clock::Instant;
#[cfg(target_family = "wasm")]
pub use clock::set_clock;

/// Measures wall time.
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch(Instant);

impl Stopwatch {
    /// Starts a stopwatch.
    #[must_use]
    pub fn start() -> Self {
        Self(clock::now())
    }

    /// Time since the start.
    #[must_use]
    pub fn elapsed(&self) -> Duration {
        clock::now() - self.0
    }

    /// Returns the time since the start and restarts.
    pub fn lap(&mut self) -> Duration {
        let now = clock::now();
        let lap = now - self.0;
        self.0 = now;
        lap
    }
}

/// System time \[ns since 1970\].
#[must_use]
pub fn unix_ns() -> i64 {
    i64::try_from(clock::since_1970().as_nanos()).unwrap_or(i64::MAX)
}

/// Sleeps for a duration. Does nothing in WebAssembly, where waiting would block the page's messages.
pub fn sleep(time: Duration) {
    clock::sleep(time);
}

#[cfg(not(target_family = "wasm"))]
mod clock {
    use std::time::{Duration, SystemTime, UNIX_EPOCH};

    pub(super) use std::time::Instant;

    pub(super) fn now() -> Instant {
        Instant::now()
    }

    pub(super) fn since_1970() -> Duration {
        SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default()
    }

    pub(super) fn sleep(time: Duration) {
        std::thread::sleep(time);
    }
}

/// The clock of the browser. `Instant` and `SystemTime` of the standard library panic in WebAssembly.
#[cfg(target_family = "wasm")]
mod clock {
    use std::sync::OnceLock;
    use std::time::Duration;

    /// Time since 1970.
    pub(super) type Instant = Duration;

    static CLOCK: OnceLock<fn() -> Duration> = OnceLock::new();

    /// Sets the clock, which returns the time since 1970 and never jumps back. The first call counts; time
    /// stands still without it.
    pub fn set_clock(clock: fn() -> Duration) {
        let _ = CLOCK.set(clock);
    }

    pub(super) fn now() -> Instant {
        since_1970()
    }

    pub(super) fn since_1970() -> Duration {
        CLOCK.get().map(|clock| clock()).unwrap_or_default()
    }

    pub(super) fn sleep(_time: Duration) {}
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
