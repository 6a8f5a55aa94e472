//! Log-likelihood and inlier ratio of a scan at a pose, with occlusion by the walls of the map.
//!
//! A likelihood field alone does not penalize beams that pass through walls. Here each beam is also
//! compared with the first wall along its ray (EXPERIMENTS.md, step 5).

use periplus_geometry::Pose2;

use crate::likelihood_map::{CellState, LikelihoodMap};
use crate::scan::Beams;

/// Approximate number of beams that are evaluated.
const MAX_BEAMS: usize = 90;
/// Number of beams that count as independent, since the errors of adjacent beams are correlated
/// (EXPERIMENTS.md, step 6).
const INDEPENDENT_BEAM_COUNT: f64 = 12.0;
/// Standard deviation of the distance between a hit and its wall \[m\].
const SIGMA_M: f64 = 0.1;
/// A beam passes through a wall that is nearer than its range by more than this \[m\].
const OCCLUSION_MARGIN_M: f64 = 0.5;
/// Walls nearer to the scanner than this do not block beams \[m\].
const OCCLUSION_RANGE_MIN_M: f64 = 0.2;
/// Likelihoods of a hit at a wall, of an obstacle that the map lacks in front of a wall, of a beam
/// through a wall, and of no echo where the map has a wall.
const HIT_FACTOR: f64 = 1.0;
const SHORT_FACTOR: f64 = 0.12;
const THROUGH_WALL_FACTOR: f64 = 0.03;
const NO_ECHO_FACTOR: f64 = 0.2;
/// Likelihood of a robot outside of the free cells.
const NOT_FREE_FACTOR: f64 = 0.02;

/// Minimum fraction of the hits in the denominator of [`InlierRatios::judged`].
const MIN_JUDGED_FRACTION: f64 = 0.5;

/// Fractions of the hits of a scan, 0 to 1. An inlier ends at a wall of the map and passes through
/// none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct InlierRatios {
    /// Inliers among all hits: the measure for a new pose hypothesis.
    pub(crate) all: f64,
    /// Inliers among the hits that the map can judge, at least half of all: the measure for a pose
    /// that was tracked. Hits in unknown space with no wall in front do not count, so that the edge
    /// of the map is not a contradiction (EXPERIMENTS.md, step 13).
    pub(crate) judged: f64,
    /// Hits among all that end in known free space or pass through a wall.
    pub(crate) contradicted: f64,
}

/// Computes the inlier ratios of a scan at a pose, or returns none when no beam hit anything.
pub(crate) fn inlier_ratios(
    map: &LikelihoodMap,
    beams: &Beams,
    map_from_base: Pose2,
) -> Option<InlierRatios> {
    let cell_transform = map.cell_transform();
    let map_from_laser = map_from_base * beams.base_from_scanner;
    let start = (map_from_laser.x_m, map_from_laser.y_m);
    let every = beams.beams.len().div_ceil(MAX_BEAMS).max(1);
    let (mut sum, mut count, mut unknown, mut contradicted) = (0.0, 0.0_f64, 0.0, 0.0);
    let hits = beams.beams.iter().filter(|beam| beam.range_m < beams.range_max_m);
    for beam in hits.step_by(every) {
        count += 1.0;
        let [x, y] = beam.end_m;
        let (x_m, y_m) = map_from_base.transform_point(x, y);
        let error_sigmas = map.distance_m(x_m, y_m) / SIGMA_M;
        let is_outlier = error_sigmas > 3.0;
        if is_outlier && map.is_known(x_m, y_m) {
            contradicted += 1.0;
            continue;
        }
        let bearing_rad = map_from_base.yaw_rad + beam.bearing_rad;
        let wall_m = map.cast_ray_m(
            &cell_transform,
            start,
            bearing_rad,
            OCCLUSION_RANGE_MIN_M,
            beam.range_m,
        );
        if is_outlier && wall_m >= beam.range_m {
            unknown += 1.0;
        } else if !is_outlier && wall_m >= beam.range_m - OCCLUSION_MARGIN_M {
            sum += libm::exp(-0.5 * error_sigmas * error_sigmas);
        } else {
            contradicted += 1.0;
        }
    }
    if count == 0.0 {
        return None;
    }
    let judged = sum / (count - unknown).max(MIN_JUDGED_FRACTION * count);
    Some(InlierRatios { all: sum / count, judged, contradicted: contradicted / count })
}

/// Log-likelihood of a scan at a pose \[nats\], up to an additive constant.
pub(crate) fn log_likelihood(map: &LikelihoodMap, beams: &Beams, map_from_base: Pose2) -> f64 {
    let cell_transform = map.cell_transform();
    let map_from_laser = map_from_base * beams.base_from_scanner;
    let start = (map_from_laser.x_m, map_from_laser.y_m);
    let every = beams.beams.len().div_ceil(MAX_BEAMS).max(1);
    let (mut sum, mut count) = (0.0, 0);
    for beam in beams.beams.iter().step_by(every) {
        let bearing_rad = map_from_base.yaw_rad + beam.bearing_rad;
        let range_m = beam.range_m.min(beams.range_max_m);
        let wall_m =
            map.cast_ray_m(&cell_transform, start, bearing_rad, OCCLUSION_RANGE_MIN_M, range_m);
        let passes_wall = wall_m < range_m - OCCLUSION_MARGIN_M;
        let p = if beam.range_m >= beams.range_max_m {
            if passes_wall { NO_ECHO_FACTOR } else { HIT_FACTOR }
        } else if passes_wall {
            THROUGH_WALL_FACTOR
        } else {
            let [x, y] = beam.end_m;
            let (x_m, y_m) = map_from_base.transform_point(x, y);
            let error_sigmas = map.distance_m(x_m, y_m) / SIGMA_M;
            SHORT_FACTOR
                + (HIT_FACTOR - SHORT_FACTOR) * libm::exp(-0.5 * error_sigmas * error_sigmas)
        };
        sum += libm::log(p);
        count += 1;
    }
    let state = map.state(map.cell_at(map_from_base.x_m, map_from_base.y_m));
    let occupancy = if state == Some(CellState::Free) { 0.0 } else { libm::log(NOT_FREE_FACTOR) };
    let independent_fraction = (INDEPENDENT_BEAM_COUNT / f64::from(count.max(1))).min(1.0);
    independent_fraction * sum + occupancy
}
