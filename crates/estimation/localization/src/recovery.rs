//! Recovery from localization failures by long-term and short-term averages of the measurement
//! likelihood.
//!
//! Source: Thrun, Burgard, Fox, *Probabilistic Robotics*, section 8.3.3, table 8.3 (Augmented_MCL).

/// Exponential averages of the measurement likelihood.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LikelihoodAverages {
    /// Long-term average `w_slow`; 0 before the first scan.
    pub slow: f64,
    /// Short-term average `w_fast`.
    pub fast: f64,
}

impl LikelihoodAverages {
    /// Updates the averages with the mean likelihood of a scan (table 8.3, lines 10 and 11).
    pub fn update(&mut self, mean: f64, [alpha_slow, alpha_fast]: [f64; 2]) {
        let filter = |average: &mut f64, alpha: f64| {
            *average = if *average == 0.0 { mean } else { *average + alpha * (mean - *average) };
        };
        filter(&mut self.slow, alpha_slow);
        filter(&mut self.fast, alpha_fast);
    }

    /// Probability of drawing a particle from the whole map: `max(0, 1 - w_fast / w_slow)` (table
    /// 8.3, line 13).
    #[must_use]
    pub fn random_fraction(&self) -> f64 {
        let random_fraction = 1.0 - self.fast / self.slow;
        // NaN when both are 0.
        if random_fraction > 0.0 { random_fraction } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::LikelihoodAverages;

    #[test]
    fn a_sudden_misfit_adds_random_particles() {
        let mut averages = LikelihoodAverages::default();
        assert_eq!(averages.random_fraction(), 0.0);
        averages.update(1.0, [0.0, 0.5]);
        assert_eq!(averages.random_fraction(), 0.0);
        averages.update(0.5, [0.0, 0.5]);
        assert_eq!((averages.slow, averages.fast, averages.random_fraction()), (1.0, 0.75, 0.25));
        averages.update(9.0, [0.0, 0.5]);
        assert_eq!(
            averages.random_fraction(),
            0.0,
            "better than usual is no reason for random particles"
        );
    }
}
