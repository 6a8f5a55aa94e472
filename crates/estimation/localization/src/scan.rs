//! Selection of the beams of a scan.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{LaserScan2, Pose2};

use crate::sensor_model::SensorModel;

/// Approximate number of beams for scan matching; more beams do not improve it.
const MATCHING_BEAMS: usize = 180;

/// Limits of the beams that are used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamLimits {
    /// Approximate maximum number of beams: `max_beams`.
    pub max_beams: usize,
    /// `laser_min_range` \[m\]; the minimum range of the scan unless above 0.
    pub range_min_m: f64,
    /// `laser_max_range` \[m\]; the maximum range of the scan unless above 0.
    pub range_max_m: f64,
}

/// Step between the used beams of a scan with more beams than `max_beams`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BeamStep {
    /// `(N - 1) / (M - 1)`, rounded down, as in Nav2's beam and likelihood field models. The number
    /// of beams may exceed the maximum.
    RoundedDown,
    /// `N / M`, rounded up, as in Nav2's `likelihood_field_prob` model.
    RoundedUp,
}

impl BeamStep {
    /// Step between used beams, for `count` beams of which at most `max_beams` are wanted.
    #[must_use]
    pub fn step(self, count: usize, max_beams: usize) -> usize {
        let step = match self {
            Self::RoundedDown => count.saturating_sub(1) / max_beams.saturating_sub(1).max(1),
            Self::RoundedUp => count.div_ceil(max_beams.max(1)),
        };
        step.max(1)
    }
}

/// Beam that is used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Beam {
    /// Measured range, at most [`Beams::range_max_m`] \[m\].
    pub(crate) range_m: f64,
    /// Bearing in the base frame \[rad\].
    pub(crate) bearing_rad: f64,
    /// End point in the base frame \[m\].
    pub(crate) end_m: [f64; 2],
}

/// Beams that are used.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Beams {
    pub(crate) base_from_scanner: Pose2,
    pub(crate) range_max_m: f64,
    pub(crate) beams: Vec<Beam>,
}

impl Beams {
    /// Selects beams of a scan. Maximum range readings are kept, NaN readings are dropped.
    pub(crate) fn new(
        scan: &LaserScan2,
        limits: &BeamLimits,
        beam_step: BeamStep,
    ) -> Result<Self, Box<Diagnostic>> {
        let limit = |limit: f64| Some(limit).filter(|limit| *limit > 0.0);
        let (mut low, mut high) = (f64::from(scan.range_min_m), f64::from(scan.range_max_m));
        if let Some(limit) = limit(limits.range_min_m) {
            low = low.max(limit);
        }
        if let Some(limit) = limit(limits.range_max_m) {
            high = if high.is_nan() { limit } else { high.min(limit) };
        }
        check(scan, low, high)?;
        let base_from_scanner = scan.mounting.base_from_scanner;
        let step = beam_step.step(scan.ranges_m.len(), limits.max_beams);
        let used = scan.ranges_m.iter().enumerate().step_by(step);
        let beam = |(index, &range): (usize, &f32)| {
            let range = f64::from(range);
            let range_m = if range <= low { high } else { range.min(high) };
            let angle = scan.beam_angle_rad(index);
            let (sine, cosine) = libm::sincos(angle);
            let (x, y) = base_from_scanner.transform_point(range_m * cosine, range_m * sine);
            let bearing_rad = base_from_scanner.yaw_rad + angle;
            Beam { range_m, bearing_rad, end_m: [x, y] }
        };
        let beams = used.filter(|(_, range)| !range.is_nan()).map(beam).collect();
        Ok(Self { base_from_scanner, range_max_m: high, beams })
    }

    /// End points of the beams that hit an obstacle, in the base frame \[m\].
    pub(crate) fn ends(&self) -> Vec<[f32; 2]> {
        let hits = self.beams.iter().filter(|beam| beam.range_m < self.range_max_m);
        hits.map(|beam| beam.end_m.map(|it| it as f32)).collect()
    }
}

/// Scan for scan matching, with more beams than the particle filter uses.
#[derive(Clone, Debug)]
pub(crate) struct MatchingScan {
    pub(crate) beams: Beams,
    /// End points of the beams that hit an obstacle, in the base frame \[m\].
    pub(crate) ends: Vec<[f32; 2]>,
}

impl MatchingScan {
    pub(crate) fn new(scan: &LaserScan2, limits: &BeamLimits) -> Result<Self, Box<Diagnostic>> {
        let limits = BeamLimits { max_beams: MATCHING_BEAMS.max(limits.max_beams), ..*limits };
        let beams = Beams::new(scan, &limits, SensorModel::LikelihoodField.beam_step())?;
        Ok(Self { ends: beams.ends(), beams })
    }
}

/// Checks that a scan can be used.
fn check(scan: &LaserScan2, low: f64, high: f64) -> Result<(), Box<Diagnostic>> {
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
    if !(scan.mounting.base_from_scanner.is_finite()
        && angles.iter().all(|angle| angle.is_finite()))
    {
        return error(
            "bad-scan",
            "an angle of the scan or the pose of the scanner on the robot is not finite",
            "check `angle_min`, `angle_increment` and the scanner's transform",
        );
    }
    if scan.ranges_m.len() > 1 && scan.angle_increment_rad == 0.0 {
        return error(
            "bad-scan",
            "all beams of the scan have the same direction",
            "its `angle_increment` is 0: check the driver",
        );
    }
    if !(high.is_finite() && high > 0.0 && low < high) {
        return error(
            "bad-scan-limits",
            &format!("the range limits of the scan, {low} m to {high} m, leave no valid reading"),
            "check `range_min`, `range_max` of the scan, `laser_min_range` and `laser_max_range`",
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use periplus_geometry::ScannerMounting;

    use super::*;

    fn scan(ranges_m: Vec<f32>) -> LaserScan2 {
        LaserScan2 {
            time_ns: 0,
            mounting: ScannerMounting::upright(Pose2::new(0.5, 0.0, 0.0)),
            time_increment_s: 0.0,
            angle_min_rad: 0.0,
            angle_increment_rad: std::f64::consts::FRAC_PI_2,
            range_min_m: 0.125,
            range_max_m: 10.0,
            ranges_m,
        }
    }

    const LIMITS: BeamLimits = BeamLimits { max_beams: 60, range_min_m: -1.0, range_max_m: 8.0 };

    #[test]
    fn steps_are_those_of_the_nav2_models() {
        let steps = [(360, 60), (61, 60), (60, 60), (5, 60), (3600, 2)]
            .map(|(n, m)| (BeamStep::RoundedDown.step(n, m), BeamStep::RoundedUp.step(n, m)));
        assert_eq!(steps, [(6, 6), (1, 2), (1, 1), (1, 1), (3599, 1800)]);
    }

    #[test]
    fn short_readings_become_maximum_range_and_nan_is_dropped() {
        let scan = scan(vec![2.0, 0.125, f32::NAN, f32::INFINITY]);
        let beams = Beams::new(&scan, &LIMITS, BeamStep::RoundedDown).unwrap();
        assert_eq!(beams.range_max_m, 8.0);
        let ranges: Vec<f64> = beams.beams.iter().map(|beam| beam.range_m).collect();
        assert_eq!(ranges, [2.0, 8.0, 8.0]);
        assert_eq!(beams.ends(), [[2.5, 0.0]]);
    }

    #[test]
    fn upside_down_beams_run_the_other_way() {
        let mut scan = scan(vec![1.0, 1.0]);
        scan.mounting.is_upside_down = true;
        let beams = Beams::new(&scan, &LIMITS, BeamStep::RoundedDown).unwrap();
        assert!((beams.beams[1].end_m[1] + 1.0).abs() < 1e-12, "{beams:?}");
    }

    #[test]
    fn useless_scans_are_rejected() {
        let code =
            |scan: LaserScan2| Beams::new(&scan, &LIMITS, BeamStep::RoundedDown).unwrap_err().code;
        assert_eq!(code(scan(vec![])), "empty-scan");
        assert_eq!(code(LaserScan2 { angle_min_rad: f64::NAN, ..scan(vec![1.0]) }), "bad-scan");
        assert_eq!(code(LaserScan2 { angle_increment_rad: 0.0, ..scan(vec![1.0; 2]) }), "bad-scan");
        assert_eq!(code(LaserScan2 { range_min_m: 9.0, ..scan(vec![1.0]) }), "bad-scan-limits");
        assert_eq!(code(LaserScan2 { range_max_m: 0.0, ..scan(vec![1.0]) }), "bad-scan-limits");
    }
}
