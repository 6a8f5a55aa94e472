//! Maximum-likelihood refinement of a calibration.

use nalgebra::{DMatrix, SMatrix, SVector, SymmetricEigen};
use periplus_geometry::{Pose2, normalize_angle};

use crate::scans::ScannerDisplacement;
use crate::wheels::{DifferentialDrive, WheelTrack};

/// Number of parameters.
const COUNT: usize = 7;

/// Number of Gauss-Newton iterations.
const STEP_COUNT: usize = 10;

/// Differences for derivatives, relative to the parameters' units. The delay's is longer, since the speed of the
/// wheels is constant between samples.
const DIFFERENCE_RATIO: [f64; COUNT] = [1e-6, 1e-6, 1e-6, 1e-6, 1e-6, 1e-6, 1e-3];

/// Median of the chi-square distribution with 3 degrees of freedom, and its 99.9 % quantile.
const MEDIAN_SQUARE_RATIO: f64 = 2.366;
const LIMIT_SQUARE_RATIO: f64 = 16.266;

/// Ratio of eigenvalues below which a direction is not determined.
const MIN_EIGENVALUE_RATIO: f64 = 1e-12;

/// A displacement of the scanner with the wheels' motion at the same time.
pub(crate) type Interval = ScannerDisplacement;

/// Parameters of a drive and its scanner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parameters {
    pub(crate) drive: DifferentialDrive,
    /// `base_from_scanner`.
    pub(crate) scanner: Pose2,
    pub(crate) delay_s: f64,
}

impl Parameters {
    pub(crate) fn values(&self) -> [f64; COUNT] {
        let DifferentialDrive { left_radius_m, right_radius_m, wheel_distance_m } = self.drive;
        let Pose2 { x_m, y_m, yaw_rad } = self.scanner;
        [left_radius_m, right_radius_m, wheel_distance_m, x_m, y_m, yaw_rad, self.delay_s]
    }

    fn of(values: [f64; COUNT]) -> Self {
        let [left_radius_m, right_radius_m, wheel_distance_m, x_m, y_m, yaw_rad, delay_s] = values;
        Self {
            drive: DifferentialDrive { left_radius_m, right_radius_m, wheel_distance_m },
            scanner: Pose2::new(x_m, y_m, normalize_angle(yaw_rad)),
            delay_s,
        }
    }

    /// Expected displacement of the scanner.
    fn displacement(&self, track: &WheelTrack, it: &Interval) -> Option<Pose2> {
        let (from_s, to_s) = (it.from_s - self.delay_s, it.to_s - self.delay_s);
        let motion = track.motion(&self.drive, from_s, to_s)?;
        Some(self.scanner.inverse() * motion * self.scanner)
    }

    /// Measured displacement minus the expected one: x, y \[m\], yaw \[rad\].
    pub(crate) fn error(&self, track: &WheelTrack, it: &Interval) -> Option<[f64; 3]> {
        let (measured, expected) = (it.from_from_to, self.displacement(track, it)?);
        Some([
            measured.x_m - expected.x_m,
            measured.y_m - expected.y_m,
            normalize_angle(measured.yaw_rad - expected.yaw_rad),
        ])
    }

    /// Squared error in units of the information.
    pub(crate) fn square(&self, track: &WheelTrack, it: &Interval) -> Option<f64> {
        let error = SVector::<f64, 3>::from(self.error(track, it)?);
        Some(error.dot(&(information(it) * error)))
    }
}

/// Result of a refinement.
pub(crate) struct Refined {
    pub(crate) parameters: Parameters,
    /// Standard errors, in the order of the parameters; infinite for what is not determined.
    pub(crate) standard_errors: [f64; COUNT],
    squares: Vec<f64>,
}

impl Refined {
    /// Parameters as they are, before a refinement.
    pub(crate) fn unfitted(
        track: &WheelTrack,
        intervals: &[Interval],
        parameters: Parameters,
    ) -> Self {
        let squares = intervals.iter().filter_map(|it| parameters.square(track, it)).collect();
        Self { parameters, standard_errors: [f64::INFINITY; COUNT], squares }
    }

    /// Largest squared error that is no outlier. The scale follows from the median, which outliers hardly
    /// change.
    pub(crate) fn outlier_limit(&self) -> f64 {
        let mut squares = self.squares.clone();
        squares.sort_by(f64::total_cmp);
        let median = squares.get(squares.len() / 2).copied().unwrap_or(f64::INFINITY);
        // Exact data has residuals of rounding only.
        (median / MEDIAN_SQUARE_RATIO * LIMIT_SQUARE_RATIO).max(1e-12)
    }
}

fn information(it: &Interval) -> SMatrix<f64, 3, 3> {
    let [a, b, c] = it.information;
    SMatrix::<f64, 3, 3>::from_row_slice(&[a, b, c].concat())
}

/// Refines parameters by Gauss-Newton steps over all intervals; a known delay is kept.
pub(crate) fn refine(
    track: &WheelTrack,
    intervals: &[Interval],
    start: Parameters,
    is_delay_known: bool,
) -> Refined {
    let mut parameters = start;
    for _ in 0..STEP_COUNT {
        let (normal, gradient) = equations(track, intervals, &parameters, is_delay_known);
        let (inverse, _) = inverse(&normal);
        let step = inverse * gradient;
        let mut values = parameters.values();
        for (value, step) in values.iter_mut().zip(step.iter()) {
            *value += step;
        }
        parameters = Parameters::of(values);
    }
    let squares: Vec<f64> =
        intervals.iter().filter_map(|it| parameters.square(track, it)).collect();
    let scores = scores(track, intervals, &parameters, is_delay_known);
    let normal = scores.iter().fold(SMatrix::zeros(), |sum, it| sum + it.normal);
    let (inverse, undetermined) = inverse(&normal);
    let covariance = inverse * meat(&scores) * inverse;
    let freedom = 1.0 - (COUNT as f64 / (3 * scores.len()).max(COUNT + 1) as f64);
    let standard_errors = std::array::from_fn(|index| {
        let variance = covariance[(index, index)].max(0.0) / freedom;
        if undetermined[index] { f64::INFINITY } else { variance.sqrt() }
    });
    Refined { parameters, standard_errors, squares }
}

/// Covariance of the sum of the gradients. Neighbouring displacements share a scan, whose errors partly
/// cancel: covariances of up to two intervals count, with the weights of Newey and West 1987, "A simple,
/// positive semi-definite, heteroskedasticity and autocorrelation consistent covariance matrix".
fn meat(scores: &[IntervalScore]) -> SMatrix<f64, COUNT, COUNT> {
    const LAG_WEIGHT_RATIO: [f64; 3] = [1.0, 2.0 / 3.0, 1.0 / 3.0];
    let mut sum = SMatrix::zeros();
    for (index, it) in scores.iter().enumerate() {
        for (lag, weight) in LAG_WEIGHT_RATIO.into_iter().enumerate() {
            let Some(later) = scores.get(index + lag) else { break };
            let product = weight * it.gradient * later.gradient.transpose();
            sum += if lag == 0 { product } else { product + product.transpose() };
        }
    }
    sum
}

/// Part of an interval in the normal equations.
struct IntervalScore {
    normal: SMatrix<f64, COUNT, COUNT>,
    gradient: SVector<f64, COUNT>,
}

/// Normal equations at the parameters.
fn equations(
    track: &WheelTrack,
    intervals: &[Interval],
    parameters: &Parameters,
    is_delay_known: bool,
) -> (SMatrix<f64, COUNT, COUNT>, SVector<f64, COUNT>) {
    let scores = scores(track, intervals, parameters, is_delay_known);
    let zero = (SMatrix::zeros(), SVector::zeros());
    scores.iter().fold(zero, |sum, it| (sum.0 + it.normal, sum.1 + it.gradient))
}

/// Parts of all intervals in the normal equations.
fn scores(
    track: &WheelTrack,
    intervals: &[Interval],
    parameters: &Parameters,
    is_delay_known: bool,
) -> Vec<IntervalScore> {
    // The delay is the last parameter.
    let count = if is_delay_known { COUNT - 1 } else { COUNT };
    let values = parameters.values();
    let score = |it: &Interval| {
        let error = SVector::<f64, 3>::from(parameters.error(track, it)?);
        let mut jacobian = SMatrix::<f64, 3, COUNT>::zeros();
        for (index, difference) in DIFFERENCE_RATIO.into_iter().enumerate().take(count) {
            let moved = |sign: f64| {
                let mut values = values;
                values[index] += sign * difference;
                Parameters::of(values).error(track, it)
            };
            let (above, below) = (moved(1.0)?, moved(-1.0)?);
            // The error falls as the expected displacement grows.
            for row in 0..3 {
                jacobian[(row, index)] = (below[row] - above[row]) / (2.0 * difference);
            }
        }
        let weighted = jacobian.transpose() * information(it);
        Some(IntervalScore { normal: weighted * jacobian, gradient: weighted * error })
    };
    intervals.iter().filter_map(score).collect()
}

/// Inverse of the normal matrix without directions that are not determined, and the parameters in those.
fn inverse(normal: &SMatrix<f64, COUNT, COUNT>) -> (SMatrix<f64, COUNT, COUNT>, [bool; COUNT]) {
    // Parameters have different units: the diagonal scales them.
    let scale: [f64; COUNT] = std::array::from_fn(|index| {
        let diagonal = normal[(index, index)];
        if diagonal > 0.0 && diagonal.is_finite() { 1.0 / diagonal.sqrt() } else { 0.0 }
    });
    let scaled = DMatrix::from_fn(COUNT, COUNT, |row, column| {
        let value = scale[row] * normal[(row, column)] * scale[column];
        if value.is_finite() { value } else { 0.0 }
    });
    let eigen = SymmetricEigen::new(scaled);
    let mut inverse = SMatrix::zeros();
    let mut undetermined = scale.map(|it| it == 0.0);
    for (index, &value) in eigen.eigenvalues.iter().enumerate() {
        let vector = eigen.eigenvectors.column(index);
        if value > MIN_EIGENVALUE_RATIO * COUNT as f64 {
            for row in 0..COUNT {
                for column in 0..COUNT {
                    inverse[(row, column)] +=
                        scale[row] * vector[row] * vector[column] * scale[column] / value;
                }
            }
        } else {
            for (row, it) in undetermined.iter_mut().enumerate() {
                *it |= vector[row].abs() > 0.1;
            }
        }
    }
    (inverse, undetermined)
}
