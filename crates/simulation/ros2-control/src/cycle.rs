//! Time of an update.

/// Time and period of one update of the controllers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlCycle {
    /// Time [ns].
    pub time_ns: i64,
    /// Time since the last update [s].
    pub period_s: f64,
}

impl ControlCycle {
    /// Returns the age of a stamp [s].
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "ages of commands are far below 2^53 ns")]
    pub fn age_s(self, stamp_ns: i64) -> f64 {
        self.time_ns.saturating_sub(stamp_ns) as f64 * 1e-9
    }
}
