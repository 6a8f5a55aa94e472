//! Calibration of a differential drive and its scanner.

use std::fmt;

use nalgebra::{Matrix2, Matrix3, Matrix3x2, SymmetricEigen};
use periplus_geometry::Pose2;

use crate::delay::delay_s;
use crate::estimated::Estimated;
use crate::fit::{Interval, Parameters, Refined, refine};
use crate::scans::ScannerDisplacement;
use crate::wheels::{DifferentialDrive, WheelTrack, sine_ratios};

/// Minimum number of displacements for seven parameters.
const MIN_DISPLACEMENT_COUNT: usize = 20;

/// Number of rounds of fitting and of rejecting outliers.
const ROUND_COUNT: usize = 4;

/// Parameter of a calibration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveParameter {
    /// Radius of the left wheel.
    LeftRadius,
    /// Radius of the right wheel.
    RightRadius,
    /// Distance of the wheels.
    WheelDistance,
    /// Position of the scanner along x of the base.
    ScannerX,
    /// Position of the scanner along y of the base.
    ScannerY,
    /// Heading of the scanner in the base.
    ScannerYaw,
    /// Delay of the scans.
    Delay,
}

impl DriveParameter {
    /// All parameters, in the order of a fit.
    pub(crate) const ALL: [Self; 7] = [
        Self::LeftRadius,
        Self::RightRadius,
        Self::WheelDistance,
        Self::ScannerX,
        Self::ScannerY,
        Self::ScannerYaw,
        Self::Delay,
    ];

    /// Maximum standard error of a parameter that counts as observable: 5 % of a length of the drive, 5 cm,
    /// 3 degrees, 50 ms. Ten times what the calibration is for.
    fn max_standard_error(self, drive: &DifferentialDrive) -> f64 {
        match self {
            Self::LeftRadius => 0.05 * drive.left_radius_m,
            Self::RightRadius => 0.05 * drive.right_radius_m,
            Self::WheelDistance => 0.05 * drive.wheel_distance_m,
            Self::ScannerX | Self::ScannerY => 0.05,
            Self::ScannerYaw => 0.052,
            Self::Delay => 0.05,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::LeftRadius => "left wheel radius",
            Self::RightRadius => "right wheel radius",
            Self::WheelDistance => "wheel distance",
            Self::ScannerX => "scanner x",
            Self::ScannerY => "scanner y",
            Self::ScannerYaw => "scanner yaw",
            Self::Delay => "delay of the scans",
        }
    }
}

/// Parameters that a drive does not determine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotObservable {
    /// The parameters.
    pub parameters: Vec<DriveParameter>,
}

/// Reason for which there is no calibration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CalibrationError {
    /// Fewer displacements than needed are covered by the wheels' track.
    TooFew(usize),
    /// Some parameters are not determined.
    NotObservable(NotObservable),
}

impl CalibrationError {
    fn of(parameters: &[DriveParameter]) -> Self {
        Self::NotObservable(NotObservable { parameters: parameters.to_vec() })
    }
}

impl fmt::Display for CalibrationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew(count) => write!(
                f,
                "{count} displacements of the scanner are covered by the wheels; {MIN_DISPLACEMENT_COUNT} are \
                 needed: compare the stamps of scans and wheels, or record a longer drive"
            ),
            Self::NotObservable(NotObservable { parameters }) => {
                let names: Vec<&str> = parameters.iter().map(|it| it.name()).collect();
                write!(
                    f,
                    "the drive does not determine: {}; drive forward, along curves to the left and to the \
                     right, and turn on the spot, with changing speed",
                    names.join(", ")
                )
            }
        }
    }
}

impl std::error::Error for CalibrationError {}

/// Calibration of a differential drive and its scanner.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveCalibration {
    /// Radius of the left wheel \[m\].
    pub left_radius_m: Estimated,
    /// Radius of the right wheel \[m\].
    pub right_radius_m: Estimated,
    /// Distance of the wheels \[m\].
    pub wheel_distance_m: Estimated,
    /// Position of the scanner along x of the base \[m\].
    pub scanner_x_m: Estimated,
    /// Position of the scanner along y of the base \[m\].
    pub scanner_y_m: Estimated,
    /// Heading of the scanner in the base \[rad\].
    pub scanner_yaw_rad: Estimated,
    /// Delay of the scans \[s\]: a scan with the stamp t was measured at t - delay by the clock of the
    /// wheels.
    pub delay_s: Estimated,
    /// Error of x, y \[m\] and yaw \[rad\] of each displacement, with its stamp \[s\].
    pub residuals: Vec<(f64, [f64; 3])>,
    /// Number of displacements that were rejected as outliers.
    pub rejected_count: usize,
}

impl DriveCalibration {
    /// Returns the calibrated drive.
    #[must_use]
    pub fn drive(&self) -> DifferentialDrive {
        DifferentialDrive {
            left_radius_m: self.left_radius_m.value,
            right_radius_m: self.right_radius_m.value,
            wheel_distance_m: self.wheel_distance_m.value,
        }
    }

    /// Returns the calibrated pose of the scanner in the base frame.
    #[must_use]
    pub fn base_from_scanner(&self) -> Pose2 {
        Pose2::new(self.scanner_x_m.value, self.scanner_y_m.value, self.scanner_yaw_rad.value)
    }
}

/// Calibrates a differential drive, the pose of its scanner and the delay of its scans from wheel angles
/// and displacements of the scanner. `nominal` has the expected parameters of the drive, which are used for a
/// first estimate of the delay only; the delay is searched within ±`max_delay_s`.
///
/// The first estimate is the closed form of Censi, Franchi, Marchionni and Oriolo 2013, "Simultaneous
/// calibration of odometry and sensor parameters for mobile robots", IEEE T-RO 29(2). Maximum likelihood with
/// all samples of the wheels, the delay and the information of each displacement refines it; displacements
/// beyond the 99.9 % quantile are rejected. Standard errors follow from the residuals, also where those of
/// neighbouring displacements are correlated.
///
/// # Errors
/// When there are too few displacements, or some parameters are not observable.
pub fn calibrate_drive(
    track: &WheelTrack,
    displacements: &[ScannerDisplacement],
    nominal: &DifferentialDrive,
    max_delay_s: f64,
) -> Result<DriveCalibration, CalibrationError> {
    let intervals: Vec<Interval> = displacements
        .iter()
        .filter(|it| {
            track.angles_at(it.from_s - max_delay_s).is_some()
                && track.angles_at(it.to_s + max_delay_s).is_some()
        })
        .copied()
        .collect();
    if intervals.len() < MIN_DISPLACEMENT_COUNT {
        return Err(CalibrationError::TooFew(intervals.len()));
    }
    let delay = delay_s(track, nominal, &intervals, max_delay_s)
        .ok_or_else(|| CalibrationError::of(&[DriveParameter::Delay]))?;
    let (drive, scanner) =
        closed_form(track, &intervals, delay).map_err(|it| CalibrationError::of(&it))?;
    let start = Parameters { drive, scanner, delay_s: delay };
    let start = refine(track, &intervals, start, false);
    fit(track, &intervals, start, false)
}

/// Repeats a calibration of all parameters but the delay with displacements of a reference. See
/// [`calibrate_drive`].
pub(crate) fn recalibrate(
    track: &WheelTrack,
    displacements: &[ScannerDisplacement],
    start: &DriveCalibration,
) -> Result<DriveCalibration, CalibrationError> {
    let parameters = Parameters {
        drive: start.drive(),
        scanner: start.base_from_scanner(),
        delay_s: start.delay_s.value,
    };
    let is_inside = |it: &&ScannerDisplacement| parameters.error(track, it).is_some();
    let intervals: Vec<Interval> = displacements.iter().filter(is_inside).copied().collect();
    if intervals.len() < MIN_DISPLACEMENT_COUNT {
        return Err(CalibrationError::TooFew(intervals.len()));
    }
    let fitted = Refined::unfitted(track, &intervals, parameters);
    let found = fit(track, &intervals, fitted, true)?;
    Ok(DriveCalibration { delay_s: start.delay_s, ..found })
}

/// Rounds of rejecting outliers and of refinement.
fn fit(
    track: &WheelTrack,
    intervals: &[Interval],
    start: Refined,
    is_delay_known: bool,
) -> Result<DriveCalibration, CalibrationError> {
    let mut kept = intervals.to_vec();
    let mut fit = start;
    for _ in 1..ROUND_COUNT {
        let parameters = fit.parameters;
        let limit = fit.outlier_limit();
        let is_kept = |it: &&Interval| parameters.square(track, it).is_some_and(|it| it <= limit);
        kept = intervals.iter().filter(is_kept).copied().collect();
        if kept.len() < MIN_DISPLACEMENT_COUNT {
            return Err(CalibrationError::TooFew(kept.len()));
        }
        fit = refine(track, &kept, parameters, is_delay_known);
    }
    let drive = fit.parameters.drive;
    let missing: Vec<DriveParameter> = DriveParameter::ALL
        .into_iter()
        .zip(fit.standard_errors)
        .filter(|(it, _)| !(is_delay_known && *it == DriveParameter::Delay))
        .filter(|(it, error)| error.is_nan() || *error > it.max_standard_error(&drive))
        .map(|(it, _)| it)
        .collect();
    if !missing.is_empty() {
        return Err(CalibrationError::of(&missing));
    }
    let values = fit.parameters.values();
    let [
        left_radius_m,
        right_radius_m,
        wheel_distance_m,
        scanner_x_m,
        scanner_y_m,
        scanner_yaw_rad,
        delay_s,
    ] = std::array::from_fn(|index| Estimated {
        value: values[index],
        standard_error: fit.standard_errors[index],
    });
    let residual = |it: &Interval| Some((it.to_s, fit.parameters.error(track, it)?));
    Ok(DriveCalibration {
        left_radius_m,
        right_radius_m,
        wheel_distance_m,
        scanner_x_m,
        scanner_y_m,
        scanner_yaw_rad,
        delay_s,
        residuals: kept.iter().filter_map(residual).collect(),
        rejected_count: intervals.len() - kept.len(),
    })
}

/// Closed form of Censi et al. 2013, section V, for wheels that turn at constant speeds between two scans.
fn closed_form(
    track: &WheelTrack,
    intervals: &[Interval],
    delay_s: f64,
) -> Result<(DifferentialDrive, Pose2), Vec<DriveParameter>> {
    use DriveParameter::{LeftRadius, RightRadius, ScannerX, ScannerY, ScannerYaw, WheelDistance};
    let turns = |it: &Interval| {
        let from = track.angles_at(it.from_s - delay_s)?;
        let to = track.angles_at(it.to_s - delay_s)?;
        Some((to.0 - from.0, to.1 - from.1))
    };
    // The rotations are linear in both ratios of radius and distance (equation 17).
    let (mut normal, mut right) = (Matrix2::zeros(), nalgebra::Vector2::zeros());
    let rows: Vec<(f64, f64, &Interval)> = intervals
        .iter()
        .filter_map(|it| turns(it).map(|(left, right)| (left, right, it)))
        .collect();
    for (left_rad, right_rad, it) in &rows {
        let row = nalgebra::Vector2::new(*left_rad, *right_rad);
        normal += row * row.transpose();
        right += row * it.from_from_to.yaw_rad;
    }
    let ratios = normal
        .cholesky()
        .map(|factor| factor.solve(&right))
        .filter(|it| it.iter().all(|it| it.is_finite()))
        .ok_or_else(|| vec![LeftRadius, RightRadius, WheelDistance])?;
    // The others minimize a quadratic form with |(cos, sin)| = 1 of the scanner's heading (equation 20):
    // a over distance, x and y; b over cosine and sine; c between both.
    let (mut a, mut b, mut c) = (Matrix3::zeros(), Matrix2::zeros(), Matrix3x2::zeros());
    for (left_rad, right_rad, it) in &rows {
        let yaw_rad = ratios[0] * left_rad + ratios[1] * right_rad;
        let length = 0.5 * (ratios[1] * right_rad - ratios[0] * left_rad);
        let (along, across) = sine_ratios(yaw_rad);
        let (sine, cosine) = libm::sincos(yaw_rad);
        let (x, y) = (it.from_from_to.x_m, it.from_from_to.y_m);
        for (first, second) in [
            ([-length * along, 1.0 - cosine, sine], [x, -y]),
            ([-length * across, -sine, 1.0 - cosine], [y, x]),
        ] {
            let first = nalgebra::Vector3::from(first);
            let second = nalgebra::Vector2::from(second);
            a += first * first.transpose();
            b += second * second.transpose();
            c += first * second.transpose();
        }
    }
    let solved = a
        .cholesky()
        .map(|factor| factor.solve(&c))
        .ok_or_else(|| vec![WheelDistance, ScannerX, ScannerY])?;
    let eigen = SymmetricEigen::new(b - c.transpose() * solved);
    if !eigen.eigenvalues.iter().all(|it| it.is_finite()) {
        return Err(vec![ScannerYaw]);
    }
    let least = usize::from(eigen.eigenvalues[1] < eigen.eigenvalues[0]);
    let heading = eigen.eigenvectors.column(least).into_owned();
    let position = -(solved * heading);
    // The distance of the wheels is positive, which decides the sign.
    let sign = if position[0] < 0.0 { -1.0 } else { 1.0 };
    let (position, heading) = (sign * position, sign * heading);
    let wheel_distance_m = position[0];
    let drive = DifferentialDrive {
        left_radius_m: -ratios[0] * wheel_distance_m,
        right_radius_m: ratios[1] * wheel_distance_m,
        wheel_distance_m,
    };
    let is_valid = [drive.left_radius_m, drive.right_radius_m, wheel_distance_m]
        .iter()
        .all(|it| it.is_finite() && *it > 0.0);
    if !is_valid {
        return Err(vec![LeftRadius, RightRadius, WheelDistance]);
    }
    let yaw_rad = libm::atan2(heading[1], heading[0]);
    Ok((drive, Pose2::new(position[1], position[2], yaw_rad)))
}
