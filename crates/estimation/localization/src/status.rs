//! Localization status and its monitor.

use std::f64::consts::FRAC_PI_6;

use periplus_geometry::normalize_angle;

use crate::kld_sampling::Cluster;
use crate::pose_threshold::PoseThreshold;
use crate::recovery::LikelihoodAverages;

/// LocalizationState of localization.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LocalizationState {
    /// No initial pose, or no scan used since.
    Unset,
    /// The pose is known.
    Tracking,
    /// Several poses are possible, or the covariance is large.
    Ambiguous,
    /// Scans contradict the estimate.
    Lost,
}

/// LocalizationStatus of localization with its reason.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalizationStatus {
    /// LocalizationState.
    pub state: LocalizationState,
    /// Reason of the state, as a sentence.
    pub reason: String,
    /// Other pose hypotheses, most likely first.
    pub hypotheses: Vec<Cluster>,
    /// Fraction of the hits of the last scan at walls of the map, 0 to 1; none without hits.
    pub inlier_ratio: Option<f64>,
}

impl Default for LocalizationStatus {
    fn default() -> Self {
        Self {
            state: LocalizationState::Unset,
            reason: "no initial pose is set".into(),
            hypotheses: Vec::new(),
            inlier_ratio: None,
        }
    }
}

/// Minimum weight of a cluster that counts as another hypothesis.
const MIN_HYPOTHESIS_FRACTION: f64 = 0.1;
/// Maximum number of reported hypotheses.
const MAX_HYPOTHESES: usize = 20;
/// Clusters closer than this to the best are the same hypothesis.
const SAME_HYPOTHESIS: PoseThreshold = PoseThreshold::new(1.0, FRAC_PI_6);
/// Maximum standard deviations of a known pose.
const MAX_STD_M: f64 = 1.0;
const MAX_STD_RAD: f64 = FRAC_PI_6;
/// Inlier ratio below which the robot is lost; half of a scan may be people and furniture.
const MIN_INLIER_RATIO: f64 = 0.35;
/// Fraction of the usual inlier ratio below which a search of the map starts (EXPERIMENTS.md, step
/// 7).
const SUSPICIOUS_FRACTION: f64 = 0.85;
/// Fraction of the usual inlier ratio below which the robot is lost.
const SUDDEN_LOSS_FRACTION: f64 = 0.6;
/// Unusual drop of the inlier ratio: as a fraction of the usual one, and in mean absolute
/// deviations (EXPERIMENTS.md, step 32).
const UNUSUAL_FRACTION: f64 = 0.12;
const UNUSUAL_SIGMAS: f64 = 4.0;
/// Gains of the long-term and short-term averages of the inlier ratio.
const SLOW_FACTOR: f64 = 0.02;
const FAST_FACTOR: f64 = 0.4;

/// Monitor of the inlier ratio: detects divergence of the filter and kidnapping.
#[derive(Clone, Debug, Default)]
pub(crate) struct ConvergenceMonitor {
    averages: LikelihoodAverages,
    /// Mean absolute deviation of the inlier ratio from its long-term average.
    deviation: f64,
    /// True if the last state was not tracking: the long-term average is frozen.
    was_not_tracking: bool,
    /// True if the state ever was tracking.
    was_localized: bool,
}

impl ConvergenceMonitor {
    /// True if the inlier ratio dropped enough to suspect kidnapping.
    pub(crate) fn suspects_kidnapping(&self, inlier_ratio: Option<f64>) -> bool {
        inlier_ratio
            .is_some_and(|it| it.min(self.averages.fast) < SUSPICIOUS_FRACTION * self.averages.slow)
    }

    /// Classifies the state from clusters and the inlier ratio. `is_undecided`: several hypotheses
    /// are being tracked and none is accepted yet.
    pub(crate) fn update(
        &mut self,
        clusters: &[Cluster],
        inlier_ratio: Option<f64>,
        is_undecided: bool,
    ) -> LocalizationStatus {
        if let Some(ratio) = inlier_ratio {
            let slow = if self.was_not_tracking { 0.0 } else { SLOW_FACTOR };
            self.averages.update(ratio, [slow, FAST_FACTOR]);
            self.deviation += slow * ((ratio - self.averages.slow).abs() - self.deviation);
        }
        let LikelihoodAverages { slow, fast } = self.averages;
        let Some(best) = clusters.first() else { return LocalizationStatus::default() };
        let hypotheses: Vec<Cluster> = clusters[1..]
            .iter()
            .filter(|it| is_undecided || is_other_hypothesis(it, best))
            .take(MAX_HYPOTHESES)
            .copied()
            .collect();
        let (state, reason) = if inlier_ratio.is_some() && fast < MIN_INLIER_RATIO {
            (
                LocalizationState::Lost,
                format!("only {:.0} % of the scan hits are at walls of the map", 100.0 * fast),
            )
        } else if inlier_ratio.is_some() && fast < SUDDEN_LOSS_FRACTION * slow {
            let (fast, slow) = (100.0 * fast, 100.0 * slow);
            let reason = format!(
                "the scan match dropped: {fast:.0} % of the hits are at walls of the map, usually \
                 {slow:.0} %; the robot may have been kidnapped"
            );
            (LocalizationState::Lost, reason)
        } else if let Some(other) = hypotheses.first() {
            let reason = format!(
                "{} poses are possible: ({:.2}, {:.2}) with {:.0} %, ({:.2}, {:.2}) with {:.0} %",
                hypotheses.len() + 1,
                best.mean.x_m,
                best.mean.y_m,
                100.0 * best.weight,
                other.mean.x_m,
                other.mean.y_m,
                100.0 * other.weight,
            );
            (LocalizationState::Ambiguous, reason)
        } else if is_undecided {
            (LocalizationState::Ambiguous, "one pose is likely, but needs more scans".into())
        } else {
            let (radius_m, turn_rad) =
                (best.covariance.radius_m(), libm::sqrt(best.covariance.yaw));
            if radius_m > MAX_STD_M || turn_rad > MAX_STD_RAD {
                let degrees = turn_rad.to_degrees();
                let reason =
                    format!("the pose is uncertain by {radius_m:.1} m and {degrees:.0} degrees");
                (LocalizationState::Ambiguous, reason)
            } else if inlier_ratio.is_none() {
                (
                    LocalizationState::Tracking,
                    "by odometry only: no beam of the scan hit anything".into(),
                )
            } else {
                let reason =
                    format!("{:.0} % of the scan hits are at walls of the map", 100.0 * fast);
                (LocalizationState::Tracking, reason)
            }
        };
        self.was_not_tracking = state != LocalizationState::Tracking;
        self.was_localized |= !self.was_not_tracking;
        LocalizationStatus { state, reason, hypotheses, inlier_ratio }
    }

    /// True if the robot was localized before.
    pub(crate) fn was_localized(&self) -> bool {
        self.was_localized
    }

    /// Long-term average of the inlier ratio; 0 before the first scan.
    pub(crate) fn usual_inlier_ratio(&self) -> f64 {
        self.averages.slow
    }

    /// Inlier ratio below which a scan is unusual.
    pub(crate) fn min_usual_inlier_ratio(&self) -> f64 {
        let drop = (UNUSUAL_FRACTION * self.averages.slow).max(UNUSUAL_SIGMAS * self.deviation);
        self.averages.slow - drop
    }

    /// Resets the short-term average after relocalization.
    pub(crate) fn reset_short_term(&mut self) {
        self.averages.fast = self.averages.slow;
    }
}

fn is_other_hypothesis(other: &Cluster, best: &Cluster) -> bool {
    let (dx, dy) = (other.mean.x_m - best.mean.x_m, other.mean.y_m - best.mean.y_m);
    let turn = normalize_angle(other.mean.yaw_rad - best.mean.yaw_rad).abs();
    let is_elsewhere =
        libm::hypot(dx, dy) > SAME_HYPOTHESIS.distance_m || turn > SAME_HYPOTHESIS.angle_rad;
    other.weight >= MIN_HYPOTHESIS_FRACTION && is_elsewhere
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;

    use super::*;
    use crate::particles::Covariance2;

    fn at(x_m: f64, weight: f64) -> Cluster {
        let mean = Pose2::new(x_m, 0.0, 0.0);
        Cluster { weight, count: 10, mean, covariance: Covariance2::default() }
    }

    #[test]
    fn states_are_distinguished() {
        let state = |clusters: &[Cluster], fit| {
            ConvergenceMonitor::default().update(clusters, fit, false).state
        };
        assert_eq!(state(&[], Some(1.0)), LocalizationState::Unset);
        assert_eq!(state(&[at(0.0, 1.0)], Some(0.8)), LocalizationState::Tracking);
        assert_eq!(state(&[at(0.0, 1.0)], Some(0.2)), LocalizationState::Lost);
        assert_eq!(state(&[at(0.0, 1.0)], None), LocalizationState::Tracking);
        assert_eq!(state(&[at(0.0, 0.7), at(5.0, 0.3)], Some(0.8)), LocalizationState::Ambiguous);
        assert_eq!(state(&[at(0.0, 0.95), at(5.0, 0.05)], Some(0.8)), LocalizationState::Tracking);
        assert_eq!(state(&[at(0.0, 0.7), at(0.6, 0.3)], Some(0.8)), LocalizationState::Tracking);
        let undecided =
            |clusters: &[Cluster]| ConvergenceMonitor::default().update(clusters, Some(0.8), true);
        assert_eq!(undecided(&[at(0.0, 1.0)]).state, LocalizationState::Ambiguous);
        assert_eq!(undecided(&[at(0.0, 0.95), at(5.0, 0.05)]).hypotheses.len(), 1);
    }

    #[test]
    fn a_kidnapped_robot_is_lost() {
        let mut monitor = ConvergenceMonitor::default();
        for _ in 0..20 {
            assert_eq!(
                monitor.update(&[at(0.0, 1.0)], Some(0.95), false).state,
                LocalizationState::Tracking
            );
        }
        let states: Vec<LocalizationState> =
            (0..5).map(|_| monitor.update(&[at(0.0, 1.0)], Some(0.45), false).state).collect();
        assert_eq!(states.last(), Some(&LocalizationState::Lost));
    }

    #[test]
    fn a_scan_is_unusual_if_others_vary_less() {
        let min_of = |fits: &[f64]| {
            let mut monitor = ConvergenceMonitor::default();
            for number in 0..100 {
                monitor.update(&[at(0.0, 1.0)], Some(fits[number % fits.len()]), false);
            }
            monitor.min_usual_inlier_ratio()
        };
        let steady = min_of(&[0.94, 0.96]);
        assert!(steady > 0.8 && steady < 0.86, "{steady}");
        let unsteady = min_of(&[0.95, 0.65]);
        assert!(unsteady < 0.5, "{unsteady}");
    }
}
