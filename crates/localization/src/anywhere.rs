//! Where a robot may be of which nothing is known: where in all of the map its scan fits.

use std::f64::consts::PI;

use periplus_base::Pose2;
use periplus_matching::{Field, FieldSettings, Peak, Window};

use crate::known_map::KnownMap;

/// More cells than this and they are taken larger.
const MOST_CELLS: f64 = 4e6;
/// Finer cells cost time and tell nothing more: particles find the rest.
const LEAST_CELL_M: f64 = 0.1;
/// More points cost time and tell nothing more.
const MOST_POINTS: usize = 90;
/// Places where a smaller part of the scan fits are none.
const LEAST_SCORE: f64 = 0.35;
/// A place that fits nearly as well as the best may be the one.
const RIVAL: f64 = 0.9;
/// Places nearer to the best are the same: \[m\], \[rad\].
const SAME: (f64, f64) = (1.0, 0.5);

/// Where in all of the map points fit that a scanner saw, in the frame of the base \[m\]: the best
/// place, and the best other one if it fits nearly as well.
pub(crate) fn places(map: &KnownMap, ends: &[[f32; 2]]) -> Vec<Peak> {
    let every = ends.len().div_ceil(MOST_POINTS).max(1);
    let points: Vec<[f32; 2]> = ends.iter().step_by(every).copied().collect();
    let lattice = map.lattice();
    let corners =
        [(0, 0), (lattice.width, 0), (0, lattice.height), (lattice.width, lattice.height)]
            .map(|(column, row)| lattice.point_at(column as f64, row as f64));
    let span = |values: [f64; 4]| {
        let low = values.into_iter().fold(f64::INFINITY, f64::min);
        let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
        (0.5 * (low + high), 0.5 * (high - low))
    };
    let (x_m, half_x_m) = span(corners.map(|corner| corner.0));
    let (y_m, half_y_m) = span(corners.map(|corner| corner.1));
    let least = libm::sqrt(4.0 * half_x_m * half_y_m / MOST_CELLS);
    let cell_m = lattice.resolution_m.max(LEAST_CELL_M).max(least);
    // Distances are kept from the middle of the map, so that floats suffice.
    let walls: Vec<[f32; 2]> =
        map.walls().map(|(x, y)| [(x - x_m) as f32, (y - y_m) as f32]).collect();
    let settings = FieldSettings {
        resolution_m: cell_m as f32,
        sigma_m: 1.2 * cell_m as f32,
        most_half_m: (half_x_m.max(half_y_m) + cell_m) as f32,
        levels: 6,
    };
    let field = Field::new(&walls, [0.0, 0.0], &settings);
    let farthest = points.iter().map(|[x, y]| x * x + y * y).fold(0.0, f32::max).sqrt();
    // The farthest of points moves by one cell from heading to heading.
    let step_rad = (cell_m / f64::from(farthest).max(0.1)).clamp(0.01, 0.1);
    let window = Window {
        middle: Pose2::IDENTITY,
        half_m: [half_x_m, half_y_m],
        half_rad: PI - 0.5 * step_rad,
        step_rad,
    };
    let mut places = Vec::new();
    if let (Some(best), _) = field.search(&points, &window, LEAST_SCORE, None) {
        places.push(best);
        let avoid = Some((best.pose, SAME.0, SAME.1));
        places.extend(field.search(&points, &window, RIVAL * best.score, avoid).0);
    }
    for place in &mut places {
        place.pose.x_m += x_m;
        place.pose.y_m += y_m;
    }
    places
}
