//! Assertions about obstacles and maps.

use periplus_evaluation::score_map;
use periplus_session::SimulationSession;

use super::Verdict;
use crate::run::RunRecord;
use crate::tables::{MapIouParams, MinClearanceParams};

/// Distance at which two wall cells of the map and of the truth match, relative to the size of a cell: a bit more than
/// the diagonal.
const MATCH_CELLS_RATIO: f64 = 1.001 * std::f64::consts::SQRT_2;

/// Largest rotation by which a map is aligned with the truth \[rad\].
const WINDOW_RAD: f64 = 0.1;

pub(super) fn no_collision(record: &RunRecord) -> Verdict {
    if !record.truth.has_robot {
        return Verdict::unknown("there is no robot");
    }
    let count = record.truth.collision_count;
    let message = if count == 0 {
        "touched nothing".to_owned()
    } else {
        format!("touched an obstacle {count} times")
    };
    Verdict::new(count == 0, count as f64, "", message)
}

pub(super) fn min_clearance(params: &MinClearanceParams, record: &RunRecord) -> Verdict {
    if !record.truth.has_robot {
        return Verdict::unknown("there is no robot");
    }
    let clearance_m = record.truth.min_clearance_m;
    if clearance_m.is_infinite() {
        let message = "there are no obstacles in the region of the true map";
        return Verdict { has_passed: true, ..Verdict::unknown(message) };
    }
    let message = format!("smallest clearance {clearance_m:.3} m (limit {})", params.distance_m);
    Verdict::new(clearance_m >= params.distance_m, clearance_m, "m", message)
}

pub(super) fn map_iou(
    params: &MapIouParams,
    session: &mut SimulationSession,
    record: &RunRecord,
) -> Verdict {
    let Some(map) = &record.slam_map else { return Verdict::unknown("SLAM has no map") };
    let truth = record.grid.and_then(|grid| session.simulation_mut().truth_map(grid));
    let Some(truth) = truth else { return Verdict::unknown("there is no robot") };
    let tolerance_m = MATCH_CELLS_RATIO * truth.info.resolution_m;
    let window_rad = if params.window_m > 0.0 { WINDOW_RAD } else { 0.0 };
    let score = match score_map(&truth, map, tolerance_m, params.window_m, window_rad) {
        Ok(score) => score,
        Err(error) => return Verdict::unknown(format!("the maps cannot be compared: {error}")),
    };
    let Some(iou) = score.wall_iou else {
        return Verdict::unknown("neither map has walls in the explored part");
    };
    let (limit, explored) = (params.min_ratio, 1.0 - score.unknown_ratio.unwrap_or(1.0));
    let message = format!("wall IoU {iou:.4} (limit {limit}), {:.0} % explored", 100.0 * explored);
    Verdict::new(iou >= limit, iou, "", message)
}
