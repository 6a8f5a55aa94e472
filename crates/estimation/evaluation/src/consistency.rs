//! Errors of an estimator compared with its covariance.

use nalgebra::{Matrix3, Vector3};
use periplus_geometry::{Pose2, normalize_angle};

use crate::chi_square::chi_square_quantile;

/// Estimated pose with its covariance, and the true pose at the same time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EstimateWithCovariance {
    /// Stamp \[s\].
    pub stamp_s: f64,
    /// True pose.
    pub truth: Pose2,
    /// Estimated pose, in the same frame.
    pub estimate: Pose2,
    /// Covariance of x, y \[m\] and yaw \[rad\] in that frame.
    pub covariance: [[f64; 3]; 3],
}

/// Limits of [`LocalizationScore`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalizationLimits {
    /// Probability between the bounds of the normalized error (default 0.95).
    pub probability: f64,
    /// Position error above which an estimate is wrong \[m\] (default 0.5, the maximum error that Nav2's
    /// default goal tolerance of 0.25 m allows on both sides).
    pub wrong_m: f64,
    /// Heading error above which an estimate is wrong \[rad\] (default 0.35, 20 degrees).
    pub wrong_rad: f64,
}

impl Default for LocalizationLimits {
    fn default() -> Self {
        Self { probability: 0.95, wrong_m: 0.5, wrong_rad: 0.35 }
    }
}

/// Accuracy and consistency of localization over a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalizationScore {
    /// Root mean square of the position error \[m\].
    pub rms_m: f64,
    /// Root mean square of the heading error \[rad\].
    pub rms_rad: f64,
    /// Mean of the normalized estimation error squared; 3 for a consistent estimator. None if no covariance
    /// is positive definite.
    pub mean_nees: Option<f64>,
    /// Part of the estimates whose normalized error is between its chi-square bounds, 0 to 1; the
    /// probability for a consistent estimator.
    pub consistent_ratio: Option<f64>,
    /// Time from the first estimate to the one from which on none is wrong \[s\]; none if the last one is.
    pub convergence_s: Option<f64>,
    /// Part of the estimates that are wrong although their covariance excludes it with the probability,
    /// 0 to 1.
    pub confidently_wrong_ratio: f64,
}

impl LocalizationScore {
    /// Returns the score of estimates in order of time; none without estimates.
    #[must_use]
    pub fn of(estimates: &[EstimateWithCovariance], limits: LocalizationLimits) -> Option<Self> {
        let first = estimates.first()?;
        let count = estimates.len() as f64;
        let errors: Vec<[f64; 3]> = estimates.iter().map(EstimateWithCovariance::error).collect();
        let rms =
            |of: &dyn Fn(&[f64; 3]) -> f64| (errors.iter().map(of).sum::<f64>() / count).sqrt();

        let nees: Vec<f64> = estimates.iter().filter_map(EstimateWithCovariance::nees).collect();
        let tail = 0.5 * (1.0 - limits.probability);
        let bounds = [tail, 1.0 - tail].map(|it| chi_square_quantile(it, 3));
        let is_inside = |it: &&f64| (bounds[0]..=bounds[1]).contains(*it);
        let ratio = |part: usize, all: usize| (all > 0).then(|| part as f64 / all as f64);

        let is_wrong = |[x, y, yaw]: &[f64; 3]| {
            libm::hypot(*x, *y) > limits.wrong_m || yaw.abs() > limits.wrong_rad
        };
        let last_wrong = errors.iter().rposition(is_wrong);
        let converged = last_wrong.map_or(Some(first), |index| estimates.get(index + 1));
        let confidently_wrong = estimates
            .iter()
            .zip(&errors)
            .filter(|(estimate, error)| is_wrong(error) && estimate.excludes_wrong(&limits));
        Some(Self {
            rms_m: rms(&|[x, y, _]| x * x + y * y),
            rms_rad: rms(&|[_, _, yaw]| yaw * yaw),
            mean_nees: ratio(1, nees.len()).map(|part| part * nees.iter().sum::<f64>()),
            consistent_ratio: ratio(nees.iter().filter(is_inside).count(), nees.len()),
            convergence_s: converged.map(|it| it.stamp_s - first.stamp_s),
            confidently_wrong_ratio: confidently_wrong.count() as f64 / count,
        })
    }
}

impl EstimateWithCovariance {
    /// Error of x, y \[m\] and yaw \[rad\].
    fn error(&self) -> [f64; 3] {
        let (truth, estimate) = (self.truth, self.estimate);
        [
            estimate.x_m - truth.x_m,
            estimate.y_m - truth.y_m,
            normalize_angle(estimate.yaw_rad - truth.yaw_rad),
        ]
    }

    /// Returns the normalized estimation error squared, `eᵀ P⁻¹ e`; none if the covariance is not positive
    /// definite.
    ///
    /// Bar-Shalom, Li, Kirubarajan, "Estimation with Applications to Tracking and Navigation", 2001,
    /// section 5.4.
    #[must_use]
    pub fn nees(&self) -> Option<f64> {
        let [a, b, c] = self.covariance;
        let covariance = Matrix3::from_row_slice(&[a, b, c].concat());
        let factor = covariance.cholesky()?;
        let error = Vector3::from(self.error());
        Some(error.dot(&factor.solve(&error))).filter(|it| it.is_finite())
    }

    /// True if the covariance excludes a wrong estimate with the probability of the limits.
    fn excludes_wrong(&self, limits: &LocalizationLimits) -> bool {
        let [[xx, xy, _], [_, yy, _], [_, _, yaw]] = self.covariance;
        // The larger eigenvalue: the longest axis of the ellipse.
        let largest = 0.5 * (xx + yy) + libm::hypot(0.5 * (xx - yy), xy);
        let reach = |variance: f64, degrees: u32| {
            (variance.max(0.0) * chi_square_quantile(limits.probability, degrees)).sqrt()
        };
        reach(largest, 2) <= limits.wrong_m && reach(yaw, 1) <= limits.wrong_rad
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Stream;

    use super::*;

    fn estimate(stamp_s: f64, error: [f64; 3], std: [f64; 3]) -> EstimateWithCovariance {
        let [xx, yy, zz] = std.map(|it| it * it);
        EstimateWithCovariance {
            stamp_s,
            truth: Pose2::new(1.0, 2.0, 3.0),
            estimate: Pose2::new(1.0 + error[0], 2.0 + error[1], 3.0 + error[2]),
            covariance: [[xx, 0.0, 0.0], [0.0, yy, 0.0], [0.0, 0.0, zz]],
        }
    }

    #[test]
    fn errors_are_measured_in_standard_deviations() {
        let nees = estimate(0.0, [0.5, 1.0, -0.3], [0.5, 0.5, 0.1]).nees().unwrap();
        assert!((nees - 14.0).abs() < 1e-9, "{nees}");
        assert_eq!(estimate(0.0, [0.5, 1.0, 0.0], [0.0; 3]).nees(), None);
    }

    #[test]
    fn a_consistent_estimator_is_consistent() {
        let mut stream = Stream::keyed(1, "consistency", 0);
        let std = [0.25, 0.125, 0.0625];
        let mut draw = |factor: f64| -> Vec<EstimateWithCovariance> {
            let one = |number| {
                estimate(f64::from(number), std.map(|it| factor * it * stream.normal()), std)
            };
            (0..4000).map(one).collect()
        };
        let score = LocalizationScore::of(&draw(1.0), LocalizationLimits::default()).unwrap();
        assert!((score.mean_nees.unwrap() - 3.0).abs() < 0.15, "{score:?}");
        assert!((score.consistent_ratio.unwrap() - 0.95).abs() < 0.015, "{score:?}");
        // An estimator with errors of three times its standard deviation.
        let score = LocalizationScore::of(&draw(3.0), LocalizationLimits::default()).unwrap();
        assert!((score.mean_nees.unwrap() - 27.0).abs() < 1.5, "{score:?}");
        assert!(score.consistent_ratio.unwrap() < 0.35, "{score:?}");
    }

    #[test]
    fn convergence_and_confidence() {
        let run = [
            estimate(2.0, [3.0, 4.0, 0.0], [2.0, 2.0, 1.0]),
            estimate(3.0, [3.0, 4.0, 0.0], [0.1, 0.1, 0.1]),
            estimate(4.0, [0.0; 3], [0.1, 0.1, 0.1]),
            estimate(5.0, [0.0; 3], [0.1, 0.1, 0.1]),
        ];
        let score = LocalizationScore::of(&run, LocalizationLimits::default()).unwrap();
        assert_eq!(score.rms_m, 12.5_f64.sqrt());
        assert_eq!((score.convergence_s, score.confidently_wrong_ratio), (Some(2.0), 0.25));
        let score = LocalizationScore::of(&run[..2], LocalizationLimits::default()).unwrap();
        assert_eq!(score.convergence_s, None);
        assert_eq!(LocalizationScore::of(&[], LocalizationLimits::default()), None);
    }
}
