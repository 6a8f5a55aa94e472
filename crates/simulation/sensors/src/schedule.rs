//! Measurement times of a sensor.

use crate::Quirks;

const SECOND_NS: f64 = 1e9;

/// Measurement times: number `k` at `start + k / rate`, rounded to a nanosecond, without drift. A
/// measurement happens at the first step at or after its time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schedule {
    start_ns: i64,
    rate: MeasurementRate,
    next: u64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum MeasurementRate {
    EachStep,
    Hz(f64),
    Period { whole_ms: i64 },
}

impl Schedule {
    /// Creates a schedule from a time on, including it. A rate that is not positive (or NaN) means
    /// every step, as in Gazebo; so does a rate above the resolution of nanoseconds.
    #[must_use]
    pub fn new(update_rate_hz: f64, start_ns: i64, quirks: Quirks) -> Self {
        let rate = if !(update_rate_hz > 0.0 && update_rate_hz <= SECOND_NS) {
            MeasurementRate::EachStep
        } else if quirks.whole_millisecond_periods {
            // gz-sensors truncates the period to whole milliseconds (`Sensor.cc`): 30 Hz is 33 ms.
            #[expect(clippy::cast_possible_truncation, reason = "as gz does; it saturates")]
            let whole_ms = (1e3 / update_rate_hz) as i64;
            if whole_ms == 0 {
                MeasurementRate::EachStep
            } else {
                MeasurementRate::Period { whole_ms }
            }
        } else {
            MeasurementRate::Hz(update_rate_hz)
        };
        Self { start_ns, rate, next: 0 }
    }

    /// Returns the time of the next measurement; `None` when every step is one.
    #[must_use]
    pub fn next_ns(&self) -> Option<i64> {
        self.time_ns(self.next)
    }

    /// Returns the number of the measurement that is due, if any, and completes it. Of several
    /// skipped by a long step the last counts.
    pub fn due(&mut self, now_ns: i64) -> Option<u64> {
        let number = match self.rate {
            MeasurementRate::EachStep => self.next,
            _ if self.next_ns()? > now_ns => return None,
            rate => {
                let since_ns = now_ns.saturating_sub(self.start_ns);
                #[expect(
                    clippy::cast_precision_loss,
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "an estimate, corrected below; casts saturate"
                )]
                let mut guess = match rate {
                    MeasurementRate::Hz(rate_hz) => (since_ns as f64 * rate_hz / SECOND_NS) as u64,
                    MeasurementRate::Period { whole_ms } => {
                        (since_ns / (whole_ms * 1_000_000)) as u64
                    }
                    MeasurementRate::EachStep => 0,
                };
                let is_over = |number: u64| self.time_ns(number).is_some_and(|time| time <= now_ns);
                while guess > self.next && !is_over(guess) {
                    guess -= 1;
                }
                while is_over(guess.saturating_add(1)) && guess < u64::MAX - 1 {
                    guess += 1;
                }
                guess.max(self.next)
            }
        };
        self.next = number.saturating_add(1);
        Some(number)
    }

    /// Returns the time between measurements [s]; 0 when every step is one.
    #[must_use]
    pub fn period_s(&self) -> f64 {
        match self.rate {
            MeasurementRate::EachStep => 0.0,
            MeasurementRate::Hz(rate_hz) => 1.0 / rate_hz,
            #[expect(clippy::cast_precision_loss, reason = "a period")]
            MeasurementRate::Period { whole_ms } => whole_ms as f64 / 1e3,
        }
    }

    /// Changes the rate from now on (`set_rate` services); the count continues.
    pub fn set_rate(&mut self, update_rate_hz: f64, now_ns: i64, quirks: Quirks) {
        let count = self.next;
        *self = Self::new(update_rate_hz, now_ns, quirks);
        // A start `count` periods in the past keeps numbers unique.
        if let Some(passed_ns) = self.time_ns(count).map(|time| time.saturating_sub(now_ns)) {
            self.start_ns = self.start_ns.saturating_sub(passed_ns);
        }
        self.next = count;
    }

    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        reason = "times below 2^53 ns are exact; beyond, casts saturate"
    )]
    fn time_ns(&self, number: u64) -> Option<i64> {
        let since_ns = match self.rate {
            MeasurementRate::EachStep => return None,
            MeasurementRate::Hz(rate_hz) => (number as f64 * SECOND_NS / rate_hz).round() as i64,
            MeasurementRate::Period { whole_ms } => whole_ms
                .saturating_mul(1_000_000)
                .saturating_mul(number.min(i64::MAX as u64) as i64),
        };
        Some(self.start_ns.saturating_add(since_ns))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: i64 = 1_000_000;

    /// Times [ms] of the measurements in the first steps of 1 ms.
    fn times(rate_hz: f64, quirks: Quirks, steps: i64) -> Vec<i64> {
        let mut schedule = Schedule::new(rate_hz, 0, quirks);
        (0..=steps).filter(|step| schedule.due(step * MS).is_some()).collect()
    }

    #[test]
    fn thirty_hertz_does_not_drift() {
        assert_eq!(times(30.0, Quirks::NONE, 105), [0, 34, 67, 100]);
        assert_eq!(times(30.0, Quirks::NONE, 60_000).len(), 1801);
    }

    #[test]
    fn gz_makes_thirty_hertz_of_33_ms() {
        assert_eq!(times(30.0, Quirks::GAZEBO, 105), [0, 33, 66, 99]);
        assert_eq!(times(60.0, Quirks::GAZEBO, 50), [0, 16, 32, 48]);
    }

    #[test]
    fn no_rate_is_each_step() {
        for rate in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(times(rate, Quirks::NONE, 3), [0, 1, 2, 3]);
        }
        assert_eq!(times(5000.0, Quirks::GAZEBO, 2), [0, 1, 2]);
        assert_eq!(Schedule::new(0.0, 0, Quirks::NONE).next_ns(), None);
    }

    #[test]
    fn what_a_long_step_passed_over_is_left_out() {
        let mut schedule = Schedule::new(10.0, 50 * MS, Quirks::NONE);
        assert_eq!(schedule.due(49 * MS), None);
        assert_eq!(schedule.due(460 * MS), Some(4));
        assert_eq!(schedule.due(460 * MS), None);
        assert_eq!(schedule.next_ns(), Some(550 * MS));
    }

    #[test]
    fn extreme_rates_end() {
        let mut slow = Schedule::new(1e-300, 0, Quirks::NONE);
        assert_eq!((slow.due(0), slow.due(i64::MAX - 1)), (Some(0), None));
        let mut fast = Schedule::new(1e300, 0, Quirks::NONE);
        assert!(fast.due(MS).is_some() && fast.due(2 * MS).is_some());
    }

    #[test]
    fn a_new_rate_counts_on() {
        let mut schedule = Schedule::new(10.0, 0, Quirks::NONE);
        assert_eq!(schedule.due(100 * MS), Some(1));
        schedule.set_rate(100.0, 130 * MS, Quirks::NONE);
        assert_eq!((schedule.due(130 * MS), schedule.due(140 * MS)), (Some(2), Some(3)));
    }
}
