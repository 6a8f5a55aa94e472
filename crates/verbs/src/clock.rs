//! The time of day, for stamps.
#![allow(clippy::disallowed_methods, reason = "a stamp that says `now` means the wall's time")]

use std::time::{SystemTime, UNIX_EPOCH};

use periplus_msgs::builtin_interfaces::Time;

/// Time since 1970 \[ns\].
#[must_use]
pub fn unix_ns() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_nanos()).unwrap_or(i64::MAX)
}

/// A time as messages have it.
#[must_use]
pub fn stamp(time_ns: i64) -> Time {
    let sec = i32::try_from(time_ns.div_euclid(1_000_000_000)).unwrap_or(i32::MAX);
    Time { sec, nanosec: u32::try_from(time_ns.rem_euclid(1_000_000_000)).unwrap_or(0) }
}
