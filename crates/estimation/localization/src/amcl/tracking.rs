//! Tracking of one pose by scan matching.

use periplus_geometry::{LaserScan2, Pose2, normalize_angle};
use periplus_scan_matching::Symmetric3;

use super::local_search::{
    GOOD_MATCH_FRACTION, MatchedPose, MissedMotion, OFF_MAP_FRACTION, REFUTED_NATS, SAME_POSE,
};
use super::mode::{Mode, RefinedPose};
use super::{Amcl, PoseEstimate};
use crate::initial_pose::scatter;
use crate::kld_sampling::Cluster;
use crate::likelihood_map::LikelihoodMap;
use crate::particles::{Covariance2, Particles};
use crate::pose_threshold::{PoseThreshold, has_moved};
use crate::scan::MatchingScan;
use crate::scan_likelihood::log_likelihood;
use crate::scan_refinement::{PoseBelief, inflated, information_from_std, predicted, refine_pose};
use crate::status::LocalizationState;

/// Minimum standard deviations of particles around a pose.
const MIN_STD_M: f64 = 0.05;
const MIN_STD_RAD: f64 = 0.02;
/// Maximum distance of a refined pose from the mean of the particles, besides
/// [`MAX_PARTICLE_SIGMAS`] standard deviations of theirs.
const MAX_PARTICLE_DISTANCE: PoseThreshold = PoseThreshold::new(0.4, 0.25);
const MAX_PARTICLE_SIGMAS: f64 = 2.0;
/// Standard deviations of the particles where their covariance is singular.
const PARTICLE_STD_M: f64 = 0.5;
const PARTICLE_STD_RAD: f64 = 0.2;
/// One particle of this number is moved to the refined pose (EXPERIMENTS.md, step 2).
const PARTICLES_PER_REFINED_COUNT: usize = 20;
/// Minimum motion between refinements.
const MIN_MOTION: PoseThreshold = PoseThreshold::new(0.02, 0.01);
/// Maximum difference of the motions by scans and by odometry, besides this fraction of the motion
/// (EXPERIMENTS.md, step 19).
const MAX_SLIP_M: f64 = 0.1;
const MAX_SLIP_RAD: f64 = 0.2;
const MAX_SLIP_FRACTION: f64 = 0.25;
/// Difference of two steps of odometry above which the newer one may be wrong (EXPERIMENTS.md,
/// step 18).
const UNEVEN_STEP: PoseThreshold = PoseThreshold::new(0.05, 0.05);
/// Minimum gain in fit of the older step over the newer one.
const MIN_EVEN_GAIN_RATIO: f64 = 0.005;
/// Maximum loss in fit of a pose predicted by odometry against the mean of the particles.
pub(super) const MAX_FIT_LOSS_RATIO: f64 = 0.03;
/// Minimum weight of a cluster that counts as another hypothesis.
const MIN_CLUSTER_FRACTION: f64 = 0.05;
/// Standard deviations of the prior at the mean of a cluster.
const CLUSTER_STD_M: f64 = 0.3;
const CLUSTER_STD_RAD: f64 = 0.2;

/// Difference between the poses by scan and by odometry.
#[derive(Clone, Copy, Debug)]
pub(super) struct OdometrySlip {
    distance_m: f64,
    angle_rad: f64,
}

impl OdometrySlip {
    /// Slip of a step, if it is a contradiction.
    fn new(predicted: Pose2, matched: Pose2, step: Pose2) -> Option<Self> {
        let error = predicted.inverse() * matched;
        let (distance_m, angle_rad) = (length_m(error), normalize_angle(error.yaw_rad).abs());
        let max_m = MAX_SLIP_M + MAX_SLIP_FRACTION * length_m(step);
        let max_rad = MAX_SLIP_RAD + MAX_SLIP_FRACTION * normalize_angle(step.yaw_rad).abs();
        (distance_m > max_m || angle_rad > max_rad).then_some(Self { distance_m, angle_rad })
    }

    fn reason(self) -> String {
        format!(
            "scan matching and odometry differ by {:.2} m and {:.0} degrees",
            self.distance_m,
            self.angle_rad.to_degrees(),
        )
    }
}

impl Amcl {
    /// Refines the estimate by scan matching in [`Mode::Tracking`] and moves some of the particles
    /// there. Returns the slip of odometry, if scans contradict it.
    pub(super) fn refine_estimate(
        &mut self,
        estimate: &mut PoseEstimate,
        scan: &MatchingScan,
        odom_from_base: Pose2,
    ) -> Option<OdometrySlip> {
        let Mode::Tracking { refined } = &mut self.mode else { return None };
        let before = refined.take();
        let cluster = estimate.clusters.first().copied()?;
        let is_possible = self.settings.refines_by_scan_matching && !scan.ends.is_empty();
        if self.map.is_none() || !is_possible {
            return None;
        }
        let mean = estimate.pose;
        let std = widened(cluster.covariance);
        let covariance =
            Symmetric3 { xx: std.xx, xy: std.xy, yy: std.yy, tt: std.yaw, ..Symmetric3::ZERO };
        let unknown = || information_from_std(PARTICLE_STD_M, PARTICLE_STD_RAD);
        let information = covariance.inverse().unwrap_or_else(unknown);
        let near = PoseThreshold {
            distance_m: MAX_PARTICLE_DISTANCE.distance_m + MAX_PARTICLE_SIGMAS * std.radius_m(),
            angle_rad: MAX_PARTICLE_DISTANCE.angle_rad + MAX_PARTICLE_SIGMAS * libm::sqrt(std.yaw),
        };

        // The better one of two starts: the last refined pose, and the mean of the particles.
        let predicted = before.map(|before| {
            let step = before.odom_from_base.inverse() * odom_from_base;
            let (belief, missed) = self.predict_refined(scan, &before, step);
            (before, step, belief, missed)
        });
        let map = self.map.as_ref()?.field();
        let by_odometry = predicted.map(|it| refine_pose(map, &scan.ends, &it.2));
        let by_particles = refine_pose(map, &scan.ends, &PoseBelief { pose: mean, information });
        let best = by_odometry
            .filter(|it| {
                near.covers(it.belief.pose, mean) && it.fit >= by_particles.fit - MAX_FIT_LOSS_RATIO
            })
            .unwrap_or(by_particles);
        let pose = best.belief.pose;
        let inlier_ratio = self.inlier_ratio(pose, &scan.beams);

        let (mut slip, mut last_step) = (None, None);
        if let Some((before, step, belief, missed)) = predicted {
            self.unmatched_distance_m += length_m(step);
            let found = self.search_nearby(scan, &belief, inlier_ratio, missed);
            let matched = found.map_or(pose, |found| found.belief.pose);
            slip = OdometrySlip::new((before.belief.pose * step).normalized(), matched, step);
            last_step = Some(before.belief.pose.inverse() * matched);
            if let Some(found) = found {
                self.track(estimate, found.belief, odom_from_base, last_step);
                return slip;
            }
            let min_ratio = OFF_MAP_FRACTION * self.monitor.usual_inlier_ratio();
            if inlier_ratio.unwrap_or(1.0) < min_ratio {
                self.track(estimate, belief, odom_from_base, last_step);
                return slip;
            }
        }
        if !near.covers(pose, mean) {
            return slip;
        }
        let covariance = best.belief.covariance();
        let map = self.map.as_ref()?.field();
        estimate.pose = pose;
        estimate.clusters = not_refuted(map, scan, &estimate.clusters, pose, covariance);
        let refined = RefinedPose { last_step, ..RefinedPose::new(best.belief, odom_from_base) };
        self.mode = Mode::Tracking { refined: Some(refined) };
        let mut stream = self.random_stream("polish");
        let mut drawn = Particles::default();
        let count = self.particles.len() / PARTICLES_PER_REFINED_COUNT;
        scatter(&mut drawn, count, pose, covariance, &mut stream);
        for index in 0..count {
            self.particles.x_m[index] = drawn.x_m[index];
            self.particles.y_m[index] = drawn.y_m[index];
            self.particles.yaw_rad[index] = drawn.yaw_rad[index];
        }
        slip
    }

    /// Refines the tracked pose with a scan that the particle filter does not use. Requests an
    /// update of the filter where the scan may be the first sign of kidnapping.
    pub(super) fn refine_between_updates(&mut self, odom_from_base: Pose2, scan: &LaserScan2) {
        let Some(before) = self.mode.refined().copied() else { return };
        let Ok(scan) = MatchingScan::new(scan, &self.settings.beams) else { return };
        if scan.ends.is_empty() {
            return;
        }
        let has_moved = has_moved(before.odom_from_base, odom_from_base, MIN_MOTION);
        let (refined, inlier_ratio, slip) = if has_moved {
            self.refine_after_motion(&scan, &before, odom_from_base)
        } else {
            self.refine_at_standstill(&scan, &before, odom_from_base)
        };
        self.mode = Mode::Tracking { refined: Some(refined) };
        if let Some(map_from_odom) = self.map_from_odom {
            let map_from_base = (map_from_odom * odom_from_base).normalized();
            self.verify_at(&scan, map_from_base, odom_from_base, slip.is_some());
        }
        self.apply_doubt(slip);
        // Not where the robot has been lost for some time, nor for a person in front of a robot that
        // waits.
        self.is_update_requested |= has_moved
            && self.filter_state() == LocalizationState::Tracking
            && self.monitor.suspects_kidnapping(inlier_ratio);
    }

    fn refine_after_motion(
        &mut self,
        scan: &MatchingScan,
        before: &RefinedPose,
        odom_from_base: Pose2,
    ) -> (RefinedPose, Option<f64>, Option<OdometrySlip>) {
        let step = before.odom_from_base.inverse() * odom_from_base;
        let (predicted, missed) = self.predict_refined(scan, before, step);
        let MatchedPose { belief, inlier_ratio } =
            self.match_scan(scan, predicted, length_m(step), missed);
        self.set_map_from_base(belief.pose, odom_from_base);
        let old = before.belief.pose;
        let slip = OdometrySlip::new((old * step).normalized(), belief.pose, step);
        let last_step = Some(old.inverse() * belief.pose);
        let refined = RefinedPose { last_step, ..RefinedPose::new(belief, odom_from_base) };
        (refined, inlier_ratio, slip)
    }

    fn refine_at_standstill(
        &mut self,
        scan: &MatchingScan,
        before: &RefinedPose,
        odom_from_base: Pose2,
    ) -> (RefinedPose, Option<f64>, Option<OdometrySlip>) {
        let belief = before.standstill.unwrap_or(before.belief);
        let inlier_ratio = self.inlier_ratio(belief.pose, &scan.beams);
        let found = self.search_nearby(scan, &belief, inlier_ratio, MissedMotion::Rotation);
        let Some(found) = found else { return (*before, inlier_ratio, None) };
        self.set_map_from_base(found.belief.pose, odom_from_base);
        let slip = OdometrySlip::new(belief.pose, found.belief.pose, Pose2::IDENTITY);
        let refined = RefinedPose { standstill: Some(found.belief), ..*before };
        (refined, found.inlier_ratio, slip)
    }

    fn set_map_from_base(&mut self, map_from_base: Pose2, odom_from_base: Pose2) {
        self.map_from_odom = Some((map_from_base * odom_from_base.inverse()).normalized());
    }

    /// Predicts a refined pose by a step of odometry. Odometry that reported a standstill while the
    /// robot moved may catch up with the whole motion at once, or lack the part that it missed: the
    /// prediction that matches the scan best wins (EXPERIMENTS.md, steps 17 and 18).
    fn predict_refined(
        &self,
        scan: &MatchingScan,
        before: &RefinedPose,
        step: Pose2,
    ) -> (PoseBelief, MissedMotion) {
        let by_odometry = predicted(&before.belief, step);
        let Some(map) = self.map.as_ref().map(|map| map.field()) else {
            return (by_odometry, MissedMotion::Any);
        };
        let fit_of = |belief: &PoseBelief| refine_pose(map, &scan.ends, belief).fit;
        if let Some(standstill) = before.standstill {
            let mut best = (by_odometry, f64::NEG_INFINITY);
            for belief in [by_odometry, predicted(&standstill, step), inflated(&standstill)] {
                let fit = fit_of(&belief);
                if fit > best.1 {
                    best = (belief, fit);
                }
            }
            return (best.0, MissedMotion::Rotation);
        }
        // A robot keeps its velocity for a moment; its odometry may report otherwise.
        let is_uneven = |last: &Pose2| has_moved(*last, step, UNEVEN_STEP);
        let Some(last_step) = before.last_step.filter(is_uneven) else {
            return (by_odometry, MissedMotion::Any);
        };
        let even = predicted(&before.belief, last_step);
        let refined = refine_pose(map, &scan.ends, &even);
        let is_better = refined.fit > fit_of(&by_odometry) + MIN_EVEN_GAIN_RATIO;
        let min_ratio = GOOD_MATCH_FRACTION * self.monitor.usual_inlier_ratio();
        let ratio = self.inlier_ratio(refined.belief.pose, &scan.beams);
        let is_even = is_better && ratio.is_some_and(|ratio| ratio >= min_ratio);
        (if is_even { even } else { by_odometry }, MissedMotion::Any)
    }

    /// Tracks one pose, with all particles around it.
    pub(super) fn track(
        &mut self,
        estimate: &mut PoseEstimate,
        belief: PoseBelief,
        odom_from_base: Pose2,
        last_step: Option<Pose2>,
    ) {
        let mut stream = self.random_stream("stray");
        let mut particles = Particles::default();
        let covariance = widened(belief.covariance());
        let count = self.settings.kld_sampling.min_particles;
        scatter(&mut particles, count, belief.pose, covariance, &mut stream);
        particles.set_uniform_weights();
        self.particles = particles;
        *estimate = self.summarize();
        estimate.pose = belief.pose;
        let refined = RefinedPose { last_step, ..RefinedPose::new(belief, odom_from_base) };
        self.mode = Mode::Tracking { refined: Some(refined) };
    }

    /// Reports an ambiguous pose where scans contradict odometry, or where the pose is not
    /// verified, in place of the state of the filter.
    pub(super) fn apply_doubt(&mut self, slip: Option<OdometrySlip>) {
        if let Some(before) = self.status_before_doubt.take() {
            self.status = before;
        }
        let Some(reason) = slip.map(OdometrySlip::reason).or_else(|| self.verification_doubt())
        else {
            return;
        };
        if self.status.state == LocalizationState::Tracking {
            self.status_before_doubt = Some(self.status.clone());
            self.status.state = LocalizationState::Ambiguous;
            self.status.reason = reason;
        }
    }

    /// State of the filter without the doubts of [`Amcl::apply_doubt`].
    pub(super) fn filter_state(&self) -> LocalizationState {
        self.status_before_doubt.as_ref().unwrap_or(&self.status).state
    }
}

pub(super) fn length_m(step: Pose2) -> f64 {
    libm::hypot(step.x_m, step.y_m)
}

/// The best cluster at the refined pose, and the other clusters that the scan does not refute
/// (EXPERIMENTS.md, step 11).
fn not_refuted(
    map: &LikelihoodMap,
    scan: &MatchingScan,
    clusters: &[Cluster],
    pose: Pose2,
    covariance: Covariance2,
) -> Vec<Cluster> {
    let Some((first, others)) = clusters.split_first() else { return Vec::new() };
    let mut kept = vec![Cluster { mean: pose, covariance, ..*first }];
    let min_log_likelihood = log_likelihood(map, &scan.beams, pose) - REFUTED_NATS;
    for other in others.iter().filter(|it| it.weight >= MIN_CLUSTER_FRACTION) {
        let information = information_from_std(CLUSTER_STD_M, CLUSTER_STD_RAD);
        let prior = PoseBelief { pose: other.mean, information };
        let refined = refine_pose(map, &scan.ends, &prior).belief.pose;
        if !SAME_POSE.covers(refined, pose)
            && log_likelihood(map, &scan.beams, refined) >= min_log_likelihood
        {
            kept.push(*other);
        }
    }
    kept
}

/// Adds the minimum spread of particles to a covariance.
pub(super) fn widened(covariance: Covariance2) -> Covariance2 {
    Covariance2 {
        xx: covariance.xx + MIN_STD_M * MIN_STD_M,
        yy: covariance.yy + MIN_STD_M * MIN_STD_M,
        yaw: covariance.yaw + MIN_STD_RAD * MIN_STD_RAD,
        ..covariance
    }
}
