//! Clusters of returns in neighbouring resolution cells.

use periplus_geometry::DVec3;

use crate::{RadarCells, RadarPoint, ReturnNoise};

/// Maximum distance of neighbours in cells: the next cell, with a margin for rounding.
const NEIGHBOUR_CELLS_RATIO: f64 = 1.5;

/// Number of standard deviations of noise by which neighbours can be farther apart.
const NEIGHBOUR_NOISE_RATIO: f64 = 2.0;

/// Returns that belong together.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cluster {
    /// Mean position, weighted by power \[m\].
    pub(crate) position_m: DVec3,
    /// Mean radial velocity, weighted by power \[m/s\].
    pub(crate) doppler_m_per_s: f64,
    /// Extent along the axes of the sensor, at least that of a cell \[m\].
    pub(crate) size_m: DVec3,
}

/// Joins returns whose cells touch and whose radial velocities differ by at most `doppler_m_per_s`, in the order of
/// their first returns.
pub(crate) fn clusters(
    points: &[RadarPoint],
    cells: &RadarCells,
    noise: &ReturnNoise,
    doppler_m_per_s: f64,
) -> Vec<Cluster> {
    let reach =
        |width: f64, stddev: f64| NEIGHBOUR_CELLS_RATIO * width + NEIGHBOUR_NOISE_RATIO * stddev;
    let range_m = reach(cells.range_m, noise.range_m);
    let azimuth_rad = reach(cells.azimuth_rad, noise.azimuth_rad);
    let elevation_rad = reach(cells.elevation_rad, noise.elevation_rad);
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| points[a].azimuth_rad.total_cmp(&points[b].azimuth_rad).then(a.cmp(&b)));
    let mut roots: Vec<usize> = (0..points.len()).collect();
    let doppler_m_per_s = doppler_m_per_s.max(reach(cells.doppler_m_per_s, noise.doppler_m_per_s));
    for (index, &a) in order.iter().enumerate() {
        for &b in &order[index + 1..] {
            let (a_point, b_point) = (&points[a], &points[b]);
            if b_point.azimuth_rad - a_point.azimuth_rad > azimuth_rad {
                break;
            }
            if (a_point.range_m - b_point.range_m).abs() <= range_m
                && (a_point.elevation_rad - b_point.elevation_rad).abs() <= elevation_rad
                && (a_point.doppler_m_per_s - b_point.doppler_m_per_s).abs() <= doppler_m_per_s
            {
                let (a, b) = (root(&mut roots, a), root(&mut roots, b));
                roots[a.max(b)] = a.min(b);
            }
        }
    }
    let mut members: Vec<Vec<RadarPoint>> = vec![Vec::new(); points.len()];
    for (index, point) in points.iter().enumerate() {
        members[root(&mut roots, index)].push(*point);
    }
    members.iter().filter(|members| !members.is_empty()).map(|it| cluster(it, cells)).collect()
}

/// Returns the first member of a set, and shortens the path to it.
fn root(roots: &mut [usize], mut index: usize) -> usize {
    while roots[index] != index {
        roots[index] = roots[roots[index]];
        index = roots[index];
    }
    index
}

fn cluster(members: &[RadarPoint], cells: &RadarCells) -> Cluster {
    let weight = |point: &RadarPoint| libm::pow(10.0, point.amplitude_db / 10.0);
    let strongest = members.iter().map(weight).fold(f64::MIN_POSITIVE, f64::max);
    let (mut sum, mut position_m, mut doppler_m_per_s) = (0.0, DVec3::ZERO, 0.0);
    let (mut low_m, mut high_m) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let mut range_m: f64 = 0.0;
    for point in members {
        let share = weight(point) / strongest;
        let at_m = point.position_m();
        sum += share;
        position_m += at_m * share;
        doppler_m_per_s += point.doppler_m_per_s * share;
        (low_m, high_m) = (low_m.min(at_m), high_m.max(at_m));
        range_m = range_m.max(point.range_m);
    }
    let cell_m =
        DVec3::new(cells.range_m, range_m * cells.azimuth_rad, range_m * cells.elevation_rad);
    Cluster {
        position_m: position_m / sum,
        doppler_m_per_s: doppler_m_per_s / sum,
        size_m: (high_m - low_m).max(cell_m),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CELLS: RadarCells =
        RadarCells { range_m: 0.5, azimuth_rad: 0.02, elevation_rad: 0.1, doppler_m_per_s: 0.1 };

    fn point(range_m: f64, azimuth_cells: f64, doppler_m_per_s: f64) -> RadarPoint {
        RadarPoint {
            range_m,
            azimuth_rad: azimuth_cells * 0.02,
            doppler_m_per_s,
            ..RadarPoint::default()
        }
    }

    /// A chain of neighbours is one cluster; a gap of a cell, or another velocity, begins a new one.
    #[test]
    fn neighbours_are_joined() {
        let points = [
            point(10.0, 0.0, 0.0),
            point(10.5, 1.0, 0.0),
            point(11.0, 2.0, 0.1),
            point(10.0, 4.0, 0.0),
            point(10.0, 0.0, -2.0),
            point(12.0, 2.0, 0.0),
        ];
        let found = clusters(&points, &CELLS, &ReturnNoise::default(), 0.5);
        assert_eq!(found.len(), 4, "{found:?}");
        let mean = &found[0];
        assert!((mean.position_m.length() - 10.5).abs() < 0.01, "{mean:?}");
        assert!((mean.doppler_m_per_s - 0.1 / 3.0).abs() < 1e-9);
    }

    /// 10 dB are ten times the power: the mean is at 1/11 of the distance.
    #[test]
    fn strong_returns_count_more() {
        let strong = RadarPoint { amplitude_db: 10.0, ..point(10.0, 0.0, 0.0) };
        let found =
            clusters(&[strong, point(10.5, 0.0, 0.0)], &CELLS, &ReturnNoise::default(), 0.5);
        assert_eq!(found.len(), 1);
        assert!((found[0].position_m.x - (10.0 + 0.5 / 11.0)).abs() < 1e-9, "{found:?}");
        assert_eq!(found[0].size_m, DVec3::new(0.5, 10.5 * 0.02, 10.5 * 0.1));
    }
}
