//! Times of messages.

use periplus_msgs::builtin_interfaces::Time;

pub(crate) fn stamp(time_ns: i64) -> Time {
    let sec = i32::try_from(time_ns.div_euclid(1_000_000_000)).unwrap_or(i32::MAX);
    Time { sec, nanosec: u32::try_from(time_ns.rem_euclid(1_000_000_000)).unwrap_or_default() }
}
