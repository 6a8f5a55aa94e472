//! Integration of odometry.

use crate::{DiffDriveGeometry, PlanarTwist, RollingMeanAccumulator};

/// Angle of a step below which an arc is treated as a straight line [rad].
const MIN_ARC_RAD: f64 = 1e-6;

/// Shortest interval for which a speed can be estimated [s].
pub(crate) const MIN_INTERVAL_S: f64 = 1e-4;

/// Pose in the plane with an unwrapped heading.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanarPose {
    /// Position along x [m].
    pub x_m: f64,
    /// Position along y [m].
    pub y_m: f64,
    /// Heading; full turns are counted [rad].
    pub heading_rad: f64,
}

impl PlanarPose {
    /// Moves along an arc by a distance [m] and an angle [rad]. Below 1e-6 rad the motion is straight
    /// along the heading in the middle.
    ///
    /// Source: `Odometry::integrateExact` of `diff_drive_controller`.
    #[must_use]
    pub fn moved(self, distance_m: f64, turned_rad: f64) -> Self {
        let heading_rad = self.heading_rad + turned_rad;
        if turned_rad.abs() < MIN_ARC_RAD {
            let (sine, cosine) = libm::sincos(self.heading_rad + turned_rad * 0.5);
            return Self {
                x_m: self.x_m + distance_m * cosine,
                y_m: self.y_m + distance_m * sine,
                heading_rad,
            };
        }
        let radius_m = distance_m / turned_rad;
        let ((sine, cosine), (sine_before, cosine_before)) =
            (libm::sincos(heading_rad), libm::sincos(self.heading_rad));
        Self {
            x_m: self.x_m + radius_m * (sine - sine_before),
            y_m: self.y_m - radius_m * (cosine - cosine_before),
            heading_rad,
        }
    }

    /// Moves by a planar velocity over a time [s], with the heading at the end of the step for the
    /// translation.
    ///
    /// Source: `Odometry::update` of `mecanum_drive_controller`.
    #[must_use]
    pub fn moved_sideways(self, twist: PlanarTwist, dt_s: f64) -> Self {
        let heading_rad = self.heading_rad + twist.yaw_rad_s * dt_s;
        let (sine, cosine) = libm::sincos(heading_rad);
        Self {
            x_m: self.x_m + (twist.x_m_s * cosine - twist.y_m_s * sine) * dt_s,
            y_m: self.y_m + (twist.x_m_s * sine + twist.y_m_s * cosine) * dt_s,
            heading_rad,
        }
    }
}

/// Rolling means of the linear and the angular speed.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedMeans {
    linear: RollingMeanAccumulator,
    angular: RollingMeanAccumulator,
}

impl SpeedMeans {
    /// Creates means over a number of updates.
    #[must_use]
    pub fn new(window: usize) -> Self {
        let mean = RollingMeanAccumulator::new(window);
        Self { linear: mean.clone(), angular: mean }
    }

    /// Adds speeds [m/s, rad/s] and returns their means.
    pub fn push(&mut self, linear_m_s: f64, angular_rad_s: f64) -> PlanarTwist {
        self.linear.push(linear_m_s);
        self.angular.push(angular_rad_s);
        PlanarTwist { x_m_s: self.linear.mean(), y_m_s: 0.0, yaw_rad_s: self.angular.mean() }
    }

    /// Forgets all speeds.
    pub fn clear(&mut self) {
        self.linear.clear();
        self.angular.clear();
    }
}

/// Odometry of a differential drive.
///
/// Source: `Odometry` of `diff_drive_controller` (ROS 1 and ROS 2 have the same formulas).
#[derive(Clone, Debug, PartialEq)]
pub struct DiffDriveOdometry {
    /// Pose from the start.
    pub pose: PlanarPose,
    /// Rolling mean of the velocity.
    pub twist: PlanarTwist,
    geometry: DiffDriveGeometry,
    /// Travelled distances of the wheels at the last update [m].
    before_m: [f64; 2],
    means: SpeedMeans,
}

impl DiffDriveOdometry {
    /// Creates odometry with both wheels at zero; `window` is the number of updates in the mean.
    #[must_use]
    pub fn new(geometry: DiffDriveGeometry, window: usize) -> Self {
        Self {
            pose: PlanarPose::default(),
            twist: PlanarTwist::default(),
            geometry,
            before_m: [0.0; 2],
            means: SpeedMeans::new(window),
        }
    }

    /// Sets the wheel angles from which the next update counts [rad].
    pub fn begin_at(&mut self, [left_rad, right_rad]: [f64; 2]) {
        let DiffDriveGeometry { left_radius_m, right_radius_m, .. } = self.geometry;
        self.before_m = [left_rad * left_radius_m, right_rad * right_radius_m];
    }

    /// Continues from the wheel angles of other odometry.
    pub(crate) fn keep_angles_of(&mut self, other: &Self) {
        self.before_m = other.before_m;
    }

    /// Updates from the angles of the left and right wheels [rad] after a time [s]. Returns false and
    /// changes nothing after less than 0.1 ms.
    pub fn update(&mut self, [left_rad, right_rad]: [f64; 2], dt_s: f64) -> bool {
        if dt_s < MIN_INTERVAL_S {
            return false;
        }
        let DiffDriveGeometry { left_radius_m, right_radius_m, .. } = self.geometry;
        let now_m = [left_rad * left_radius_m, right_rad * right_radius_m];
        let travelled_m = [now_m[0] - self.before_m[0], now_m[1] - self.before_m[1]];
        self.before_m = now_m;
        self.advance(travelled_m, dt_s);
        true
    }

    /// Updates from the speeds of the left and right wheels [rad/s] after a time [s]. Returns false
    /// and changes nothing after less than 0.1 ms.
    pub fn update_from_speeds(&mut self, [left_rad_s, right_rad_s]: [f64; 2], dt_s: f64) -> bool {
        if dt_s < MIN_INTERVAL_S {
            return false;
        }
        let DiffDriveGeometry { left_radius_m, right_radius_m, .. } = self.geometry;
        self.advance(
            [left_rad_s * left_radius_m * dt_s, right_rad_s * right_radius_m * dt_s],
            dt_s,
        );
        true
    }

    /// Updates from a commanded velocity over a time [s]: the velocity is published as it is.
    pub fn update_open_loop(&mut self, twist: PlanarTwist, dt_s: f64) {
        self.twist = PlanarTwist { y_m_s: 0.0, ..twist };
        self.pose = self.pose.moved(twist.x_m_s * dt_s, twist.yaw_rad_s * dt_s);
    }

    fn advance(&mut self, [left_m, right_m]: [f64; 2], dt_s: f64) {
        let distance_m = (left_m + right_m) * 0.5;
        let turned_rad = (right_m - left_m) / self.geometry.separation_m;
        self.pose = self.pose.moved(distance_m, turned_rad);
        self.twist = self.means.push(distance_m / dt_s, turned_rad / dt_s);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_circle_of_one_metre() {
        let half_pi = std::f64::consts::FRAC_PI_2;
        let end = PlanarPose::default().moved(half_pi, half_pi);
        assert!((end.x_m - 1.0).abs() < 1e-12 && (end.y_m - 1.0).abs() < 1e-12, "{end:?}");
        assert_eq!(end.heading_rad, half_pi);
    }

    #[test]
    fn wheel_angles_become_speeds() {
        let geometry =
            DiffDriveGeometry { separation_m: 0.4, left_radius_m: 0.1, right_radius_m: 0.1 };
        let mut odometry = DiffDriveOdometry::new(geometry, 2);
        // 0.05 m on both sides in 0.1 s.
        assert!(odometry.update([0.5, 0.5], 0.1));
        assert_eq!(odometry.twist, PlanarTwist { x_m_s: 0.5, ..PlanarTwist::default() });
        // 0.05 m and 0.07 m: 0.6 m/s and 0.5 rad/s; the means of two.
        assert!(odometry.update([1.0, 1.2], 0.1));
        assert!((odometry.twist.x_m_s - 0.55).abs() < 1e-12);
        assert!((odometry.twist.yaw_rad_s - 0.25).abs() < 1e-12);
        assert!((odometry.pose.heading_rad - 0.05).abs() < 1e-12);
        assert!(!odometry.update([9.0, 9.0], 0.00009));
    }

    #[test]
    fn an_open_loop_follows_the_command() {
        let geometry =
            DiffDriveGeometry { separation_m: 0.4, left_radius_m: 0.1, right_radius_m: 0.1 };
        let mut odometry = DiffDriveOdometry::new(geometry, 10);
        let twist = PlanarTwist { x_m_s: 1.0, y_m_s: 0.0, yaw_rad_s: 0.0 };
        odometry.update_open_loop(twist, 0.5);
        assert_eq!((odometry.pose.x_m, odometry.twist), (0.5, twist));
    }
}
