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
/// rounds, and the mean of the others is the variance of the noise. A constant bias of the ranges is not observable from lines and is not estimated. A dropout is a beam without a return between two
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
