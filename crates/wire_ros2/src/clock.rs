//! Time on the wire is that of the machine: how long something has been known, how long to wait.
#![allow(clippy::disallowed_methods, reason = "a network has no other time than the wall's")]

use std::time::{Duration, Instant};

/// A moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Since(Instant);

impl Since {
    pub(crate) fn now() -> Self {
        Self(Instant::now())
    }

    pub(crate) fn elapsed(self) -> Duration {
        self.0.elapsed()
    }
}
