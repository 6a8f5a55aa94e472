//! Directions of a lidar's rays.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::DVec3;
use periplus_scene::ScanAxis;

use super::MAX_BEAMS;
use crate::Quirks;

/// Angles and counts of a lidar. The first of every pair is horizontal, the second vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LidarBeams {
    /// Number of rays that are cast.
    pub rays: [usize; 2],
    /// Number of ranges that are reported: rays times resolution.
    pub ranges: [usize; 2],
    /// Angle of the first range [rad].
    pub first_rad: [f64; 2],
    /// Angle of the last range [rad].
    pub last_rad: [f64; 2],
}

impl LidarBeams {
    pub(super) fn new(spec: &periplus_scene::LidarSpec) -> Result<Self, Box<Diagnostic>> {
        let axes = [&spec.horizontal, &spec.vertical];
        for (axis, name) in axes.into_iter().zip(["horizontal", "vertical"]) {
            check(axis, name)?;
        }
        // SDF: the number of ranges is an integer.
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "as Gazebo does; it saturates"
        )]
        let ranges =
            axes.map(|axis| (f64::from(axis.samples) * axis.resolution + 1e-9).max(1.0) as usize);
        let rays = axes.map(|axis| axis.samples as usize);
        for [across, up] in [rays, ranges] {
            if across.saturating_mul(up) > MAX_BEAMS {
                return Err(Diagnostic::error(
                    "too-many-beams",
                    format!("a lidar of {across} x {up} beams is more than {MAX_BEAMS}"),
                )
                .help("fewer `<samples>`, or a smaller `<resolution>`")
                .into());
            }
        }
        // A single beam has the middle direction.
        let ends = |axis: &ScanAxis, count: usize| {
            let (first, last) = (axis.min_angle_rad, axis.max_angle_rad);
            if count == 1 { [(first + last) / 2.0; 2] } else { [first, last] }
        };
        let [[left, right], [low, high]] = [ends(axes[0], ranges[0]), ends(axes[1], ranges[1])];
        Ok(Self { rays, ranges, first_rad: [left, low], last_rad: [right, high] })
    }

    /// Returns the angles between ranges [rad]: `(last - first) / (count - 1)`, as in Gazebo. For a
    /// single range 0, or with Gazebo's quirk 0/0 in the vertical.
    #[must_use]
    pub fn steps_rad(&self, quirks: Quirks) -> [f64; 2] {
        let mut steps = [0, 1].map(|axis| step(self.ends(axis), self.ranges[axis]));
        if quirks.nan_vertical_step && self.ranges[1] == 1 {
            steps[1] = f64::NAN;
        }
        steps
    }

    /// Returns the row that represents several rows in a 2D scan: the middle one, as ROS bridges do.
    #[must_use]
    pub fn middle_row(&self) -> std::ops::Range<usize> {
        let [columns, rows] = self.ranges;
        rows / 2 * columns..(rows / 2 + 1) * columns
    }

    /// Returns azimuth and elevation [rad] of all ranges, in order.
    pub fn range_angles(&self) -> impl Iterator<Item = [f64; 2]> + use<> {
        angles([self.ends(0), self.ends(1)], self.ranges)
    }

    /// Returns the directions of all ranges in the sensor's frame.
    pub fn range_directions(&self) -> impl Iterator<Item = DVec3> + use<> {
        grid([self.ends(0), self.ends(1)], self.ranges)
    }

    /// Returns the directions of all rays in the sensor's frame.
    pub(super) fn directions(&self) -> Vec<DVec3> {
        // A single ray from which several ranges are interpolated has the middle direction.
        let ends = [0, 1].map(|axis| {
            let [first, last] = self.ends(axis);
            if self.rays[axis] == 1 { [(first + last) / 2.0; 2] } else { [first, last] }
        });
        grid(ends, self.rays).collect()
    }

    fn ends(&self, axis: usize) -> [f64; 2] {
        [self.first_rad[axis], self.last_rad[axis]]
    }
}

#[expect(clippy::cast_precision_loss, reason = "fewer than 2^22")]
fn step([first, last]: [f64; 2], count: usize) -> f64 {
    if count > 1 { (last - first) / (count - 1) as f64 } else { 0.0 }
}

#[expect(clippy::cast_precision_loss, reason = "fewer than 2^22")]
fn angles(ends: [[f64; 2]; 2], counts: [usize; 2]) -> impl Iterator<Item = [f64; 2]> {
    let steps = [step(ends[0], counts[0]), step(ends[1], counts[1])];
    let angle = move |axis: usize, number: usize| ends[axis][0] + steps[axis] * number as f64;
    (0..counts[1])
        .flat_map(move |row| (0..counts[0]).map(move |column| [angle(0, column), angle(1, row)]))
}

/// Returns `(cos e cos a, cos e sin a, sin e)` of azimuths a and elevations e.
fn grid(ends: [[f64; 2]; 2], counts: [usize; 2]) -> impl Iterator<Item = DVec3> {
    // Sines and cosines of the azimuths are reused by all rows.
    let row: Vec<(f64, f64)> = angles([ends[0], [0.0; 2]], [counts[0], 1])
        .map(|[azimuth, _]| libm::sincos(azimuth))
        .collect();
    let column: Vec<(f64, f64)> = angles([[0.0; 2], ends[1]], [1, counts[1]])
        .map(|[_, elevation]| libm::sincos(elevation))
        .collect();
    (0..counts[0] * counts[1]).map(move |index| {
        let (sine, cosine) = row[index % row.len()];
        let (up, out) = column[index / row.len()];
        DVec3::new(out * cosine, out * sine, up)
    })
}

fn check(axis: &ScanAxis, name: &str) -> Result<(), Box<Diagnostic>> {
    let ScanAxis { samples, resolution, min_angle_rad, max_angle_rad } = *axis;
    let error = if samples == 0 || !(resolution > 0.0 && resolution.is_finite()) {
        Diagnostic::error("out-of-range", format!("a lidar without {name} beams cannot measure"))
            .help("set `<samples>` to at least 1 and `<resolution>` above 0")
    } else if !(min_angle_rad.is_finite() && max_angle_rad.is_finite()) {
        Diagnostic::error("out-of-range", format!("the {name} angles of a lidar are not finite"))
            .help("angles are in radians")
    } else {
        return Ok(());
    };
    Err(error.into())
}
