//! Odometry that does not move while the robot does.

use periplus_geometry::{Pose2, normalize_angle};

use crate::doubts::Doubt;
use crate::local::apart;

/// Odometry that has changed by less since it last moved stands still \[m, rad\].
const STILL_M: f64 = 0.002;
const STILL_RAD: f64 = 0.001;
/// While odometry has never moved, a scan that was found farther off is looked for without it \[m, rad\].
const SUSPECT_M: f64 = 0.03;
const SUSPECT_RAD: f64 = 0.03;
/// Scans that show more motion than this, while odometry stands still, are believed \[m, rad\].
const DEAD_M: f64 = 0.3;
const DEAD_RAD: f64 = 0.4;
/// A turn of a radian counts as so much way \[m\].
const TURN_WAY_M: f64 = 0.3;
/// Way without odometry before it is told \[m\].
const TOLD_M: f64 = 1.0;

/// Whether odometry counts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Wheels {
    /// Odometry when it last moved.
    rest: Option<Pose2>,
    has_moved: bool,
    /// Whether it stood still at the last scan.
    is_still: bool,
    /// Motion that scans show since then.
    unseen: Pose2,
    unseen_m: f64,
    is_told: bool,
}

crate::session::packed!(Wheels { rest, has_moved, is_still, unseen, unseen_m, is_told });

/// What to make of odometry that tells a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Belief {
    /// It counts.
    Full,
    /// It stands still and never moved: it counts as long as scans do not contradict it.
    Unproved,
    /// It stands still while scans show that the robot moves.
    None,
}

impl Wheels {
    /// Takes note of odometry at a scan.
    pub(crate) fn take(&mut self, odom_from_base: Option<Pose2>) -> Belief {
        let Some(now) = odom_from_base else { return Belief::Full };
        let Some(rest) = self.rest else {
            self.rest = Some(now);
            return Belief::Unproved;
        };
        let (metres, radians) = apart(rest, now);
        if metres > STILL_M || radians > STILL_RAD {
            *self =
                Self { rest: Some(now), has_moved: true, is_told: self.is_told, ..Self::default() };
            return Belief::Full;
        }
        self.is_still = true;
        let (metres, radians) = apart(self.unseen, Pose2::IDENTITY);
        if metres > DEAD_M || radians > DEAD_RAD {
            Belief::None
        } else if self.has_moved {
            Belief::Full
        } else {
            Belief::Unproved
        }
    }

    /// The doubt that was told, as long as it holds.
    pub(crate) fn standing_still(&self) -> Option<Doubt> {
        let holds = self.is_still && self.is_told && self.unseen_m > TOLD_M;
        holds.then_some(Doubt::OdometryStill(self.unseen_m))
    }

    /// Whether a scan that was found there contradicts odometry that stands still.
    pub(crate) fn is_suspect(moved: Pose2, is_matched: bool) -> bool {
        let (metres, radians) = apart(moved, Pose2::IDENTITY);
        !is_matched || metres > SUSPECT_M || radians > SUSPECT_RAD
    }

    /// Takes note of the motion that a scan shows. Gives a doubt, once, when odometry should have moved.
    pub(crate) fn found(&mut self, moved: Pose2) -> Option<Doubt> {
        if !self.is_still {
            return None;
        }
        self.unseen = (self.unseen * moved).normalized();
        let (metres, radians) = apart(self.unseen, Pose2::IDENTITY);
        if metres > DEAD_M || radians > DEAD_RAD {
            let turn = normalize_angle(moved.yaw_rad).abs();
            self.unseen_m += libm::hypot(moved.x_m, moved.y_m) + TURN_WAY_M * turn;
        }
        (self.unseen_m > TOLD_M && !std::mem::replace(&mut self.is_told, true))
            .then_some(Doubt::OdometryStill(self.unseen_m))
    }
}
