//! What a scan says for a place: walls where beams end, and none before.
//!
//! A likelihood field alone does not see that a beam went through a wall; here each beam is also
//! held against the wall that it should have hit first.

use periplus_geometry::Pose2;

use crate::known_map::{CellState, KnownMap};
use crate::scan::Beams;

/// Beams that are looked at, about.
const BEAMS: usize = 90;
/// Neighbouring beams are wrong together: so many count as independent.
const INDEPENDENT: f64 = 12.0;
/// How far from a wall a beam ends that hit it: one standard deviation \[m\].
const SIGMA_M: f64 = 0.1;
/// A wall that is nearer by more than this stood in the way \[m\].
const THROUGH_M: f64 = 0.5;
/// Nothing nearer to the scanner than this stands in the way \[m\].
const NEAR_M: f64 = 0.2;
/// Likelihoods: of a hit at the wall, of what the map does not have before it, of a beam through a
/// wall, of no echo where a wall is.
const HIT: f64 = 1.0;
const SHORT: f64 = 0.12;
const THROUGH: f64 = 0.03;
const UNSEEN: f64 = 0.2;
/// Of a robot where the map says that none can be.
const NOT_FREE: f64 = 0.02;

/// Of beams that hit something at least such a share counts, however little the map knows there.
const LEAST_JUDGED: f64 = 0.5;

/// Which part of the beams that hit anything ends at walls of the map and goes through none, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Agreement {
    /// Of all beams: what a place that is new has to have for itself.
    pub(crate) all: f64,
    /// Of those that the map can judge, at least half of all: for a robot that came here by a way that
    /// it knew. What ends where the map knows nothing, with no wall in between, says nothing then, so
    /// that the edge of a map is no contradiction.
    pub(crate) judged: f64,
    /// Of all beams, those that end where the map knows that nothing is, or go through a wall.
    pub(crate) contradicted: f64,
}

/// None when nothing was hit.
pub(crate) fn agreement(map: &KnownMap, beams: &Beams, map_from_base: Pose2) -> Option<Agreement> {
    let finder = map.finder();
    let map_from_laser = map_from_base * beams.base_from_laser;
    let start = (map_from_laser.x_m, map_from_laser.y_m);
    let every = beams.beams.len().div_ceil(BEAMS).max(1);
    let (mut sum, mut count, mut silent, mut contradicted) = (0.0, 0.0_f64, 0.0, 0.0);
    let hits = beams.beams.iter().filter(|beam| beam.range_m < beams.range_max_m);
    for beam in hits.step_by(every) {
        count += 1.0;
        let [x, y] = beam.end_m;
        let (x_m, y_m) = map_from_base.transform_point(x, y);
        let off = map.distance_m(x_m, y_m) / SIGMA_M;
        let is_off = off > 3.0;
        if is_off && map.is_known(x_m, y_m) {
            contradicted += 1.0;
            continue;
        }
        let bearing_rad = map_from_base.yaw_rad + beam.bearing_rad;
        let wall_m = map.wall_m(&finder, start, bearing_rad, NEAR_M, beam.range_m);
        if is_off && wall_m >= beam.range_m {
            silent += 1.0;
        } else if !is_off && wall_m >= beam.range_m - THROUGH_M {
            sum += libm::exp(-0.5 * off * off);
        } else {
            contradicted += 1.0;
        }
    }
    if count == 0.0 {
        return None;
    }
    let judged = sum / (count - silent).max(LEAST_JUDGED * count);
    Some(Agreement { all: sum / count, judged, contradicted: contradicted / count })
}

/// The natural logarithm of how likely a scan is at a place; only differences between places mean
/// anything.
pub(crate) fn evidence(map: &KnownMap, beams: &Beams, map_from_base: Pose2) -> f64 {
    let finder = map.finder();
    let map_from_laser = map_from_base * beams.base_from_laser;
    let start = (map_from_laser.x_m, map_from_laser.y_m);
    let every = beams.beams.len().div_ceil(BEAMS).max(1);
    let (mut sum, mut count) = (0.0, 0);
    for beam in beams.beams.iter().step_by(every) {
        let bearing_rad = map_from_base.yaw_rad + beam.bearing_rad;
        let reach_m = beam.range_m.min(beams.range_max_m);
        let wall_m = map.wall_m(&finder, start, bearing_rad, NEAR_M, reach_m);
        let goes_through = wall_m < reach_m - THROUGH_M;
        let p = if beam.range_m >= beams.range_max_m {
            if goes_through { UNSEEN } else { HIT }
        } else if goes_through {
            THROUGH
        } else {
            let [x, y] = beam.end_m;
            let (x_m, y_m) = map_from_base.transform_point(x, y);
            let off = map.distance_m(x_m, y_m) / SIGMA_M;
            SHORT + (HIT - SHORT) * libm::exp(-0.5 * off * off)
        };
        sum += libm::log(p);
        count += 1;
    }
    let state = map.state(map.cell_at(map_from_base.x_m, map_from_base.y_m));
    let standing = if state == Some(CellState::Free) { 0.0 } else { libm::log(NOT_FREE) };
    let share = (INDEPENDENT / f64::from(count.max(1))).min(1.0);
    share * sum + standing
}
