//! Where a scan was found, by odometry and by the scans just before.

use periplus_geometry::Pose2;
use periplus_scan_matching::{Cloud, Symmetric3};

use super::{LEAST_POINTS, Last, Slam};
use crate::local::{apart, grouped, is_better, locate, neighbours, uncertain, weighed};
use crate::odometry::Trust;
use crate::scan::{Ends, Scan};

/// Less motion than this is standing still \[m, rad\].
const STILL_M: f64 = 0.002;
const STILL_RAD: f64 = 0.001;
/// More motion than this since the scan before asks for a search \[m, rad\].
const SEARCH_M: f64 = 0.1;
const SEARCH_RAD: f64 = 0.05;
/// After a longer time the motion before tells nothing of the one now \[s\].
const RECENT_S: f64 = 1.0;

/// A scan among those before.
pub(super) struct Look {
    pub(super) ends: Ends,
    pub(super) cloud: Cloud,
    /// The step that odometry tells; none when it is not believed.
    pub(super) told: Option<Pose2>,
    /// The step that was expected, and its covariance.
    pub(super) motion: Pose2,
    pub(super) covariance: Symmetric3,
    /// Where the scan was found, as seen from the last kept one.
    pub(super) key_from_base: Pose2,
    /// What scans and odometry say together; and the same for asking how far off it may be.
    pub(super) information: Symmetric3,
    pub(super) doubted: Symmetric3,
    /// Whether it has too few points to be laid onto others.
    pub(super) is_blank: bool,
    /// Whether odometry tells that the robot stands.
    pub(super) is_still: bool,
    pub(super) is_matched: bool,
    pub(super) is_doubted: bool,
    /// Where it is small, it may be a scan of another place: see [`crate::local::Located`].
    pub(super) agreeing: f64,
    /// From 0 where walls do not hold along some direction to 1.
    pub(super) firmness: f64,
    /// Part of the points that found partners.
    pub(super) matched: f64,
}

/// A motion in a second, when it was short enough to be one.
pub(super) fn per_second(motion: Pose2, seconds: f64) -> Option<Pose2> {
    let rate = 1.0 / seconds;
    (seconds > 0.0 && seconds < RECENT_S)
        .then(|| Pose2::new(motion.x_m * rate, motion.y_m * rate, motion.yaw_rad * rate))
}

impl Slam {
    /// Looks for a scan among those just before.
    pub(super) fn look(&self, scan: &Scan, last: &Last, told: Option<Pose2>, seconds: f64) -> Look {
        // As the robot moved before.
        let inertia = last
            .motion
            .filter(|_| seconds > 0.0 && seconds < RECENT_S)
            .map(|it| Pose2::new(it.x_m * seconds, it.y_m * seconds, it.yaw_rad * seconds));
        let motion = told.or(inertia).unwrap_or(Pose2::IDENTITY);
        let covariance =
            if told.is_some() { self.trust.covariance(motion, seconds) } else { Trust::blind() };
        let ends = scan.ends(per_second(motion, seconds), self.settings.used_m());
        let cloud = ends.cloud(&self.settings.cloud);
        let (metres, radians) = apart(motion, Pose2::IDENTITY);
        let expected = (last.key_from_base * motion).normalized();
        let information = covariance.inverse().unwrap_or(Symmetric3::diagonal(1.0, 1.0, 1.0));
        let mut look = Look {
            is_blank: cloud.points().len() < LEAST_POINTS,
            is_still: told.is_some() && metres < STILL_M && radians < STILL_RAD,
            ends,
            cloud,
            told,
            motion,
            covariance,
            key_from_base: expected,
            information,
            doubted: information,
            is_matched: false,
            is_doubted: false,
            agreeing: 1.0,
            firmness: 0.0,
            matched: 0.0,
        };
        if look.is_blank {
            return look;
        }
        let (cloud, settings) = (&look.cloud, &self.settings);
        let group = neighbours(&self.keys, &self.graph, settings.local_scans, self.piece);
        let group = grouped(&self.keys, &self.graph, &group, last.key);
        let group = group.placed();
        // The prior is about a motion that began at the last scan.
        let turned = covariance.turned(last.key_from_base.yaw_rad);
        let searches = told.is_none() || metres > SEARCH_M || radians > SEARCH_RAD;
        let mut found = locate(cloud, &group, expected, &turned, settings, searches, self.usual);
        let is_against_inertia = |inertia: &Pose2| {
            let (metres, radians) = apart(motion, *inertia);
            metres > SEARCH_M || radians > SEARCH_RAD
        };
        if let Some(inertia) = inertia.filter(|it| told.is_some() && is_against_inertia(it)) {
            // Odometry that is told late stands still first, and makes up for it in one step.
            let expected = (last.key_from_base * inertia).normalized();
            let turned = Trust::blind().turned(last.key_from_base.yaw_rad);
            let other = locate(cloud, &group, expected, &turned, settings, true, self.usual);
            if is_better(cloud, &group, &other, &found) {
                found = other;
                found.is_doubted = true;
                look.told = None;
            }
        }
        if look.told.is_some() && found.is_matched {
            let typical = self.trust.typical(motion, seconds).turned(last.key_from_base.yaw_rad);
            if !look.is_still {
                found = weighed(found, cloud, &group, expected, &typical, settings);
            }
            found.doubted = uncertain(&found, &typical);
        }
        look.key_from_base = found.fit.target_from_moving;
        (look.information, look.doubted) = (found.information, found.doubted);
        (look.is_matched, look.is_doubted) = (found.is_matched, found.is_doubted);
        (look.firmness, look.matched) = (found.fit.firmness, found.fit.matched);
        look.agreeing = found.agreeing;
        look
    }
}
