//! Logical cameras.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{DVec3, Pose};

/// A camera that detects models instead of pixels. It looks along x, y to the left, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogicalCamera {
    near_m: f64,
    far_m: f64,
    /// Half width and half height at 1 m.
    slopes: [f64; 2],
}

impl LogicalCamera {
    /// Creates a frustum from its ends [m], width over height, and horizontal field of view [rad].
    ///
    /// # Errors
    /// When the values do not define a frustum.
    pub fn new(
        near_m: f64,
        far_m: f64,
        aspect_ratio: f64,
        horizontal_fov_rad: f64,
    ) -> Result<Self, Box<Diagnostic>> {
        let sound = near_m >= 0.0
            && far_m > near_m
            && aspect_ratio > 0.0
            && aspect_ratio.is_finite()
            && horizontal_fov_rad > 0.0
            && horizontal_fov_rad < std::f64::consts::PI;
        if !sound {
            return Err(Diagnostic::error(
                "out-of-range",
                "near, far, aspect ratio and field of view of the logical camera do not define a frustum",
            )
            .help("0 <= near < far, aspect ratio above 0, horizontal field of view within 0..pi")
            .into());
        }
        let across = libm::tan(horizontal_fov_rad / 2.0);
        Ok(Self { near_m, far_m, slopes: [across, across / aspect_ratio] })
    }

    /// Returns true if a point in the sensor's frame [m] is in the frustum.
    #[must_use]
    pub fn contains(&self, point_in_sensor_m: DVec3) -> bool {
        let DVec3 { x, y, z } = point_in_sensor_m;
        let [across, up] = self.slopes;
        (self.near_m..=self.far_m).contains(&x) && y.abs() <= x * across && z.abs() <= x * up
    }

    /// Returns the models whose origins are in the frustum, with their poses in the sensor's frame,
    /// in the given order (gz-sensors' rule; Classic uses bounding boxes).
    pub fn see<'a, M: 'a>(
        &'a self,
        world_from_sensor: Pose,
        models: impl Iterator<Item = (M, Pose)> + 'a,
    ) -> impl Iterator<Item = (M, Pose)> + 'a {
        let sensor_from_world = world_from_sensor.inverse();
        models
            .map(move |(model, world_from_model)| (model, sensor_from_world * world_from_model))
            .filter(|(_, sensor_from_model)| self.contains(sensor_from_model.translation))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use periplus_geometry::Rpy;

    use super::*;

    /// 90° across, half as high: at 4 m it sees 4 m to either side and 2 m up.
    #[test]
    fn the_frustum_has_straight_sides() {
        let camera = LogicalCamera::new(0.5, 10.0, 2.0, FRAC_PI_2).unwrap();
        let sees = |x, y, z| camera.contains(DVec3::new(x, y, z));
        assert!(sees(4.0, 3.999, 1.999) && sees(4.0, -3.999, -1.999));
        assert!(!sees(4.0, 4.001, 0.0) && !sees(4.0, 0.0, 2.001));
        assert!(!sees(0.4, 0.0, 0.0) && !sees(10.1, 0.0, 0.0) && !sees(-4.0, 0.0, 0.0));
    }

    #[test]
    fn models_have_poses_in_the_sensor_frame() {
        let camera = LogicalCamera::new(0.1, 5.0, 1.0, 1.0).unwrap();
        let left = Rpy { roll: 0.0, pitch: 0.0, yaw: FRAC_PI_2 };
        let world_from_sensor = Pose::from_xyz_rpy([1.0, 0.0, 0.0], left);
        let models =
            [("cup", Pose::from_xyz(1.0, 2.0, 0.0)), ("wall", Pose::from_xyz(3.0, 0.0, 0.0))];
        let seen: Vec<_> = camera.see(world_from_sensor, models.into_iter()).collect();
        assert_eq!(seen.len(), 1);
        assert_eq!(seen[0].0, "cup");
        assert!(seen[0].1.translation.distance(DVec3::X * 2.0) < 1e-12);
    }

    #[test]
    fn invalid_frustums_are_rejected() {
        for (near, far, aspect, fov) in [
            (1.0, 0.5, 1.0, 1.0),
            (0.0, 1.0, 0.0, 1.0),
            (0.0, 1.0, 1.0, 4.0),
            (f64::NAN, 1.0, 1.0, 1.0),
        ] {
            assert!(LogicalCamera::new(near, far, aspect, fov).is_err());
        }
    }
}
