//! Prediction of the errors of odometry in the second half of a drive.

use std::fmt;

use periplus_geometry::{LaserScan2, Pose2};

use crate::drive::{CalibrationError, DriveCalibration, calibrate_drive};
use crate::error_model::{OdometryErrorModel, RelativeError};
use crate::reference::{odometry_poses, refine_with_slam, slam_poses};
use crate::scans::ScannerDisplacement;
use crate::wheels::{DifferentialDrive, WheelTrack};

/// Errors of odometry in the second half of a drive, as predicted and as measured.
#[derive(Clone, Debug, PartialEq)]
pub struct SecondHalf {
    /// Stamp at the middle of the path \[s\].
    pub middle_s: f64,
    /// Calibration of the first half.
    pub calibration: DriveCalibration,
    /// Model of the errors in the first half.
    pub model: OdometryErrorModel,
    /// Prediction from the model and the odometry of the second half.
    pub predicted: Vec<RelativeError>,
    /// Measurement against SLAM with the scans of the second half alone, at the same lengths.
    pub measured: Vec<RelativeError>,
}

/// Reason for which there is no prediction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PredictionError {
    /// The first half does not determine the calibration.
    Calibration(CalibrationError),
    /// The path of a half is too short: its length in whole metres.
    TooShort(u32),
}

impl fmt::Display for PredictionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Calibration(why) => write!(f, "first half alone: {why}"),
            Self::TooShort(length_m) => write!(
                f,
                "half of the path is {length_m} m, too short for 30 segments that are longer than the steps \
                 between scans; record a longer drive"
            ),
        }
    }
}

impl std::error::Error for PredictionError {}

/// Predicts the errors of odometry in the second half of a drive, by length of its path, and measures them. The
/// calibration and the error model are of the first half; of the second half the prediction uses the wheels
/// alone.
///
/// # Errors
/// When the first half does not determine a calibration, or a half is too short.
pub fn predict_second_half(
    track: &WheelTrack,
    scans: &[LaserScan2],
    displacements: &[ScannerDisplacement],
    nominal: &DifferentialDrive,
    max_delay_s: f64,
) -> Result<SecondHalf, PredictionError> {
    let (middle_s, half_m) = middle(track, nominal);
    let too_short = PredictionError::TooShort(half_m as u32);
    let (first, second) = scans.split_at(scans.partition_point(|it| stamp_s(it) < middle_s));
    let known: Vec<ScannerDisplacement> =
        displacements.iter().filter(|it| it.to_s < middle_s).copied().collect();
    let calibration = calibrate_drive(track, &known, nominal, max_delay_s)
        .and_then(|found| refine_with_slam(&found, track, first))
        .map_err(PredictionError::Calibration)?;
    let model = OdometryErrorModel::fit(&slam_poses(&calibration, track, first))
        .ok_or_else(|| too_short.clone())?;
    let odometry: Vec<Pose2> =
        odometry_poses(&calibration, track, second).into_iter().flatten().collect();
    let predicted = model.predict(&odometry);
    let measured = model.measure(&slam_poses(&calibration, track, second));
    if predicted.len() != model.fitted.len() || measured.len() != predicted.len() {
        return Err(too_short);
    }
    Ok(SecondHalf { middle_s, calibration, model, predicted, measured })
}

fn stamp_s(scan: &LaserScan2) -> f64 {
    scan.time_ns as f64 * 1e-9
}

/// Stamp at half of the path \[s\], and the length of the half \[m\].
fn middle(track: &WheelTrack, drive: &DifferentialDrive) -> (f64, f64) {
    let mut lengths = Vec::new();
    let mut length_m = 0.0;
    for pair in track.samples().windows(2) {
        let (left, right) =
            (pair[1].left_rad - pair[0].left_rad, pair[1].right_rad - pair[0].right_rad);
        length_m += 0.5 * (drive.left_radius_m * left + drive.right_radius_m * right).abs();
        lengths.push((pair[1].stamp_s, length_m));
    }
    let half_m = 0.5 * length_m;
    let index = lengths.partition_point(|it| it.1 < half_m);
    (lengths.get(index).map_or(0.0, |it| it.0), half_m)
}
