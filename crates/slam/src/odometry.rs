//! How far odometry can be trusted.

use periplus_base::{Pose2, normalize_angle};
use periplus_matching::Symmetric3;

/// How odometry errs, learnt as the robot drives.
#[derive(Clone, Debug)]
pub(crate) struct Trust {
    /// Errors are so many times those of the model, squared: of place and of heading.
    place: f64,
    heading: f64,
}

/// One standard deviation: at least, per metre, per radian.
const SHIFT_M: [f64; 3] = [0.02, 0.08, 0.03];
const TURN_RAD: [f64; 3] = [0.015, 0.03, 0.08];
/// Bounds of the learnt factor, squared; a robot with wheels that slip on every turn stays findable,
/// and one with perfect wheels does not come to a window of nothing.
const LEAST: f64 = 0.25;
const MOST: f64 = 36.0;
/// How fast it learns.
const RATE: f64 = 0.04;

impl Default for Trust {
    fn default() -> Self {
        Self { place: 2.0, heading: 2.0 }
    }
}

impl Trust {
    /// Covariance of a motion that odometry tells; errors as along the axes of where it began.
    pub(crate) fn covariance(&self, motion: Pose2) -> Symmetric3 {
        let model = Self::model(motion);
        Symmetric3::diagonal(model[0] * self.place, model[0] * self.place, model[1] * self.heading)
    }

    /// When there is no odometry: the robot goes on as before, or not.
    pub(crate) fn blind() -> Symmetric3 {
        Symmetric3::diagonal(0.09, 0.09, 0.04)
    }

    /// Variances of place and heading.
    fn model(motion: Pose2) -> [f64; 2] {
        let way = libm::hypot(motion.x_m, motion.y_m);
        let turn = normalize_angle(motion.yaw_rad).abs();
        [SHIFT_M, TURN_RAD].map(|[least, per_metre, per_radian]| {
            let sigma = least + per_metre * way + per_radian * turn;
            sigma * sigma
        })
    }

    /// Learns from where a scan was found against where odometry had it.
    pub(crate) fn learn(&mut self, motion: Pose2, found: Pose2) {
        let model = Self::model(motion);
        let (x, y) = (found.x_m - motion.x_m, found.y_m - motion.y_m);
        let turn = normalize_angle(found.yaw_rad - motion.yaw_rad);
        let toward = |factor: &mut f64, squared: f64| {
            *factor += RATE * (squared.min(4.0 * MOST) - *factor);
            *factor = factor.clamp(LEAST, MOST);
        };
        toward(&mut self.place, 0.5 * (x * x + y * y) / model[0]);
        toward(&mut self.heading, turn * turn / model[1]);
    }
}

crate::session::packed!(Trust { place, heading });
