//! Faults of mounting and axes that a drive shows for certain, undone in its data: then the map can be
//! made again without them.

use std::f64::consts::FRAC_PI_2;
use std::fmt;

use periplus_geometry::{LaserScan2, Pose2, normalize_angle};

use crate::remark::{Remark, RemarkKind};

/// Correction of a scanner mounting or of odometry axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MountingCorrection {
    /// The scanner is taken as one that hangs upside down, or the other way round.
    Flip,
    /// The scanner is turned by this \[rad\].
    Turn(f64),
    /// `x` and `y` of odometry are swapped back.
    SwapAxes,
    /// `x` of odometry gets the other sign.
    NegateX,
    /// `y` of odometry gets the other sign.
    NegateY,
    /// Every step of odometry is taken the other way round.
    Reverse,
}

/// Mountings are by quarter turns; an angle this near to one is one \[rad\].
const QUARTER_RAD: f64 = 0.1;
/// Smaller angles are reported but not corrected: a drive that pulls to one side looks the same \[rad\].
const LEAST_TURN_RAD: f64 = 0.3;

impl MountingCorrection {
    /// Returns the correction of the fault that the remarks report, if any.
    ///
    /// A reversed drive looks mirrored while it has only rotated, so that the more specific fault has
    /// priority.
    #[must_use]
    pub fn of(remarks: &[Remark]) -> Option<Self> {
        let first = |pick: fn(&RemarkKind) -> Option<Self>| {
            remarks.iter().find_map(|remark| pick(&remark.kind))
        };
        first(|kind| matches!(kind, RemarkKind::OdometryReversed).then_some(Self::Reverse))
            .or_else(|| {
                first(|kind| match kind {
                    RemarkKind::OdometryAxesSwapped => Some(Self::SwapAxes),
                    RemarkKind::OdometryXNegated => Some(Self::NegateX),
                    RemarkKind::OdometryYNegated => Some(Self::NegateY),
                    _ => None,
                })
            })
            .or_else(|| {
                first(|kind| matches!(kind, RemarkKind::ScanMirrored).then_some(Self::Flip))
            })
            .or_else(|| {
                first(|kind| match *kind {
                    RemarkKind::ScannerYaw(turn_rad) if turn_rad.abs() > LEAST_TURN_RAD => {
                        let quarter_rad = (turn_rad / FRAC_PI_2).round() * FRAC_PI_2;
                        let is_quarter = (turn_rad - quarter_rad).abs() < QUARTER_RAD;
                        Some(Self::Turn(if is_quarter { quarter_rad } else { turn_rad }))
                    }
                    _ => None,
                })
            })
    }

    /// A scan without the fault.
    fn scan(self, scan: &LaserScan2) -> LaserScan2 {
        let mut scan = scan.clone();
        match self {
            Self::Flip => scan.mounting.is_upside_down = !scan.mounting.is_upside_down,
            Self::Turn(turn_rad) => {
                let Pose2 { x_m, y_m, yaw_rad } = scan.mounting.base_from_scanner;
                scan.mounting.base_from_scanner =
                    Pose2::new(x_m, y_m, normalize_angle(yaw_rad + turn_rad));
            }
            Self::SwapAxes | Self::NegateX | Self::NegateY | Self::Reverse => {}
        }
        scan
    }

    /// Odometry without the fault. `before` is odometry at the scan before, as it came and as it was
    /// corrected; [`CorrectedInput`] keeps it.
    fn odometry(self, now: Pose2, before: &mut Option<(Pose2, Pose2)>) -> Pose2 {
        match self {
            Self::Flip | Self::Turn(_) => now,
            Self::SwapAxes => Pose2::new(now.y_m, now.x_m, now.yaw_rad),
            Self::NegateX => Pose2::new(-now.x_m, now.y_m, now.yaw_rad),
            Self::NegateY => Pose2::new(now.x_m, -now.y_m, now.yaw_rad),
            Self::Reverse => {
                let corrected = match *before {
                    Some((raw, corrected)) => {
                        let step = (raw.inverse() * now).normalized();
                        let back = Pose2::new(-step.x_m, -step.y_m, -step.yaw_rad);
                        (corrected * back).normalized()
                    }
                    None => now,
                };
                *before = Some((now, corrected));
                corrected
            }
        }
    }
}

impl fmt::Display for MountingCorrection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flip => f.write_str(
                "scans are taken as those of a scanner that hangs upside down; if odometry turns with \
                 the wrong sign instead (left and right wheels swapped), the map is a mirror image",
            ),
            Self::Turn(turn_rad) => write!(
                f,
                "the scanner is taken as turned by {:+.0} degrees against its transform",
                turn_rad.to_degrees()
            ),
            Self::SwapAxes => f.write_str("x and y of odometry are swapped back"),
            Self::NegateX => f.write_str("x of odometry is taken with the other sign"),
            Self::NegateY => f.write_str("y of odometry is taken with the other sign"),
            Self::Reverse => f.write_str("odometry is taken the other way round, step by step"),
        }
    }
}

/// A remedy at work on a log, scan by scan.
#[derive(Clone, Debug)]
pub struct CorrectedInput {
    remedy: MountingCorrection,
    /// Odometry at the scan before, as it came and as it was corrected.
    before: Option<(Pose2, Pose2)>,
}

impl CorrectedInput {
    /// For a log from its first scan on.
    #[must_use]
    pub const fn new(remedy: MountingCorrection) -> Self {
        Self { remedy, before: None }
    }

    /// The fault that is undone.
    #[must_use]
    pub const fn remedy(&self) -> MountingCorrection {
        self.remedy
    }

    /// A scan and where odometry has the robot at its time, without the fault.
    pub fn apply(
        &mut self,
        scan: &LaserScan2,
        odom_from_base: Option<Pose2>,
    ) -> (LaserScan2, Option<Pose2>) {
        (self.remedy.scan(scan), odom_from_base.map(|now| self.odometry(now)))
    }

    /// Odometry alone, where no scan is needed.
    pub fn odometry(&mut self, odom_from_base: Pose2) -> Pose2 {
        self.remedy.odometry(odom_from_base, &mut self.before)
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::ScannerMounting;

    use super::*;

    fn remark(kind: RemarkKind) -> Remark {
        Remark { time_ns: 0, kind }
    }

    /// A drive of 1 m ahead and 0.5 rad to the left, counted with the wrong sign, is what it was.
    #[test]
    fn steps_that_went_backwards_go_ahead() {
        let scan = LaserScan2 {
            time_ns: 0,
            mounting: ScannerMounting::upright(Pose2::IDENTITY),
            angle_min_rad: 0.0,
            angle_increment_rad: 0.1,
            time_increment_s: 0.0,
            range_min_m: 0.0,
            range_max_m: 10.0,
            ranges_m: vec![],
        };
        let step = Pose2::new(1.0, 0.0, 0.5);
        let counted = Pose2::new(-1.0, 0.0, -0.5);
        let mut cure = CorrectedInput::new(MountingCorrection::Reverse);
        let start = Pose2::new(2.0, 3.0, 0.3);
        let _ = cure.apply(&scan, Some(start));
        let (_, once) = cure.apply(&scan, Some(start * counted));
        let (_, twice) = cure.apply(&scan, Some(start * counted * counted));
        let right = start * step * step;
        let found = once.unwrap().inverse() * twice.unwrap();
        assert!((found.x_m - 1.0).abs() < 1e-9 && (found.yaw_rad - 0.5).abs() < 1e-9);
        assert!((twice.unwrap().x_m - right.x_m).abs() < 1e-9);
    }

    /// A drive that has only rotated looks mirrored; a quarter turn with an error of 0.3 degrees is one.
    #[test]
    fn the_more_special_fault_counts() {
        let remarks = [remark(RemarkKind::ScanMirrored), remark(RemarkKind::OdometryReversed)];
        assert_eq!(MountingCorrection::of(&remarks), Some(MountingCorrection::Reverse));
        let turned = [remark(RemarkKind::ScannerYaw(-FRAC_PI_2 + 0.005))];
        assert_eq!(MountingCorrection::of(&turned), Some(MountingCorrection::Turn(-FRAC_PI_2)));
        assert_eq!(MountingCorrection::of(&[remark(RemarkKind::ScannerYaw(0.12))]), None);
        assert_eq!(MountingCorrection::of(&[remark(RemarkKind::DistanceScale(1.1))]), None);
    }
}
