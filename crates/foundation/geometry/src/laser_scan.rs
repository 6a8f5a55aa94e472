//! Scans of planar range finders.

use glam::DVec3;

use crate::{Pose, Pose2};

/// Mounting of a planar scanner on a robot, projected onto the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScannerMounting {
    /// Pose of the scanner in the base frame \[m, rad\]. For a scanner that is mounted upside down,
    /// the yaw of its x axis.
    pub base_from_scanner: Pose2,
    /// True for a scanner that is mounted upside down: its beams run clockwise seen from above.
    pub is_upside_down: bool,
}

impl ScannerMounting {
    /// Mounting of a scanner that stands upright.
    #[must_use]
    pub const fn upright(base_from_scanner: Pose2) -> Self {
        Self { base_from_scanner, is_upside_down: false }
    }
}

/// Projects a mounting onto the plane: keeps x, y and the direction of the x axis. A scanner is
/// upside down if its z axis points down.
impl From<Pose> for ScannerMounting {
    fn from(base_from_scanner: Pose) -> Self {
        let forward = base_from_scanner.rotation * DVec3::X;
        let up = base_from_scanner.rotation * DVec3::Z;
        let DVec3 { x, y, .. } = base_from_scanner.translation;
        let yaw_rad = libm::atan2(forward.y, forward.x);
        Self { base_from_scanner: Pose2::new(x, y, yaw_rad), is_upside_down: up.z < 0.0 }
    }
}

/// Ranges along the beams of a planar scanner, as in `sensor_msgs/LaserScan`, and its mounting.
#[derive(Clone, Debug, PartialEq)]
pub struct LaserScan2 {
    /// Stamp of the first beam \[ns\].
    pub time_ns: i64,
    /// Mounting of the scanner.
    pub mounting: ScannerMounting,
    /// Angle of the first beam in the frame of the scanner \[rad\].
    pub angle_min_rad: f64,
    /// Angle between beams \[rad\]; may be negative.
    pub angle_increment_rad: f64,
    /// Time between beams \[s\]; 0 if all were measured at once.
    pub time_increment_s: f64,
    /// Minimum range \[m\]; shorter readings are invalid.
    pub range_min_m: f32,
    /// Maximum range \[m\]; readings at or above it hit nothing.
    pub range_max_m: f32,
    /// Measured ranges \[m\]; values that are not positive numbers are no returns.
    pub ranges_m: Vec<f32>,
}

impl LaserScan2 {
    /// Angle of a beam relative to the scanner's x axis, counterclockwise seen from above \[rad\].
    #[must_use]
    #[inline]
    pub fn beam_angle_rad(&self, index: usize) -> f64 {
        let sign = if self.mounting.is_upside_down { -1.0 } else { 1.0 };
        sign * (self.angle_min_rad + index as f64 * self.angle_increment_rad)
    }

    /// Angle between beams, counterclockwise seen from above \[rad\].
    #[must_use]
    pub fn beam_step_rad(&self) -> f64 {
        if self.mounting.is_upside_down {
            -self.angle_increment_rad
        } else {
            self.angle_increment_rad
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;
    use crate::Rpy;

    fn rpy(roll: f64, pitch: f64, yaw: f64) -> Rpy {
        Rpy { roll, pitch, yaw }
    }

    #[test]
    fn a_mounting_is_projected_and_upside_down_by_its_axis() {
        let upright = Pose::from_xyz_rpy([0.2, -0.1, 0.3], rpy(0.0, 0.1, FRAC_PI_2));
        let mounting = ScannerMounting::from(upright);
        assert!(!mounting.is_upside_down);
        let Pose2 { x_m, y_m, yaw_rad } = mounting.base_from_scanner;
        assert_eq!((x_m, y_m), (0.2, -0.1));
        assert!((yaw_rad - FRAC_PI_2).abs() < 1e-12);
        let rolled = ScannerMounting::from(Pose::from_xyz_rpy([0.2, 0.0, 0.3], rpy(PI, 0.0, 0.0)));
        assert!(rolled.is_upside_down && rolled.base_from_scanner.yaw_rad.abs() < 1e-12);
        // Upside down by its pitch: the x axis points backwards.
        let pitched = ScannerMounting::from(Pose::from_xyz_rpy([0.2, 0.0, 0.3], rpy(0.0, PI, 0.0)));
        assert!(pitched.is_upside_down);
        assert!((pitched.base_from_scanner.yaw_rad.abs() - PI).abs() < 1e-12, "{pitched:?}");
    }

    #[test]
    fn beams_of_a_scanner_upside_down_run_clockwise() {
        let mut scan = LaserScan2 {
            time_ns: 0,
            mounting: ScannerMounting::upright(Pose2::IDENTITY),
            angle_min_rad: 0.25,
            angle_increment_rad: 0.5,
            time_increment_s: 0.0,
            range_min_m: 0.1,
            range_max_m: 8.0,
            ranges_m: vec![1.0; 3],
        };
        assert_eq!((scan.beam_angle_rad(2), scan.beam_step_rad()), (1.25, 0.5));
        scan.mounting.is_upside_down = true;
        assert_eq!((scan.beam_angle_rad(2), scan.beam_step_rad()), (-1.25, -0.5));
    }
}
