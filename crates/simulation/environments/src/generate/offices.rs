//! Offices: a corridor with rooms on both sides, each with a door, a table and a cabinet.

use periplus_geometry::Stream;

use super::plan::{FloorPlan, PlanBox, WallAxis, WallLine};
use super::{WorldGeneratorParams, between};

/// Width of the corridor beyond that of a door \[m\].
const CORRIDOR_MARGIN_M: f64 = 0.5;
/// Range of the widths of offices \[m\].
const OFFICE_WIDTHS_M: [f64; 2] = [2.6, 4.2];
/// Length, depth and height of a table \[m\].
const TABLE_M: [f64; 3] = [1.4, 0.7, 0.75];
/// Length, depth and height of a cabinet \[m\].
const CABINET_M: [f64; 3] = [0.8, 0.4, 1.2];
/// Width of a passage between furniture \[m\].
const PASSAGE_M: f64 = 0.8;

pub(super) fn build(params: &WorldGeneratorParams, stream: &mut Stream, plan: &mut FloorPlan) {
    plan.add_outer_walls(params);
    let half = [params.size_x_m / 2.0, params.size_y_m / 2.0];
    let corridor_half_m = (params.door_width_m + CORRIDOR_MARGIN_M) / 2.0;
    // The corridor is off the middle, but leaves space for a table and a passage on both sides.
    let free_m = half[1] - corridor_half_m - TABLE_M[1] - 2.0 * PASSAGE_M;
    let middle = between(stream, -1.0, 1.0) * (free_m.max(0.0) / 3.0);
    for side in [-1.0, 1.0] {
        let wall = middle + side * corridor_half_m;
        let mut from = -half[0];
        while from < half[0] - 1e-9 {
            let width_m = between(stream, OFFICE_WIDTHS_M[0], OFFICE_WIDTHS_M[1]);
            let is_last = half[0] - from - width_m < OFFICE_WIDTHS_M[0];
            let to = if is_last { half[0] } else { from + width_m };
            office(
                WallLine { axis: WallAxis::X, at: wall, from, to },
                side * half[1],
                params,
                stream,
                plan,
            );
            if !is_last {
                let [low, high] = if side < 0.0 { [-half[1], wall] } else { [wall, half[1]] };
                plan.add_wall(WallLine { axis: WallAxis::Y, at: to, from: low, to: high }, params);
            }
            from = to;
        }
    }
}

/// One office between the wall to the corridor and the outer wall.
fn office(
    wall: WallLine,
    outer_m: f64,
    params: &WorldGeneratorParams,
    stream: &mut Stream,
    plan: &mut FloorPlan,
) {
    let edge_m = params.door_width_m / 2.0 + params.wall_thickness_m;
    let door = between(stream, wall.from + edge_m, (wall.to - edge_m).max(wall.from + edge_m));
    plan.add_wall_with_door(wall, door, params);
    let inwards = if outer_m > wall.at { -1.0 } else { 1.0 };
    let depth_m = (outer_m - wall.at).abs();
    let (low, high) = (wall.from + params.wall_thickness_m, wall.to - params.wall_thickness_m);
    // The table is at the outer wall, or beyond a passage in front of it.
    if depth_m > TABLE_M[1] + 2.0 * PASSAGE_M && stream.unit() < 0.5 + params.clutter {
        let is_behind = depth_m > TABLE_M[1] + 3.0 * PASSAGE_M && stream.unit() < 0.5;
        let off_m = params.wall_thickness_m / 2.0
            + TABLE_M[1] / 2.0
            + if is_behind { PASSAGE_M } else { 0.0 };
        let x = between(stream, low + TABLE_M[0] / 2.0, (high - TABLE_M[0] / 2.0).max(low));
        let centre = [x, outer_m + inwards * off_m];
        let size_m = [TABLE_M[0], TABLE_M[1]];
        plan.boxes.push(PlanBox { centre, size_m, yaw_rad: 0.0, height_m: TABLE_M[2] });
    }
    // The cabinet is at the side wall that is farther from the door.
    if wall.to - wall.from > 2.4 && stream.unit() < params.clutter {
        let is_left = door > (wall.from + wall.to) / 2.0;
        let x = if is_left { low + CABINET_M[1] / 2.0 } else { high - CABINET_M[1] / 2.0 };
        let y = wall.at - inwards * (params.wall_thickness_m + CABINET_M[0] / 2.0);
        let size_m = [CABINET_M[1], CABINET_M[0]];
        plan.boxes.push(PlanBox { centre: [x, y], size_m, yaw_rad: 0.0, height_m: CABINET_M[2] });
    }
}
