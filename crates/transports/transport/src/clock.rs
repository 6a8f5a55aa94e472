//! System time for network code: ages and timeouts.

use std::time::Duration;

use periplus_os::Stopwatch;

pub use periplus_os::unix_ns;

/// A point in time.
#[derive(Clone, Copy, Debug)]
pub struct Since(Stopwatch);

impl Since {
    /// The current time.
    #[must_use]
    pub fn now() -> Self {
        Self(Stopwatch::start())
    }

    /// Time since this point.
    #[must_use]
    pub fn elapsed(self) -> Duration {
        self.0.elapsed()
    }
}
