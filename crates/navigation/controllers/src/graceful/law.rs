//! Smooth control law.
//!
//! Source: `smooth_control_law.cpp`, `ego_polar_coords.hpp`; J. J. Park, B. Kuipers, "A smooth control law for graceful
//! motion of differential wheeled mobile robots in 2D environment", ICRA 2011.

use periplus_geometry::{Pose2, Twist2, normalize_angle};

use super::GracefulParams;

/// Target seen from the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EgoPolar {
    /// Distance to the target \[m\].
    pub r_m: f64,
    /// Heading of the target, from the line of sight \[rad\].
    pub phi_rad: f64,
    /// Heading of the robot, from the line of sight \[rad\].
    pub delta_rad: f64,
}

impl EgoPolar {
    /// Returns the target as seen from a pose in the same frame; backwards the line of sight is reversed.
    #[must_use]
    pub fn new(target: Pose2, robot: Pose2, is_backward: bool) -> Self {
        let (dx_m, dy_m) = (target.x_m - robot.x_m, target.y_m - robot.y_m);
        let reversal_rad = if is_backward { std::f64::consts::PI } else { 0.0 };
        let sight_rad = libm::atan2(-dy_m, dx_m) + reversal_rad;
        Self {
            r_m: libm::hypot(dx_m, dy_m),
            phi_rad: normalize_angle(target.yaw_rad + sight_rad),
            delta_rad: normalize_angle(robot.yaw_rad + sight_rad),
        }
    }
}

/// Control law with its gains and limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothControlLaw {
    /// Gain of the heading on the path to the target.
    pub k_phi: f64,
    /// Gain of the error of the heading.
    pub k_delta: f64,
    /// Reduction of the speed on curves.
    pub beta: f64,
    /// Exponent of the curvature.
    pub lambda: f64,
    /// Distance to the target below which the speed is reduced \[m\].
    pub slowdown_radius_m: f64,
    /// Deceleration before the target \[m/s²\]; infinite for none.
    pub deceleration_m_s2: f64,
    /// Minimum speed \[m/s\].
    pub min_speed_m_s: f64,
    /// Maximum speed \[m/s\].
    pub max_speed_m_s: f64,
    /// Maximum turn rate \[rad/s\].
    pub max_rate_rad_s: f64,
}

impl SmoothControlLaw {
    /// Creates the law from parameters and limits.
    #[must_use]
    pub fn new(params: &GracefulParams, max_speed_m_s: f64, max_rate_rad_s: f64) -> Self {
        Self {
            k_phi: params.k_phi,
            k_delta: params.k_delta,
            beta: params.beta,
            lambda: params.lambda,
            slowdown_radius_m: params.slowdown_radius_m,
            deceleration_m_s2: params.deceleration_max_m_s2,
            min_speed_m_s: params.v_linear_min_m_s,
            max_speed_m_s,
            max_rate_rad_s,
        }
    }

    /// Returns the curvature of the path to the target \[1/m\]; backwards that of the reversed line of sight.
    #[must_use]
    pub fn curvature_per_m(&self, seen: EgoPolar, is_backward: bool) -> f64 {
        let EgoPolar { r_m, phi_rad, delta_rad } = seen;
        let scaled = self.k_phi * phi_rad;
        let proportional = self.k_delta * (delta_rad - libm::atan(-scaled));
        let feedback = (1.0 + self.k_phi / (1.0 + scaled * scaled)) * libm::sin(delta_rad);
        let curvature_per_m = -(proportional + feedback) / r_m;
        if is_backward { -curvature_per_m } else { curvature_per_m }
    }

    /// Returns the velocity towards a target.
    #[must_use]
    pub fn velocity(&self, target: Pose2, robot: Pose2, is_backward: bool) -> Twist2 {
        let seen = EgoPolar::new(target, robot, is_backward);
        let direction = if is_backward { -1.0 } else { 1.0 };
        let curvature_per_m = self.curvature_per_m(seen, is_backward);
        let slowing = 1.0 + self.beta * libm::pow(curvature_per_m.abs(), self.lambda);
        let speed_m_s = (self.max_speed_m_s / slowing)
            .min(self.max_speed_m_s * seen.r_m / self.slowdown_radius_m)
            .min(libm::sqrt(2.0 * seen.r_m * self.deceleration_m_s2))
            .max(self.min_speed_m_s)
            .min(self.max_speed_m_s);
        let linear_m_s = direction * speed_m_s;
        let limit_rad_s = self.max_rate_rad_s;
        let angular_rad_s = (curvature_per_m * linear_m_s).max(-limit_rad_s).min(limit_rad_s);
        let linear_m_s =
            if curvature_per_m == 0.0 { linear_m_s } else { angular_rad_s / curvature_per_m };
        Twist2::new(linear_m_s, 0.0, angular_rad_s)
    }

    /// Returns the pose after a step \[s\] towards a target.
    #[must_use]
    pub fn next_pose(&self, step_s: f64, target: Pose2, robot: Pose2, is_backward: bool) -> Pose2 {
        let velocity = self.velocity(target, robot, is_backward);
        let (sine, cosine) = libm::sincos(robot.yaw_rad);
        Pose2::new(
            robot.x_m + velocity.vx_m_s * step_s * cosine,
            robot.y_m + velocity.vx_m_s * step_s * sine,
            normalize_angle(robot.yaw_rad + velocity.wz_rad_s * step_s),
        )
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn law() -> SmoothControlLaw {
        SmoothControlLaw::new(&GracefulParams::default(), 0.5, 1.0)
    }

    #[track_caller]
    fn check(target: Pose2, is_backward: bool, expected: (f64, f64)) {
        let found = law().velocity(target, Pose2::IDENTITY, is_backward);
        let off = (found.vx_m_s - expected.0).abs() + (found.wz_rad_s - expected.1).abs();
        assert!(off < 1e-9, "{found:?}");
    }

    #[test]
    fn straight_ahead() {
        check(Pose2::new(3.0, 0.0, 0.0), false, (0.5, 0.0));
        check(Pose2::new(0.75, 0.0, 0.0), false, (0.25, 0.0));
        check(Pose2::new(0.01, 0.0, 0.0), false, (0.1, 0.0));
        check(Pose2::new(-3.0, 0.0, 0.0), true, (-0.5, 0.0));
    }

    #[test]
    fn a_target_to_the_left() {
        // r 1, phi and delta -pi/2: kappa = pi/2 + atan(pi) + (1 + 2 / (1 + pi^2)).
        let target = Pose2::new(0.0, 1.0, 0.0);
        let seen = EgoPolar::new(target, Pose2::IDENTITY, false);
        assert_eq!((seen.r_m, seen.phi_rad), (1.0, -std::f64::consts::FRAC_PI_2));
        let pi = std::f64::consts::PI;
        let expected = pi / 2.0 + libm::atan(pi) + 1.0 + 2.0 / (1.0 + pi * pi);
        assert!((law().curvature_per_m(seen, false) - expected).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn velocities_stay_within_the_limits(
            x_m in -3.0..3.0, y_m in -3.0..3.0, yaw_rad in -3.0..3.0_f64,
        ) {
            let found = law().velocity(Pose2::new(x_m, y_m, yaw_rad), Pose2::IDENTITY, false);
            prop_assert!(found.vx_m_s <= 0.5 + 1e-12 && found.wz_rad_s.abs() <= 1.0 + 1e-12);
        }
    }
}
