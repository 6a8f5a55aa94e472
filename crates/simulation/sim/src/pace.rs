//! Real-time pacing.

use std::time::Duration;

use periplus_os::{Stopwatch, sleep};

/// Maximum lag of simulated time that is caught up \[s\]; after a longer pause of the machine the
/// rest is skipped.
const MAX_LAG_S: f64 = 0.2;

/// Minimum wait that is worth a system call \[s\].
const MIN_WAIT_S: f64 = 0.000_5;

/// Keeps simulated time at a factor of wall time.
#[derive(Clone, Debug)]
pub struct RealTimePacer {
    factor: Option<f64>,
    stopwatch: Stopwatch,
    start_ns: i64,
}

impl RealTimePacer {
    /// Creates a pace with a real-time factor; `None`, or a factor that is not positive, is
    /// unlimited.
    #[must_use]
    pub fn new(factor: Option<f64>, time_ns: i64) -> Self {
        let factor = factor.filter(|factor| factor.is_finite() && *factor > 0.0);
        Self { factor, stopwatch: Stopwatch::start(), start_ns: time_ns }
    }

    /// Restarts after a pause or a jump.
    pub fn restart(&mut self, time_ns: i64) {
        *self = Self::new(self.factor, time_ns);
    }

    /// Waits until wall time has reached a simulated time.
    pub fn wait(&mut self, time_ns: i64) {
        if let Some(wait) = self.until(time_ns) {
            sleep(wait);
        }
    }

    /// Time until wall time has reached a simulated time; `None` if it has, or if the rest is not worth a wait.
    pub fn until(&mut self, time_ns: i64) -> Option<Duration> {
        let ahead_s = self.ahead_s(time_ns, self.stopwatch.elapsed())?;
        if ahead_s < -MAX_LAG_S {
            self.restart(time_ns);
        }
        (ahead_s > MIN_WAIT_S).then(|| Duration::from_secs_f64(ahead_s))
    }

    /// Wall time by which a simulated time is ahead \[s\]; `None` without a factor.
    fn ahead_s(&self, time_ns: i64, elapsed: Duration) -> Option<f64> {
        #[expect(clippy::cast_precision_loss, reason = "a run lasts less than 2^53 ns")]
        let wanted_s = (time_ns - self.start_ns) as f64 * 1e-9 / self.factor?;
        Some(wanted_s - elapsed.as_secs_f64())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twice_as_fast_takes_half_the_time() {
        let stopwatch = Stopwatch::start();
        let mut pace = RealTimePacer::new(Some(2.0), 0);
        for tick in 1..=10 {
            pace.wait(tick * 10_000_000);
        }
        let elapsed = stopwatch.elapsed();
        assert!(elapsed >= Duration::from_millis(48), "{elapsed:?}");
    }

    #[test]
    fn half_as_fast_is_ahead_by_twice_the_time() {
        let pace = RealTimePacer::new(Some(0.5), 1_000_000_000);
        let ahead_s = pace.ahead_s(2_000_000_000, Duration::from_millis(1500));
        assert_eq!(ahead_s, Some(0.5), "1 s takes 2 s, of which 1.5 s have passed");
    }

    #[test]
    fn without_a_factor_nothing_waits() {
        let stopwatch = Stopwatch::start();
        RealTimePacer::new(None, 0).wait(3_600_000_000_000);
        RealTimePacer::new(Some(f64::NAN), 0).wait(3_600_000_000_000);
        assert!(stopwatch.elapsed() < Duration::from_secs(1));
    }
}
