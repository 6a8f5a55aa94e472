//! Times of a loop with a fixed rate.

/// Times at which a loop runs: a period apart, without drift.
///
/// After a jump of time or an overrun of more than a period the phase starts again.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoopRate {
    period_ns: i64,
    next_ns: i64,
}

impl LoopRate {
    /// Starts a loop now; its second run is one period later.
    pub(crate) fn start(period_ns: i64, now_ns: i64) -> Self {
        Self { period_ns: period_ns.max(1), next_ns: now_ns }
    }

    /// Starts a loop of a frequency \[Hz\].
    pub(crate) fn of_hertz(frequency_hz: f64, now_ns: i64) -> Self {
        Self::start((1e9 / frequency_hz) as i64, now_ns)
    }

    /// Time of the next run \[ns\].
    pub(crate) fn next(&mut self, now_ns: i64) -> i64 {
        let next_ns = self.next_ns.saturating_add(self.period_ns);
        let is_ahead = now_ns < next_ns && next_ns - now_ns <= self.period_ns;
        self.next_ns = if is_ahead { next_ns } else { now_ns.saturating_add(self.period_ns) };
        self.next_ns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_keeps_its_phase_and_survives_jumps() {
        let mut rate = LoopRate::start(100, 1000);
        let mut check = |now_ns, expected| assert_eq!(rate.next(now_ns), expected, "{now_ns}");
        check(1000, 1100);
        check(1130, 1200);
        check(1200, 1300);
        check(1450, 1550);
        check(0, 100);
        check(100, 200);
    }
}
