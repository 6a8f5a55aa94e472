//! Times and headers of messages.

use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::std_msgs::Header;

/// A time as messages carry it.
#[must_use]
pub fn stamp(time_ns: i64) -> Time {
    // Simulated time starts at zero and a message counts seconds in 31 bits.
    let sec = i32::try_from(time_ns.div_euclid(1_000_000_000)).unwrap_or(i32::MAX);
    let nanosec = u32::try_from(time_ns.rem_euclid(1_000_000_000)).unwrap_or_default();
    Time { sec, nanosec }
}

/// A header.
#[must_use]
pub fn header(time_ns: i64, frame_id: &str) -> Header {
    Header { stamp: stamp(time_ns), frame_id: frame_id.into() }
}
