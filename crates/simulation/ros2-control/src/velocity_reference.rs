//! Velocity commands with time stamps and a timeout.

use crate::{ControlCycle, PlanarTwist};

/// Result of a received command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReferenceOutcome {
    /// The command applies from now on.
    Accepted,
    /// The stamp was zero and is replaced by the current time.
    StampedNow,
    /// The command is older than the timeout and dropped.
    TooOld,
    /// A number is not finite, and the command is dropped.
    NotFinite,
}

/// The last velocity command, which expires.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityReference {
    /// Maximum age of a command [s]; zero for none.
    pub timeout_s: f64,
    twist: PlanarTwist,
    stamp_ns: Option<i64>,
}

impl VelocityReference {
    /// Creates a reference without a command.
    #[must_use]
    pub fn new(timeout_s: f64) -> Self {
        Self { timeout_s, twist: PlanarTwist::default(), stamp_ns: None }
    }

    /// Receives a command. A stamp of zero is the current time; `None` is a command without a stamp.
    pub fn receive(
        &mut self,
        twist: PlanarTwist,
        stamp_ns: Option<i64>,
        now_ns: i64,
    ) -> ReferenceOutcome {
        if !twist.is_finite() {
            return ReferenceOutcome::NotFinite;
        }
        let (stamp_ns, outcome) = match stamp_ns {
            Some(0) => (now_ns, ReferenceOutcome::StampedNow),
            Some(stamp_ns) => (stamp_ns, ReferenceOutcome::Accepted),
            None => (now_ns, ReferenceOutcome::Accepted),
        };
        let cycle = ControlCycle { time_ns: now_ns, period_s: 0.0 };
        if self.timeout_s > 0.0 && cycle.age_s(stamp_ns) > self.timeout_s {
            return ReferenceOutcome::TooOld;
        }
        (self.twist, self.stamp_ns) = (twist, Some(stamp_ns));
        outcome
    }

    /// Returns the command that applies now: zero without one, and after the timeout.
    pub fn current(&mut self, cycle: ControlCycle) -> PlanarTwist {
        let is_expired = self
            .stamp_ns
            .is_none_or(|stamp_ns| self.timeout_s > 0.0 && cycle.age_s(stamp_ns) > self.timeout_s);
        if is_expired {
            self.twist = PlanarTwist::default();
        }
        self.twist
    }

    /// Returns true if a command has been received since the last [`Self::clear`].
    #[must_use]
    pub fn has_command(&self) -> bool {
        self.stamp_ns.is_some()
    }

    /// Forgets the command.
    pub fn clear(&mut self) {
        (self.twist, self.stamp_ns) = Default::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AHEAD: PlanarTwist = PlanarTwist { x_m_s: 1.0, y_m_s: 0.0, yaw_rad_s: 0.0 };

    fn at(time_ms: i64) -> ControlCycle {
        ControlCycle { time_ns: time_ms * 1_000_000, period_s: 0.01 }
    }

    #[test]
    fn a_command_expires() {
        let mut reference = VelocityReference::new(0.5);
        let ms = |ms: i64| Some(ms * 1_000_000);
        assert_eq!(reference.receive(AHEAD, ms(1000), 1_000_000_000), ReferenceOutcome::Accepted);
        assert_eq!(reference.current(at(1500)), AHEAD);
        assert_eq!(reference.current(at(1501)), PlanarTwist::default());
        assert_eq!(reference.receive(AHEAD, ms(1000), 1_501_000_000), ReferenceOutcome::TooOld);
        assert_eq!(reference.receive(AHEAD, Some(0), 2_000_000_000), ReferenceOutcome::StampedNow);
        assert_eq!(reference.current(at(2500)), AHEAD);
        let bad = PlanarTwist { x_m_s: f64::NAN, ..AHEAD };
        assert_eq!(reference.receive(bad, None, 0), ReferenceOutcome::NotFinite);
    }

    #[test]
    fn without_a_timeout_it_stays() {
        let mut reference = VelocityReference::new(0.0);
        assert_eq!(reference.current(at(0)), PlanarTwist::default());
        assert_eq!(reference.receive(AHEAD, None, 0), ReferenceOutcome::Accepted);
        assert_eq!(reference.current(at(1_000_000)), AHEAD);
    }
}
