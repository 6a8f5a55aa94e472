//! Random errors of odometry, and their prediction for another drive.

use periplus_geometry::Pose2;

/// Motion with the error of odometry over it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionError {
    /// Motion of the base.
    pub motion: Pose2,
    /// Error of x, y \[m\] and yaw \[rad\].
    pub error: [f64; 3],
}

/// Root mean squares of errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RmsError {
    /// Root mean square of the position error \[m\].
    pub rms_m: f64,
    /// Root mean square of the heading error \[rad\].
    pub rms_rad: f64,
}

/// Variances of the errors of odometry: a constant part, and parts in proportion to the length of the path
/// and to the rotation. The constant part contains the errors of the measurement against which odometry is
/// compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OdometryErrorModel {
    /// Variance of the position \[m²\]: constant, per metre, per radian.
    pub position: [f64; 3],
    /// Variance of the heading \[rad²\]: constant, per metre, per radian.
    pub heading: [f64; 3],
}

/// Part of the largest errors on each side that is limited to the next one: a single slip in a short drive does
/// not decide the prediction.
const WINSORIZED_RATIO: f64 = 0.01;

/// Minimum number of motions.
const MIN_MOTION_COUNT: usize = 30;

/// Number of sweeps over the coordinates of a fit.
const SWEEP_COUNT: usize = 2000;

impl OdometryErrorModel {
    /// Fits the model by least squares of the squared errors without negative parts; none with fewer than 30
    /// motions. The largest percent of the errors is limited to the next largest.
    #[must_use]
    pub fn fit(errors: &[MotionError]) -> Option<Self> {
        if errors.len() < MIN_MOTION_COUNT {
            return None;
        }
        let rows: Vec<[f64; 3]> = errors.iter().map(|it| regressors(it.motion)).collect();
        let fit = |square: fn(&MotionError) -> f64| {
            let squares: Vec<f64> = errors.iter().map(square).collect();
            nonnegative(&rows, &limited(&squares))
        };
        Some(Self { position: fit(position_square), heading: fit(heading_square) })
    }

    /// Returns the expected root mean squares over other motions; none without motions.
    #[must_use]
    pub fn predict(&self, motions: &[Pose2]) -> Option<RmsError> {
        let rms = |parts: [f64; 3]| {
            let variance = |it: &Pose2| {
                regressors(*it).iter().zip(parts).map(|(row, part)| row * part).sum::<f64>()
            };
            (motions.iter().map(variance).sum::<f64>() / motions.len() as f64).sqrt()
        };
        (!motions.is_empty())
            .then(|| RmsError { rms_m: rms(self.position), rms_rad: rms(self.heading) })
    }
}

impl RmsError {
    /// Returns the root mean squares of errors, the largest percent limited as in
    /// [`OdometryErrorModel::fit`]; none without errors.
    #[must_use]
    pub fn of(errors: &[MotionError]) -> Option<Self> {
        let rms = |square: fn(&MotionError) -> f64| {
            let squares = limited(&errors.iter().map(square).collect::<Vec<_>>());
            (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
        };
        (!errors.is_empty())
            .then(|| Self { rms_m: rms(position_square), rms_rad: rms(heading_square) })
    }
}

fn regressors(motion: Pose2) -> [f64; 3] {
    [1.0, libm::hypot(motion.x_m, motion.y_m), motion.yaw_rad.abs()]
}

fn position_square(it: &MotionError) -> f64 {
    it.error[0] * it.error[0] + it.error[1] * it.error[1]
}

fn heading_square(it: &MotionError) -> f64 {
    it.error[2] * it.error[2]
}

fn limited(squares: &[f64]) -> Vec<f64> {
    let mut sorted = squares.to_vec();
    sorted.sort_by(f64::total_cmp);
    let index = ((1.0 - WINSORIZED_RATIO) * sorted.len().saturating_sub(1) as f64) as usize;
    let limit = sorted.get(index).copied().unwrap_or(f64::INFINITY);
    squares.iter().map(|it| it.min(limit)).collect()
}

/// Least squares without negative parts, by descent along the coordinates.
fn nonnegative(rows: &[[f64; 3]], values: &[f64]) -> [f64; 3] {
    let (mut normal, mut right) = ([[0.0; 3]; 3], [0.0; 3]);
    for (row, value) in rows.iter().zip(values) {
        for i in 0..3 {
            right[i] += row[i] * value;
            for j in 0..3 {
                normal[i][j] += row[i] * row[j];
            }
        }
    }
    let mut parts = [0.0; 3];
    for _ in 0..SWEEP_COUNT {
        for i in 0..3 {
            if normal[i][i] > 0.0 {
                let others: f64 = (0..3).filter(|j| *j != i).map(|j| normal[i][j] * parts[j]).sum();
                parts[i] = ((right[i] - others) / normal[i][i]).max(0.0);
            }
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Stream;

    use super::*;

    /// Motions of up to `length_m` and `turn_rad` with errors of a tenth of the root of the length, and of 0.02
    /// and of a twentieth of the root of the rotation.
    fn errors(name: &str, count: usize, length_m: f64, turn_rad: f64) -> Vec<MotionError> {
        let mut stream = Stream::keyed(5, name, 0);
        let mut one = || {
            let (x_m, yaw_rad) = (length_m * stream.unit(), turn_rad * (stream.unit() - 0.5));
            let along = 0.1 * x_m.sqrt() * stream.normal();
            let turn = 0.05 * yaw_rad.abs().sqrt() * stream.normal() + 0.02 * stream.normal();
            MotionError { motion: Pose2::new(x_m, 0.0, yaw_rad), error: [along, 0.0, turn] }
        };
        (0..count).map(|_| one()).collect()
    }

    #[test]
    fn errors_of_a_faster_drive_are_predicted() {
        let (slow, fast) = (errors("slow", 4000, 0.5, 0.5), errors("fast", 4000, 2.0, 2.0));
        let model = OdometryErrorModel::fit(&slow).unwrap();
        let motions: Vec<Pose2> = fast.iter().map(|it| it.motion).collect();
        let (expected, found) = (model.predict(&motions).unwrap(), RmsError::of(&fast).unwrap());
        assert!((expected.rms_m / found.rms_m - 1.0).abs() < 0.1, "{expected:?} {found:?}");
        assert!((expected.rms_rad / found.rms_rad - 1.0).abs() < 0.1, "{expected:?} {found:?}");
    }

    #[test]
    fn one_slip_does_not_decide_the_prediction() {
        let mut drive = errors("slip", 1000, 0.5, 0.5);
        let before = RmsError::of(&drive).unwrap();
        drive[500].error = [3.0, 0.0, 1.0];
        let after = RmsError::of(&drive).unwrap();
        assert!((after.rms_m / before.rms_m - 1.0).abs() < 0.02, "{before:?} {after:?}");
        assert_eq!(OdometryErrorModel::fit(&drive[..20]), None);
        assert_eq!(RmsError::of(&[]), None);
    }
}
