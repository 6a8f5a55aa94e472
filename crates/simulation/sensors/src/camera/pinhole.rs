//! Pinhole projection and the contents of a camera info.

use periplus_diagnostics::Diagnostic;
use periplus_scene::Camera;

/// Maximum number of pixels of a camera: four times 8K. More is assumed to be a mistake.
pub const MAX_PIXELS: u64 = 4 * 7680 * 4320;

/// A pinhole camera without distortion. Its own frame looks along x, y to the left, z up; the
/// optical frame along z, x to the right, y down (REP 103).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pinhole {
    /// Width [px].
    pub width: u32,
    /// Height [px].
    pub height: u32,
    /// Focal length, equal in both axes: `width / (2 tan(fov / 2))` [px].
    pub focal_px: f64,
}

impl Pinhole {
    /// Converts the camera of a file.
    ///
    /// # Errors
    /// When the image has no pixels or too many, or the field of view is not between 0 and π.
    pub fn new(camera: &Camera) -> Result<Self, Box<Diagnostic>> {
        let Camera { width, height, horizontal_fov_rad: fov_rad, .. } = *camera;
        let pixels = u64::from(width) * u64::from(height);
        if pixels == 0 || pixels > MAX_PIXELS {
            return Err(Diagnostic::error(
                "out-of-range",
                format!("a camera of {width} x {height} pixels is not supported"),
            )
            .help(format!("at least one pixel, at most {MAX_PIXELS}"))
            .into());
        }
        if !(fov_rad > 0.0 && fov_rad < std::f64::consts::PI) {
            return Err(Diagnostic::error(
                "out-of-range",
                format!("a pinhole camera cannot cover {fov_rad} rad"),
            )
            .help("`<horizontal_fov>` must be between 0 and pi (3.14159)")
            .into());
        }
        let focal_px = f64::from(width) / (2.0 * libm::tan(fov_rad / 2.0));
        Ok(Self { width, height, focal_px })
    }

    /// Returns the number of pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Returns the horizontal slopes of all columns: x over z of the pixel centres in the optical
    /// frame.
    #[must_use]
    pub fn right(&self) -> Vec<f64> {
        slopes(self.width, self.focal_px)
    }

    /// Returns the vertical slopes of all rows: y over z in the optical frame.
    #[must_use]
    pub fn down(&self) -> Vec<f64> {
        slopes(self.height, self.focal_px)
    }
}

fn slopes(count: u32, focal_px: f64) -> Vec<f64> {
    let middle = (f64::from(count) - 1.0) / 2.0;
    (0..count).map(|pixel| (f64::from(pixel) - middle) / focal_px).collect()
}

/// Calibration of a camera info (REP 104), matrices in row-major order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraCalibration {
    /// Distortion: k1, k2, p1, p2, k3 (`plumb_bob`).
    pub d: [f64; 5],
    /// Focal lengths and principal point of the raw image.
    pub k: [f64; 9],
    /// Rotation to the rectified axes.
    pub r: [f64; 9],
    /// Projection of rectified points.
    pub p: [f64; 12],
}

impl CameraCalibration {
    /// Returns the calibration with gz-sensors' principal point: `width / 2`, `height / 2`.
    #[must_use]
    pub fn of_gz(pinhole: &Pinhole, camera: &Camera) -> Self {
        let middle = [f64::from(pinhole.width) / 2.0, f64::from(pinhole.height) / 2.0];
        Self::new(pinhole.focal_px, middle, camera)
    }

    /// Returns the calibration with the principal point of Classic's ROS plugins: `(width + 1) / 2`,
    /// `(height + 1) / 2`.
    #[must_use]
    pub fn of_classic(pinhole: &Pinhole, camera: &Camera) -> Self {
        let middle = [pinhole.width, pinhole.height].map(|pixels| (f64::from(pixels) + 1.0) / 2.0);
        Self::new(pinhole.focal_px, middle, camera)
    }

    /// Returns the calibration of a focal length and principal point [px], and a camera's
    /// distortion.
    #[must_use]
    pub fn new(focal_px: f64, [cx, cy]: [f64; 2], camera: &Camera) -> Self {
        let d = camera
            .distortion
            .map_or([0.0; 5], |lens| [lens.k1, lens.k2, lens.p1, lens.p2, lens.k3]);
        let f = focal_px;
        Self {
            d,
            k: [f, 0.0, cx, 0.0, f, cy, 0.0, 0.0, 1.0],
            r: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
            p: [f, 0.0, cx, 0.0, 0.0, f, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
        }
    }

    /// Converts to the right camera of a stereo pair at this distance from the left one [m]: `Tx =
    /// -f · baseline`.
    #[must_use]
    pub fn with_baseline(mut self, baseline_m: f64) -> Self {
        self.p[3] = -self.p[0] * baseline_m;
        self
    }
}

#[cfg(test)]
mod tests {
    use periplus_scene::{CameraKind, NoiseSpec};

    use super::*;

    fn camera(width: u32, height: u32, fov_rad: f64) -> Camera {
        Camera {
            name: None,
            kind: CameraKind::Depth,
            sensor_from_camera: periplus_geometry::Pose::IDENTITY,
            horizontal_fov_rad: fov_rad,
            width,
            height,
            format: "R8G8B8".into(),
            near_m: 0.1,
            far_m: 10.0,
            depth_clip_m: None,
            noise: NoiseSpec::default(),
            distortion: None,
            camera_info_topic: None,
            optical_frame_id: None,
            triggered: false,
            visibility_mask: u32::MAX,
            label_type: None,
            others: Vec::new(),
            extra: Vec::new(),
        }
    }

    /// 90° across 4 pixels: f = 2, and the outermost pixels look 1.5 / 2 aside.
    #[test]
    fn pixels_look_through_their_middles() {
        let pinhole = Pinhole::new(&camera(4, 2, std::f64::consts::FRAC_PI_2)).unwrap();
        assert!((pinhole.focal_px - 2.0).abs() < 1e-12);
        let near = |slopes: &[f64], expected: &[f64]| {
            slopes.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        assert!(near(&pinhole.right(), &[-0.75, -0.25, 0.25, 0.75]));
        assert!(near(&pinhole.down(), &[-0.25, 0.25]));
    }

    #[test]
    fn principal_points_differ_by_half_a_pixel() {
        let camera = camera(640, 480, std::f64::consts::FRAC_PI_2);
        let pinhole = Pinhole::new(&camera).unwrap();
        let (gz, classic) = (
            CameraCalibration::of_gz(&pinhole, &camera),
            CameraCalibration::of_classic(&pinhole, &camera),
        );
        assert_eq!((gz.k[2], gz.k[5], classic.k[2], classic.k[5]), (320.0, 240.0, 320.5, 240.5));
        assert!((gz.with_baseline(0.1).p[3] + 32.0).abs() < 1e-9);
    }

    #[test]
    fn invalid_cameras_are_rejected() {
        for (width, height, fov_rad) in
            [(0, 5, 1.0), (5, 5, 0.0), (5, 5, 3.2), (5, 5, f64::NAN), (u32::MAX, u32::MAX, 1.0)]
        {
            assert!(Pinhole::new(&camera(width, height, fov_rad)).is_err());
        }
    }
}
