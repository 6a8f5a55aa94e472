//! Detection of constant odometry while the robot moves.

use periplus_geometry::{Pose2, normalize_angle};

use crate::local::apart;
use crate::remark::RemarkKind;

/// Odometry that has changed by less since it last moved is constant.
const STILL_M: f64 = 0.002;
const STILL_RAD: f64 = 0.001;
/// Matched motion beyond which odometry that has never changed is ignored for the scan.
const SUSPECT_M: f64 = 0.03;
const SUSPECT_RAD: f64 = 0.03;
/// Matched motion beyond which constant odometry is ignored.
const STUCK_M: f64 = 0.3;
const STUCK_RAD: f64 = 0.4;
/// Path length equivalent of a rotation by one radian \[m\].
const ROTATION_ARM_M: f64 = 0.3;
/// Path without odometry before it is reported \[m\].
const REPORTED_M: f64 = 1.0;

/// Comparison of constant odometry with the motion by scans.
#[derive(Clone, Debug, Default)]
pub(crate) struct OdometryMonitor {
    /// Odometry pose when it last changed.
    rest: Option<Pose2>,
    has_moved: bool,
    /// True if odometry was constant at the last scan.
    is_still: bool,
    /// Motion by scans since then.
    unseen: Pose2,
    unseen_m: f64,
    is_reported: bool,
}

crate::session::packed!(OdometryMonitor {
    rest,
    has_moved,
    is_still,
    unseen,
    unseen_m,
    is_reported
});

/// Use of odometry for a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OdometryTrust {
    /// Used.
    Full,
    /// Constant since the start: used unless the scan contradicts it.
    Unproved,
    /// Constant while scans show motion: not used.
    None,
}

impl OdometryMonitor {
    /// Updates with the odometry pose at a scan.
    pub(crate) fn update(&mut self, odom_from_base: Option<Pose2>) -> OdometryTrust {
        let Some(now) = odom_from_base else { return OdometryTrust::Full };
        let Some(rest) = self.rest else {
            self.rest = Some(now);
            return OdometryTrust::Unproved;
        };
        let (metres, radians) = apart(rest, now);
        if metres > STILL_M || radians > STILL_RAD {
            *self = Self {
                rest: Some(now),
                has_moved: true,
                is_reported: self.is_reported,
                ..Self::default()
            };
            return OdometryTrust::Full;
        }
        self.is_still = true;
        let (metres, radians) = apart(self.unseen, Pose2::IDENTITY);
        if metres > STUCK_M || radians > STUCK_RAD {
            OdometryTrust::None
        } else if self.has_moved {
            OdometryTrust::Full
        } else {
            OdometryTrust::Unproved
        }
    }

    /// The remark made, while it holds.
    pub(crate) fn stuck(&self) -> Option<RemarkKind> {
        let holds = self.is_still && self.is_reported && self.unseen_m > REPORTED_M;
        holds.then_some(RemarkKind::OdometryStuck(self.unseen_m))
    }

    /// True if the motion by a scan contradicts constant odometry.
    pub(crate) fn is_suspect(moved: Pose2, is_matched: bool) -> bool {
        let (metres, radians) = apart(moved, Pose2::IDENTITY);
        !is_matched || metres > SUSPECT_M || radians > SUSPECT_RAD
    }

    /// Updates with the motion by a scan. Returns a remark, once, if odometry should have changed.
    pub(crate) fn observe(&mut self, moved: Pose2) -> Option<RemarkKind> {
        if !self.is_still {
            return None;
        }
        self.unseen = (self.unseen * moved).normalized();
        let (metres, radians) = apart(self.unseen, Pose2::IDENTITY);
        if metres > STUCK_M || radians > STUCK_RAD {
            let turn = normalize_angle(moved.yaw_rad).abs();
            self.unseen_m += libm::hypot(moved.x_m, moved.y_m) + ROTATION_ARM_M * turn;
        }
        (self.unseen_m > REPORTED_M && !std::mem::replace(&mut self.is_reported, true))
            .then_some(RemarkKind::OdometryStuck(self.unseen_m))
    }
}
