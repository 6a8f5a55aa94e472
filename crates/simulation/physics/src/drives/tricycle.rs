//! `libgazebo_ros_tricycle_drive.so` of ROS 1: one front wheel, steered and driven.

use std::f64::consts::FRAC_PI_2;

use crate::kinematic::Twist;

/// Parameters of the plugin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tricycle {
    /// Diameter of the driven wheel [m].
    pub actuated_wheel_diameter_m: f64,
    /// Diameter of the encoder wheels [m].
    pub encoder_wheel_diameter_m: f64,
    /// Distance between the encoder wheels [m].
    pub encoder_wheel_separation_m: f64,
    /// Acceleration of the driven wheel [rad/s²]; 0 is unlimited.
    pub wheel_acceleration_rad_s2: f64,
    /// Deceleration of the driven wheel [rad/s²].
    pub wheel_deceleration_rad_s2: f64,
    /// Speed error below which the target speed is set at once [rad/s].
    pub wheel_speed_tolerance_rad_s: f64,
    /// Steering speed [rad/s]; 0 is unlimited.
    pub steering_speed_rad_s: f64,
    /// Angle error below which the wheel does not steer [rad].
    pub steering_angle_tolerance_rad: f64,
    /// Maximum torque of both joints [N m].
    pub wheel_torque_n_m: f64,
    /// Update rate [Hz]; 0 is every step.
    pub update_rate_hz: f64,
}

impl Default for Tricycle {
    fn default() -> Self {
        Self {
            actuated_wheel_diameter_m: 0.15,
            encoder_wheel_diameter_m: 0.15,
            encoder_wheel_separation_m: 0.5,
            wheel_acceleration_rad_s2: 0.0,
            wheel_deceleration_rad_s2: 0.0,
            wheel_speed_tolerance_rad_s: 0.01,
            steering_speed_rad_s: 0.0,
            steering_angle_tolerance_rad: 0.01,
            wheel_torque_n_m: 5.0,
            update_rate_hz: 100.0,
        }
    }
}

/// Command of the steering joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steering {
    /// Position [rad].
    At(f64),
    /// Velocity [rad/s].
    Turning(f64),
}

impl Tricycle {
    /// Updates with the command, the current speed [rad/s] and angle [rad] of the front wheel, and
    /// the time since the last update [s]. Returns the wheel's speed [rad/s] and the steering
    /// command.
    ///
    /// The command's `angular.z` is the steering **angle**, up to a quarter turn. The original
    /// compares errors with the target instead of zero, and so accelerates where it should
    /// decelerate; here both converge to the target (gazebo_ros_pkgs,
    /// `gazebo_ros_tricycle_drive.cpp`).
    #[must_use]
    pub fn update(
        &self,
        command: Twist,
        wheel_rad_s: f64,
        steering_rad: f64,
        dt_s: f64,
    ) -> (f64, Steering) {
        let wanted = command.x_m_s / (self.actuated_wheel_diameter_m / 2.0);
        let missing = wanted - wheel_rad_s;
        let slows = wanted * wheel_rad_s >= 0.0 && wanted.abs() < wheel_rad_s.abs();
        let rate =
            if slows { self.wheel_deceleration_rad_s2 } else { self.wheel_acceleration_rad_s2 };
        let at_once = self.wheel_acceleration_rad_s2 <= 0.0
            || missing.abs() < self.wheel_speed_tolerance_rad_s;
        let speed = if at_once {
            wanted
        } else {
            wheel_rad_s + (rate * dt_s).min(missing.abs()).copysign(missing)
        };
        let angle = command.yaw_rad_s.clamp(-FRAC_PI_2, FRAC_PI_2);
        let way = angle - steering_rad;
        let steering = if self.steering_speed_rad_s <= 0.0 {
            Steering::At(angle)
        } else if way.abs() < self.steering_angle_tolerance_rad {
            Steering::Turning(0.0)
        } else {
            Steering::Turning(self.steering_speed_rad_s.copysign(way))
        };
        (speed, steering)
    }

    /// Returns the twist of the midpoint of the rear wheels without slip, for the front wheel this
    /// far ahead of it [m].
    #[must_use]
    pub fn twist(&self, wheel_rad_s: f64, steering_rad: f64, wheel_base_m: f64) -> Twist {
        let speed = wheel_rad_s * self.actuated_wheel_diameter_m / 2.0;
        let (sine, cosine) = libm::sincos(steering_rad);
        Twist { x_m_s: speed * cosine, y_m_s: 0.0, yaw_rad_s: speed * sine / wheel_base_m }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AHEAD: Twist = Twist { x_m_s: 0.3, y_m_s: 0.0, yaw_rad_s: 0.5 };

    #[test]
    fn at_once_where_nothing_is_limited() {
        let (speed, steering) = Tricycle::default().update(AHEAD, 0.0, 0.0, 0.01);
        // 0.3 m/s on 7.5 cm.
        assert!((speed - 4.0).abs() < 1e-12);
        assert_eq!(steering, Steering::At(0.5));
        let (_, sharp) =
            Tricycle::default().update(Twist { yaw_rad_s: 9.0, ..AHEAD }, 0.0, 0.0, 0.01);
        assert_eq!(sharp, Steering::At(FRAC_PI_2));
    }

    #[test]
    fn speeds_up_and_slows_down_at_its_own_rates() {
        let drive = Tricycle {
            wheel_acceleration_rad_s2: 10.0,
            wheel_deceleration_rad_s2: 20.0,
            steering_speed_rad_s: 0.2,
            ..Tricycle::default()
        };
        let speed = |now: f64| drive.update(AHEAD, now, 0.0, 0.01).0;
        assert!((speed(0.0) - 0.1).abs() < 1e-12);
        assert!((speed(6.0) - 5.8).abs() < 1e-12);
        assert_eq!(speed(3.995), 4.0);
        let steer = |now: f64| drive.update(AHEAD, 0.0, now, 0.01).1;
        assert_eq!(steer(0.0), Steering::Turning(0.2));
        assert_eq!(steer(0.7), Steering::Turning(-0.2));
        assert_eq!(steer(0.495), Steering::Turning(0.0));
    }

    #[test]
    fn a_wheel_across_turns_about_the_rear_axle() {
        let twist = Tricycle::default().twist(4.0, FRAC_PI_2, 0.6);
        assert!(twist.x_m_s.abs() < 1e-12 && (twist.yaw_rad_s - 0.5).abs() < 1e-12, "{twist:?}");
    }
}
