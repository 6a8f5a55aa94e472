//! Noise of a planar scanner.

use nalgebra::{Matrix2, Vector2};
use periplus_geometry::LaserScan2;

use crate::estimated::Estimated;

/// Number of beams of a window that is fitted with a line.
const WINDOW_BEAM_COUNT: usize = 12;
/// Largest step of range between neighbouring beams on a surface, relative to the range.
const MAX_STEP_RATIO: f32 = 0.1;
/// Minimum number of windows.
const MIN_WINDOW_COUNT: usize = 50;
/// Median and 99.9 % quantile of the chi-square distribution with `WINDOW_BEAM_COUNT` - 2 degrees of freedom, divided by
/// these.
const MEDIAN_RATIO: f64 = 9.341_818 / 10.0;
const LIMIT_RATIO: f64 = 29.588 / 10.0;
/// Number of rounds in which windows beyond the limit are dropped.
const ROUND_COUNT: usize = 8;

/// Angle of the beams of a window for the bias \[rad\]: the bias deforms a wall by the difference of the cosines of
/// incidence.
const BIAS_WINDOW_RAD: f64 = 1.2;
/// Number of rounds of the fit of the bias.
const BIAS_ROUND_COUNT: usize = 5;
/// Maximum standard error of a bias that counts as observed \[m\].
const MAX_BIAS_ERROR_M: f64 = 0.01;
/// Maximum scatter of the biases of single windows relative to that of noise. It is 1 for flat walls, where 2 is
/// beyond the 99.9 % quantile already for 50 windows.
const MAX_BIAS_SCATTER_RATIO: f64 = 2.0;

/// Noise of a planar scanner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LidarNoise {
    /// Standard deviation of a range on a flat surface \[m\].
    pub std_m: Estimated,
    /// Part of the beams to a surface without a return, 0 to 1.
    pub dropout_ratio: Estimated,
    /// Number of windows of neighbouring beams that were fitted.
    pub window_count: usize,
}

/// Returns the noise of a scanner from scans of a scene with flat walls; none with fewer than 50 windows of
/// twelve beams on surfaces.
///
/// The inverse of the range to a line is linear in cosine and sine of the beam's angle. Each window has the
/// variance of its residuals. The first estimate of the noise is their median, corrected for the median of the
/// chi-square distribution; windows over corners and edges are beyond its 99.9 % quantile and are dropped in
/// rounds, and the mean of the others is the variance of the noise. For a constant bias of the ranges see
/// [`range_bias`]. A dropout is a beam without a return between two
/// beams on one surface.
#[must_use]
pub fn lidar_noise(scans: &[LaserScan2]) -> Option<LidarNoise> {
    let mut variances = Vec::new();
    let (mut dropouts, mut between) = (0_usize, 0_usize);
    for scan in scans {
        let is_return = |range_m: f32| range_m >= scan.range_min_m && range_m < scan.range_max_m;
        for (beam, ranges_m) in
            scan.ranges_m.windows(WINDOW_BEAM_COUNT).enumerate().step_by(WINDOW_BEAM_COUNT)
        {
            let is_surface = ranges_m.iter().all(|it| is_return(*it))
                && ranges_m.windows(2).all(|it| is_neighbour(it[0], it[1]));
            if is_surface {
                let angle = |index: usize| scan.beam_angle_rad(beam + index);
                variances.extend(variance(ranges_m, angle));
            }
        }
        for it in scan.ranges_m.windows(3) {
            if is_return(it[0]) && is_return(it[2]) && is_neighbour(it[0], it[2]) {
                between += 1;
                dropouts += usize::from(!is_return(it[1]));
            }
        }
    }
    let window_count = variances.len();
    if window_count < MIN_WINDOW_COUNT {
        return None;
    }
    variances.sort_by(f64::total_cmp);
    for _ in 0..ROUND_COUNT {
        let limit = variances[variances.len() / 2] / MEDIAN_RATIO * LIMIT_RATIO;
        variances.truncate(variances.partition_point(|it| *it <= limit).max(1));
    }
    let window_count = variances.len();
    let std_m = (variances.iter().sum::<f64>() / window_count as f64).sqrt();
    let freedom = (WINDOW_BEAM_COUNT - 2) as f64;
    let dropout = dropouts as f64 / between.max(1) as f64;
    Some(LidarNoise {
        std_m: Estimated {
            value: std_m,
            standard_error: std_m / (2.0 * freedom * window_count as f64).sqrt(),
        },
        dropout_ratio: Estimated {
            value: dropout,
            standard_error: (dropout * (1.0 - dropout) / between.max(1) as f64).sqrt(),
        },
        window_count,
    })
}

/// Returns the constant bias of the ranges \[m\] from walls that are seen over more than 69 degrees: a bias b turns a
/// wall at the distance d into r = d / cos(φ) + b. None if there are too few such walls for a standard error of
/// 1 cm, or if the windows disagree by more than noise: doors, frames and furniture deform a wall too.
///
/// `noise` is that of the ranges, see [`lidar_noise`]. Each window has its line and all have one bias, by least squares;
/// windows over corners are beyond the 99.9 % quantile of the chi-square distribution and are dropped.
#[must_use]
pub fn range_bias(scans: &[LaserScan2], noise: &LidarNoise) -> Option<Estimated> {
    let mut windows: Vec<Vec<(Vector2<f64>, f64)>> = Vec::new();
    for scan in scans {
        let is_return = |range_m: f32| range_m >= scan.range_min_m && range_m < scan.range_max_m;
        let step_rad = scan.beam_step_rad().abs();
        if !(step_rad > 0.0 && step_rad < BIAS_WINDOW_RAD) {
            continue;
        }
        let count = (BIAS_WINDOW_RAD / step_rad).ceil() as usize;
        for (first, ranges_m) in
            scan.ranges_m.windows(count).enumerate().step_by((count / 4).max(1))
        {
            let beams: Vec<(Vector2<f64>, f64)> = ranges_m
                .iter()
                .enumerate()
                .filter(|(_, range_m)| is_return(**range_m))
                .map(|(index, range_m)| {
                    let (sine, cosine) = libm::sincos(scan.beam_angle_rad(first + index));
                    (Vector2::new(cosine, sine), f64::from(*range_m))
                })
                .collect();
            if beams.len() * 2 > count {
                windows.push(beams);
            }
        }
    }
    let mut bias_m = 0.0;
    let (mut standard_error, mut scatter_ratio) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..BIAS_ROUND_COUNT {
        let (mut normal, mut right) = (0.0, 0.0);
        let (mut scatter, mut count) = (0.0, 0.0);
        for beams in &windows {
            let Some(window) = bent_line(beams, bias_m) else { continue };
            let freedom = beams.len().saturating_sub(3) as f64;
            // Upper 99.9 % quantile of the normal approximation.
            let limit =
                noise.std_m.value * noise.std_m.value * (freedom + 3.1 * (2.0 * freedom).sqrt());
            if window.squares <= limit {
                normal += window.normal;
                right += window.right;
                scatter += window.right * window.right / window.normal;
                count += 1.0;
            }
        }
        if normal <= 0.0 {
            return None;
        }
        bias_m += right / normal;
        let variance = noise.std_m.value * noise.std_m.value;
        // Without the part of the change of this round.
        scatter_ratio = (scatter - right * right / normal) / (variance * count);
        // Windows overlap by three quarters.
        standard_error = 2.0 * (variance * scatter_ratio.max(1.0) / normal).sqrt();
    }
    (standard_error <= MAX_BIAS_ERROR_M && scatter_ratio <= MAX_BIAS_SCATTER_RATIO)
        .then_some(Estimated { value: bias_m, standard_error })
}

/// Part of a window in the normal equation of the bias, and its squared residuals with its own bias.
struct BentLine {
    normal: f64,
    right: f64,
    squares: f64,
}

/// Fit of a line to ranges without a bias. The line and the change of the bias are separated as in a
/// partitioned regression.
fn bent_line(beams: &[(Vector2<f64>, f64)], bias_m: f64) -> Option<BentLine> {
    let mut line = {
        let (mut normal, mut right) = (Matrix2::zeros(), Vector2::zeros());
        for (row, range_m) in beams {
            normal += row * row.transpose();
            right += row / (range_m - bias_m);
        }
        normal.cholesky()?.solve(&right)
    };
    let mut sums = (0.0, 0.0, 0.0);
    for _ in 0..3 {
        let (mut normal, mut right, mut cross) =
            (Matrix2::zeros(), Vector2::zeros(), Vector2::zeros());
        let (mut ones, mut residuals, mut squares) = (0.0, 0.0, 0.0);
        for (row, range_m) in beams {
            let expected_m = 1.0 / row.dot(&line);
            let residual_m = range_m - bias_m - expected_m;
            let slope = -expected_m * expected_m * row;
            normal += slope * slope.transpose();
            right += slope * residual_m;
            cross += slope;
            ones += 1.0;
            residuals += residual_m;
            squares += residual_m * residual_m;
        }
        let factor = normal.cholesky()?;
        let (step, of_ones) = (factor.solve(&right), factor.solve(&cross));
        line += step;
        sums = (
            ones - cross.dot(&of_ones),
            residuals - of_ones.dot(&right),
            squares - right.dot(&step),
        );
    }
    let (normal, right, squares) = sums;
    let is_valid = normal > 0.0 && squares.is_finite();
    // Without the part that another bias explains.
    is_valid.then(|| BentLine { normal, right, squares: squares - right * right / normal })
}

fn is_neighbour(a: f32, b: f32) -> bool {
    (a - b).abs() <= MAX_STEP_RATIO * a.min(b)
}

/// Variance of ranges around a line \[m²\].
fn variance(ranges_m: &[f32], angle_rad: impl Fn(usize) -> f64) -> Option<f64> {
    let (mut normal, mut right) = (Matrix2::zeros(), Vector2::zeros());
    let rows: Vec<(Vector2<f64>, f64)> = ranges_m
        .iter()
        .enumerate()
        .map(|(index, &range_m)| {
            let (sine, cosine) = libm::sincos(angle_rad(index));
            (Vector2::new(cosine, sine), f64::from(range_m))
        })
        .collect();
    for (row, range_m) in &rows {
        // The inverse has a standard deviation of that of the range over its square. One weight for the window
        // keeps it independent of the noise.
        normal += row * row.transpose();
        right += row / *range_m;
    }
    let line = normal.cholesky()?.solve(&right);
    let residual = |(row, range_m): &(Vector2<f64>, f64)| range_m - 1.0 / row.dot(&line);
    let squares: f64 = rows.iter().map(residual).map(|it| it * it).sum();
    Some(squares / (WINDOW_BEAM_COUNT - 2) as f64).filter(|it| it.is_finite())
}
