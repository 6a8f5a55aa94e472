//! System time for network code: ages and timeouts.
#![allow(clippy::disallowed_methods, reason = "network timeouts use the system clock")]

use std::time::{Duration, Instant, SystemTime};

/// A point in time.
#[derive(Clone, Copy, Debug)]
pub struct Since(Instant);

impl Since {
    /// The current time.
    #[must_use]
    pub fn now() -> Self {
        Self(Instant::now())
    }

    /// Time since this point.
    #[must_use]
    pub fn elapsed(self) -> Duration {
        self.0.elapsed()
    }
}

/// System time since 1970 \[ns\].
#[must_use]
pub fn unix_ns() -> i64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_nanos()).unwrap_or(i64::MAX)
}
