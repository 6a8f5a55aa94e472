//! Rooms: a rectangle is divided by walls with doors; boxes are furniture.

use std::f64::consts::FRAC_PI_2;

use periplus_geometry::Stream;

use super::plan::{FloorPlan, PlanBox, WallAxis, WallLine};
use super::{WorldGeneratorParams, below, between};

/// Minimum side of a room \[m\].
const MIN_ROOM_SIDE_M: f64 = 2.6;
/// Number of positions that are tried for a wall or a box.
const MAX_DRAW_COUNT: usize = 24;
/// Distance between boxes, and between a box and a door, beyond half of a door's width \[m\].
const PASSAGE_M: f64 = 0.9;
/// Floor area for each box with full clutter \[m²\].
const BOX_AREA_M2: f64 = 5.0;
/// Range of the sides of boxes \[m\].
const BOX_SIDES_M: [f64; 2] = [0.3, 1.4];
/// Height of boxes \[m\].
const BOX_HEIGHT_M: f64 = 0.8;

/// A door in a wall.
#[derive(Clone, Copy)]
struct Door {
    axis: WallAxis,
    centre: [f64; 2],
}

/// Lower left and upper right corner \[m\].
type Rectangle = [[f64; 2]; 2];

pub(super) fn build(params: &WorldGeneratorParams, stream: &mut Stream, plan: &mut FloorPlan) {
    plan.add_outer_walls(params);
    let half = [params.size_x_m / 2.0, params.size_y_m / 2.0];
    let mut open: Vec<Rectangle> = vec![[half.map(|it| -it), half]];
    let (mut rooms, mut doors) = (Vec::new(), Vec::new());
    while let Some(rectangle) = open.pop() {
        match divide(rectangle, params, stream, &mut doors, plan) {
            Some(halves) => open.extend(halves),
            None => rooms.push(rectangle),
        }
    }
    for room in rooms {
        furnish(room, params, stream, &doors, plan);
    }
}

/// Divides a rectangle by a wall with a door across its longer side; none if the halves would be too small.
fn divide(
    [low, high]: Rectangle,
    params: &WorldGeneratorParams,
    stream: &mut Stream,
    doors: &mut Vec<Door>,
    plan: &mut FloorPlan,
) -> Option<[Rectangle; 2]> {
    let size_m = [high[0] - low[0], high[1] - low[1]];
    let long = usize::from(size_m[1] > size_m[0]);
    let across = 1 - long;
    let side_m = MIN_ROOM_SIDE_M.max(params.door_width_m + 1.0);
    if size_m[long] < 2.0 * side_m {
        return None;
    }
    let axis = if long == 0 { WallAxis::Y } else { WallAxis::X };
    let gap_m = params.door_width_m / 2.0 + params.wall_thickness_m + 0.1;
    let is_beside_doors = |at: f64| {
        let mut ends = doors.iter().filter(|door| door.axis != axis);
        ends.all(|door| {
            let is_touched = door.centre[across] >= low[across] - gap_m
                && door.centre[across] <= high[across] + gap_m;
            !is_touched || (door.centre[long] - at).abs() > gap_m
        })
    };
    let mut draws =
        (0..MAX_DRAW_COUNT).map(|_| between(stream, low[long] + side_m, high[long] - side_m));
    let at = draws.find(|at| is_beside_doors(*at))?;
    let edge_m = gap_m + 0.1;
    let door = between(stream, low[across] + edge_m, high[across] - edge_m);
    let line = WallLine { axis, at, from: low[across], to: high[across] };
    plan.add_wall_with_door(line, door, params);
    let mut centre = [0.0; 2];
    (centre[long], centre[across]) = (at, door);
    doors.push(Door { axis, centre });
    let (mut lower_high, mut upper_low) = (high, low);
    (lower_high[long], upper_low[long]) = (at, at);
    Some([[low, lower_high], [upper_low, high]])
}

/// Adds boxes with passages between them and to the doors.
fn furnish(
    [low, high]: Rectangle,
    params: &WorldGeneratorParams,
    stream: &mut Stream,
    doors: &[Door],
    plan: &mut FloorPlan,
) {
    let area_m2 = (high[0] - low[0]) * (high[1] - low[1]);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
    let count = (params.clutter * area_m2 / BOX_AREA_M2).round() as usize;
    let mut placed: Vec<PlanBox> = Vec::new();
    for _ in 0..count {
        for _ in 0..MAX_DRAW_COUNT {
            let size_m = [0; 2].map(|_| between(stream, BOX_SIDES_M[0], BOX_SIDES_M[1]));
            let radius_m = libm::hypot(size_m[0], size_m[1]) / 2.0;
            let margin_m = radius_m + params.wall_thickness_m / 2.0;
            let [x, y] = [0, 1].map(|axis| {
                between(
                    stream,
                    low[axis] + margin_m,
                    (high[axis] - margin_m).max(low[axis] + margin_m),
                )
            });
            // Most furniture is parallel to the walls.
            let yaw_rad = if below(stream, 4) == 0 { between(stream, 0.0, FRAC_PI_2) } else { 0.0 };
            let apart_m = |other: [f64; 2]| libm::hypot(other[0] - x, other[1] - y);
            let is_free = placed.iter().all(|other| {
                let other_m = libm::hypot(other.size_m[0], other.size_m[1]) / 2.0;
                apart_m(other.centre) > radius_m + other_m + PASSAGE_M
            }) && doors.iter().all(|door| {
                apart_m(door.centre) > radius_m + params.door_width_m / 2.0 + PASSAGE_M
            });
            if is_free {
                placed.push(PlanBox { centre: [x, y], size_m, yaw_rad, height_m: BOX_HEIGHT_M });
                break;
            }
        }
    }
    plan.boxes.extend(placed);
}
