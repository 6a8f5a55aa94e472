//! `gz-sim-ackermann-steering-system`: two steered wheels in front, two driven ones.

use crate::kinematic::Twist;

/// Speed below which the steering angle is zero [m/s].
const MIN_STEERING_SPEED_M_S: f64 = 1e-3;

/// Parameters of the plugin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ackermann {
    /// Distance between left and right driven wheels [m].
    pub wheel_separation_m: f64,
    /// Distance between the pivots of the steered wheels [m].
    pub kingpin_width_m: f64,
    /// Distance between the axles [m].
    pub wheel_base_m: f64,
    /// Maximum steering angle [rad].
    pub steering_limit_rad: f64,
    /// Radius of a wheel [m].
    pub wheel_radius_m: f64,
}

impl Default for Ackermann {
    fn default() -> Self {
        Self {
            wheel_separation_m: 1.0,
            kingpin_width_m: 0.8,
            wheel_base_m: 1.0,
            steering_limit_rad: 0.5,
            wheel_radius_m: 0.2,
        }
    }
}

/// Joint commands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AckermannCommand {
    /// Angles of the left and right steered wheels [rad].
    pub steering_rad: [f64; 2],
    /// Speeds of the left and right driven wheels [rad/s].
    pub wheels_rad_s: [f64; 2],
}

impl Ackermann {
    /// Returns the joint commands of a twist. The steering angle at the middle of the front axle is
    /// `atan(w base / v)`, clamped to the limit. Each wheel is perpendicular to the line to the
    /// common centre of the turn on the rear axle.
    #[must_use]
    pub fn command(&self, twist: Twist) -> AckermannCommand {
        let speed = twist.x_m_s;
        let yaw_rad_s = if speed.abs() < MIN_STEERING_SPEED_M_S { 0.0 } else { twist.yaw_rad_s };
        let middle_rad = if yaw_rad_s == 0.0 {
            0.0
        } else {
            let limit = self.steering_limit_rad.abs();
            libm::atan(yaw_rad_s * self.wheel_base_m / speed).clamp(-limit, limit)
        };
        let (sine, cosine) = libm::sincos(middle_rad);
        // The centre is `base cos / sin` to the left; all terms are multiplied by the sine, so that
        // driving straight needs no special case.
        let wheel_rad = |aside_m: f64| {
            libm::atan2(self.wheel_base_m * sine, self.wheel_base_m * cosine - aside_m * sine)
        };
        let held_rad_s = speed * libm::tan(middle_rad) / self.wheel_base_m;
        let wheel_rad_s = |aside_m: f64| (speed - held_rad_s * aside_m) / self.wheel_radius_m;
        let (pin_m, half_m) = (self.kingpin_width_m / 2.0, self.wheel_separation_m / 2.0);
        AckermannCommand {
            steering_rad: [wheel_rad(pin_m), wheel_rad(-pin_m)],
            wheels_rad_s: [wheel_rad_s(half_m), wheel_rad_s(-half_m)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: [f64; 2], expected: [f64; 2]) {
        let error = (found[0] - expected[0]).abs() + (found[1] - expected[1]).abs();
        assert!(error < 1e-9, "{found:?} instead of {expected:?}");
    }

    #[test]
    fn straight_ahead_nothing_steers() {
        let command = Ackermann::default().command(Twist { x_m_s: 1.0, ..Twist::default() });
        near(command.steering_rad, [0.0; 2]);
        near(command.wheels_rad_s, [5.0; 2]);
    }

    #[test]
    fn a_circle_of_four_metres_to_the_left() {
        let twist = Twist { x_m_s: 1.0, y_m_s: 0.0, yaw_rad_s: 0.25 };
        let command = Ackermann::default().command(twist);
        // The pivots are 3.6 m and 4.4 m from the centre's line, the axle 1 m behind.
        near(command.steering_rad, [libm::atan(1.0 / 3.6), libm::atan(1.0 / 4.4)]);
        // Driven wheels run on 3.5 m and 4.5 m: 0.875 and 1.125 m/s on 0.2 m.
        near(command.wheels_rad_s, [4.375, 5.625]);
    }

    #[test]
    fn it_cannot_turn_in_place_nor_beyond_its_limit() {
        let drive = Ackermann::default();
        let standing = drive.command(Twist { yaw_rad_s: 1.0, ..Twist::default() });
        assert_eq!(standing, AckermannCommand::default());
        let sharp = drive.command(Twist { x_m_s: 0.1, y_m_s: 0.0, yaw_rad_s: -5.0 });
        let middle =
            drive.command(Twist { x_m_s: 0.1, y_m_s: 0.0, yaw_rad_s: -0.1 * libm::tan(0.5) });
        near(sharp.steering_rad, middle.steering_rad);
        // Backwards, turning left steers right.
        let back = drive.command(Twist { x_m_s: -1.0, y_m_s: 0.0, yaw_rad_s: 0.25 });
        assert!(back.steering_rad[0] < 0.0);
    }
}
