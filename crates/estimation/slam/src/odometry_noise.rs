//! Odometry noise, learned from scan matching.

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::Symmetric3;

/// Scale of the odometry errors relative to the noise model.
#[derive(Clone, Debug)]
pub(crate) struct OdometryNoise {
    /// Squared factors of the model's errors: of position and heading.
    place: f64,
    heading: f64,
    /// The same for ordinary steps: a step counts at most as one three times as far off as usual, so that a
    /// single wheel slip does not count against all others.
    typical_place: f64,
    typical_heading: f64,
    /// The longest step of late, forgotten slowly \[m\].
    step_m: f64,
}

/// One standard deviation: at least, per metre, per radian.
const SHIFT_M: [f64; 3] = [0.02, 0.08, 0.03];
const TURN_RAD: [f64; 3] = [0.015, 0.03, 0.08];
/// Bounds of the factor in searches, squared; a robot with wheels that slip on every turn stays findable,
/// and one with perfect wheels does not come to a window of nothing.
const MIN_SEARCH_FACTOR: f64 = 0.25;
const MAX_SEARCH_FACTOR: f64 = 36.0;
/// Lower bound of what is learnt, squared.
const MIN_LEARNED_FACTOR: f64 = 0.01;
/// Maximum squared factor with which a step counts for ordinary steps.
const MAX_STEP_FACTOR: f64 = 9.0;
/// Odometry that goes farther in one step than this, and faster than that, has jumped \[m, m/s\].
const JUMP_M: f64 = 4.0;
const FASTEST_M_S: f64 = 5.0;
/// A step is a jump too if it exceeds this multiple of the longest recent one, this distance, and this
/// speed.
const JUMP_STEP_FACTOR: f64 = 3.0;
const LEAST_JUMP_M: f64 = 0.5;
const FAST_M_S: f64 = 3.0;
const DECAY_FACTOR: f64 = 0.998;
/// After a longer time without scans \[s\] a robot that has moved may have gone at this pace \[m/s, rad/s\].
const BLIND_S: f64 = 5.0;
const LONGEST_S: f64 = 60.0;
const HIDDEN_M_S: f64 = 0.3;
const HIDDEN_RAD_S: f64 = 0.1;
const MOVED_M: f64 = 0.3;
const MOVED_RAD: f64 = 0.3;
/// Learning rate.
const LEARNING_RATE_FACTOR: f64 = 0.04;

impl Default for OdometryNoise {
    fn default() -> Self {
        Self { place: 2.0, heading: 2.0, typical_place: 2.0, typical_heading: 2.0, step_m: JUMP_M }
    }
}

impl OdometryNoise {
    /// Covariance of an odometry motion, along the axes of its start.
    pub(crate) fn covariance(&self, motion: Pose2, seconds: f64) -> Symmetric3 {
        let model = Self::model(motion, seconds);
        let place = model[0] * self.place.max(MIN_SEARCH_FACTOR);
        Symmetric3::diagonal(place, place, model[1] * self.heading.max(MIN_SEARCH_FACTOR))
    }

    /// Covariance of an ordinary step without wheel slip and without the lower bound for searches: the
    /// uncertainty of path measured by odometry alone.
    pub(crate) fn typical(&self, motion: Pose2, seconds: f64) -> Symmetric3 {
        let [place, heading] = Self::model(motion, seconds);
        let place = place * self.typical_place;
        Symmetric3::diagonal(place, place, heading * self.typical_heading)
    }

    /// When there is no odometry: the robot goes on as before, or not.
    pub(crate) fn blind() -> Symmetric3 {
        Symmetric3::diagonal(0.09, 0.09, 0.04)
    }

    /// True if a robot can have moved this far in this time.
    pub(crate) fn is_possible(&self, motion: Pose2, seconds: f64) -> bool {
        let way_m = libm::hypot(motion.x_m, motion.y_m);
        let usual_m =
            (JUMP_STEP_FACTOR * self.step_m).max(LEAST_JUMP_M) + FAST_M_S * seconds.max(0.0);
        way_m < usual_m.min(JUMP_M + FASTEST_M_S * seconds.max(0.0))
    }

    /// Variances of position and heading. Without scans for a while the robot may have moved unseen.
    fn model(motion: Pose2, seconds: f64) -> [f64; 2] {
        let way = libm::hypot(motion.x_m, motion.y_m);
        let turn = normalize_angle(motion.yaw_rad).abs();
        let has_moved = way > MOVED_M || turn > MOVED_RAD;
        let hidden_s = if has_moved { (seconds - BLIND_S).clamp(0.0, LONGEST_S) } else { 0.0 };
        let (way, turn) = (way.max(HIDDEN_M_S * hidden_s), turn.max(HIDDEN_RAD_S * hidden_s));
        [SHIFT_M, TURN_RAD].map(|[least, per_metre, per_radian]| {
            let sigma = least + per_metre * way + per_radian * turn;
            sigma * sigma
        })
    }

    /// Learns from where a scan was found against where odometry had it.
    pub(crate) fn learn(&mut self, motion: Pose2, found: Pose2, is_doubted: bool) {
        let model = Self::model(motion, 0.0);
        self.step_m = (self.step_m * DECAY_FACTOR).max(libm::hypot(found.x_m, found.y_m));
        let (x, y) = (found.x_m - motion.x_m, found.y_m - motion.y_m);
        let turn = normalize_angle(found.yaw_rad - motion.yaw_rad);
        let toward = |factor: &mut f64, squared: f64| {
            *factor += LEARNING_RATE_FACTOR * (squared.min(4.0 * MAX_SEARCH_FACTOR) - *factor);
            *factor = factor.clamp(MIN_LEARNED_FACTOR, MAX_SEARCH_FACTOR);
        };
        let clipped = |factor: &mut f64, squared: f64| {
            *factor += LEARNING_RATE_FACTOR * (squared.min(MAX_STEP_FACTOR * *factor) - *factor);
            *factor = factor.clamp(MIN_LEARNED_FACTOR, MAX_SEARCH_FACTOR);
        };
        let (place, heading) = (0.5 * (x * x + y * y) / model[0], turn * turn / model[1]);
        toward(&mut self.place, place);
        toward(&mut self.heading, heading);
        if !is_doubted {
            clipped(&mut self.typical_place, place);
            clipped(&mut self.typical_heading, heading);
        }
    }
}

crate::session::packed!(OdometryNoise { place, heading, typical_place, typical_heading, step_m });
