//! `libgazebo_ros_ackermann_drive.so`: front wheels steered by force, rear wheels driven by force.

use crate::kinematic::Twist;

/// Parameters of the plugin and dimensions of the model. Its controllers convert errors to efforts;
/// their default gains are zero, and such a robot does not move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClassicAckermann {
    /// Maximum speed [m/s].
    pub max_speed_m_s: f64,
    /// Maximum steering angle of a wheel [rad].
    pub max_steer_rad: f64,
    /// Maximum angle of the steering wheel, if any [rad].
    pub max_steering_angle_rad: f64,
    /// Distance between the centres of the front wheels, from the model [m].
    pub wheel_separation_m: f64,
    /// Distance between the axles, from the model [m].
    pub wheel_base_m: f64,
    /// Radius of the right rear wheel, from the model [m].
    pub wheel_radius_m: f64,
}

impl Default for ClassicAckermann {
    fn default() -> Self {
        Self {
            max_speed_m_s: 20.0,
            max_steer_rad: 0.6,
            max_steering_angle_rad: 7.85,
            wheel_separation_m: 1.0,
            wheel_base_m: 1.0,
            wheel_radius_m: 0.2,
        }
    }
}

/// Joint targets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClassicAckermannTarget {
    /// Angles of the left and right steering joints [rad].
    pub steering_rad: [f64; 2],
    /// Speed of both rear wheels [rad/s].
    pub wheels_rad_s: f64,
}

impl ClassicAckermann {
    /// Returns the targets of a command. Its `angular.z` is not a yaw rate but the steering
    /// **angle**; driving backwards reverses it.
    ///
    /// Each wheel is perpendicular to the line to the centre of the turn, `tan / (1 ∓ s tan / 2 b)`
    /// with the tangent of the angle, the separation and the base (gazebo_ros_pkgs,
    /// `gazebo_ros_ackermann_drive.cpp`).
    #[must_use]
    pub fn target(&self, command: Twist) -> ClassicAckermannTarget {
        let clamp = |value: f64, most: f64| value.max(-most.abs()).min(most.abs());
        let speed = clamp(command.x_m_s, self.max_speed_m_s);
        let angle = command.yaw_rad_s * f64::copysign(1.0, command.x_m_s);
        let tangent = libm::tan(clamp(angle, self.max_steer_rad));
        let aside = self.wheel_separation_m / 2.0 / self.wheel_base_m * tangent;
        ClassicAckermannTarget {
            steering_rad: [libm::atan2(tangent, 1.0 - aside), libm::atan2(tangent, 1.0 + aside)],
            wheels_rad_s: speed / self.wheel_radius_m,
        }
    }

    /// Returns the angle of the steering wheel at these angles of the front wheels [rad].
    #[must_use]
    pub fn steering_wheel_rad(&self, steering_rad: [f64; 2]) -> f64 {
        let ratio = self.max_steer_rad / self.max_steering_angle_rad;
        (steering_rad[0] + steering_rad[1]) / 2.0 / ratio
    }

    /// Returns the twist of the middle of the rear axle without slip.
    #[must_use]
    pub fn twist(&self, steering_rad: [f64; 2], wheels_rad_s: f64) -> Twist {
        let x_m_s = wheels_rad_s * self.wheel_radius_m;
        // The cotangent of the middle is the mean of the two.
        let [left, right] = steering_rad.map(libm::tan);
        let sum = left + right;
        let tangent = if sum == 0.0 { 0.0 } else { 2.0 * left * right / sum };
        Twist { x_m_s, y_m_s: 0.0, yaw_rad_s: x_m_s * tangent / self.wheel_base_m }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found} instead of {expected}");
    }

    #[test]
    fn both_front_wheels_point_at_one_centre() {
        let drive = ClassicAckermann { max_steer_rad: 1.0, ..ClassicAckermann::default() };
        let angle = libm::atan(0.25);
        let target = drive.target(Twist { x_m_s: 2.0, y_m_s: 0.0, yaw_rad_s: angle });
        // The centre is 4 m to the left: 3.5 m and 4.5 m from the wheels, the axles 1 m apart.
        near(target.steering_rad[0], libm::atan(1.0 / 3.5));
        near(target.steering_rad[1], libm::atan(1.0 / 4.5));
        near(target.wheels_rad_s, 10.0);
        // 2 m/s on 4 m.
        near(drive.twist(target.steering_rad, target.wheels_rad_s).yaw_rad_s, 0.5);
        // Backwards the same turning speed steers the other way.
        let back = drive.target(Twist { x_m_s: -2.0, y_m_s: 0.0, yaw_rad_s: angle });
        near(back.steering_rad[0], -libm::atan(1.0 / 4.5));
    }

    #[test]
    fn beyond_its_limits_it_does_not_go() {
        let drive = ClassicAckermann::default();
        let target = drive.target(Twist { x_m_s: 99.0, y_m_s: 0.0, yaw_rad_s: 3.0 });
        near(target.wheels_rad_s, 100.0);
        let most = drive.target(Twist { x_m_s: 1.0, y_m_s: 0.0, yaw_rad_s: 0.6 });
        assert_eq!(target.steering_rad, most.steering_rad);
        near(drive.steering_wheel_rad([0.6, 0.6]), 7.85);
        near(drive.twist([0.0, 0.0], 5.0).yaw_rad_s, 0.0);
    }
}
