//! Tracking of one pose where odometry errs and where the map ends.

use periplus_geometry::Pose2;
use periplus_scan_matching::Peak;

use super::Amcl;
use crate::pose_threshold::PoseThreshold;
use crate::scan::{Beams, MatchingScan};
use crate::scan_likelihood::{inlier_ratios, log_likelihood};
use crate::scan_refinement::{PoseBelief, information_from_std, refine_pose};

/// Fraction of the usual inlier ratio below which the neighbourhood of a pose is searched.
pub(super) const GOOD_MATCH_FRACTION: f64 = 0.85;
/// Fraction of the usual inlier ratio below which the robot has left the map, or the map is
/// outdated: odometry alone predicts the pose (EXPERIMENTS.md, step 10).
pub(super) const OFF_MAP_FRACTION: f64 = 0.5;
/// Minimum inlier ratio of another pose: as a fraction of the usual one, and absolute
/// (EXPERIMENTS.md, step 10).
pub(super) const CONVINCING_FRACTION: f64 = 0.8;
pub(super) const CONVINCING_RATIO: f64 = 0.6;
/// Log-likelihood below the best pose at which another pose is refuted \[nats\].
pub(super) const REFUTED_NATS: f64 = 4.6;
/// Poses closer than this are the same.
pub(super) const SAME_POSE: PoseThreshold = PoseThreshold::new(0.3, 0.2);
/// Distance after a matching scan within which the pose is trusted beyond the edge of the map \[m\].
pub(super) const TRUSTED_DISTANCE_M: f64 = 3.0;
/// Minimum gain in inlier ratio of a pose nearby.
const MIN_GAIN_RATIO: f64 = 0.1;
/// Search window: minimum, growth per metre without a matching scan, maximum (EXPERIMENTS.md,
/// step 14).
const MIN_WINDOW_M: f64 = 0.25;
const WINDOW_GROWTH_FACTOR: f64 = 0.1;
const MAX_WINDOW_M: f64 = 4.0;
const MIN_WINDOW_RAD: f64 = 0.35;
const WINDOW_GROWTH_RAD_PER_M: f64 = 0.02;
const MAX_WINDOW_RAD: f64 = 0.8;
/// Standard deviations of the prior of a candidate. A robot that only turned keeps its position.
const MOVED_STD_M: f64 = 0.3;
const TURNED_STD_M: f64 = 0.1;
const CANDIDATE_STD_RAD: f64 = 0.15;

/// Motion that odometry may have missed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MissedMotion {
    /// Translation and rotation.
    Any,
    /// Rotation with little translation. A scan of two walls suffices, although it does not
    /// determine the position along them.
    Rotation,
}

/// Pose and inlier ratio after a scan.
#[derive(Clone, Copy)]
pub(super) struct MatchedPose {
    pub(super) belief: PoseBelief,
    pub(super) inlier_ratio: Option<f64>,
}

impl Amcl {
    /// Updates a predicted pose with a scan: refined where the scan matches, searched nearby where
    /// it does not, and left to odometry off the map.
    pub(super) fn match_scan(
        &mut self,
        scan: &MatchingScan,
        predicted: PoseBelief,
        distance_m: f64,
        missed: MissedMotion,
    ) -> MatchedPose {
        let Some(map) = &self.map else {
            return MatchedPose { belief: predicted, inlier_ratio: None };
        };
        let refined = refine_pose(map.field(), &scan.ends, &predicted).belief;
        let inlier_ratio = self.inlier_ratio(refined.pose, &scan.beams);
        self.unmatched_distance_m += distance_m;
        if let Some(found) = self.search_nearby(scan, &predicted, inlier_ratio, missed) {
            return found;
        }
        let min_ratio = OFF_MAP_FRACTION * self.monitor.usual_inlier_ratio();
        let is_off_map = inlier_ratio.is_some_and(|ratio| ratio < min_ratio);
        MatchedPose { belief: if is_off_map { predicted } else { refined }, inlier_ratio }
    }

    /// Inlier ratio of a scan at a pose that was tracked by odometry. Just after a matching scan,
    /// hits beyond the edge of the map do not count.
    pub(super) fn inlier_ratio(&self, map_from_base: Pose2, beams: &Beams) -> Option<f64> {
        let ratios = inlier_ratios(self.map.as_ref()?.field(), beams, map_from_base)?;
        Some(if self.matched_recently() { ratios.judged } else { ratios.all })
    }

    fn matched_recently(&self) -> bool {
        self.unmatched_distance_m < TRUSTED_DISTANCE_M
    }

    /// Minimum inlier ratio of a pose other than the tracked one.
    pub(super) fn convincing_ratio(&self) -> f64 {
        (CONVINCING_FRACTION * self.monitor.usual_inlier_ratio()).max(CONVINCING_RATIO)
    }

    /// Searches for a scan around a pose at which it does not match, after a gross error of
    /// odometry: refinement alone would converge to the wrong walls. None if the scan matches at
    /// the pose, or if no pose nearby is clearly better than all others.
    pub(super) fn search_nearby(
        &mut self,
        scan: &MatchingScan,
        predicted: &PoseBelief,
        inlier_ratio: Option<f64>,
        missed: MissedMotion,
    ) -> Option<MatchedPose> {
        let good_ratio = GOOD_MATCH_FRACTION * self.monitor.usual_inlier_ratio();
        let Some(ratio) = inlier_ratio.filter(|ratio| *ratio < good_ratio) else {
            self.unmatched_distance_m = 0.0;
            return None;
        };
        let min_ratio = good_ratio.max(CONVINCING_RATIO).max(ratio + MIN_GAIN_RATIO);
        let matched_recently = self.matched_recently();
        let distance_m = self.unmatched_distance_m;
        let half_window = PoseThreshold {
            distance_m: (MIN_WINDOW_M + WINDOW_GROWTH_FACTOR * distance_m).min(MAX_WINDOW_M),
            angle_rad: (MIN_WINDOW_RAD + WINDOW_GROWTH_RAD_PER_M * distance_m).min(MAX_WINDOW_RAD),
        };
        let (map, localizer) = self.map.as_ref()?.localizer();
        let peaks = localizer.peaks_near(&scan.ends, predicted.pose, half_window);
        let matched = |peak: &Peak| {
            let prior = match missed {
                MissedMotion::Any => PoseBelief {
                    pose: peak.pose,
                    information: information_from_std(MOVED_STD_M, CANDIDATE_STD_RAD),
                },
                MissedMotion::Rotation => PoseBelief {
                    pose: Pose2 { yaw_rad: peak.pose.yaw_rad, ..predicted.pose },
                    information: information_from_std(TURNED_STD_M, CANDIDATE_STD_RAD),
                },
            };
            let belief = refine_pose(map, &scan.ends, &prior).belief;
            let ratios = inlier_ratios(map, &scan.beams, belief.pose)?;
            let ratio = if matched_recently { ratios.judged } else { ratios.all };
            if ratio < min_ratio {
                return None;
            }
            let log_likelihood = log_likelihood(map, &scan.beams, belief.pose);
            Some((log_likelihood, MatchedPose { belief, inlier_ratio: Some(ratio) }))
        };
        let mut candidates: Vec<(f64, MatchedPose)> = peaks.iter().filter_map(matched).collect();
        candidates.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (max_log_likelihood, best) = *candidates.first()?;
        let is_other =
            |it: &&(f64, MatchedPose)| !SAME_POSE.covers(it.1.belief.pose, best.belief.pose);
        let is_unique =
            candidates.iter().filter(is_other).all(|it| it.0 < max_log_likelihood - REFUTED_NATS);
        is_unique.then_some(best)
    }
}
