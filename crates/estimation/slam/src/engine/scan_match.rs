//! Matching of a scan with odometry as the prior.

use periplus_geometry::{LaserScan2, Pose2};
use periplus_scan_matching::{Cloud, Symmetric3};

use super::{MIN_POINTS_COUNT, Slam};
use crate::local::{
    MAX_CONTRADICTING_AGREEMENT_RATIO, apart, grouped, is_better, match_locally, neighbours,
    reweighted, uncertain,
};
use crate::odometry_noise::OdometryNoise;
use crate::scan::Ends;

/// Less motion than this is standing still \[m, rad\].
const STILL_M: f64 = 0.002;
const STILL_RAD: f64 = 0.001;
/// More motion than this since the scan before asks for a search \[m, rad\].
const SEARCH_M: f64 = 0.1;
const SEARCH_RAD: f64 = 0.05;
/// Longest interval over which constant velocity is assumed \[s\].
const RECENT_S: f64 = 1.0;

/// A scan among those before.
pub(super) struct ScanMatch {
    pub(super) ends: Ends,
    pub(super) cloud: Cloud,
    /// Motion by odometry; `None` if it is not used.
    pub(super) odometry: Option<Pose2>,
    /// The step that was expected, and its covariance.
    pub(super) motion: Pose2,
    pub(super) covariance: Symmetric3,
    /// Matched pose relative to the last keyframe.
    pub(super) keyframe_from_base: Pose2,
    /// Information of scans and odometry together; `doubted` is the one used for the uncertainty of a path.
    pub(super) information: Symmetric3,
    pub(super) doubted: Symmetric3,
    /// True if there are too few points to match.
    pub(super) is_blank: bool,
    /// True if odometry reports no motion.
    pub(super) is_still: bool,
    pub(super) is_matched: bool,
    pub(super) is_doubted: bool,
    /// Agreement with the scans before; low if the scan may belong elsewhere: see
    /// [`crate::local::LocalMatch`].
    pub(super) agreeing: f64,
    /// From 0 where walls do not hold along some direction to 1.
    pub(super) firmness: f64,
    /// Part of the points that found partners.
    pub(super) matched: f64,
}

impl ScanMatch {
    /// True if most of what this scan and those before it can both see contradicts them, so that it may belong
    /// elsewhere.
    pub(super) fn contradicts(&self) -> bool {
        self.agreeing <= MAX_CONTRADICTING_AGREEMENT_RATIO
    }
}

/// A motion in a second, when it was short enough to be one.
pub(super) fn per_second(motion: Pose2, seconds: f64) -> Option<Pose2> {
    let rate = 1.0 / seconds;
    (seconds > 0.0 && seconds < RECENT_S)
        .then(|| Pose2::new(motion.x_m * rate, motion.y_m * rate, motion.yaw_rad * rate))
}

impl Slam {
    /// Looks for a scan among those just before.
    pub(super) fn match_scan(
        &self,
        scan: &LaserScan2,
        odometry: Option<Pose2>,
        seconds: f64,
    ) -> ScanMatch {
        let (last_keyframe, last_from_base, last_motion) =
            self.last.as_ref().map_or((0, Pose2::IDENTITY, None), |last| {
                (last.keyframe, last.keyframe_from_base, last.motion)
            });
        // Constant velocity.
        let inertia = last_motion
            .filter(|_| seconds > 0.0 && seconds < RECENT_S)
            .map(|it| Pose2::new(it.x_m * seconds, it.y_m * seconds, it.yaw_rad * seconds));
        let motion = odometry.or(inertia).unwrap_or(Pose2::IDENTITY);
        let covariance = if odometry.is_some() {
            self.odometry_noise.covariance(motion, seconds)
        } else {
            OdometryNoise::blind()
        };
        let ends = Ends::new(scan, per_second(motion, seconds), self.settings.used_m());
        let cloud = ends.cloud(&self.settings.cloud);
        let (metres, radians) = apart(motion, Pose2::IDENTITY);
        let expected = (last_from_base * motion).normalized();
        let information = covariance.inverse().unwrap_or(Symmetric3::diagonal(1.0, 1.0, 1.0));
        let mut scan_match = ScanMatch {
            is_blank: cloud.points().len() < MIN_POINTS_COUNT,
            is_still: odometry.is_some() && metres < STILL_M && radians < STILL_RAD,
            ends,
            cloud,
            odometry,
            motion,
            covariance,
            keyframe_from_base: expected,
            information,
            doubted: information,
            is_matched: false,
            is_doubted: false,
            agreeing: 1.0,
            firmness: 0.0,
            matched: 0.0,
        };
        if scan_match.is_blank {
            return scan_match;
        }
        let (cloud, settings) = (&scan_match.cloud, &self.settings);
        let group = neighbours(&self.keyframes, &self.graph, settings.local_scans, self.component);
        let group = grouped(&self.keyframes, &self.graph, &group, last_keyframe);
        let group = group.placed();
        // The prior is about a motion that began at the last scan.
        let turned = covariance.turned(last_from_base.yaw_rad);
        let searches = odometry.is_none() || metres > SEARCH_M || radians > SEARCH_RAD;
        let mut found =
            match_locally(cloud, &group, expected, &turned, settings, searches, self.inlier_ratio);
        let is_against_inertia = |inertia: &Pose2| {
            let (metres, radians) = apart(motion, *inertia);
            metres > SEARCH_M || radians > SEARCH_RAD
        };
        if let Some(inertia) = inertia.filter(|it| odometry.is_some() && is_against_inertia(it)) {
            // Delayed odometry is constant first and catches up in one step.
            let expected = (last_from_base * inertia).normalized();
            let turned = OdometryNoise::blind().turned(last_from_base.yaw_rad);
            let other =
                match_locally(cloud, &group, expected, &turned, settings, true, self.inlier_ratio);
            if is_better(cloud, &group, &other, &found) {
                found = other;
                found.is_doubted = true;
                scan_match.odometry = None;
            }
        }
        if scan_match.odometry.is_some() && found.is_matched {
            let typical =
                self.odometry_noise.typical(motion, seconds).turned(last_from_base.yaw_rad);
            if !scan_match.is_still {
                found = reweighted(found, cloud, &group, expected, &typical, settings);
            }
            found.doubted = uncertain(&found, &typical);
        }
        scan_match.keyframe_from_base = found.fit.target_from_moving;
        (scan_match.information, scan_match.doubted) = (found.information, found.doubted);
        (scan_match.is_matched, scan_match.is_doubted) = (found.is_matched, found.is_doubted);
        (scan_match.firmness, scan_match.matched) = (found.fit.firmness, found.fit.matched);
        scan_match.agreeing = found.agreeing;
        scan_match
    }
}
