//! Conversion of times.

use crate::builtin_interfaces::{Duration, Time};
use crate::std_msgs::Header;

const NS_PER_S: i64 = 1_000_000_000;

impl Time {
    /// Message of a time \[ns\]: seconds have 31 bits, so the range ends in 2038.
    #[must_use]
    pub fn of_ns(time_ns: i64) -> Self {
        let sec = i32::try_from(time_ns.div_euclid(NS_PER_S)).unwrap_or(i32::MAX);
        Self { sec, nanosec: u32::try_from(time_ns.rem_euclid(NS_PER_S)).unwrap_or_default() }
    }

    /// Time \[ns\].
    #[must_use]
    pub fn ns(&self) -> i64 {
        i64::from(self.sec) * NS_PER_S + i64::from(self.nanosec)
    }
}

impl Duration {
    /// Message of a duration \[ns\].
    #[must_use]
    pub fn of_ns(duration_ns: i64) -> Self {
        let Time { sec, nanosec } = Time::of_ns(duration_ns);
        Self { sec, nanosec }
    }

    /// Duration \[ns\].
    #[must_use]
    pub fn ns(&self) -> i64 {
        i64::from(self.sec) * NS_PER_S + i64::from(self.nanosec)
    }
}

impl Header {
    /// Header with a time \[ns\] and a frame.
    #[must_use]
    pub fn at(time_ns: i64, frame_id: &str) -> Self {
        Self { stamp: Time::of_ns(time_ns), frame_id: frame_id.to_owned() }
    }
}

#[test]
fn times_go_there_and_back() {
    for time_ns in [0, 1, -1, 999_999_999, 1_000_000_000, -1_000_000_001] {
        assert_eq!(Time::of_ns(time_ns).ns(), time_ns);
        assert_eq!(Duration::of_ns(time_ns).ns(), time_ns);
    }
    assert_eq!(Time::of_ns(-1), Time { sec: -1, nanosec: 999_999_999 });
    assert_eq!(Time::of_ns(i64::MAX).sec, i32::MAX);
}
