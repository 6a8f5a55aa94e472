//! `gz-sim-diff-drive-system`: all left wheels get one speed, all right wheels the other.

use super::{Odometry, SpeedLimits};
use crate::kinematic::Twist;

/// Parameters of the plugin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GzDiffDrive {
    /// Distance between left and right wheels [m].
    pub wheel_separation_m: f64,
    /// Radius of a wheel [m].
    pub wheel_radius_m: f64,
    /// Bounds of the forward speed [m/s].
    pub linear: SpeedLimits,
    /// Bounds of the turning speed [rad/s].
    pub angular: SpeedLimits,
    /// Publishing rate of odometry [Hz].
    pub odom_publish_frequency_hz: f64,
}

impl Default for GzDiffDrive {
    fn default() -> Self {
        Self {
            wheel_separation_m: 1.0,
            wheel_radius_m: 0.2,
            linear: SpeedLimits::default(),
            angular: SpeedLimits::default(),
            odom_publish_frequency_hz: 50.0,
        }
    }
}

/// State of the plugin, updated in each simulation step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GzDiffDriveState {
    last: [Twist; 2],
    wheels_before_rad: Option<[f64; 2]>,
    /// Odometry of the first left and right wheels, from zero.
    pub odometry: Odometry,
}

impl GzDiffDriveState {
    /// Returns the speeds of left and right wheels [rad/s] for a command after a time since the last
    /// step [s]: `(v ∓ w separation / 2) / radius`.
    pub fn command(&mut self, drive: &GzDiffDrive, wanted: Twist, dt_s: f64) -> [f64; 2] {
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
    pub fn observe(&mut self, drive: &GzDiffDrive, wheels_rad: [f64; 2], dt_s: f64) {
        if let Some([left, right]) = self.wheels_before_rad {
            let way = |now: f64, before: f64| (now - before) * drive.wheel_radius_m;
            self.odometry = self.odometry.advanced(
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
        let drive = GzDiffDrive::default();
        let mut plugin = GzDiffDriveState::default();
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
        let linear = SpeedLimits { acceleration: [-1.0, 1.0], ..SpeedLimits::default() };
        let drive = GzDiffDrive { linear, ..GzDiffDrive::default() };
        let mut plugin = GzDiffDriveState::default();
        let twist = Twist { x_m_s: 1.0, ..Twist::default() };
        let mut wheels = [0.0; 2];
        for _ in 0..500 {
            wheels = plugin.command(&drive, twist, 0.001);
        }
        // Half a second at 1 m/s²: 0.5 m/s on 0.2 m.
        assert!((wheels[0] - 2.5).abs() < 1e-9, "{wheels:?}");
    }
}
