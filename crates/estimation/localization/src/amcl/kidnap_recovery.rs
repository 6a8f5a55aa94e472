//! Recovery of a lost or kidnapped robot: global search and multi-hypothesis tracking.

use periplus_geometry::Pose2;

use super::global_search::SearchResult;
use super::local_search::{
    MatchedPose, MissedMotion, OFF_MAP_FRACTION, SAME_POSE, TRUSTED_DISTANCE_M,
};
use super::mode::{Mode, RefinedPose};
use super::pose_verification::{MIN_RIVAL_FRACTION, OdometryAgreement};
use super::tracking::{MAX_FIT_LOSS_RATIO, length_m, widened};
use super::{Amcl, PoseEstimate};
use crate::hypotheses::Hypotheses;
use crate::initial_pose::scatter;
use crate::particles::Particles;
use crate::scan::MatchingScan;
use crate::scan_likelihood::inlier_ratios;
use crate::scan_refinement::{PoseBelief, information_from_std, predicted};
use crate::shared_maps::PreparedMap;
use crate::status::LocalizationState;

/// Distance with several hypotheses after which the map is searched for others \[m\].
const STUCK_DISTANCE_M: f64 = 4.0;
/// Fraction of random particles (augmented MCL) above which the map is searched.
const MAX_RANDOM_FRACTION: f64 = 0.1;
/// Prior log-odds that the robot was not kidnapped \[nats\] (EXPERIMENTS.md, step 9).
const NOT_KIDNAPPED_NATS: f64 = 5.0;
/// Distance between the best hypothesis and the estimate at which both agree \[m\].
const AGREEMENT_DISTANCE_M: f64 = 0.5;
/// Standard deviations of an estimate that was not refined.
const ESTIMATE_STD_M: f64 = 0.2;
const ESTIMATE_STD_RAD: f64 = 0.1;

impl Amcl {
    /// Updates the hypotheses with a step of odometry and a scan, and decides between them.
    pub(super) fn update_hypotheses(
        &mut self,
        estimate: &mut PoseEstimate,
        scan: &MatchingScan,
        old_from_new: Option<Pose2>,
        odom_from_base: Pose2,
    ) {
        let Some(map) = self.map.as_ref().map(PreparedMap::field) else { return };
        let (mut hypotheses, fallback) =
            match std::mem::replace(&mut self.mode, Mode::Tracking { refined: None }) {
                Mode::Hypotheses(hypotheses) => (hypotheses, None),
                Mode::Relocalizing { hypotheses, fallback } => (hypotheses, Some(fallback)),
                other @ (Mode::Uninitialized { .. } | Mode::Tracking { .. }) => {
                    self.mode = other;
                    return;
                }
            };
        if let Some(old_from_new) = old_from_new {
            hypotheses.update(map, scan, old_from_new);
        }
        let best = hypotheses.best().belief.pose;
        let inlier_ratio = inlier_ratios(map, &scan.beams, best).map_or(1.0, |it| it.all);
        let Some(fallback) = fallback else {
            self.decide(estimate, hypotheses, None, inlier_ratio, scan);
            return;
        };
        let step = fallback.odom_from_base.inverse() * odom_from_base;
        let predicted = predicted(&fallback.belief, step);
        let MatchedPose { belief, inlier_ratio: fallback_ratio } =
            self.match_scan(scan, predicted, length_m(step), MissedMotion::Any);
        let min_ratio = self.convincing_ratio().max(inlier_ratio - MAX_FIT_LOSS_RATIO);
        let was_right = fallback_ratio.is_some_and(|it| it >= min_ratio)
            && !self.verification.is_odometry_unreliable();
        if was_right || inlier_ratio < OFF_MAP_FRACTION * self.monitor.usual_inlier_ratio() {
            self.track(estimate, belief, odom_from_base, None);
            return;
        }
        let fallback = Some(RefinedPose::new(belief, odom_from_base));
        self.decide(estimate, hypotheses, fallback, inlier_ratio, scan);
    }

    /// Decides between hypotheses: accepts the best one, returns to the fallback, or continues with
    /// all. `inlier_ratio` is that of the best one.
    fn decide(
        &mut self,
        estimate: &mut PoseEstimate,
        hypotheses: Hypotheses,
        fallback: Option<RefinedPose>,
        inlier_ratio: f64,
        scan: &MatchingScan,
    ) {
        self.mode = Mode::Tracking { refined: None };
        self.particles = self.particles_at(&hypotheses);
        let best = hypotheses.best().belief;
        *estimate = self.summarize();
        estimate.pose = best.pose;
        estimate.clusters = hypotheses.clusters(self.particles.len());
        // Without a fallback one scan suffices.
        let is_decided =
            hypotheses.is_decided() || fallback.is_none() && hypotheses.is_unique_at_once();
        if is_decided
            && let Some(fallback) = fallback
            && self.odometry_agreement(best.pose) == OdometryAgreement::Contradicted
        {
            self.verification.require(0);
            self.track(estimate, fallback.belief, fallback.odom_from_base, None);
            return;
        }
        if is_decided && inlier_ratio >= self.convincing_ratio() {
            let is_fallback =
                fallback.is_some_and(|it| SAME_POSE.covers(it.belief.pose, best.pose));
            if !is_fallback || self.verification.is_required() {
                self.verify_accepted(best.pose, scan, &hypotheses);
            }
            // A new pose has to match as a whole before it is tracked beyond the edge of the map.
            self.unmatched_distance_m = TRUSTED_DISTANCE_M;
            return;
        }
        if hypotheses.are_refuted() {
            self.verification.require(0);
            if let Some(fallback) = fallback {
                self.track(estimate, fallback.belief, fallback.odom_from_base, None);
            }
            return;
        }
        // The tracked pose is reported until another one is certain (EXPERIMENTS.md, step 15).
        if let Some(fallback) = fallback {
            estimate.pose = fallback.belief.pose;
        }
        self.mode = Mode::with_hypotheses(hypotheses, fallback);
    }

    /// Particles at hypotheses, in proportion to their probabilities.
    pub(super) fn particles_at(&mut self, hypotheses: &Hypotheses) -> Particles {
        let mut stream = self.random_stream("rivals");
        let mut particles = Particles::default();
        for cluster in hypotheses.clusters(self.settings.kld_sampling.max_particles) {
            let covariance = widened(cluster.covariance);
            scatter(&mut particles, cluster.count.max(1), cluster.mean, covariance, &mut stream);
        }
        particles.set_uniform_weights();
        particles
    }

    /// True if a search of the whole map is due: the robot is lost, may have been kidnapped, or its
    /// pose is to be verified.
    fn is_search_due(
        &self,
        scan: &MatchingScan,
        random_fraction: f64,
        odom_from_base: Pose2,
    ) -> bool {
        if !self.settings.searches_when_lost || self.search.is_running() {
            return false;
        }
        let hypotheses = self.mode.hypotheses();
        if hypotheses.is_some_and(|it| it.distance_m() <= STUCK_DISTANCE_M) {
            return false;
        }
        let is_lost = self.status.state == LocalizationState::Lost
            || random_fraction > MAX_RANDOM_FRACTION
            || self.monitor.suspects_kidnapping(self.status.inlier_ratio)
            || hypotheses.is_some();
        is_lost && self.search.is_due(scan, odom_from_base)
            || self.is_verification_due(odom_from_base)
    }

    /// Searches the map for a robot that is lost or whose pose is not verified. True if the robot
    /// may be at another pose.
    pub(super) fn relocalize(
        &mut self,
        estimate: &mut PoseEstimate,
        scan: &MatchingScan,
        random_fraction: f64,
        odom_from_base: Pose2,
    ) -> bool {
        if self.status.state == LocalizationState::Lost && !self.verification.is_required() {
            self.verification.require(0);
        }
        if !self.search.has_result() && self.is_search_due(scan, random_fraction, odom_from_base) {
            // To verify a pose that matches, only poses that match nearly as well are of interest.
            let inlier_ratio = self.status.inlier_ratio;
            let matches = inlier_ratio.is_some_and(|it| it >= self.convincing_ratio());
            let only_verifies = self.is_verification_due(odom_from_base)
                && matches
                && self.mode.hypotheses().is_none();
            let localizer = self.map.as_ref().and_then(PreparedMap::built_localizer);
            let score = localizer.map_or(0.0, |it| it.score(&scan.ends, estimate.pose));
            let min_score = if only_verifies { MIN_RIVAL_FRACTION * score } else { 0.0 };
            self.start_search(scan, odom_from_base, min_score);
        }
        let Some(result) = self.search.take_result(odom_from_base) else { return false };
        if self.needs_verification()
            && self.mode.hypotheses().is_none()
            && self.verify_by_search(scan, estimate.pose, &result)
        {
            self.search.failure_count = 0;
            return false;
        }
        self.search.failure_count += 1;
        self.consider_candidates(estimate, scan, odom_from_base, &result)
    }

    /// Starts to track the candidates of a search where one of them is more likely than the present
    /// pose. True if it does.
    fn consider_candidates(
        &mut self,
        estimate: &mut PoseEstimate,
        scan: &MatchingScan,
        odom_from_base: Pose2,
        result: &SearchResult,
    ) -> bool {
        let Some(map) = self.map.as_ref().map(PreparedMap::field) else { return false };
        let completeness = result.completeness;
        let Some(mut hypotheses) = Hypotheses::new(map, scan, result.poses(), completeness) else {
            return false;
        };
        let min_ratio = OFF_MAP_FRACTION * self.monitor.usual_inlier_ratio();
        let ratio_at = |pose: Pose2| inlier_ratios(map, &scan.beams, pose).map(|it| it.all);
        let matches = |pose: Pose2| ratio_at(pose).is_some_and(|it| it >= min_ratio);
        if !hypotheses.retain_any(|it| matches(it.belief.pose)) {
            return false;
        }
        let present = Hypotheses::new(map, scan, [estimate.pose], completeness);
        // Only a robot that was localized can have driven off the map.
        let was_localized = self.monitor.was_localized();
        if let Some(present) = present.filter(|_| was_localized) {
            let is_unreliable = self.verification.is_odometry_unreliable();
            let prior_nats = if is_unreliable { 0.0 } else { NOT_KIDNAPPED_NATS };
            hypotheses.insert(present.best(), prior_nats);
        }
        let best = hypotheses.best().belief.pose;
        let inlier_ratio = ratio_at(best).unwrap_or(0.0);
        if inlier_ratio < self.convincing_ratio() {
            return false;
        }
        let offset_m = libm::hypot(best.x_m - estimate.pose.x_m, best.y_m - estimate.pose.y_m);
        let agrees = offset_m < AGREEMENT_DISTANCE_M;
        if agrees && (hypotheses.is_decided() || hypotheses.stands_out()) {
            self.collect_evidence(&hypotheses);
            return false;
        }
        let information = information_from_std(ESTIMATE_STD_M, ESTIMATE_STD_RAD);
        let belief = PoseBelief { pose: estimate.pose, information };
        let fallback = was_localized.then(|| {
            let refined = self.mode.refined().copied();
            refined.unwrap_or_else(|| RefinedPose::new(belief, odom_from_base))
        });
        self.decide(estimate, hypotheses, fallback, inlier_ratio, scan);
        true
    }
}
