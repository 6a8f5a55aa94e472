//! Velocities that a robot can reach, as samples.
//!
//! Source: `one_d_velocity_iterator.hpp`, `xy_theta_iterator.cpp`, `kinematic_parameters.cpp`; D. Fox, W. Burgard,
//! S. Thrun, "The Dynamic Window Approach to Collision Avoidance", 1997.

use periplus_geometry::Twist2;

use super::KinematicParams;

/// Difference of velocities that counts as none \[m/s or rad/s\]; the value of Nav2.
const EQUAL_M_S: f64 = 1e-5;

/// Difference of squared speeds that counts as none; the rounding error of single precision, as in Nav2.
const EQUAL_SPEED_RATIO: f64 = f32::EPSILON as f64;

/// Limits of one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisLimits {
    /// Minimum velocity.
    pub min: f64,
    /// Maximum velocity.
    pub max: f64,
    /// Acceleration.
    pub acceleration: f64,
    /// Deceleration; negative.
    pub deceleration: f64,
}

impl AxisLimits {
    /// Returns the velocity after a time \[s\] towards a target.
    #[must_use]
    pub fn approach(&self, present: f64, time_s: f64, target: f64) -> f64 {
        if present < target {
            target.min(present + self.acceleration * time_s)
        } else {
            target.max(present + self.deceleration * time_s)
        }
    }

    /// Returns evenly spaced velocities that are reachable within a time \[s\], at least two if there is a range. Zero
    /// is inserted between a negative and a positive one.
    #[must_use]
    pub fn samples(&self, present: f64, time_s: f64, count: usize) -> Vec<f64> {
        let present = if present < self.min { self.min } else { present.min(self.max) };
        let max = self.approach(present, time_s, self.max);
        let min = self.approach(present, time_s, self.min);
        if (min - max).abs() < EQUAL_M_S {
            return vec![min];
        }
        let step = (max - min) / (count.max(2) - 1) as f64;
        let mut samples = Vec::with_capacity(count + 2);
        let mut next = min;
        while next <= max + EQUAL_M_S {
            samples.push(next);
            let after = next + step;
            if next < 0.0 && after > 0.0 && after <= max + EQUAL_M_S {
                samples.push(0.0);
            }
            next = after;
        }
        samples
    }
}

/// Limits of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KinematicLimits {
    /// Along x.
    pub x: AxisLimits,
    /// Along y.
    pub y: AxisLimits,
    /// Around z.
    pub theta: AxisLimits,
    /// Minimum speed of translation \[m/s\]; negative for none.
    pub min_speed_m_s: f64,
    /// Maximum speed of translation \[m/s\]; negative for none.
    pub max_speed_m_s: f64,
    /// Minimum turn rate \[rad/s\]; negative for none.
    pub min_turn_rate_rad_s: f64,
}

impl KinematicLimits {
    /// Returns the limits of parameters.
    #[must_use]
    pub fn new(params: &KinematicParams) -> Self {
        Self {
            x: AxisLimits {
                min: params.min_vel_x_m_s,
                max: params.max_vel_x_m_s,
                acceleration: params.acc_lim_x_m_s2,
                deceleration: params.decel_lim_x_m_s2,
            },
            y: AxisLimits {
                min: params.min_vel_y_m_s,
                max: params.max_vel_y_m_s,
                acceleration: params.acc_lim_y_m_s2,
                deceleration: params.decel_lim_y_m_s2,
            },
            theta: AxisLimits {
                min: -params.max_vel_theta_rad_s,
                max: params.max_vel_theta_rad_s,
                acceleration: params.acc_lim_theta_rad_s2,
                deceleration: params.decel_lim_theta_rad_s2,
            },
            min_speed_m_s: params.min_speed_xy_m_s,
            max_speed_m_s: params.max_speed_xy_m_s,
            min_turn_rate_rad_s: params.min_speed_theta_rad_s,
        }
    }

    /// Returns the limits under a speed limit: 0 for none, a percentage, or metres a second. All maxima shrink in the
    /// same ratio; minima stay. A limit above the maximum speed has no effect.
    #[must_use]
    pub fn limited(&self, limit: f64, is_percentage: bool) -> Self {
        let ratio = if limit == 0.0 {
            1.0
        } else if is_percentage {
            limit / 100.0
        } else if limit < self.max_speed_m_s {
            limit / self.max_speed_m_s
        } else {
            1.0
        };
        let shrunk = |axis: AxisLimits| AxisLimits { max: axis.max * ratio, ..axis };
        let max_rad_s = self.theta.max * ratio;
        Self {
            x: shrunk(self.x),
            y: shrunk(self.y),
            theta: AxisLimits { min: -max_rad_s, max: max_rad_s, ..self.theta },
            max_speed_m_s: self.max_speed_m_s * ratio,
            ..*self
        }
    }

    /// Returns true if a velocity is within the limits of speed, and not zero.
    #[must_use]
    pub fn is_valid(&self, velocity: Twist2) -> bool {
        let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = velocity;
        let squared = vx_m_s * vx_m_s + vy_m_s * vy_m_s;
        let is_too_fast = self.max_speed_m_s >= 0.0
            && squared > self.max_speed_m_s * self.max_speed_m_s + EQUAL_SPEED_RATIO;
        let is_too_slow = self.min_speed_m_s >= 0.0
            && squared + EQUAL_SPEED_RATIO < self.min_speed_m_s * self.min_speed_m_s
            && self.min_turn_rate_rad_s >= 0.0
            && wz_rad_s.abs() + EQUAL_SPEED_RATIO < self.min_turn_rate_rad_s;
        !is_too_fast && !is_too_slow && (squared != 0.0 || wz_rad_s != 0.0)
    }

    /// Returns valid velocities that are reachable within a time \[s\]; the turn rate varies fastest.
    #[must_use]
    pub fn samples(&self, present: Twist2, time_s: f64, counts: [usize; 3]) -> Vec<Twist2> {
        let [x_count, y_count, theta_count] = counts;
        let ys = self.y.samples(present.vy_m_s, time_s, y_count);
        let rates = self.theta.samples(present.wz_rad_s, time_s, theta_count);
        let mut samples = Vec::new();
        for x in self.x.samples(present.vx_m_s, time_s, x_count) {
            for y in &ys {
                let velocities = rates.iter().map(|rate| Twist2::new(x, *y, *rate));
                samples.extend(velocities.filter(|velocity| self.is_valid(*velocity)));
            }
        }
        samples
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn axis(min: f64, max: f64, acceleration: f64) -> AxisLimits {
        AxisLimits { min, max, acceleration, deceleration: -acceleration }
    }

    #[track_caller]
    fn check(limits: AxisLimits, present: f64, time_s: f64, count: usize, expected: &[f64]) {
        let found = limits.samples(present, time_s, count);
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} is not {expected}");
        }
    }

    #[test]
    fn samples_are_evenly_spaced_with_zero() {
        check(axis(-5.0, 5.0, 1.0), 0.0, 1.0, 3, &[-1.0, 0.0, 1.0]);
        check(axis(-5.0, 5.0, 1.0), 0.0, 1.0, 4, &[-1.0, -1.0 / 3.0, 0.0, 1.0 / 3.0, 1.0]);
        check(axis(-0.1, 0.5, 2.5), 0.9, 0.05, 3, &[0.375, 0.4375, 0.5]);
        check(axis(0.0, 0.0, 2.5), 0.0, 1.7, 5, &[0.0]);
        check(axis(0.0, 1.0, 1.0), 0.5, 0.1, 0, &[0.4, 0.6]);
    }

    #[test]
    fn speeds_have_limits() {
        let params = KinematicParams {
            max_vel_x_m_s: 0.5,
            max_vel_y_m_s: 0.5,
            max_vel_theta_rad_s: 2.0,
            max_speed_xy_m_s: 0.5,
            min_speed_xy_m_s: 0.1,
            min_speed_theta_rad_s: 0.5,
            ..default_kinematics()
        };
        let limits = KinematicLimits::new(&params);
        let is_valid = |x, y, theta| limits.is_valid(Twist2::new(x, y, theta));
        assert!(is_valid(0.3, 0.4, 0.0));
        assert!(!is_valid(0.4, 0.4, 0.0), "faster than 0.5 m/s");
        assert!(!is_valid(0.05, 0.0, 0.4), "too slow in both");
        assert!(is_valid(0.05, 0.0, 0.5) && is_valid(0.1, 0.0, 0.0));
        assert!(!KinematicLimits::new(&default_kinematics()).is_valid(Twist2::ZERO));
        let limited = limits.limited(0.2, false);
        assert_eq!((limited.x.max, limited.theta.max, limited.theta.min), (0.2, 0.8, -0.8));
        assert_eq!(limits.limited(0.9, false), limits);
        assert_eq!(limits.limited(50.0, true).x.max, 0.25);
    }

    fn default_kinematics() -> KinematicParams {
        super::super::DwbParams::default().kinematics
    }

    proptest! {
        #[test]
        fn samples_are_reachable(present in -1.0..1.0_f64, time_s in 0.01..2.0, count in 0..30_usize) {
            let limits = axis(-0.5, 0.5, 1.0);
            let start = present.clamp(-0.5, 0.5);
            for sample in limits.samples(present, time_s, count) {
                prop_assert!((sample - start).abs() <= time_s + 1e-4);
                prop_assert!(sample.abs() <= 0.5 + 1e-4);
            }
        }
    }
}
