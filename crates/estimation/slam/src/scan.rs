//! Beam ends of a scan, and checks of its fields.

use periplus_geometry::{LaserScan2, Pose2};
use periplus_scan_matching::{Cloud, CloudSettings};

/// Beams of a scan with more are joined by twos, threes and so on to keep to this.
const MOST_BEAMS: usize = 8192;

/// Ends of beams in the base's frame.
pub(crate) struct Ends {
    pub(crate) ends: Vec<Option<[f32; 2]>>,
    pub(crate) origin: [f32; 2],
    pub(crate) step_rad: f32,
}

impl Ends {
    /// Returns the beam ends in the frame of the base at the stamp. `motion` is the motion of the base per
    /// second, for deskewing; readings from `nearest_m` to `farthest_m` are used.
    pub(crate) fn new(
        scan: &LaserScan2,
        motion: Option<Pose2>,
        [nearest_m, farthest_m]: [f32; 2],
    ) -> Self {
        let every = scan.ranges_m.len().div_ceil(MOST_BEAMS).max(1);
        let base_from_scanner = scan.mounting.base_from_scanner;
        let least = scan.range_min_m.max(nearest_m).max(0.01);
        // A little below, for scanners round what they send.
        let most = (scan.range_max_m * 0.9995).min(farthest_m);
        let end = |index: usize, range: f32| {
            if !(range >= least && range < most) {
                return None;
            }
            let (s, c) = libm::sincos(scan.beam_angle_rad(index));
            let (x, y) = (f64::from(range) * c, f64::from(range) * s);
            let (mut x, mut y) = base_from_scanner.transform_point(x, y);
            if let Some(motion) = motion.filter(|_| scan.time_increment_s != 0.0) {
                let part = index as f64 * scan.time_increment_s;
                let moved = Pose2::new(motion.x_m * part, motion.y_m * part, motion.yaw_rad * part);
                (x, y) = moved.transform_point(x, y);
            }
            Some([x as f32, y as f32]).filter(|end| end[0].is_finite() && end[1].is_finite())
        };
        let ranges = scan.ranges_m.iter().copied().enumerate().step_by(every);
        Self {
            ends: ranges.map(|(index, range)| end(index, range)).collect(),
            origin: [base_from_scanner.x_m as f32, base_from_scanner.y_m as f32],
            step_rad: (scan.beam_step_rad() * every as f64) as f32,
        }
    }

    pub(crate) fn cloud(&self, settings: &CloudSettings) -> Cloud {
        Cloud::new(self.ends.iter().copied(), self.origin, self.step_rad, settings)
    }
}

/// Returns the reason for which the scan is unusable, if any.
pub(crate) fn fault(scan: &LaserScan2) -> Option<&'static str> {
    let is_finite = scan.mounting.base_from_scanner.is_finite()
        && scan.angle_min_rad.is_finite()
        && scan.angle_increment_rad.is_finite()
        && scan.time_increment_s.is_finite()
        && scan.range_min_m.is_finite()
        && !scan.range_max_m.is_nan();
    if !is_finite {
        Some("an angle, a limit of range or the pose of the scanner is not a finite number")
    } else if scan.ranges_m.len() > 1 && scan.angle_increment_rad == 0.0 {
        Some("all beams point in one direction: the increment of the angle is 0")
    } else {
        None
    }
}
