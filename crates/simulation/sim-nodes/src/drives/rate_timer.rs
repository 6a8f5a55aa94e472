//! When a device acts or publishes.

use periplus_sensors::{Quirks, Schedule};

/// Times at a rate, or each step. Controllers keep their own time to the nanosecond in Gazebo too,
/// so no quirk applies.
#[derive(Clone, Debug)]
pub(crate) struct Beat {
    rate_hz: f64,
    /// Whether the first time is the start itself, and not one period later.
    at_once: bool,
    schedule: Schedule,
}

impl Beat {
    /// For controllers: from the start on.
    pub(crate) fn acting(rate_hz: f64, start_ns: i64) -> Self {
        Self::new(rate_hz, true, start_ns)
    }

    /// For publishers: one period after the start first.
    pub(crate) fn telling(rate_hz: f64, start_ns: i64) -> Self {
        Self::new(rate_hz, false, start_ns)
    }

    fn new(rate_hz: f64, at_once: bool, start_ns: i64) -> Self {
        let mut schedule = Schedule::new(rate_hz, start_ns, Quirks::NONE);
        if !at_once && schedule.next_ns().is_some() {
            schedule.due(start_ns);
        }
        Self { rate_hz, at_once, schedule }
    }

    /// Whether it is time; if so, the time is used up.
    pub(crate) fn due(&mut self, now_ns: i64) -> bool {
        self.schedule.due(now_ns).is_some()
    }

    /// As [`Self::due`], with the number of the time since the start.
    pub(crate) fn due_number(&mut self, now_ns: i64) -> Option<u64> {
        self.schedule.due(now_ns)
    }

    /// The next time; none if each step is one.
    pub(crate) fn next_ns(&self) -> Option<i64> {
        self.schedule.next_ns()
    }

    pub(crate) fn restart(&mut self, start_ns: i64) {
        *self = Self::new(self.rate_hz, self.at_once, start_ns);
    }
}

/// The earlier of two times, where there are any.
pub(crate) fn earlier(one: Option<i64>, other: Option<i64>) -> Option<i64> {
    one.into_iter().chain(other).min()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn controllers_begin_at_once_and_publishers_a_period_later() {
        let times = |mut beat: Beat| -> Vec<i64> {
            (0..=30).filter(|&ms| beat.due(ms * 1_000_000)).collect()
        };
        assert_eq!(times(Beat::acting(100.0, 0)), [0, 10, 20, 30]);
        assert_eq!(times(Beat::telling(100.0, 0)), [10, 20, 30]);
        assert_eq!(times(Beat::telling(0.0, 0)).len(), 31);
        let mut beat = Beat::telling(100.0, 0);
        assert!(beat.due(15_000_000));
        beat.restart(5_000_000);
        assert_eq!(beat.next_ns(), Some(15_000_000));
    }
}
