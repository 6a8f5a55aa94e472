//! Rates of devices.

use periplus_sensors::{Quirks, Schedule};

/// Timer with a rate, or with every step. Controllers in Gazebo are accurate to the nanosecond too,
/// so no quirk applies.
#[derive(Clone, Debug)]
pub(crate) struct RateTimer {
    rate_hz: f64,
    /// True if the first time is the start itself, not one period later.
    at_once: bool,
    schedule: Schedule,
}

impl RateTimer {
    /// For controllers: the first time is the start.
    pub(crate) fn for_controller(rate_hz: f64, start_ns: i64) -> Self {
        Self::new(rate_hz, true, start_ns)
    }

    /// For publishers: the first time is one period after the start.
    pub(crate) fn for_publisher(rate_hz: f64, start_ns: i64) -> Self {
        Self::new(rate_hz, false, start_ns)
    }

    fn new(rate_hz: f64, at_once: bool, start_ns: i64) -> Self {
        let mut schedule = Schedule::new(rate_hz, start_ns, Quirks::NONE);
        if !at_once && schedule.next_ns().is_some() {
            schedule.due(start_ns);
        }
        Self { rate_hz, at_once, schedule }
    }

    /// Returns true if the timer is due, and advances it.
    pub(crate) fn due(&mut self, now_ns: i64) -> bool {
        self.schedule.due(now_ns).is_some()
    }

    /// As [`Self::due`], with the number of periods since the start.
    pub(crate) fn due_number(&mut self, now_ns: i64) -> Option<u64> {
        self.schedule.due(now_ns)
    }

    /// Returns the next time; `None` if each step is one.
    pub(crate) fn next_ns(&self) -> Option<i64> {
        self.schedule.next_ns()
    }

    pub(crate) fn restart(&mut self, start_ns: i64) {
        *self = Self::new(self.rate_hz, self.at_once, start_ns);
    }
}

/// Returns the earlier of two optional times.
pub(crate) fn earlier(one: Option<i64>, other: Option<i64>) -> Option<i64> {
    one.into_iter().chain(other).min()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn controllers_begin_at_once_and_publishers_a_period_later() {
        let times = |mut beat: RateTimer| -> Vec<i64> {
            (0..=30).filter(|&ms| beat.due(ms * 1_000_000)).collect()
        };
        assert_eq!(times(RateTimer::for_controller(100.0, 0)), [0, 10, 20, 30]);
        assert_eq!(times(RateTimer::for_publisher(100.0, 0)), [10, 20, 30]);
        assert_eq!(times(RateTimer::for_publisher(0.0, 0)).len(), 31);
        let mut beat = RateTimer::for_publisher(100.0, 0);
        assert!(beat.due(15_000_000));
        beat.restart(5_000_000);
        assert_eq!(beat.next_ns(), Some(15_000_000));
    }
}
