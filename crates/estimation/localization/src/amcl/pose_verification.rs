//! Verification of a pose before it is reported as known.
//!
//! An initial pose, or one that was tracked without interruption, is trusted as long as scans match.
//! A pose from a search, or one that odometry led to after scans had not matched for some distance,
//! is not: half of a scan of one room matches many others, and the best match on a map need not be on
//! it at all. Such a pose has to be verified: searches of the whole map, some distance apart, must
//! find it again, each time better than every other pose.

use periplus_geometry::{Pose2, normalize_angle};

use super::Amcl;
use super::global_search::SearchResult;
use super::local_search::{CONVINCING_FRACTION, CONVINCING_RATIO, REFUTED_NATS, SAME_POSE};
use super::tracking::length_m;
use crate::branch_and_bound::Completeness;
use crate::hypotheses::{
    DROPPED_NATS, Hypotheses, OFF_MAP_NATS, OnMapEvidence, VERIFICATION_DISTANCE_M,
    independent_fraction,
};
use crate::pose_threshold::PoseThreshold;
use crate::scan::MatchingScan;
use crate::scan_likelihood::{inlier_ratios, log_likelihood};
use crate::scan_refinement::{PoseBelief, information_from_std, refine_pose};
use crate::shared_maps::PreparedMap;
use crate::status::LocalizationState;

// All values are from EXPERIMENTS.md, steps 23 to 33.

/// Inlier ratio below which the map does not determine the pose (step 23).
const MIN_COVERED_RATIO: f64 = 0.55;
/// Minimum inlier ratio of the first scan at an initial pose that needs no verification.
const MIN_TRUSTED_RATIO: f64 = 0.6;
/// Distance from all free cells above which the robot is off the map \[m\].
const MAX_FREE_DISTANCE_M: f64 = 0.3;
/// Distance without a match, less the distance with one, above which a pose has to be verified \[m\].
const MAX_UNMATCHED_DISTANCE_M: f64 = 2.0;
/// Weight of that distance where scans hit nothing: open space is not a contradiction.
const OPEN_SPACE_FACTOR: f64 = 0.25;
/// Weight of that distance where scans are unusual (step 32).
const UNUSUAL_FACTOR: f64 = 0.5;
/// Number of searches that have to agree (step 24).
const AGREEING_SEARCH_COUNT: u32 = 2;
/// As [`AGREEING_SEARCH_COUNT`], where odometry is off the map, but within its error (step 31).
const OFF_MAP_AGREEING_SEARCH_COUNT: u32 = 6;
/// Maximum error of odometry since the last trusted pose: constant, and per distance (step 31).
const ODOMETRY_ERROR_M: f64 = 0.5;
const ODOMETRY_ERROR_FRACTION: f64 = 0.1;
const ODOMETRY_ERROR_RAD: f64 = 0.35;
const ODOMETRY_ERROR_RAD_PER_M: f64 = 0.02;
/// Step of odometry between scans above which odometry is unreliable \[m\].
const MAX_STEP_M: f64 = 2.5;
/// Fraction of contradicting hits, above the usual one, that indicates kidnapping (step 30).
const CONTRADICTED_FRACTION: f64 = 0.4;
/// Distance of such scans that proves kidnapping: near the last trusted pose, that is within
/// [`NEAR_ANCHOR_M`], and farther on \[m\].
const KIDNAPPED_DISTANCE_M: f64 = 0.3;
const NEAR_ANCHOR_M: f64 = 3.0;
const KIDNAPPED_FAR_DISTANCE_M: f64 = 10.0;
/// Gain of the average fraction of contradicting hits.
const CONTRADICTED_GAIN_FACTOR: f64 = 0.02;
/// Usual inlier ratio below which the environment changed too much for a conclusive search.
const MIN_CONCLUSIVE_RATIO: f64 = 0.75;
/// Drift of scan matching along the path against odometry: averaging distance, and the limit,
/// constant and per distance (step 33).
const DRIFT_DISTANCE_M: f64 = 4.0;
const MAX_DRIFT_M: f64 = 0.25;
const MAX_DRIFT_FRACTION: f64 = 0.12;
/// Minimum step of odometry with a direction \[m\].
const MIN_DIRECTION_STEP_M: f64 = 0.01;
/// One search suffices at this inlier ratio and log-likelihood, and with this margin over every
/// other pose.
const SINGLE_SEARCH_RATIO: f64 = 0.85;
const SINGLE_SEARCH_NATS: f64 = -3.0;
const SINGLE_SEARCH_MARGIN_NATS: f64 = 9.0;
/// Log-likelihood lost from a full match to none \[nats\].
const NO_MATCH_NATS: f64 = 20.0;
/// Minimum motion between searches for verification; farther where odometry is off the map.
const SEARCH_INTERVAL: PoseThreshold = PoseThreshold::new(0.8, 0.8);
const OFF_MAP_SEARCH_INTERVAL: PoseThreshold = PoseThreshold::new(2.5, 9.0);
/// Minimum score of other poses in a search for verification, as a fraction of that of the pose.
pub(super) const MIN_RIVAL_FRACTION: f64 = 0.85;
/// Standard deviations of the prior of a candidate.
const CANDIDATE_STD_M: f64 = 0.3;
const CANDIDATE_STD_RAD: f64 = 0.15;

/// Evidence for the reported pose.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PoseVerification {
    /// Number of searches that agree; none when no verification is required.
    agreeing_searches: Option<u32>,
    /// Evidence of the scans since a search left one pose.
    evidence: Option<OnMapEvidence>,
    /// True after kidnapping or an error of odometry: odometry does not constrain the pose.
    is_odometry_unreliable: bool,
    /// Distance of scans that contradict the map at the pose by odometry \[m\]; none if the last one
    /// did not.
    contradicted_distance_m: Option<f64>,
    /// Average fraction of contradicting hits.
    usual_contradicted: f64,
    /// True if odometry is off the map.
    is_off_map: bool,
    anchor: Option<OdometryAnchor>,
    drift: ScanDrift,
    /// Last reported pose.
    map_from_base: Option<Pose2>,
    /// Distance without a match, less that with one \[m\].
    unmatched_distance_m: f64,
    /// Odometry at the last scan.
    odom_from_base: Option<Pose2>,
    /// Inlier ratio of the last scan, where it is too low.
    uncovered: Option<f64>,
    /// Inlier ratio of the last scan, where it is unusual.
    unusual: Option<UnusualRatio>,
    /// True if the robot is outside of the free space of the map.
    is_outside: bool,
    scan_count: u64,
}

/// Odometry at the last trusted pose.
#[derive(Clone, Copy, Debug)]
struct OdometryAnchor {
    map_from_odom: Pose2,
    /// Distance since \[m\].
    distance_m: f64,
}

/// Prediction of the pose from the last trusted one, with the maximum error of odometry.
struct AnchoredPose {
    map_from_base: Pose2,
    max_error_m: f64,
    max_error_rad: f64,
}

/// Motion by scans along the path, in excess of that by odometry, with exponential decay.
#[derive(Clone, Copy, Debug, Default)]
struct ScanDrift {
    excess_m: f64,
    distance_m: f64,
}

impl ScanDrift {
    fn add(&mut self, by_odometry: Pose2, by_scans: Pose2) {
        let distance_m = length_m(by_odometry);
        let decay = libm::exp(-distance_m / DRIFT_DISTANCE_M);
        let excess = [by_scans.x_m - by_odometry.x_m, by_scans.y_m - by_odometry.y_m];
        // Across the path odometry errs with the heading, and with the mounting of the scanner.
        let along_m = (excess[0] * by_odometry.x_m + excess[1] * by_odometry.y_m)
            / distance_m.max(MIN_DIRECTION_STEP_M);
        self.excess_m = decay * self.excess_m + along_m;
        self.distance_m = decay * self.distance_m + distance_m;
    }

    /// Drift as a fraction of its limit.
    fn fraction(&self) -> f64 {
        self.excess_m.abs() / (MAX_DRIFT_M + MAX_DRIFT_FRACTION * self.distance_m)
    }
}

/// Inlier ratio that is unusually low, and the usual minimum.
#[derive(Clone, Copy, Debug)]
struct UnusualRatio {
    ratio: f64,
    min_ratio: f64,
}

/// Agreement of a pose with odometry since the last trusted pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OdometryAgreement {
    /// The pose is within the error of odometry.
    Possible,
    /// As [`OdometryAgreement::Possible`], but odometry is rather off the map.
    OffMap,
    /// The pose is beyond the error of odometry.
    Contradicted,
}

/// Match of a scan at the reported pose.
struct ScanMatch {
    /// Fraction of the hits at walls; none without hits.
    inlier_ratio: Option<f64>,
    /// Fraction of the hits that contradict the map at the pose by odometry; none off the map.
    contradicted: Option<f64>,
    is_outside: bool,
    unusual: Option<UnusualRatio>,
}

impl PoseVerification {
    /// Requires verification of the pose, with a number of searches that agree already.
    pub(super) fn require(&mut self, agreeing_searches: u32) {
        self.agreeing_searches = Some(agreeing_searches);
        self.is_off_map = false;
        self.evidence = None;
    }

    pub(super) fn is_required(&self) -> bool {
        self.agreeing_searches.is_some()
    }

    pub(super) fn is_odometry_unreliable(&self) -> bool {
        self.is_odometry_unreliable
    }

    /// Adds the log-likelihood ratio of a scan after a step.
    fn add_evidence(&mut self, step: Pose2, log_ratio_nats: f64) {
        let Some(evidence) = &mut self.evidence else { return };
        evidence.log_ratio_nats += independent_fraction(step) * log_ratio_nats;
        evidence.distance_m += length_m(step);
        if evidence.log_ratio_nats >= DROPPED_NATS && evidence.distance_m >= VERIFICATION_DISTANCE_M
        {
            self.add_agreement(true);
        }
    }

    fn required_count(&self) -> u32 {
        if self.is_off_map { OFF_MAP_AGREEING_SEARCH_COUNT } else { AGREEING_SEARCH_COUNT }
    }

    /// Counts a search that found the pose and no other one.
    fn add_agreement(&mut self, is_conclusive: bool) {
        self.agreeing_searches = self.agreeing_searches.map(|count| count + 1);
        let is_enough = self.agreeing_searches.is_some_and(|it| it >= self.required_count());
        if is_conclusive && !self.is_off_map || is_enough {
            self.agreeing_searches = None;
            self.evidence = None;
            self.unmatched_distance_m = 0.0;
        }
    }

    /// Adds a scan at the reported pose. `is_steady`: the pose agrees with odometry.
    fn add_scan(
        &mut self,
        odom_from_base: Pose2,
        map_from_base: Pose2,
        scan: &ScanMatch,
        is_steady: bool,
    ) {
        let step =
            self.odom_from_base.replace(odom_from_base).map(|old| old.inverse() * odom_from_base);
        let distance_m = step.map_or(0.0, length_m);
        let old = self.map_from_base.replace(map_from_base);
        if let (Some(step), Some(old)) = (step, old) {
            self.drift.add(step, old.inverse() * map_from_base);
        }
        let has_drifted = self.drift.fraction() > 1.0;
        if distance_m > MAX_STEP_M {
            self.require(0);
            self.is_odometry_unreliable = true;
        }
        let ScanMatch { inlier_ratio, is_outside, .. } = *scan;
        self.uncovered = inlier_ratio.filter(|ratio| *ratio < MIN_COVERED_RATIO);
        self.unusual = scan.unusual;
        self.is_outside = is_outside;
        let is_bad = self.uncovered.is_some() || self.unusual.is_some() || is_outside;
        if let Some(anchor) = &mut self.anchor {
            anchor.distance_m += distance_m;
        }
        self.unmatched_distance_m = match inlier_ratio {
            None if !is_outside => self.unmatched_distance_m + OPEN_SPACE_FACTOR * distance_m,
            _ if self.uncovered.is_some() || is_outside => self.unmatched_distance_m + distance_m,
            _ if is_bad => self.unmatched_distance_m + UNUSUAL_FACTOR * distance_m,
            _ => (self.unmatched_distance_m - distance_m).max(0.0),
        };
        self.add_contradiction(scan.contradicted, distance_m);
        let map_from_odom = (map_from_base * odom_from_base.inverse()).normalized();
        let anchor = OdometryAnchor { map_from_odom, distance_m: 0.0 };
        // At the edge of a map, half of a scan may drag the pose along.
        let matches = inlier_ratio.is_some_and(|ratio| ratio >= MIN_TRUSTED_RATIO)
            && !is_bad
            && self.drift.fraction() < 0.5;
        if matches && is_steady && !self.is_required() && self.unmatched_distance_m == 0.0 {
            self.anchor = Some(anchor);
            self.is_odometry_unreliable = false;
        }
        self.scan_count += 1;
        let is_doubtful_start =
            self.scan_count == 1 && inlier_ratio.is_some_and(|ratio| ratio < MIN_TRUSTED_RATIO);
        if is_doubtful_start && !self.is_required() {
            // At the edge of the map rather than anywhere.
            self.anchor = Some(anchor);
        }
        let is_lost = self.unmatched_distance_m > MAX_UNMATCHED_DISTANCE_M;
        if (is_lost || is_doubtful_start || has_drifted) && !self.is_required() {
            self.require(0);
        }
    }

    /// Adds the fraction of hits that contradict the map at the pose by odometry, after a distance.
    fn add_contradiction(&mut self, fraction: Option<f64>, distance_m: f64) {
        let min_fraction = CONTRADICTED_FRACTION + self.usual_contradicted;
        let is_contradicted = fraction.is_some_and(|it| it >= min_fraction);
        self.contradicted_distance_m = is_contradicted
            .then(|| self.contradicted_distance_m.map_or(0.0, |before_m| before_m + distance_m));
        let is_near = self.anchor.is_some_and(|it| it.distance_m < NEAR_ANCHOR_M);
        let max_m = if is_near { KIDNAPPED_DISTANCE_M } else { KIDNAPPED_FAR_DISTANCE_M };
        self.is_odometry_unreliable |= self.contradicted_distance_m.is_some_and(|it| it > max_m);
        if let Some(fraction) = fraction
            && !self.is_required()
        {
            self.usual_contradicted +=
                CONTRADICTED_GAIN_FACTOR * (fraction - self.usual_contradicted);
        }
    }

    /// Reason to doubt a pose that is being tracked.
    fn doubt(&self, needs_verification: bool) -> Option<String> {
        if let Some(ratio) = self.uncovered {
            let percent = 100.0 * ratio;
            return Some(format!(
                "only {percent:.0} % of the scan hits are at walls of the map: the robot is off the \
                 map, or the environment changed"
            ));
        }
        if self.is_outside {
            return Some("the robot is outside of the free space of the map".into());
        }
        if let Some(UnusualRatio { ratio, min_ratio }) = self.unusual {
            let (percent, min_percent) = (100.0 * ratio, 100.0 * min_ratio);
            return Some(format!(
                "only {percent:.0} % of the scan hits are at walls of the map, usually more than \
                 {min_percent:.0} %: the robot was kidnapped, or the environment changed"
            ));
        }
        let agreeing = self.agreeing_searches.filter(|_| needs_verification)?;
        Some(format!(
            "the pose is not verified: {agreeing} of {} searches of the map found it and no other \
             pose; drive on to verify it",
            self.required_count()
        ))
    }
}

impl Amcl {
    /// True if the pose has to be verified. Without searches of the map it cannot be.
    pub(super) fn needs_verification(&self) -> bool {
        self.verification.is_required() && self.settings.searches_when_lost
    }

    /// Adds the match of a scan at the reported pose to the verification.
    pub(super) fn verify_at(
        &mut self,
        scan: &MatchingScan,
        map_from_base: Pose2,
        odom_from_base: Pose2,
        has_slipped: bool,
    ) {
        let Some(map) = self.map.as_ref().map(PreparedMap::field) else { return };
        let Pose2 { x_m, y_m, .. } = map_from_base;
        let min_ratio = self.monitor.min_usual_inlier_ratio();
        let scan_match = ScanMatch {
            inlier_ratio: inlier_ratios(map, &scan.beams, map_from_base).map(|it| it.all),
            contradicted: self.contradicted_at_odometry(scan, odom_from_base),
            is_outside: !map.is_free_near(x_m, y_m, MAX_FREE_DISTANCE_M),
            unusual: self
                .inlier_ratio(map_from_base, &scan.beams)
                .filter(|ratio| self.monitor.was_localized() && *ratio < min_ratio)
                .map(|ratio| UnusualRatio { ratio, min_ratio }),
        };
        if self.verification.evidence.is_some()
            && let Some(old) = self.verification.odom_from_base
        {
            let ratio_nats = log_likelihood(map, &scan.beams, map_from_base) - OFF_MAP_NATS;
            self.verification.add_evidence(old.inverse() * odom_from_base, ratio_nats);
        }
        let is_steady = !has_slipped && self.filter_state() == LocalizationState::Tracking;
        self.verification.add_scan(odom_from_base, map_from_base, &scan_match, is_steady);
    }

    /// Reason to doubt a pose that the filter tracks.
    pub(super) fn verification_doubt(&self) -> Option<String> {
        self.verification.doubt(self.settings.searches_when_lost)
    }

    /// True if the next search for verification is due.
    pub(super) fn is_verification_due(&self, odom_from_base: Pose2) -> bool {
        let is_off_map = self.verification.is_off_map;
        let interval = if is_off_map { OFF_MAP_SEARCH_INTERVAL } else { SEARCH_INTERVAL };
        self.needs_verification()
            && self.mode.hypotheses().is_none()
            && self.search.has_moved_since_last(odom_from_base, interval)
    }

    /// Compares the reported pose with all other poses of a search. True, and one more agreeing
    /// search, if the pose is the only one that matches.
    pub(super) fn verify_by_search(
        &mut self,
        scan: &MatchingScan,
        pose: Pose2,
        result: &SearchResult,
    ) -> bool {
        let Some(map) = self.map.as_ref().map(PreparedMap::field) else { return false };
        let own_nats = log_likelihood(map, &scan.beams, pose);
        let Some(ratio) = inlier_ratios(map, &scan.beams, pose).map(|it| it.all) else {
            return false;
        };
        let information = information_from_std(CANDIDATE_STD_M, CANDIDATE_STD_RAD);
        let refined = |peak: Pose2| {
            refine_pose(map, &scan.ends, &PoseBelief { pose: peak, information }).belief.pose
        };
        // For a pose with a usual match, poses beyond the error of odometry are not alternatives.
        let is_usual = ratio >= self.monitor.min_usual_inlier_ratio();
        let is_other = |other: &Pose2| {
            let agreement = self.odometry_agreement(*other);
            let is_possible = !is_usual || agreement != OdometryAgreement::Contradicted;
            is_possible && !SAME_POSE.covers(*other, pose)
        };
        let others = result.poses().into_iter().map(refined).filter(is_other);
        let other_nats = others
            .map(|other| log_likelihood(map, &scan.beams, other))
            .fold(f64::NEG_INFINITY, f64::max);
        let usual_ratio = self.monitor.usual_inlier_ratio();
        let min_ratio = (CONVINCING_FRACTION * usual_ratio).max(CONVINCING_RATIO);
        // Where scans usually match less, less suffices.
        let usual_ratio = if self.monitor.was_localized() { usual_ratio } else { 1.0 };
        let min_nats = OFF_MAP_NATS - NO_MATCH_NATS * (1.0 - usual_ratio).max(0.0);
        let is_unique =
            other_nats <= own_nats - REFUTED_NATS && result.completeness > Completeness::Partial;
        let agreement = self.odometry_agreement(pose);
        let is_likely = own_nats >= min_nats;
        if ratio < min_ratio
            || !is_likely
            || !is_unique
            || agreement == OdometryAgreement::Contradicted
        {
            return false;
        }
        if agreement == OdometryAgreement::OffMap {
            (self.verification.is_off_map, self.verification.evidence) = (true, None);
        }
        let is_conclusive = result.completeness == Completeness::Complete
            && ratio >= SINGLE_SEARCH_RATIO
            && own_nats >= SINGLE_SEARCH_NATS
            && other_nats < own_nats - SINGLE_SEARCH_MARGIN_NATS;
        self.verification.add_agreement(is_conclusive);
        true
    }

    /// Predicts the pose by odometry from the last trusted one. None without a trusted pose, or if
    /// odometry is unreliable.
    fn anchored_pose(&self, odom_from_base: Pose2) -> Option<AnchoredPose> {
        let verification = &self.verification;
        let OdometryAnchor { map_from_odom, distance_m } =
            verification.anchor.filter(|_| !verification.is_odometry_unreliable)?;
        Some(AnchoredPose {
            map_from_base: (map_from_odom * odom_from_base).normalized(),
            max_error_m: ODOMETRY_ERROR_M + ODOMETRY_ERROR_FRACTION * distance_m,
            max_error_rad: ODOMETRY_ERROR_RAD + ODOMETRY_ERROR_RAD_PER_M * distance_m,
        })
    }

    fn contradicted_at_odometry(&self, scan: &MatchingScan, odom_from_base: Pose2) -> Option<f64> {
        let map = self.map.as_ref()?.field();
        let by_odometry = self.anchored_pose(odom_from_base)?.map_from_base;
        let is_on_map = map.is_free_near(by_odometry.x_m, by_odometry.y_m, MAX_FREE_DISTANCE_M);
        inlier_ratios(map, &scan.beams, by_odometry).filter(|_| is_on_map).map(|it| it.contradicted)
    }

    /// Compares a pose with odometry. A robot that has left the map sees other rooms that look like
    /// those on it.
    pub(super) fn odometry_agreement(&self, pose: Pose2) -> OdometryAgreement {
        let (Some(map), Some(odom_from_base)) = (&self.map, self.verification.odom_from_base)
        else {
            return OdometryAgreement::Possible;
        };
        let Some(AnchoredPose { map_from_base, max_error_m, max_error_rad }) =
            self.anchored_pose(odom_from_base)
        else {
            return OdometryAgreement::Possible;
        };
        let error = map_from_base.inverse() * pose;
        let is_far =
            length_m(error) > max_error_m || normalize_angle(error.yaw_rad).abs() > max_error_rad;
        let Pose2 { x_m, y_m, .. } = map_from_base;
        let is_free_within = |distance_m| map.field().is_free_near(x_m, y_m, distance_m);
        if is_far || !is_free_within(max_error_m) {
            OdometryAgreement::Contradicted
        } else if !is_free_within(MAX_FREE_DISTANCE_M) {
            OdometryAgreement::OffMap
        } else {
            OdometryAgreement::Possible
        }
    }

    /// Starts the verification of a hypothesis that was accepted.
    pub(super) fn verify_accepted(
        &mut self,
        pose: Pose2,
        scan: &MatchingScan,
        hypotheses: &Hypotheses,
    ) {
        let Some(map) = self.map.as_ref().map(PreparedMap::field) else { return };
        let ratio = inlier_ratios(map, &scan.beams, pose).map_or(0.0, |it| it.all);
        let is_conclusive = hypotheses.is_unique_at_once()
            && ratio >= SINGLE_SEARCH_RATIO
            && log_likelihood(map, &scan.beams, pose) >= SINGLE_SEARCH_NATS;
        let agreement = self.odometry_agreement(pose);
        self.verification.require(1);
        // The pose jumps; it does not drift.
        self.verification.drift = ScanDrift::default();
        self.verification.map_from_base = None;
        if agreement != OdometryAgreement::Possible {
            self.verification.is_off_map = true;
            return;
        }
        if is_conclusive || hypotheses.is_verified() && self.is_search_conclusive() {
            self.verification.add_agreement(true);
        } else {
            self.collect_evidence(hypotheses);
        }
    }

    /// True if the right pose was among the candidates of a search. A robot that was not kidnapped
    /// may have been off the map; then another search has to agree (EXPERIMENTS.md, step 25).
    fn is_search_conclusive(&self) -> bool {
        let was_localized = self.monitor.was_localized() || self.verification.anchor.is_some();
        !was_localized
            || self.verification.is_odometry_unreliable
                && self.monitor.usual_inlier_ratio() >= MIN_CONCLUSIVE_RATIO
    }

    /// From now on, scans verify the pose as well.
    pub(super) fn collect_evidence(&mut self, hypotheses: &Hypotheses) {
        if self.verification.is_required()
            && self.verification.evidence.is_none()
            && self.is_search_conclusive()
        {
            self.verification.evidence = hypotheses.on_map_evidence();
        }
    }
}
