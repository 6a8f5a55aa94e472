//! Where a robot may be of which nothing is known: where in all of the map its scan fits.

use std::f64::consts::PI;

use periplus_base::Pose2;
use periplus_matching::{Field, FieldSettings, Peak, Wanted, Window};

use crate::known_map::KnownMap;

/// More cells than this and they are taken larger.
const MOST_CELLS: f64 = 4e6;
/// Finer cells cost time and tell nothing more: particles find the rest.
const LEAST_CELL_M: f64 = 0.1;
/// More points cost time and tell nothing more.
const MOST_POINTS: usize = 90;
/// Places where a smaller part of the scan fits are none.
const LEAST_SCORE: f64 = 0.35;
/// Which places are looked for: those that fit nearly as well as the best may be the one.
const WANTED: Wanted =
    Wanted { least: LEAST_SCORE, share: 0.75, most: 200, apart: (0.4, 0.3), most_work: 50_000_000 };
/// Around a place there are few.
const WANTED_NEAR: Wanted =
    Wanted { least: LEAST_SCORE, share: 0.85, most: 6, apart: (0.3, 0.2), most_work: 4_000_000 };

/// A map, prepared for the search on all of it.
#[derive(Clone, Debug)]
pub(crate) struct Everywhere {
    field: Field,
    cell_m: f64,
    /// The middle of the map \[m\]: places are counted from it, so that floats suffice.
    middle: [f64; 2],
    half_m: [f64; 2],
}

impl Everywhere {
    pub(crate) fn new(map: &KnownMap) -> Self {
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
        let walls: Vec<[f32; 2]> =
            map.walls().map(|(x, y)| [(x - x_m) as f32, (y - y_m) as f32]).collect();
        let settings = FieldSettings {
            resolution_m: cell_m as f32,
            sigma_m: 1.2 * cell_m as f32,
            most_half_m: (half_x_m.max(half_y_m) + cell_m) as f32,
            levels: 6,
        };
        let field = Field::new(&walls, [0.0, 0.0], &settings);
        Self { field, cell_m, middle: [x_m, y_m], half_m: [half_x_m, half_y_m] }
    }

    /// Where points fit that a scanner saw, in the frame of the base \[m\], the best first.
    pub(crate) fn peaks(&self, ends: &[[f32; 2]]) -> Vec<Peak> {
        self.search(ends, Pose2::IDENTITY, self.half_m, PI, &WANTED)
    }

    /// The same not farther from a pose than so, along each axis of the map.
    pub(crate) fn peaks_near(
        &self,
        ends: &[[f32; 2]],
        pose: Pose2,
        (half_m, half_rad): (f64, f64),
    ) -> Vec<Peak> {
        let [x, y] = self.middle;
        let middle = Pose2::new(pose.x_m - x, pose.y_m - y, pose.yaw_rad);
        self.search(ends, middle, [half_m; 2], half_rad, &WANTED_NEAR)
    }

    fn search(
        &self,
        ends: &[[f32; 2]],
        middle: Pose2,
        half_m: [f64; 2],
        half_rad: f64,
        wanted: &Wanted,
    ) -> Vec<Peak> {
        let every = ends.len().div_ceil(MOST_POINTS).max(1);
        let points: Vec<[f32; 2]> = ends.iter().step_by(every).copied().collect();
        let farthest = points.iter().map(|[x, y]| x * x + y * y).fold(0.0, f32::max).sqrt();
        // The farthest of points moves by one cell from heading to heading.
        let step_rad = (self.cell_m / f64::from(farthest).max(0.1)).clamp(0.01, 0.1);
        let half_rad = half_rad.min(PI - 0.5 * step_rad);
        let window = Window { middle, half_m, half_rad, step_rad };
        let (mut peaks, _) = self.field.peaks(&points, &window, wanted);
        for peak in &mut peaks {
            peak.pose.x_m += self.middle[0];
            peak.pose.y_m += self.middle[1];
        }
        peaks
    }
}
