//! How fast simulated time goes.

use std::time::Duration;

use periplus_os::{Stopwatch, sleep};

/// Simulated time that falls further behind than this is let go: after a pause of the machine
/// nobody wants to see the world race \[s\].
const LONGEST_LAG_S: f64 = 0.2;

/// Waits shorter than this are not worth the call \[s\].
const SHORTEST_WAIT_S: f64 = 0.000_5;

/// Keeps simulated time at a factor of wall time.
#[derive(Clone, Debug)]
pub struct Pace {
    factor: Option<f64>,
    stopwatch: Stopwatch,
    start_ns: i64,
}

impl Pace {
    /// Follows the wall at a factor; without one as fast as can be. A factor that is no positive
    /// number counts as none.
    #[must_use]
    pub fn new(factor: Option<f64>, time_ns: i64) -> Self {
        let factor = factor.filter(|factor| factor.is_finite() && *factor > 0.0);
        Self { factor, stopwatch: Stopwatch::start(), start_ns: time_ns }
    }

    /// Begins again: time stood still, or jumped.
    pub fn restart(&mut self, time_ns: i64) {
        *self = Self::new(self.factor, time_ns);
    }

    /// Waits until the wall has come to a simulated time.
    pub fn wait(&mut self, time_ns: i64) {
        let Some(factor) = self.factor else { return };
        #[expect(clippy::cast_precision_loss, reason = "a run lasts less than 2^53 ns")]
        let wanted_s = (time_ns - self.start_ns) as f64 * 1e-9 / factor;
        let ahead_s = wanted_s - self.stopwatch.elapsed().as_secs_f64();
        if ahead_s > SHORTEST_WAIT_S {
            sleep(Duration::from_secs_f64(ahead_s));
        } else if ahead_s < -LONGEST_LAG_S {
            self.restart(time_ns);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twice_as_fast_takes_half_the_time() {
        let stopwatch = Stopwatch::start();
        let mut pace = Pace::new(Some(2.0), 0);
        for tick in 1..=10 {
            pace.wait(tick * 10_000_000);
        }
        let elapsed = stopwatch.elapsed();
        assert!(elapsed >= Duration::from_millis(48), "{elapsed:?}");
    }

    #[test]
    fn without_a_factor_nothing_waits() {
        let stopwatch = Stopwatch::start();
        Pace::new(None, 0).wait(3_600_000_000_000);
        Pace::new(Some(f64::NAN), 0).wait(3_600_000_000_000);
        assert!(stopwatch.elapsed() < Duration::from_secs(1));
    }
}
