//! `libgazebo_ros_diff_drive.so`, of ROS 1 and ROS 2: one or several pairs of wheels; and ROS 1's
//! `libgazebo_ros_skid_steer_drive.so`, which is the same with two pairs.

use super::Odometry;
use crate::kinematic::Twist;

/// Speed error below which the target speed is set at once [m/s].
const SPEED_TOLERANCE_M_S: f64 = 0.01;

/// A left and a right wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelPair {
    /// Distance between them [m].
    pub separation_m: f64,
    /// Diameter [m].
    pub diameter_m: f64,
}

impl Default for WheelPair {
    fn default() -> Self {
        Self { separation_m: 0.34, diameter_m: 0.15 }
    }
}

/// Parameters of the plugin.
#[derive(Clone, Debug, PartialEq)]
pub struct ClassicDiffDrive {
    /// Wheel pairs; skid-steered robots have several. Odometry uses the first only.
    pub pairs: Vec<WheelPair>,
    /// Maximum change of a wheel's rim speed [m/s²]; 0 is unlimited.
    pub max_wheel_acceleration_m_s2: f64,
    /// Maximum torque of a wheel [N m].
    pub max_wheel_torque_n_m: f64,
    /// Update rate [Hz]; 0 is every step.
    pub update_rate_hz: f64,
}

impl Default for ClassicDiffDrive {
    fn default() -> Self {
        Self {
            pairs: vec![WheelPair::default()],
            max_wheel_acceleration_m_s2: 0.0,
            max_wheel_torque_n_m: 5.0,
            update_rate_hz: 100.0,
        }
    }
}

impl ClassicDiffDrive {
    /// `libgazebo_ros_skid_steer_drive.so`: a front and a rear pair with equal commands, without a
    /// limit on acceleration. Its own defaults are a separation of 0.4 m and a diameter of 0.15 m;
    /// its odometry is the true pose.
    #[must_use]
    pub fn skid_steer(wheels: WheelPair, torque_n_m: f64, update_rate_hz: f64) -> Self {
        Self {
            pairs: vec![wheels; 2],
            max_wheel_acceleration_m_s2: 0.0,
            max_wheel_torque_n_m: torque_n_m,
            update_rate_hz,
        }
    }

    /// Returns the twist of the midpoint of the wheels at these speeds [rad/s], left and right of
    /// each pair, with minimal slip: the mean over the pairs.
    #[must_use]
    pub fn twist(&self, wheels_rad_s: &[[f64; 2]]) -> Twist {
        let mut twist = Twist::default();
        let count = self.pairs.len().min(wheels_rad_s.len()).max(1) as f64;
        for (pair, [left, right]) in self.pairs.iter().zip(wheels_rad_s) {
            let radius_m = pair.diameter_m / 2.0;
            twist.x_m_s += (left + right) * radius_m / 2.0 / count;
            twist.yaw_rad_s += (right - left) * radius_m / pair.separation_m / count;
        }
        twist
    }
}

/// State of the plugin. The last command has no timeout, as in the original.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClassicDrive {
    /// Commanded rim speeds [m/s], left and right of each pair.
    ramps: Vec<[f64; 2]>,
    /// Pose from the encoders.
    pub odometry: Odometry,
}

impl ClassicDrive {
    /// Updates with the command, the current speeds of each pair's wheels [rad/s, left and right],
    /// and the time since the last update [s]. Returns the target speed of each wheel [rad/s].
    ///
    /// A wheel's rim speed is `v ∓ w separation / 2`. With a limit on acceleration, each update adds
    /// at most `acceleration dt` to the previous target, and at most the wheel's own speed error.
    pub fn update(
        &mut self,
        drive: &ClassicDiffDrive,
        command: Twist,
        wheels_rad_s: &[[f64; 2]],
        dt_s: f64,
    ) -> Vec<[f64; 2]> {
        self.ramps.resize(drive.pairs.len(), [0.0; 2]);
        let limit = drive.max_wheel_acceleration_m_s2;
        let mut answer = Vec::with_capacity(drive.pairs.len());
        for (number, pair) in drive.pairs.iter().enumerate() {
            let radius_m = pair.diameter_m / 2.0;
            let now = wheels_rad_s.get(number).copied().unwrap_or_default();
            let mut wanted_rad_s = [0.0; 2];
            for (side, sign) in [(0, -1.0), (1, 1.0)] {
                let target = command.x_m_s + sign * command.yaw_rad_s * pair.separation_m / 2.0;
                let missing = target - now[side] * radius_m;
                let ramp = &mut self.ramps[number][side];
                if limit == 0.0 || missing.abs() < SPEED_TOLERANCE_M_S {
                    *ramp = target;
                } else if missing >= 0.0 {
                    *ramp += missing.min(limit * dt_s);
                } else {
                    *ramp += missing.max(-limit * dt_s);
                }
                wanted_rad_s[side] = *ramp / radius_m;
            }
            answer.push(wanted_rad_s);
        }
        if let (Some(pair), Some([left, right])) = (drive.pairs.first(), wheels_rad_s.first()) {
            let way = pair.diameter_m / 2.0 * dt_s;
            self.odometry =
                self.odometry.advanced(left * way, right * way, pair.separation_m, dt_s);
        }
        answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn twist(x_m_s: f64, yaw_rad_s: f64) -> Twist {
        Twist { x_m_s, y_m_s: 0.0, yaw_rad_s }
    }

    fn drive(max_wheel_acceleration_m_s2: f64) -> ClassicDiffDrive {
        let pairs = vec![WheelPair { separation_m: 0.4, diameter_m: 0.2 }; 2];
        ClassicDiffDrive { pairs, max_wheel_acceleration_m_s2, ..ClassicDiffDrive::default() }
    }

    #[test]
    fn every_pair_turns_as_the_twist_says() {
        // 0.5 m/s on 0.1 m is 5 rad/s; 1 rad/s on 0.2 m is 0.2 m/s, 2 rad/s.
        let answer = ClassicDrive::default().update(&drive(0.0), twist(0.5, 1.0), &[], 0.01);
        assert_eq!(answer.len(), 2);
        for [left, right] in answer {
            assert!((left - 3.0).abs() < 1e-12 && (right - 7.0).abs() < 1e-12);
        }
    }

    #[test]
    fn four_wheels_of_a_skid_steered_robot() {
        let drive = ClassicDiffDrive::skid_steer(
            WheelPair { separation_m: 0.4, diameter_m: 0.2 },
            5.0,
            100.0,
        );
        let answer = ClassicDrive::default().update(&drive, twist(0.5, 1.0), &[], 0.01);
        assert_eq!(answer, vec![answer[0]; 2]);
        let back = drive.twist(&answer);
        assert!((back.x_m_s - 0.5).abs() < 1e-12 && (back.yaw_rad_s - 1.0).abs() < 1e-12);
    }

    #[test]
    fn one_metre_per_second_squared_reaches_half_a_metre_per_second_in_half_a_second() {
        let drive = drive(1.0);
        let mut plugin = ClassicDrive::default();
        let mut wheels = vec![[0.0; 2]; 2];
        let mut updates = 0;
        while wheels[0][0] < 5.0 {
            wheels = plugin.update(&drive, twist(0.5, 0.0), &wheels, 0.01);
            updates += 1;
            assert!(updates < 60, "{wheels:?}");
        }
        // The last centimetre per second is set at once.
        assert!((49..=51).contains(&updates), "{updates}");
        assert_eq!(wheels[1], [5.0, 5.0]);
        // 0.5 m/s² for half a second, less than 0.125 m by the delay of one update.
        let x_m = plugin.odometry.pose.x_m;
        assert!((x_m - 0.1225).abs() < 0.003, "{x_m}");
    }
}
