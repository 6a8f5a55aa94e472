//! Whether scans fit worse than they used to, so that the robot may have been carried away.
//!
//! Source: Thrun, Burgard, Fox, "Probabilistic Robotics", section 8.3.3 (augmented MCL).

/// Averages of how well scans fit, over a long and a short time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Recovery {
    /// Over a long time; 0 before the first scan.
    pub slow: f64,
    /// Over a short time.
    pub fast: f64,
}

impl Recovery {
    /// Takes the mean likelihood of a scan.
    pub fn take(&mut self, mean: f64, [alpha_slow, alpha_fast]: [f64; 2]) {
        let follow = |average: &mut f64, alpha: f64| {
            *average = if *average == 0.0 { mean } else { *average + alpha * (mean - *average) };
        };
        follow(&mut self.slow, alpha_slow);
        follow(&mut self.fast, alpha_fast);
    }

    /// Which share of particles should be anywhere, rather than where the others are.
    #[must_use]
    pub fn share(&self) -> f64 {
        let share = 1.0 - self.fast / self.slow;
        // Also when both are 0, and the share no number.
        if share > 0.0 { share } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::Recovery;

    #[test]
    fn a_sudden_misfit_asks_for_particles_elsewhere() {
        let mut recovery = Recovery::default();
        assert_eq!(recovery.share(), 0.0);
        recovery.take(1.0, [0.0, 0.5]);
        assert_eq!(recovery.share(), 0.0);
        recovery.take(0.5, [0.0, 0.5]);
        assert_eq!((recovery.slow, recovery.fast, recovery.share()), (1.0, 0.75, 0.25));
        recovery.take(9.0, [0.0, 0.5]);
        assert_eq!(recovery.share(), 0.0, "better than usual is no reason");
    }
}
