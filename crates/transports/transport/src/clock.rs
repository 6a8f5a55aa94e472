//! Time on the wire is that of the machine: how long something has been known, how long to wait.
#![allow(clippy::disallowed_methods, reason = "a network has no other time than the wall's")]

use std::time::{Duration, Instant, SystemTime};

/// A moment.
#[derive(Clone, Copy, Debug)]
pub struct Since(Instant);

impl Since {
    /// This one.
    #[must_use]
    pub fn now() -> Self {
        Self(Instant::now())
    }

    /// How long ago it was.
    #[must_use]
    pub fn elapsed(self) -> Duration {
        self.0.elapsed()
    }
}

/// The time of the machine, since 1970 \[ns\].
#[must_use]
pub fn unix_ns() -> i64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_nanos()).unwrap_or(i64::MAX)
}
