//! A scan as it comes in.

use periplus_geometry::Pose2;
use periplus_scan_matching::{Cloud, CloudSettings};

/// Ranges along beams, as `sensor_msgs/LaserScan` has them, and where the scanner is on the robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Scan {
    /// Stamp of the first beam \[ns\].
    pub time_ns: i64,
    /// Pose of the scanner \[m, rad\]; for a scanner mounted upside down, its direction after
    /// [`Scan::is_flipped`] is undone.
    pub base_from_laser: Pose2,
    /// True if the scanner is mounted upside down: its beams run clockwise seen from above.
    pub is_flipped: bool,
    /// Direction of the first beam \[rad\].
    pub angle_min_rad: f64,
    /// From beam to beam \[rad\]; may be negative.
    pub angle_increment_rad: f64,
    /// From beam to beam \[s\]; 0 when all were at once.
    pub time_increment_s: f64,
    /// Nearer readings mean nothing \[m\].
    pub range_min_m: f32,
    /// Readings at or above saw nothing \[m\].
    pub range_max_m: f32,
    /// Measured ranges \[m\]; values that are not positive numbers are no returns.
    pub ranges_m: Vec<f32>,
}

/// Beams of a scan with more are joined by twos, threes and so on to keep to this.
const MOST_BEAMS: usize = 8192;

/// Ends of beams in the base's frame.
pub(crate) struct Ends {
    pub(crate) ends: Vec<Option<[f32; 2]>>,
    pub(crate) origin: [f32; 2],
    pub(crate) step_rad: f32,
}

impl Scan {
    /// Returns the beam ends in the frame of the base at the stamp. `motion` is the motion of the base per
    /// second, for deskewing; readings from `nearest_m` to `farthest_m` are used.
    pub(crate) fn ends(&self, motion: Option<Pose2>, [nearest_m, farthest_m]: [f32; 2]) -> Ends {
        let every = self.ranges_m.len().div_ceil(MOST_BEAMS).max(1);
        let sign = if self.is_flipped { -1.0 } else { 1.0 };
        let least = self.range_min_m.max(nearest_m).max(0.01);
        // A little below, for scanners round what they send.
        let most = (self.range_max_m * 0.9995).min(farthest_m);
        let end = |index: usize, range: f32| {
            if !(range >= least && range < most) {
                return None;
            }
            let angle = sign * (self.angle_min_rad + index as f64 * self.angle_increment_rad);
            let (s, c) = libm::sincos(angle);
            let (x, y) = (f64::from(range) * c, f64::from(range) * s);
            let (mut x, mut y) = self.base_from_laser.transform_point(x, y);
            if let Some(motion) = motion.filter(|_| self.time_increment_s != 0.0) {
                let part = index as f64 * self.time_increment_s;
                let moved = Pose2::new(motion.x_m * part, motion.y_m * part, motion.yaw_rad * part);
                (x, y) = moved.transform_point(x, y);
            }
            Some([x as f32, y as f32]).filter(|end| end[0].is_finite() && end[1].is_finite())
        };
        let ranges = self.ranges_m.iter().copied().enumerate().step_by(every);
        Ends {
            ends: ranges.map(|(index, range)| end(index, range)).collect(),
            origin: [self.base_from_laser.x_m as f32, self.base_from_laser.y_m as f32],
            step_rad: (sign * self.angle_increment_rad * every as f64) as f32,
        }
    }

    /// Returns the reason for which the scan is unusable, if any.
    pub(crate) fn fault(&self) -> Option<&'static str> {
        let is_finite = self.base_from_laser.is_finite()
            && self.angle_min_rad.is_finite()
            && self.angle_increment_rad.is_finite()
            && self.time_increment_s.is_finite()
            && self.range_min_m.is_finite()
            && !self.range_max_m.is_nan();
        if !is_finite {
            Some("an angle, a limit of range or the pose of the scanner is not a finite number")
        } else if self.ranges_m.len() > 1 && self.angle_increment_rad == 0.0 {
            Some("all beams point in one direction: the increment of the angle is 0")
        } else {
            None
        }
    }
}

impl Ends {
    pub(crate) fn cloud(&self, settings: &CloudSettings) -> Cloud {
        Cloud::new(self.ends.iter().copied(), self.origin, self.step_rad, settings)
    }
}
