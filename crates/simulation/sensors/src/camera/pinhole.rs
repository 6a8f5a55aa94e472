//! Where the pixels of a camera look, and what a camera info says of them.

use periplus_diagnostics::Diagnostic;
use periplus_scene::Camera;

/// The most pixels of one camera: four times 8K. More is taken for a slip of the pen.
pub const MOST_PIXELS: u64 = 4 * 7680 * 4320;

/// A camera without a lens. Its own frame looks along x, y to the left, z up; the optical frame
/// along z, x to the right, y down (REP 103).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pinhole {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Focal length, the same both ways: `width / (2 tan(fov / 2))` [px].
    pub focal_px: f64,
}

impl Pinhole {
    /// Of a camera as a file describes it.
    ///
    /// # Errors
    /// When there are no pixels or too many, or no angle between 0 and half a turn.
    pub fn new(camera: &Camera) -> Result<Self, Box<Diagnostic>> {
        let Camera { width, height, horizontal_fov_rad: fov_rad, .. } = *camera;
        let pixels = u64::from(width) * u64::from(height);
        if pixels == 0 || pixels > MOST_PIXELS {
            return Err(Diagnostic::error(
                "out-of-range",
                format!("a camera of {width} x {height} pixels is not possible"),
            )
            .help(format!("at least one pixel, at most {MOST_PIXELS}"))
            .into());
        }
        if !(fov_rad > 0.0 && fov_rad < std::f64::consts::PI) {
            return Err(Diagnostic::error(
                "out-of-range",
                format!("a flat image cannot show {fov_rad} rad"),
            )
            .help("`<horizontal_fov>` lies between 0 and pi (3.14159)")
            .into());
        }
        let focal_px = f64::from(width) / (2.0 * libm::tan(fov_rad / 2.0));
        Ok(Self { width, height, focal_px })
    }

    /// How many pixels there are.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Slopes to the right of all columns: x over z in the optical frame, through the middle of the
    /// pixels.
    #[must_use]
    pub fn right(&self) -> Vec<f64> {
        slopes(self.width, self.focal_px)
    }

    /// Slopes down of all rows: y over z in the optical frame.
    #[must_use]
    pub fn down(&self) -> Vec<f64> {
        slopes(self.height, self.focal_px)
    }
}

fn slopes(count: u32, focal_px: f64) -> Vec<f64> {
    let middle = (f64::from(count) - 1.0) / 2.0;
    (0..count).map(|pixel| (f64::from(pixel) - middle) / focal_px).collect()
}

/// The numbers of a camera info (REP 104), by row where they are matrices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibration {
    /// Distortion: k1, k2, p1, p2, k3 (`plumb_bob`).
    pub d: [f64; 5],
    /// Focal lengths and principal point of the image as it is.
    pub k: [f64; 9],
    /// Rotation to rectified axes.
    pub r: [f64; 9],
    /// Projection of rectified points.
    pub p: [f64; 12],
}

impl Calibration {
    /// Of a camera with a principal point at the corner between the middle pixels, as
    /// gz-sensors has it: `width / 2`, `height / 2`.
    #[must_use]
    pub fn of_gz(pinhole: &Pinhole, camera: &Camera) -> Self {
        let middle = [f64::from(pinhole.width) / 2.0, f64::from(pinhole.height) / 2.0];
        Self::new(pinhole.focal_px, middle, camera)
    }

    /// Of a camera as the ROS plugins of Classic have it: `(width + 1) / 2`, `(height + 1) / 2`.
    #[must_use]
    pub fn of_classic(pinhole: &Pinhole, camera: &Camera) -> Self {
        let middle = [pinhole.width, pinhole.height].map(|pixels| (f64::from(pixels) + 1.0) / 2.0);
        Self::new(pinhole.focal_px, middle, camera)
    }

    /// From a focal length and a principal point [px], and the distortion of a camera.
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

    /// The right one of a stereo pair at this distance from the left [m]: `Tx = -f · baseline`.
    #[must_use]
    pub fn with_baseline(mut self, baseline_m: f64) -> Self {
        self.p[3] = -self.p[0] * baseline_m;
        self
    }
}

#[cfg(test)]
mod tests {
    use periplus_scene::{CameraKind, Noise};

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
            noise: Noise::default(),
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

    /// A right angle across 4 pixels: f = 2, and the outermost pixels look 1.5 / 2 aside.
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
        let (gz, classic) =
            (Calibration::of_gz(&pinhole, &camera), Calibration::of_classic(&pinhole, &camera));
        assert_eq!((gz.k[2], gz.k[5], classic.k[2], classic.k[5]), (320.0, 240.0, 320.5, 240.5));
        assert!((gz.with_baseline(0.1).p[3] + 32.0).abs() < 1e-9);
    }

    #[test]
    fn impossible_cameras_are_told() {
        for (width, height, fov_rad) in
            [(0, 5, 1.0), (5, 5, 0.0), (5, 5, 3.2), (5, 5, f64::NAN), (u32::MAX, u32::MAX, 1.0)]
        {
            assert!(Pinhole::new(&camera(width, height, fov_rad)).is_err());
        }
    }
}
