//! How particles move when odometry says that the robot moved.
//!
//! Source of the formulas: Thrun, Burgard, Fox, "Probabilistic Robotics", section 5.4; what is special
//! about them here (how much a turn counts, how short is no way) is as Nav2 has it.

use std::f64::consts::PI;

use periplus_geometry::{Pose2, Stream, normalize_angle};

use crate::particles::Particles;

/// How a robot can move.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Drive {
    /// It turns and goes ahead.
    #[default]
    Differential,
    /// It goes in any direction.
    Omnidirectional,
}

/// What odometry is expected to be wrong by: `alpha1` to `alpha5`.
pub type Alphas = [f64; 5];

/// Shorter ways have no direction of their own \[m\].
const NO_WAY_M: f64 = 0.01;

/// A motion as a turn, a way and another turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnWayTurn {
    /// First turn \[rad\].
    pub first_rad: f64,
    /// Way \[m\].
    pub way_m: f64,
    /// Second turn \[rad\].
    pub second_rad: f64,
}

/// Standard deviations of a [`TurnWayTurn`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnWayTurnSpread {
    /// Of the first turn \[rad\].
    pub first_rad: f64,
    /// Of the way \[m\].
    pub way_m: f64,
    /// Of the second turn \[rad\].
    pub second_rad: f64,
}

impl TurnWayTurn {
    /// The motion from one pose of odometry to another.
    #[must_use]
    pub fn between(odom_from_old: Pose2, odom_from_new: Pose2) -> Self {
        let (x_m, y_m) =
            (odom_from_new.x_m - odom_from_old.x_m, odom_from_new.y_m - odom_from_old.y_m);
        let way_m = libm::hypot(x_m, y_m);
        let first_rad = if way_m < NO_WAY_M {
            0.0
        } else {
            shortest(libm::atan2(y_m, x_m) - odom_from_old.yaw_rad)
        };
        let turn_rad = shortest(odom_from_new.yaw_rad - odom_from_old.yaw_rad);
        Self { first_rad, way_m, second_rad: shortest(turn_rad - first_rad) }
    }

    /// How far it may be off. Turns near half a turn count as small ones: the robot drove backwards.
    #[must_use]
    pub fn spread(&self, alphas: &Alphas) -> TurnWayTurnSpread {
        let [a1, a2, a3, a4, _] = *alphas;
        let (n1, n2) = (least_turn(self.first_rad), least_turn(self.second_rad));
        let way = self.way_m * self.way_m;
        let (n1, n2) = (n1 * n1, n2 * n2);
        TurnWayTurnSpread {
            first_rad: libm::sqrt(a1 * n1 + a2 * way),
            way_m: libm::sqrt(a3 * way + a4 * (n1 + n2)),
            second_rad: libm::sqrt(a1 * n2 + a2 * way),
        }
    }
}

/// A motion as a way in a direction and a turn on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glide {
    /// Direction of the way as seen from the robot \[rad\].
    pub bearing_rad: f64,
    /// Way \[m\].
    pub way_m: f64,
    /// Turn \[rad\].
    pub turn_rad: f64,
}

/// Standard deviations of a [`Glide`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlideSpread {
    /// Along the way \[m\].
    pub way_m: f64,
    /// Across the way \[m\].
    pub strafe_m: f64,
    /// Of the turn \[rad\].
    pub turn_rad: f64,
}

impl Glide {
    /// The motion from one pose of odometry to another.
    #[must_use]
    pub fn between(odom_from_old: Pose2, odom_from_new: Pose2) -> Self {
        let (x_m, y_m) =
            (odom_from_new.x_m - odom_from_old.x_m, odom_from_new.y_m - odom_from_old.y_m);
        Self {
            bearing_rad: shortest(libm::atan2(y_m, x_m) - odom_from_old.yaw_rad),
            way_m: libm::hypot(x_m, y_m),
            turn_rad: shortest(odom_from_new.yaw_rad - odom_from_old.yaw_rad),
        }
    }

    /// How far it may be off.
    #[must_use]
    pub fn spread(&self, alphas: &Alphas) -> GlideSpread {
        let [a1, a2, a3, a4, a5] = *alphas;
        let (way, turn) = (self.way_m * self.way_m, self.turn_rad * self.turn_rad);
        GlideSpread {
            way_m: libm::sqrt(a3 * way + a4 * turn),
            strafe_m: libm::sqrt(a4 * turn + a5 * way),
            turn_rad: libm::sqrt(a1 * turn + a2 * way),
        }
    }
}

/// Moves every particle as odometry says, each with an error of its own.
pub(crate) fn move_all(
    particles: &mut Particles,
    drive: Drive,
    alphas: &Alphas,
    odom_from_old: Pose2,
    odom_from_new: Pose2,
    stream: &mut Stream,
) {
    match drive {
        Drive::Differential => {
            let motion = TurnWayTurn::between(odom_from_old, odom_from_new);
            let spread = motion.spread(alphas);
            for index in 0..particles.len() {
                let first = motion.first_rad - spread.first_rad * stream.normal();
                let way = motion.way_m - spread.way_m * stream.normal();
                let second = motion.second_rad - spread.second_rad * stream.normal();
                let (sine, cosine) = libm::sincos(particles.yaw_rad[index] + first);
                particles.x_m[index] += way * cosine;
                particles.y_m[index] += way * sine;
                particles.yaw_rad[index] =
                    normalize_angle(particles.yaw_rad[index] + first + second);
            }
        }
        Drive::Omnidirectional => {
            let motion = Glide::between(odom_from_old, odom_from_new);
            let spread = motion.spread(alphas);
            for index in 0..particles.len() {
                let way = motion.way_m + spread.way_m * stream.normal();
                let turn = motion.turn_rad + spread.turn_rad * stream.normal();
                let strafe = spread.strafe_m * stream.normal();
                let yaw_rad = particles.yaw_rad[index];
                let (sine, cosine) = libm::sincos(yaw_rad + motion.bearing_rad);
                particles.x_m[index] += way * cosine + strafe * sine;
                particles.y_m[index] += way * sine - strafe * cosine;
                particles.yaw_rad[index] = normalize_angle(yaw_rad + turn);
            }
        }
    }
}

/// The same turn within half a turn to either side; both ends stay as they are, so that a robot that
/// backs up turns there and back by the same angle.
fn shortest(angle_rad: f64) -> f64 {
    if (-PI..=PI).contains(&angle_rad) { angle_rad } else { normalize_angle(angle_rad) }
}

/// How far a turn is from none or from half a turn \[rad\].
fn least_turn(angle_rad: f64) -> f64 {
    let size = shortest(angle_rad).abs();
    size.min(PI - size)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread_of(delta: Pose2, drive: Drive, alphas: Alphas) -> (Pose2, Pose2) {
        let mut particles = Particles::default();
        for _ in 0..20_000 {
            particles.push(Pose2::new(1.0, 2.0, 0.0));
        }
        let mut stream = Stream::keyed(3, "motion", 0);
        move_all(&mut particles, drive, &alphas, Pose2::IDENTITY, delta, &mut stream);
        let count = particles.len() as f64;
        let moments = |values: &[f64]| {
            let mean = values.iter().sum::<f64>() / count;
            let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count;
            (mean, variance.sqrt())
        };
        let (x, y, yaw) =
            (moments(&particles.x_m), moments(&particles.y_m), moments(&particles.yaw_rad));
        (Pose2::new(x.0, y.0, yaw.0), Pose2::new(x.1, y.1, yaw.1))
    }

    #[test]
    fn without_errors_particles_go_where_odometry_went() {
        for drive in [Drive::Differential, Drive::Omnidirectional] {
            let (mean, sd) = spread_of(Pose2::new(1.0, 1.0, 0.5), drive, [0.0; 5]);
            assert!((mean.x_m - 2.0).abs() < 1e-9 && (mean.y_m - 3.0).abs() < 1e-9, "{mean:?}");
            assert!((mean.yaw_rad - 0.5).abs() < 1e-9 && sd.x_m < 1e-9, "{mean:?} {sd:?}");
        }
    }

    #[test]
    fn each_alpha_spreads_what_it_says() {
        let ahead = Pose2::new(2.0, 0.0, 0.0);
        let near = |got: f64, expected: f64| (got - expected).abs() < 0.02 * expected.max(0.05);
        let (_, sd) = spread_of(ahead, Drive::Differential, [0.0, 0.0, 0.04, 0.0, 0.0]);
        assert!(near(sd.x_m, 0.4) && sd.y_m < 1e-9, "{sd:?}");
        let (_, sd) = spread_of(ahead, Drive::Omnidirectional, [0.0, 0.0, 0.0, 0.0, 0.04]);
        assert!(near(sd.y_m, 0.4) && sd.x_m < 1e-9, "{sd:?}");
        let (_, sd) = spread_of(ahead, Drive::Omnidirectional, [0.0, 0.01, 0.0, 0.0, 0.0]);
        assert!(near(sd.yaw_rad, 0.2) && sd.x_m < 1e-9, "{sd:?}");
        let turn = Pose2::new(0.0, 0.0, 1.0);
        let (_, sd) = spread_of(turn, Drive::Differential, [0.04, 0.0, 0.0, 0.0, 0.0]);
        assert!(near(sd.yaw_rad, 0.2), "{sd:?}");
    }

    #[test]
    fn backing_up_is_no_turn() {
        let motion = TurnWayTurn::between(Pose2::IDENTITY, Pose2::new(-0.5, 0.0, 0.0));
        assert_eq!((motion.first_rad, motion.second_rad), (PI, -PI));
        assert_eq!(motion.spread(&[0.2, 0.0, 0.0, 0.0, 0.0]).first_rad, 0.0);
    }
}
