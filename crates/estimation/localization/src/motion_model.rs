//! Odometry motion models: sampling of particle motions.
//!
//! Source of the formulas: Thrun, Burgard, Fox, *Probabilistic Robotics*, section 5.4. Details
//! (noise of turns near 180 degrees, no heading of short translations) as in Nav2.

use std::f64::consts::PI;

use periplus_geometry::{Pose2, Stream, normalize_angle};

use crate::particles::Particles;

/// Motion model: `robot_model_type`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MotionModel {
    /// Differential motion_model: rotation, translation, rotation.
    #[default]
    Differential,
    /// Omnidirectional motion_model.
    Omnidirectional,
}

/// Noise parameters of the motion models: `alpha1` to `alpha5`.
pub type MotionNoise = [f64; 5];

/// Minimum translation with a heading \[m\], as in Nav2.
const MIN_TRANSLATION_M: f64 = 0.01;

/// Odometry motion as rotation, translation, rotation (*Probabilistic Robotics*, table 5.6, lines 2
/// to 4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotTransRot {
    /// First rotation \[rad\].
    pub rot1_rad: f64,
    /// Translation \[m\].
    pub trans_m: f64,
    /// Second rotation \[rad\].
    pub rot2_rad: f64,
}

/// Standard deviations of a [`RotTransRot`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotTransRotNoise {
    /// First rotation \[rad\].
    pub rot1_rad: f64,
    /// Translation \[m\].
    pub trans_m: f64,
    /// Second rotation \[rad\].
    pub rot2_rad: f64,
}

impl RotTransRot {
    /// Decomposes the motion between two poses of odometry.
    #[must_use]
    pub fn between(odom_from_old: Pose2, odom_from_new: Pose2) -> Self {
        let (x_m, y_m) =
            (odom_from_new.x_m - odom_from_old.x_m, odom_from_new.y_m - odom_from_old.y_m);
        let trans_m = libm::hypot(x_m, y_m);
        let rot1_rad = if trans_m < MIN_TRANSLATION_M {
            0.0
        } else {
            wrap_angle(libm::atan2(y_m, x_m) - odom_from_old.yaw_rad)
        };
        let turn_rad = wrap_angle(odom_from_new.yaw_rad - odom_from_old.yaw_rad);
        Self { rot1_rad, trans_m, rot2_rad: wrap_angle(turn_rad - rot1_rad) }
    }

    /// Standard deviations of the motion (*Probabilistic Robotics*, table 5.6, lines 5 to 7).
    /// Rotations near 180 degrees count as small: the robot drove backwards.
    #[must_use]
    pub fn noise(&self, alphas: &MotionNoise) -> RotTransRotNoise {
        let [a1, a2, a3, a4, _] = *alphas;
        let (n1, n2) =
            (distance_to_straight_rad(self.rot1_rad), distance_to_straight_rad(self.rot2_rad));
        let trans = self.trans_m * self.trans_m;
        let (n1, n2) = (n1 * n1, n2 * n2);
        RotTransRotNoise {
            rot1_rad: libm::sqrt(a1 * n1 + a2 * trans),
            trans_m: libm::sqrt(a3 * trans + a4 * (n1 + n2)),
            rot2_rad: libm::sqrt(a1 * n2 + a2 * trans),
        }
    }
}

/// Odometry motion of an omnidirectional robot: a translation in some direction and a rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OmniMotion {
    /// Direction of the translation in the old base frame \[rad\].
    pub bearing_rad: f64,
    /// Translation \[m\].
    pub trans_m: f64,
    /// Rotation \[rad\].
    pub turn_rad: f64,
}

/// Standard deviations of an [`OmniMotion`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OmniMotionNoise {
    /// Along the translation \[m\].
    pub trans_m: f64,
    /// Across the translation \[m\].
    pub strafe_m: f64,
    /// Rotation \[rad\].
    pub turn_rad: f64,
}

impl OmniMotion {
    /// Decomposes the motion between two poses of odometry.
    #[must_use]
    pub fn between(odom_from_old: Pose2, odom_from_new: Pose2) -> Self {
        let (x_m, y_m) =
            (odom_from_new.x_m - odom_from_old.x_m, odom_from_new.y_m - odom_from_old.y_m);
        Self {
            bearing_rad: wrap_angle(libm::atan2(y_m, x_m) - odom_from_old.yaw_rad),
            trans_m: libm::hypot(x_m, y_m),
            turn_rad: wrap_angle(odom_from_new.yaw_rad - odom_from_old.yaw_rad),
        }
    }

    /// Standard deviations of the motion, as in Nav2's `OmniMotionModel`.
    #[must_use]
    pub fn noise(&self, alphas: &MotionNoise) -> OmniMotionNoise {
        let [a1, a2, a3, a4, a5] = *alphas;
        let (trans, turn) = (self.trans_m * self.trans_m, self.turn_rad * self.turn_rad);
        OmniMotionNoise {
            trans_m: libm::sqrt(a3 * trans + a4 * turn),
            strafe_m: libm::sqrt(a4 * turn + a5 * trans),
            turn_rad: libm::sqrt(a1 * turn + a2 * trans),
        }
    }
}

/// Moves every particle by a sample of the motion model (*Probabilistic Robotics*, table 5.6).
pub(crate) fn sample_motion(
    particles: &mut Particles,
    motion_model: MotionModel,
    alphas: &MotionNoise,
    odom_from_old: Pose2,
    odom_from_new: Pose2,
    stream: &mut Stream,
) {
    match motion_model {
        MotionModel::Differential => {
            let motion = RotTransRot::between(odom_from_old, odom_from_new);
            let noise = motion.noise(alphas);
            for index in 0..particles.len() {
                let first = motion.rot1_rad - noise.rot1_rad * stream.normal();
                let trans = motion.trans_m - noise.trans_m * stream.normal();
                let second = motion.rot2_rad - noise.rot2_rad * stream.normal();
                let (sine, cosine) = libm::sincos(particles.yaw_rad[index] + first);
                particles.x_m[index] += trans * cosine;
                particles.y_m[index] += trans * sine;
                particles.yaw_rad[index] =
                    normalize_angle(particles.yaw_rad[index] + first + second);
            }
        }
        MotionModel::Omnidirectional => {
            let motion = OmniMotion::between(odom_from_old, odom_from_new);
            let noise = motion.noise(alphas);
            for index in 0..particles.len() {
                let trans = motion.trans_m + noise.trans_m * stream.normal();
                let turn = motion.turn_rad + noise.turn_rad * stream.normal();
                let strafe = noise.strafe_m * stream.normal();
                let yaw_rad = particles.yaw_rad[index];
                let (sine, cosine) = libm::sincos(yaw_rad + motion.bearing_rad);
                particles.x_m[index] += trans * cosine + strafe * sine;
                particles.y_m[index] += trans * sine - strafe * cosine;
                particles.yaw_rad[index] = normalize_angle(yaw_rad + turn);
            }
        }
    }
}

/// Wraps an angle to ±π, both ends included: a robot that backs up turns by +π and -π.
fn wrap_angle(angle_rad: f64) -> f64 {
    if (-PI..=PI).contains(&angle_rad) { angle_rad } else { normalize_angle(angle_rad) }
}

/// Distance of an angle from 0 or ±π, whichever is closer \[rad\].
fn distance_to_straight_rad(angle_rad: f64) -> f64 {
    let size = wrap_angle(angle_rad).abs();
    size.min(PI - size)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread_of(delta: Pose2, motion_model: MotionModel, alphas: MotionNoise) -> (Pose2, Pose2) {
        let mut particles = Particles::default();
        for _ in 0..20_000 {
            particles.push(Pose2::new(1.0, 2.0, 0.0));
        }
        let mut stream = Stream::keyed(3, "motion", 0);
        sample_motion(&mut particles, motion_model, &alphas, Pose2::IDENTITY, delta, &mut stream);
        let count = particles.len() as f64;
        let moments = |values: &[f64]| {
            let mean = values.iter().sum::<f64>() / count;
            let variance = values.iter().map(|v| libm::pow(v - mean, 2.0)).sum::<f64>() / count;
            (mean, variance.sqrt())
        };
        let (x, y, yaw) =
            (moments(&particles.x_m), moments(&particles.y_m), moments(&particles.yaw_rad));
        (Pose2::new(x.0, y.0, yaw.0), Pose2::new(x.1, y.1, yaw.1))
    }

    #[test]
    fn without_noise_particles_follow_odometry() {
        for motion_model in [MotionModel::Differential, MotionModel::Omnidirectional] {
            let (mean, sd) = spread_of(Pose2::new(1.0, 1.0, 0.5), motion_model, [0.0; 5]);
            assert!((mean.x_m - 2.0).abs() < 1e-9 && (mean.y_m - 3.0).abs() < 1e-9, "{mean:?}");
            assert!((mean.yaw_rad - 0.5).abs() < 1e-9 && sd.x_m < 1e-9, "{mean:?} {sd:?}");
        }
    }

    #[test]
    fn each_alpha_adds_its_noise() {
        let ahead = Pose2::new(2.0, 0.0, 0.0);
        let near = |got: f64, expected: f64| (got - expected).abs() < 0.02 * expected.max(0.05);
        let (_, sd) = spread_of(ahead, MotionModel::Differential, [0.0, 0.0, 0.04, 0.0, 0.0]);
        assert!(near(sd.x_m, 0.4) && sd.y_m < 1e-9, "{sd:?}");
        let (_, sd) = spread_of(ahead, MotionModel::Omnidirectional, [0.0, 0.0, 0.0, 0.0, 0.04]);
        assert!(near(sd.y_m, 0.4) && sd.x_m < 1e-9, "{sd:?}");
        let (_, sd) = spread_of(ahead, MotionModel::Omnidirectional, [0.0, 0.01, 0.0, 0.0, 0.0]);
        assert!(near(sd.yaw_rad, 0.2) && sd.x_m < 1e-9, "{sd:?}");
        let turn = Pose2::new(0.0, 0.0, 1.0);
        let (_, sd) = spread_of(turn, MotionModel::Differential, [0.04, 0.0, 0.0, 0.0, 0.0]);
        assert!(near(sd.yaw_rad, 0.2), "{sd:?}");
    }

    #[test]
    fn backing_up_is_no_rotation() {
        let motion = RotTransRot::between(Pose2::IDENTITY, Pose2::new(-0.5, 0.0, 0.0));
        assert_eq!((motion.rot1_rad, motion.rot2_rad), (PI, -PI));
        assert_eq!(motion.noise(&[0.2, 0.0, 0.0, 0.0, 0.0]).rot1_rad, 0.0);
    }
}
