//! A scan, and the beams of it that are used.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose2;

/// Ranges along beams, as `sensor_msgs/LaserScan` has them, and where the scanner is on the robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Scan {
    /// Where the scanner is \[m, rad\]. With one that hangs upside down this is where it points after
    /// [`Scan::is_flipped`] is undone.
    pub base_from_laser: Pose2,
    /// Whether the scanner hangs upside down: its beams run clockwise as seen from above.
    pub is_flipped: bool,
    /// Direction of the first beam \[rad\].
    pub angle_min_rad: f64,
    /// From beam to beam \[rad\]; may be negative.
    pub angle_increment_rad: f64,
    /// Readings that are not longer mean nothing \[m\].
    pub range_min_m: f64,
    /// Readings that are not shorter saw nothing \[m\].
    pub range_max_m: f64,
    /// What the beams measured \[m\].
    pub ranges_m: Vec<f32>,
}

/// Which beams are used, and up to where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamLimits {
    /// How many beams are used, about: `max_beams`.
    pub most: usize,
    /// `laser_min_range` \[m\]; what the scan says unless above 0.
    pub range_min_m: f64,
    /// `laser_max_range` \[m\]; what the scan says unless above 0.
    pub range_max_m: f64,
}

/// How beams are taken from a scan with more of them than wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Thinning {
    /// So that first and last may both be used: (N - 1) / (M - 1), rounded down. There may be more
    /// than wanted.
    Between,
    /// N / M rounded up: never more than wanted.
    Within,
}

impl Thinning {
    /// Every how many beams one is used, of `count` when `most` are wanted.
    #[must_use]
    pub fn stride(self, count: usize, most: usize) -> usize {
        let stride = match self {
            Self::Between => count.saturating_sub(1) / most.saturating_sub(1).max(1),
            Self::Within => count.div_ceil(most.max(1)),
        };
        stride.max(1)
    }
}

/// A beam that is used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Beam {
    /// What it measured, no more than [`Beams::range_max_m`] \[m\].
    pub(crate) range_m: f64,
    /// Its direction in the frame of the base \[rad\].
    pub(crate) bearing_rad: f64,
    /// Where it ended in the frame of the base \[m\].
    pub(crate) end_m: [f64; 2],
}

/// Beams that are used.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Beams {
    pub(crate) base_from_laser: Pose2,
    pub(crate) range_max_m: f64,
    pub(crate) beams: Vec<Beam>,
}

impl Beams {
    /// Those that measured anything, also nothing within reach; not those without a number.
    pub(crate) fn new(
        scan: &Scan,
        limits: &BeamLimits,
        thinning: Thinning,
    ) -> Result<Self, Box<Diagnostic>> {
        let limit = |limit: f64| Some(limit).filter(|limit| *limit > 0.0);
        let (mut low, mut high) = (scan.range_min_m, scan.range_max_m);
        if let Some(limit) = limit(limits.range_min_m) {
            low = low.max(limit);
        }
        if let Some(limit) = limit(limits.range_max_m) {
            high = if high.is_nan() { limit } else { high.min(limit) };
        }
        check(scan, low, high)?;
        let sign = if scan.is_flipped { -1.0 } else { 1.0 };
        let stride = thinning.stride(scan.ranges_m.len(), limits.most);
        let used = scan.ranges_m.iter().enumerate().step_by(stride);
        let beam = |(index, &range): (usize, &f32)| {
            let range = f64::from(range);
            let range_m = if range <= low { high } else { range.min(high) };
            let angle = sign * (scan.angle_min_rad + index as f64 * scan.angle_increment_rad);
            let (sine, cosine) = libm::sincos(angle);
            let (x, y) = scan.base_from_laser.transform_point(range_m * cosine, range_m * sine);
            let bearing_rad = scan.base_from_laser.yaw_rad + angle;
            Beam { range_m, bearing_rad, end_m: [x, y] }
        };
        let beams = used.filter(|(_, range)| !range.is_nan()).map(beam).collect();
        Ok(Self { base_from_laser: scan.base_from_laser, range_max_m: high, beams })
    }

    /// Where beams ended that hit something, in the frame of the base \[m\].
    pub(crate) fn ends(&self) -> Vec<[f32; 2]> {
        let hits = self.beams.iter().filter(|beam| beam.range_m < self.range_max_m);
        hits.map(|beam| beam.end_m.map(|it| it as f32)).collect()
    }
}

/// What makes a scan useless.
fn check(scan: &Scan, low: f64, high: f64) -> Result<(), Box<Diagnostic>> {
    let error = |code, message: &str, help: &str| {
        Err(Box::new(Diagnostic::error(code, message).help(help.to_owned())))
    };
    if scan.ranges_m.is_empty() {
        return error(
            "empty-scan",
            "the scan has no ranges",
            "check that the driver fills `ranges`, and `scan_topic`",
        );
    }
    let angles = [scan.angle_min_rad, scan.angle_increment_rad];
    if !(scan.base_from_laser.is_finite() && angles.iter().all(|angle| angle.is_finite())) {
        return error(
            "bad-scan",
            "an angle of the scan or the place of the scanner on the robot is not a finite number",
            "check `angle_min`, `angle_increment` and the scanner's transform",
        );
    }
    if scan.ranges_m.len() > 1 && scan.angle_increment_rad == 0.0 {
        return error(
            "bad-scan",
            "all beams of the scan point in one direction",
            "its `angle_increment` is 0: check the driver",
        );
    }
    if !(high.is_finite() && high > 0.0 && low < high) {
        return error(
            "bad-scan-limits",
            &format!("the scan measures from {low} m to {high} m: no reading can be in between"),
            "check `range_min`, `range_max` of the scan, `laser_min_range` and `laser_max_range`",
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scan(ranges_m: Vec<f32>) -> Scan {
        Scan {
            base_from_laser: Pose2::new(0.5, 0.0, 0.0),
            is_flipped: false,
            angle_min_rad: 0.0,
            angle_increment_rad: std::f64::consts::FRAC_PI_2,
            range_min_m: 0.125,
            range_max_m: 10.0,
            ranges_m,
        }
    }

    const LIMITS: BeamLimits = BeamLimits { most: 60, range_min_m: -1.0, range_max_m: 8.0 };

    #[test]
    fn strides_are_those_of_the_models() {
        let strides = [(360, 60), (61, 60), (60, 60), (5, 60), (3600, 2)]
            .map(|(n, m)| (Thinning::Between.stride(n, m), Thinning::Within.stride(n, m)));
        assert_eq!(strides, [(6, 6), (1, 2), (1, 1), (1, 1), (3599, 1800)]);
    }

    #[test]
    fn too_short_is_nothing_seen_and_no_number_is_no_beam() {
        let scan = scan(vec![2.0, 0.125, f32::NAN, f32::INFINITY]);
        let beams = Beams::new(&scan, &LIMITS, Thinning::Between).unwrap();
        assert_eq!(beams.range_max_m, 8.0);
        let ranges: Vec<f64> = beams.beams.iter().map(|beam| beam.range_m).collect();
        assert_eq!(ranges, [2.0, 8.0, 8.0]);
        assert_eq!(beams.ends(), [[2.5, 0.0]]);
    }

    #[test]
    fn upside_down_beams_run_the_other_way() {
        let mut scan = scan(vec![1.0, 1.0]);
        scan.is_flipped = true;
        let beams = Beams::new(&scan, &LIMITS, Thinning::Between).unwrap();
        assert!((beams.beams[1].end_m[1] + 1.0).abs() < 1e-12, "{beams:?}");
    }

    #[test]
    fn useless_scans_are_told() {
        let told = |scan: Scan| Beams::new(&scan, &LIMITS, Thinning::Between).unwrap_err().code;
        assert_eq!(told(scan(vec![])), "empty-scan");
        assert_eq!(told(Scan { angle_min_rad: f64::NAN, ..scan(vec![1.0]) }), "bad-scan");
        assert_eq!(told(Scan { angle_increment_rad: 0.0, ..scan(vec![1.0; 2]) }), "bad-scan");
        assert_eq!(told(Scan { range_min_m: 9.0, ..scan(vec![1.0]) }), "bad-scan-limits");
        assert_eq!(told(Scan { range_max_m: 0.0, ..scan(vec![1.0]) }), "bad-scan-limits");
    }
}
