//! `gz-sim-diff-drive-system`: every left wheel gets one speed, every right wheel the other.

use super::{Limits, Odometry};
use crate::kinematic::Twist;

/// What the plugin is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HarmonicDiffDrive {
    /// Distance between left and right wheels [m].
    pub wheel_separation_m: f64,
    /// Radius of a wheel [m].
    pub wheel_radius_m: f64,
    /// Bounds of the forward speed [m/s].
    pub linear: Limits,
    /// Bounds of the turning speed [rad/s].
    pub angular: Limits,
    /// How often odometry is told [Hz].
    pub odom_publish_frequency_hz: f64,
}

impl Default for HarmonicDiffDrive {
    fn default() -> Self {
        Self {
            wheel_separation_m: 1.0,
            wheel_radius_m: 0.2,
            linear: Limits::default(),
            angular: Limits::default(),
            odom_publish_frequency_hz: 50.0,
        }
    }
}

/// The plugin at work, at each step of the simulation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HarmonicDrive {
    last: [Twist; 2],
    wheels_before_rad: Option<[f64; 2]>,
    /// Where the first left and right wheels say that it is, from zero.
    pub odometry: Odometry,
}

impl HarmonicDrive {
    /// One step: the command, and the time since the last step [s]. Answers the speeds of left and
    /// right wheels [rad/s]: `(v ∓ w separation / 2) / radius`.
    pub fn command(&mut self, drive: &HarmonicDiffDrive, wanted: Twist, dt_s: f64) -> [f64; 2] {
        let [last, before] = self.last;
        let x_m_s = drive.linear.limited(wanted.x_m_s, last.x_m_s, before.x_m_s, dt_s);
        let yaw_rad_s =
            drive.angular.limited(wanted.yaw_rad_s, last.yaw_rad_s, before.yaw_rad_s, dt_s);
        let now = Twist { x_m_s, y_m_s: 0.0, yaw_rad_s };
        self.last = [now, last];
        let aside = yaw_rad_s * drive.wheel_separation_m / 2.0;
        [(x_m_s - aside) / drive.wheel_radius_m, (x_m_s + aside) / drive.wheel_radius_m]
    }

    /// Reads the angles of the first left and right wheels [rad]. The first reading is the zero.
    pub fn observe(&mut self, drive: &HarmonicDiffDrive, wheels_rad: [f64; 2], dt_s: f64) {
        if let Some([left, right]) = self.wheels_before_rad {
            let way = |now: f64, before: f64| (now - before) * drive.wheel_radius_m;
            self.odometry = self.odometry.moved(
                way(wheels_rad[0], left),
                way(wheels_rad[1], right),
                drive.wheel_separation_m,
                dt_s,
            );
        }
        self.wheels_before_rad = Some(wheels_rad);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_twist_in_wheel_speeds_and_back() {
        let drive = HarmonicDiffDrive::default();
        let mut plugin = HarmonicDrive::default();
        let twist = Twist { x_m_s: 1.0, y_m_s: 0.0, yaw_rad_s: 0.4 };
        let wheels = plugin.command(&drive, twist, 0.001);
        // (1 ∓ 0.2) / 0.2.
        assert!((wheels[0] - 4.0).abs() < 1e-9 && (wheels[1] - 6.0).abs() < 1e-9, "{wheels:?}");
        plugin.observe(&drive, [100.0, -100.0], 0.001);
        plugin.observe(&drive, [100.004, -99.994], 0.001);
        let back = plugin.odometry.twist;
        assert!((back.x_m_s - 1.0).abs() < 1e-9 && (back.yaw_rad_s - 0.4).abs() < 1e-9, "{back:?}");
    }

    #[test]
    fn acceleration_is_bounded() {
        let linear = Limits { acceleration: [-1.0, 1.0], ..Limits::default() };
        let drive = HarmonicDiffDrive { linear, ..HarmonicDiffDrive::default() };
        let mut plugin = HarmonicDrive::default();
        let twist = Twist { x_m_s: 1.0, ..Twist::default() };
        let mut wheels = [0.0; 2];
        for _ in 0..500 {
            wheels = plugin.command(&drive, twist, 0.001);
        }
        // Half a second at 1 m/s²: 0.5 m/s on 0.2 m.
        assert!((wheels[0] - 2.5).abs() < 1e-9, "{wheels:?}");
    }
}
