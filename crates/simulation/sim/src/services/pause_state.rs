//! Pausing and stepping.

/// Pause state: running, paused, or a number of steps before a pause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct PauseState {
    is_paused: bool,
    /// End of the requested steps of a paused world \[ns\].
    until_ns: Option<i64>,
}

impl PauseState {
    /// Pauses or resumes.
    pub(crate) fn set_paused(&mut self, is_paused: bool) {
        *self = Self { is_paused, until_ns: None };
    }

    pub(crate) fn is_paused(self) -> bool {
        self.is_paused
    }

    /// Returns true while requested steps remain.
    pub(crate) fn is_stepping(self) -> bool {
        self.until_ns.is_some()
    }

    pub(crate) fn may_step(self) -> bool {
        !self.is_paused || self.is_stepping()
    }

    /// Returns the latest end of the next step \[ns\].
    pub(crate) fn until_ns(self) -> i64 {
        self.until_ns.unwrap_or(i64::MAX)
    }

    /// Adds steps before a pause, after those of earlier requests.
    pub(crate) fn add_steps(&mut self, steps: u32, step_ns: i64, now_ns: i64) {
        let from_ns = self.until_ns.unwrap_or(now_ns);
        let way_ns = i64::from(steps).saturating_mul(step_ns);
        self.run_to(from_ns.saturating_add(way_ns), now_ns);
    }

    /// Runs to a time \[ns\], then pauses. A past time pauses at once.
    pub(crate) fn run_to(&mut self, time_ns: i64, now_ns: i64) {
        *self = Self { is_paused: true, until_ns: (time_ns > now_ns).then_some(time_ns) };
    }

    /// Records the current time \[ns\].
    pub(crate) fn arrived(&mut self, now_ns: i64) {
        self.until_ns = self.until_ns.filter(|until_ns| now_ns < *until_ns);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_add_up_and_end_in_a_pause() {
        let mut tempo = PauseState::default();
        assert!(tempo.may_step());
        tempo.set_paused(true);
        assert!(!tempo.may_step());
        tempo.add_steps(10, 1_000, 500);
        tempo.add_steps(1, 1_000, 500);
        assert_eq!(tempo.until_ns(), 11_500);
        assert!(tempo.may_step());
        tempo.arrived(11_499);
        assert!(tempo.may_step());
        tempo.arrived(11_500);
        assert!(!tempo.may_step() && tempo.is_paused());
    }

    #[test]
    fn a_time_that_is_over_is_a_pause() {
        let mut tempo = PauseState::default();
        tempo.run_to(5, 7);
        assert!(!tempo.may_step());
        tempo.run_to(8, 7);
        assert!(tempo.may_step());
    }
}
