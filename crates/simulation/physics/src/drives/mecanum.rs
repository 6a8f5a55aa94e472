//! `gz-sim-mecanum-drive-system`: four wheels with rollers at 45 degrees.

use crate::kinematic::Twist;

/// Parameters of the plugin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mecanum {
    /// Distance between front and back axles [m].
    pub wheelbase_m: f64,
    /// Distance between left and right wheels [m].
    pub wheel_separation_m: f64,
    /// Radius of a wheel [m].
    pub wheel_radius_m: f64,
}

impl Default for Mecanum {
    fn default() -> Self {
        Self { wheelbase_m: 1.0, wheel_separation_m: 1.0, wheel_radius_m: 0.2 }
    }
}

/// Speeds of the four wheels [rad/s].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MecanumWheels {
    /// Front left.
    pub front_left: f64,
    /// Front right.
    pub front_right: f64,
    /// Back left.
    pub back_left: f64,
    /// Back right.
    pub back_right: f64,
}

impl Mecanum {
    /// Returns the wheel speeds of a twist: each wheel pushes along its rollers' normal, so sideways
    /// motion is subtracted at the front left and added at the front right (Taheri, Qiao,
    /// Ghaeminezhad 2015, "Kinematic model of a four mecanum wheeled mobile robot", equation 20).
    #[must_use]
    pub fn wheels(&self, twist: Twist) -> MecanumWheels {
        let Twist { x_m_s, y_m_s, yaw_rad_s } = twist;
        let turn = yaw_rad_s * self.arm_m();
        let radius = self.wheel_radius_m;
        MecanumWheels {
            front_left: (x_m_s - y_m_s - turn) / radius,
            front_right: (x_m_s + y_m_s + turn) / radius,
            back_left: (x_m_s + y_m_s - turn) / radius,
            back_right: (x_m_s - y_m_s + turn) / radius,
        }
    }

    /// Returns the twist of wheel speeds: the least-squares inverse.
    #[must_use]
    pub fn twist(&self, wheels: MecanumWheels) -> Twist {
        let MecanumWheels { front_left, front_right, back_left, back_right } = wheels;
        let share = self.wheel_radius_m / 4.0;
        Twist {
            x_m_s: (front_left + front_right + back_left + back_right) * share,
            y_m_s: (-front_left + front_right + back_left - back_right) * share,
            yaw_rad_s: (-front_left + front_right - back_left + back_right) * share / self.arm_m(),
        }
    }

    fn arm_m(&self) -> f64 {
        (self.wheelbase_m + self.wheel_separation_m) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn to_the_left_the_diagonals_turn_against_each_other() {
        let left = Twist { y_m_s: 0.2, ..Twist::default() };
        let wheels = Mecanum::default().wheels(left);
        let expected =
            MecanumWheels { front_left: -1.0, front_right: 1.0, back_left: 1.0, back_right: -1.0 };
        assert_eq!(wheels, expected);
    }

    proptest! {
        #[test]
        fn a_twist_comes_back(x in -2.0..2.0f64, y in -2.0..2.0f64, w in -2.0..2.0f64) {
            let drive = Mecanum { wheelbase_m: 0.5, wheel_separation_m: 0.3, wheel_radius_m: 0.1 };
            let back = drive.twist(drive.wheels(Twist { x_m_s: x, y_m_s: y, yaw_rad_s: w }));
            let error = (back.x_m_s - x).abs() + (back.y_m_s - y).abs() + (back.yaw_rad_s - w).abs();
            prop_assert!(error < 1e-9);
        }
    }
}
