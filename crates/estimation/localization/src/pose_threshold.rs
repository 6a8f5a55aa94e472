//! Thresholds for the difference of two poses.

use periplus_geometry::{Pose2, normalize_angle};

/// Limits of a translation and a rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseThreshold {
    /// Translation \[m\].
    pub distance_m: f64,
    /// Rotation \[rad\].
    pub angle_rad: f64,
}

impl PoseThreshold {
    /// Creates a threshold.
    #[must_use]
    pub const fn new(distance_m: f64, angle_rad: f64) -> Self {
        Self { distance_m, angle_rad }
    }

    /// Multiplies both limits.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self::new(factor * self.distance_m, factor * self.angle_rad)
    }

    /// True if two poses are closer than both limits.
    pub(crate) fn covers(self, a: Pose2, b: Pose2) -> bool {
        libm::hypot(a.x_m - b.x_m, a.y_m - b.y_m) < self.distance_m
            && normalize_angle(a.yaw_rad - b.yaw_rad).abs() < self.angle_rad
    }

    /// True if two poses are closer than the distance along each axis, and than the angle.
    pub(crate) fn covers_per_axis(self, a: Pose2, b: Pose2) -> bool {
        (a.x_m - b.x_m).abs() < self.distance_m
            && (a.y_m - b.y_m).abs() < self.distance_m
            && normalize_angle(a.yaw_rad - b.yaw_rad).abs() < self.angle_rad
    }
}

/// True if a robot moved by more than the threshold along x or y of odometry, or in yaw, as in
/// Nav2's AMCL.
#[must_use]
pub fn has_moved(old: Pose2, new: Pose2, threshold: PoseThreshold) -> bool {
    let turn_rad = normalize_angle(new.yaw_rad - old.yaw_rad);
    (new.x_m - old.x_m).abs() > threshold.distance_m
        || (new.y_m - old.y_m).abs() > threshold.distance_m
        || turn_rad.abs() > threshold.angle_rad
}
