//! Multi-hypothesis tracking: pose hypotheses, each tracked separately until one remains.
//!
//! Resampling drops the right hypothesis as easily as a wrong one. Here each hypothesis is
//! predicted by odometry, refined by every scan, and accumulates the log-likelihood of the scans
//! (EXPERIMENTS.md, step 4).

use periplus_geometry::{Pose2, normalize_angle};

use crate::branch_and_bound::Completeness;
use crate::kld_sampling::Cluster;
use crate::likelihood_map::LikelihoodMap;
use crate::pose_threshold::PoseThreshold;
use crate::scan::{Beams, MatchingScan};
use crate::scan_likelihood::log_likelihood;
use crate::scan_refinement::{
    PoseBelief, Refinement, information_from_std, predicted, refine_pose,
};

/// Hypotheses closer than this are merged.
const MERGED: PoseThreshold = PoseThreshold::new(0.4, 0.3);
/// Log-likelihood below the best hypothesis, or below being off the map, at which a hypothesis is
/// dropped \[nats\].
pub(crate) const DROPPED_NATS: f64 = 9.0;
/// Number of hypotheses above which fewer beam ends refine each one, and their number.
const MAX_DENSE_HYPOTHESES: usize = 8;
const SPARSE_POINTS: usize = 50;
/// Maximum number of hypotheses.
const MAX_HYPOTHESES: usize = 120;
/// Maximum probability of all other hypotheses for a decision.
const MAX_DOUBT_PROBABILITY: f64 = 0.01;
/// As [`MAX_DOUBT_PROBABILITY`], for the first scan: scans of one pose are correlated.
const MAX_FIRST_DOUBT_PROBABILITY: f64 = 1e-3;
/// Log-likelihood ratio to every other hypothesis at which the best one is distinct \[nats\].
const STANDS_OUT_NATS: f64 = 4.6;
/// Distance after which the scans on it verify a hypothesis \[m\] (EXPERIMENTS.md, step 25).
pub(crate) const VERIFICATION_DISTANCE_M: f64 = 1.5;
/// Distance after which a scan counts as independent \[m\].
const INDEPENDENCE_DISTANCE_M: f64 = 0.5;
/// Log-likelihood of a scan for a robot that is nowhere on the map \[nats\]: lower than at any pose
/// with 80 % inliers (EXPERIMENTS.md, step 26).
pub(crate) const OFF_MAP_NATS: f64 = -7.0;
/// Maximum penalty for the difference between odometry and scan, as a squared Mahalanobis distance
/// (EXPERIMENTS.md, step 21).
const MAX_SQUARED_SIGMAS: f64 = 4.0;
/// Standard deviations of a candidate of the search.
const CANDIDATE_STD_M: f64 = 0.3;
const CANDIDATE_STD_RAD: f64 = 0.15;

/// Pose hypothesis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hypothesis {
    pub(crate) belief: PoseBelief,
    /// Log-likelihood of all scans since the start \[nats\].
    pub(crate) log_likelihood: f64,
    /// Refinement fit of the last scan, 0 to 1.
    pub(crate) fit: f64,
}

/// Hypotheses in order of decreasing likelihood; never empty.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Hypotheses {
    hypotheses: Vec<Hypothesis>,
    distance_m: f64,
    /// Log-likelihood of a robot that is nowhere on the map, or on another map \[nats\].
    off_map: f64,
    /// Completeness of the search that found the hypotheses.
    completeness: Completeness,
}

impl Hypotheses {
    /// Creates hypotheses at poses, refined and weighted by a scan; none without poses.
    pub(crate) fn new(
        map: &LikelihoodMap,
        scan: &MatchingScan,
        poses: impl IntoIterator<Item = Pose2>,
        completeness: Completeness,
    ) -> Option<Self> {
        let information = information_from_std(CANDIDATE_STD_M, CANDIDATE_STD_RAD);
        let poses: Vec<Pose2> = poses.into_iter().collect();
        let ends = subsampled(&scan.ends, poses.len());
        let hypotheses: Vec<Hypothesis> = poses
            .into_iter()
            .map(|pose| refined(map, &scan.beams, &ends, &PoseBelief { pose, information }))
            .collect();
        let mut all = Self { hypotheses, distance_m: 0.0, off_map: OFF_MAP_NATS, completeness };
        all.sort_and_prune();
        (!all.hypotheses.is_empty()).then_some(all)
    }

    /// Predicts all hypotheses by odometry and updates them with a scan.
    pub(crate) fn update(&mut self, map: &LikelihoodMap, scan: &MatchingScan, old_from_new: Pose2) {
        self.distance_m += libm::hypot(old_from_new.x_m, old_from_new.y_m);
        let fraction = independent_fraction(old_from_new);
        self.off_map += fraction * OFF_MAP_NATS;
        let ends = subsampled(&scan.ends, self.hypotheses.len());
        for hypothesis in &mut self.hypotheses {
            let belief = predicted(&hypothesis.belief, old_from_new);
            let refined = refined(map, &scan.beams, &ends, &belief);
            let squared_sigmas =
                squared_sigmas(&belief, refined.belief.pose).min(MAX_SQUARED_SIGMAS);
            let gain = refined.log_likelihood - 0.5 * squared_sigmas;
            let log_likelihood = hypothesis.log_likelihood + fraction * gain;
            *hypothesis = Hypothesis { log_likelihood, ..refined };
        }
        self.sort_and_prune();
    }

    /// Adds a hypothesis with prior log-odds, such as the pose tracked by odometry; the prior also
    /// goes to being off the map.
    pub(crate) fn insert(&mut self, hypothesis: &Hypothesis, prior_nats: f64) {
        let log_likelihood = hypothesis.log_likelihood + prior_nats;
        self.hypotheses.push(Hypothesis { log_likelihood, ..*hypothesis });
        self.off_map += prior_nats;
        self.sort_and_prune();
    }

    /// Keeps the hypotheses that pass a test and returns true, or keeps all and returns false if
    /// none passes.
    pub(crate) fn retain_any(&mut self, is_kept: impl Fn(&Hypothesis) -> bool) -> bool {
        let kept: Vec<Hypothesis> =
            self.hypotheses.iter().filter(|it| is_kept(it)).copied().collect();
        let has_any = !kept.is_empty();
        if has_any {
            self.hypotheses = kept;
        }
        has_any
    }

    /// Sorts, merges duplicates and drops unlikely hypotheses.
    fn sort_and_prune(&mut self) {
        self.hypotheses.sort_by(|a, b| b.log_likelihood.total_cmp(&a.log_likelihood));
        let best = self.hypotheses.first().map_or(0.0, |best| best.log_likelihood);
        let mut kept: Vec<Hypothesis> = Vec::new();
        for hypothesis in &self.hypotheses {
            let pose = hypothesis.belief.pose;
            let is_dropped = hypothesis.log_likelihood < best - DROPPED_NATS;
            let is_new = |it: &Hypothesis| !MERGED.covers_per_axis(it.belief.pose, pose);
            if !is_dropped && kept.iter().all(is_new) {
                kept.push(*hypothesis);
            }
        }
        self.hypotheses = kept;
        self.hypotheses.truncate(MAX_HYPOTHESES);
    }

    pub(crate) fn best(&self) -> &Hypothesis {
        &self.hypotheses[0]
    }

    /// True if the robot is far more likely off the map than at any hypothesis.
    pub(crate) fn are_refuted(&self) -> bool {
        self.best().log_likelihood < self.off_map - DROPPED_NATS
    }

    /// True if a single scan leaves at most one likely hypothesis.
    pub(crate) fn is_unique_at_once(&self) -> bool {
        let best = self.best().log_likelihood;
        let others: f64 =
            self.hypotheses[1..].iter().map(|it| libm::exp(it.log_likelihood - best)).sum();
        self.completeness > Completeness::Partial
            && others < MAX_FIRST_DOUBT_PROBABILITY
            && self.distance_m < INDEPENDENCE_DISTANCE_M
    }

    /// True if every other hypothesis is far less likely than the best.
    pub(crate) fn stands_out(&self) -> bool {
        let best = self.best().log_likelihood;
        self.hypotheses[1..].iter().all(|it| it.log_likelihood < best - STANDS_OUT_NATS)
    }

    /// True if the scans since the search suffice to verify the best hypothesis.
    pub(crate) fn is_verified(&self) -> bool {
        self.completeness > Completeness::Partial
            && self.distance_m >= VERIFICATION_DISTANCE_M
            && self.off_map < self.best().log_likelihood - DROPPED_NATS
            && self.is_decided()
    }

    /// Log-likelihood ratio of the best hypothesis to being nowhere on the map \[nats\] and the
    /// distance over which it was accumulated \[m\]; none if the search was cut off.
    pub(crate) fn on_map_evidence(&self) -> Option<OnMapEvidence> {
        let is_complete = self.completeness > Completeness::Partial;
        is_complete.then(|| OnMapEvidence {
            log_ratio_nats: self.best().log_likelihood - self.off_map,
            distance_m: self.distance_m,
        })
    }

    /// Distance since the hypotheses were found \[m\].
    pub(crate) fn distance_m(&self) -> f64 {
        self.distance_m
    }

    /// True if one hypothesis remains.
    pub(crate) fn is_decided(&self) -> bool {
        let is_first_scan = self.distance_m < INDEPENDENCE_DISTANCE_M;
        let max_doubt =
            if is_first_scan { MAX_FIRST_DOUBT_PROBABILITY } else { MAX_DOUBT_PROBABILITY };
        1.0 - self.probabilities()[0] < max_doubt
    }

    /// Probabilities of the hypotheses. Their sum is below 1 by the probability that all are wrong.
    pub(crate) fn probabilities(&self) -> Vec<f64> {
        let best = self.hypotheses[0].log_likelihood;
        let mut probabilities: Vec<f64> =
            self.hypotheses.iter().map(|it| libm::exp(it.log_likelihood - best)).collect();
        let off_map = libm::exp(self.off_map - best);
        let sum = probabilities.iter().sum::<f64>() + off_map;
        probabilities.iter_mut().for_each(|it| *it /= sum);
        probabilities
    }

    /// Converts the hypotheses to clusters of a number of particles.
    pub(crate) fn clusters(&self, particle_count: usize) -> Vec<Cluster> {
        let probabilities = self.probabilities();
        let cluster = |(hypothesis, &weight): (&Hypothesis, &f64)| Cluster {
            weight,
            count: (weight * particle_count as f64) as usize,
            mean: hypothesis.belief.pose,
            covariance: hypothesis.belief.covariance(),
        };
        self.hypotheses.iter().zip(&probabilities).map(cluster).collect()
    }
}

/// Evidence that a pose is the right one rather than nowhere on the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OnMapEvidence {
    /// Log-likelihood ratio \[nats\].
    pub(crate) log_ratio_nats: f64,
    /// Distance of the scans \[m\].
    pub(crate) distance_m: f64,
}

/// Subset of the beam ends where there are many hypotheses: the choice between them needs no
/// centimetre accuracy.
fn subsampled(ends: &[[f32; 2]], hypothesis_count: usize) -> Vec<[f32; 2]> {
    let is_dense = hypothesis_count <= MAX_DENSE_HYPOTHESES;
    let step = if is_dense { 1 } else { ends.len().div_ceil(SPARSE_POINTS).max(1) };
    ends.iter().step_by(step).copied().collect()
}

/// Fraction of a scan that is independent of the scan before a step: the same scan again adds no
/// information.
pub(crate) fn independent_fraction(step: Pose2) -> f64 {
    let distance_m = libm::hypot(step.x_m, step.y_m);
    (distance_m / INDEPENDENCE_DISTANCE_M + normalize_angle(step.yaw_rad).abs()).min(1.0)
}

/// Squared Mahalanobis distance between a refined pose and its prediction by odometry.
fn squared_sigmas(predicted: &PoseBelief, pose: Pose2) -> f64 {
    let error = [
        pose.x_m - predicted.pose.x_m,
        pose.y_m - predicted.pose.y_m,
        normalize_angle(pose.yaw_rad - predicted.pose.yaw_rad),
    ];
    predicted.information.quadratic(error)
}

fn refined(
    map: &LikelihoodMap,
    beams: &Beams,
    ends: &[[f32; 2]],
    prior: &PoseBelief,
) -> Hypothesis {
    let Refinement { belief, fit } = refine_pose(map, ends, prior);
    Hypothesis { belief, log_likelihood: log_likelihood(map, beams, belief.pose), fit }
}
