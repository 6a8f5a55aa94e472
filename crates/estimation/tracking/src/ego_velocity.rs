//! Velocity of the radar itself from the radial velocities of objects at rest.

use crate::{RadarCells, RadarPoint};

/// Maximum number of pairs of returns that are tried.
const MAX_PAIR_COUNT: usize = 400;

/// Minimum share of the returns that must agree: more than those of moving objects.
const MIN_INLIER_RATIO: f64 = 0.5;

/// Minimum number of returns that must agree; two always do.
const MIN_INLIER_COUNT: usize = 4;

/// Minimum determinant of the normal equations per return: directions that differ by some degrees.
const MIN_DETERMINANT_RATIO: f64 = 1e-4;

/// Maximum residual of a return of an object at rest, in cells of radial velocity: half a cell by rounding, and the
/// change of the velocity within a cell of azimuth.
const MAX_RESIDUAL_CELLS_RATIO: f64 = 1.5;

/// Returns the velocity of a radar in the world along its x and y axes \[m/s\]; `None` without a majority of returns of
/// objects at rest in different directions.
///
/// An object at rest in the direction u has the radial velocity `-u · v` for the velocity v of the radar, so that most
/// returns of a scan agree on v (Kellner et al., "Instantaneous Ego-Motion Estimation using Doppler Radar", ITSC 2013).
/// Pairs of returns propose velocities; the one with the most inliers is refined by least squares.
#[must_use]
pub fn ego_velocity(points: &[RadarPoint], cells: &RadarCells) -> Option<[f64; 2]> {
    let tolerance_m_per_s = MAX_RESIDUAL_CELLS_RATIO * cells.doppler_m_per_s;
    let residual = |point: &RadarPoint, [vx, vy]: [f64; 2]| {
        let direction = point.direction();
        (point.doppler_m_per_s + direction.x * vx + direction.y * vy).abs()
    };
    let agreeing = |velocity: [f64; 2]| {
        points.iter().filter(|point| residual(point, velocity) <= tolerance_m_per_s).count()
    };
    let mut best: Option<(usize, [f64; 2])> = None;
    for (a, b) in pairs(points.len()) {
        let Some(velocity) = least_squares([&points[a], &points[b]].into_iter()) else { continue };
        let count = agreeing(velocity);
        if best.is_none_or(|(most, _)| count > most) {
            best = Some((count, velocity));
        }
    }
    let (_, proposed) = best?;
    let inliers = || points.iter().filter(|point| residual(point, proposed) <= tolerance_m_per_s);
    let count = inliers().count();
    #[expect(clippy::cast_precision_loss, reason = "returns of one scan")]
    let is_majority = count as f64 >= MIN_INLIER_RATIO * points.len() as f64;
    if count < MIN_INLIER_COUNT || !is_majority {
        return None;
    }
    least_squares(inliers())
}

/// Returns evenly chosen pairs of indices, all if there are few.
fn pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
    let all = count * count.saturating_sub(1) / 2;
    let stride = all.div_ceil(MAX_PAIR_COUNT).max(1);
    (0..count).flat_map(move |a| (a + 1..count).map(move |b| (a, b))).step_by(stride)
}

/// Solves `doppler = -u · v` in the plane; `None` if the directions are nearly equal.
fn least_squares<'a>(points: impl Iterator<Item = &'a RadarPoint>) -> Option<[f64; 2]> {
    let (mut xx, mut xy, mut yy, mut x, mut y, mut count) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for point in points {
        let u = point.direction();
        (xx, xy, yy) = (xx + u.x * u.x, xy + u.x * u.y, yy + u.y * u.y);
        (x, y) = (x - u.x * point.doppler_m_per_s, y - u.y * point.doppler_m_per_s);
        count += 1.0;
    }
    let determinant = xx * yy - xy * xy;
    (determinant > MIN_DETERMINANT_RATIO * count * count)
        .then(|| [(yy * x - xy * y) / determinant, (xx * y - xy * x) / determinant])
}

#[cfg(test)]
mod tests {
    use super::*;

    const CELLS: RadarCells =
        RadarCells { range_m: 0.5, azimuth_rad: 0.02, elevation_rad: 0.1, doppler_m_per_s: 0.1 };

    fn points(velocity: [f64; 2], moving: usize) -> Vec<RadarPoint> {
        let point = |number: usize| {
            let azimuth_rad = (number as f64 - 10.0) * 0.06;
            let mut point = RadarPoint { range_m: 10.0, azimuth_rad, ..RadarPoint::default() };
            let u = point.direction();
            let exact = -(u.x * velocity[0] + u.y * velocity[1]);
            point.doppler_m_per_s = (exact / 0.1).round() * 0.1;
            if number < moving {
                point.doppler_m_per_s += 2.0;
            }
            point
        };
        (0..21).map(point).collect()
    }

    #[test]
    fn the_majority_is_at_rest() {
        for moving in [0, 8] {
            let [vx, vy] = ego_velocity(&points([3.0, -0.5], moving), &CELLS).unwrap();
            assert!((vx - 3.0).abs() < 0.05 && (vy + 0.5).abs() < 0.1, "{vx} {vy}");
        }
    }

    #[test]
    fn few_returns_or_one_direction_have_no_answer() {
        assert_eq!(ego_velocity(&points([3.0, 0.0], 0)[..3], &CELLS), None);
        let ahead = vec![RadarPoint { range_m: 5.0, ..RadarPoint::default() }; 10];
        assert_eq!(ego_velocity(&ahead, &CELLS), None);
        assert_eq!(ego_velocity(&[], &CELLS), None);
    }
}
