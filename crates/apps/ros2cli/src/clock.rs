//! Wall clock, for stamps.
#![allow(clippy::disallowed_methods, reason = "the stamp `now` is wall time")]

use std::time::{SystemTime, UNIX_EPOCH};

/// Time since 1970 \[ns\].
#[must_use]
pub fn unix_ns() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_nanos()).unwrap_or(i64::MAX)
}
