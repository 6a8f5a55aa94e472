//! Where a robot may be of which nothing is known: where in all of the map its scan fits.

use periplus_geometry::Pose2;
use periplus_scan_matching::Peak;

use crate::hunt::{Hunt, Wanted as Places};
use crate::known_map::{CellState, KnownMap};
use crate::pyramid::Pyramid;

/// More cells than this and they are taken larger.
const MOST_CELLS: f64 = 4e6;
/// Nor more along a side.
const MOST_ALONG: f64 = 60_000.0;
/// Finer cells cost time and tell nothing more: particles find the rest.
const LEAST_CELL_M: f64 = 0.1;
/// More points cost time and tell nothing more.
const MOST_POINTS: usize = 45;
/// Places where a smaller part of the scan fits are none: with 60 % of it on walls a place has more.
const LEAST_SCORE: f64 = 0.42;
/// Places that fit nearly as well as the best may be the one: down to this share of it.
const SHARE: f64 = 0.8;
/// Never more places, and of such near to each other the better one.
const PLACES: Places = Places { most: 200, apart: (0.4, 0.3) };
/// After so many lookups only what reaches a larger share of the best is wanted, and of a scan, so that
/// the end comes soon; after twice as many it has come.
const MOST_WORK: u64 = 16_000_000;
const NARROW: (f64, f64) = (0.92, 0.5);
/// Around a place there are few, and they come soon.
const PLACES_NEAR: Places = Places { most: 6, apart: (0.3, 0.2) };
const SHARE_NEAR: f64 = 0.85;
const MOST_WORK_NEAR: u64 = 600_000;

/// A map, prepared for the search on all of it.
#[derive(Clone, Debug)]
pub(crate) struct Everywhere {
    pyramid: Pyramid,
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
        let longest = 2.0 * half_x_m.max(half_y_m) / MOST_ALONG;
        let cell_m = lattice.resolution_m.max(LEAST_CELL_M).max(least).max(longest);
        let corners = [[x_m - half_x_m, y_m - half_y_m], [x_m + half_x_m, y_m + half_y_m]];
        let free = map.places(CellState::Free);
        let pyramid = Pyramid::new(map.walls(), free, corners, cell_m);
        Self { pyramid }
    }

    /// Begins to look for where points fit that a scanner saw, in the frame of the base \[m\]. Of
    /// places that fit less than `least` (0 to 1) nothing is wanted.
    pub(crate) fn hunt(&self, ends: &[[f32; 2]], least: f64) -> Hunt {
        let (points, step_rad) = self.thinned(ends);
        Hunt::new(&self.pyramid, &points, step_rad, (least.max(LEAST_SCORE), SHARE), None)
    }

    /// Goes on for about so many lookups.
    pub(crate) fn go_on(&self, hunt: &mut Hunt, most: u64) {
        hunt.go_on(&self.pyramid, most, &PLACES);
        if hunt.work() > MOST_WORK && !hunt.is_done() {
            hunt.narrow(NARROW.0, NARROW.1);
        }
        if hunt.work() > 2 * MOST_WORK {
            hunt.give_up();
        }
    }

    /// Which part of points that a scanner saw fits at a pose, as the search counts it.
    pub(crate) fn score(&self, ends: &[[f32; 2]], pose: Pose2) -> f64 {
        let (points, _) = self.thinned(ends);
        self.pyramid.score(&points, pose)
    }

    /// Where points fit that a scanner saw, in the frame of the base \[m\], the best first.
    pub(crate) fn peaks(&self, ends: &[[f32; 2]]) -> Vec<Peak> {
        let mut hunt = self.hunt(ends, 0.0);
        while !hunt.is_done() {
            self.go_on(&mut hunt, MOST_WORK / 4);
        }
        hunt.into_peaks().0
    }

    /// The same not farther from a pose than so, along each axis of the map and in heading.
    pub(crate) fn peaks_near(
        &self,
        ends: &[[f32; 2]],
        pose: Pose2,
        (half_m, half_rad): (f64, f64),
    ) -> Vec<Peak> {
        let (points, step_rad) = self.thinned(ends);
        let wanted = (LEAST_SCORE, SHARE_NEAR);
        let near = Some((pose, half_m, half_rad));
        let mut hunt = Hunt::new(&self.pyramid, &points, step_rad, wanted, near);
        hunt.go_on(&self.pyramid, MOST_WORK_NEAR, &PLACES_NEAR);
        hunt.into_peaks().0
    }

    /// No more points than are useful, and from heading to heading.
    fn thinned(&self, ends: &[[f32; 2]]) -> (Vec<[f32; 2]>, f64) {
        let every = ends.len().div_ceil(MOST_POINTS).max(1);
        let points: Vec<[f32; 2]> = ends.iter().step_by(every).copied().collect();
        let farthest = points.iter().map(|[x, y]| x * x + y * y).fold(0.0, f32::max).sqrt();
        // The farthest of points moves by one cell from heading to heading.
        let step_rad = (self.pyramid.cell_m / f64::from(farthest).max(0.1)).clamp(0.02, 0.1);
        (points, step_rad)
    }
}
