//! Costs of cells for GlobalPlanner, and paths from cell to cell.
//!
//! GlobalPlanner's cost of a cell is `neutral_cost + cost_factor * cost`, below `lethal_cost`; NavFn's is
//! `50 + 0.8 * cost`. Only the ratio to the cost of a free cell matters for a path, so that NavFn plans as GlobalPlanner
//! on a costmap with converted costs.
//!
//! Source: `expander.h`, `grid_path.cpp` of `global_planner` (Noetic).

use periplus_costmap::Costmap;
use periplus_costmap::cost::{INSCRIBED, LETHAL, UNKNOWN};
use periplus_geometry::Pose2;
use periplus_grid::{Cell, GridInfo};
use periplus_planners::{PotentialField, navfn_cell_of, navfn_point_of};

use super::global_planner::GlobalPlannerParams;

/// Cost of a free cell in NavFn.
const NAVFN_NEUTRAL_COST: f64 = 50.0;
/// Share of the cost of the costmap in NavFn.
const NAVFN_COST_FACTOR: f64 = 0.8;

/// Converts a cost to the one by which NavFn has the cost of GlobalPlanner.
fn converted(cost: u8, params: &GlobalPlannerParams) -> u8 {
    let lethal = params.lethal_cost as f64;
    match cost {
        UNKNOWN | LETHAL => cost,
        cost if f64::from(cost) >= lethal - 1.0 => cost.max(INSCRIBED),
        INSCRIBED => cost,
        cost => {
            let neutral = params.neutral_cost as f64;
            let beyond = (f64::from(cost) * params.cost_factor).min(lethal - 1.0 - neutral);
            let ratio = beyond.max(0.0) / neutral;
            let own = libm::round(ratio * NAVFN_NEUTRAL_COST / NAVFN_COST_FACTOR);
            own.min(f64::from(INSCRIBED - 1)) as u8
        }
    }
}

/// Returns a costmap with the costs of GlobalPlanner.
pub(super) fn converted_costmap(costmap: &Costmap, params: &GlobalPlannerParams) -> Costmap {
    let table: Vec<u8> = (0..=u8::MAX).map(|cost| converted(cost, params)).collect();
    let mut own = Costmap::new(*costmap.info(), 0);
    for (to, from) in own.costs_mut().iter_mut().zip(costmap.costs()) {
        *to = table[usize::from(*from)];
    }
    own
}

/// Returns the positions from the robot to the end of a path, from cell to cell down the potentials. None if a cell has
/// no lower neighbour.
pub(super) fn grid_path(field: &PotentialField, info: &GridInfo, end: Pose2) -> Option<Vec<Pose2>> {
    let mut cell = navfn_cell_of(info, end.x_m, end.y_m)?;
    let mut potential = field.potential(cell)?;
    let mut cells = vec![cell];
    while potential > 0.0 {
        let lowest = neighbours(cell)
            .filter_map(|next| Some((field.potential(next)?, next)))
            .min_by(|a, b| a.0.total_cmp(&b.0))?;
        if lowest.0 >= potential {
            return None;
        }
        (potential, cell) = lowest;
        cells.push(cell);
    }
    let pose = |(column, row): &Cell| {
        let (x_m, y_m) = navfn_point_of(info, *column as f64, *row as f64);
        Pose2::new(x_m, y_m, 0.0)
    };
    let mut poses: Vec<Pose2> = cells.iter().rev().map(pose).collect();
    if let Some(last) = poses.last_mut() {
        *last = end;
    }
    Some(poses)
}

/// The eight cells around a cell.
fn neighbours((column, row): Cell) -> impl Iterator<Item = Cell> {
    let offsets = [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)];
    offsets.into_iter().filter_map(move |(dx, dy)| {
        Some((column.checked_add_signed(dx)?, row.checked_add_signed(dy)?))
    })
}

#[test]
fn costs_keep_their_ratio_to_that_of_a_free_cell() {
    let check = |cost_factor, neutral_cost, expected: [u8; 3]| {
        let params = GlobalPlannerParams { cost_factor, neutral_cost, ..Default::default() };
        assert_eq!([0, 20, 252].map(|cost| converted(cost, &params)), expected);
        assert_eq!([253, 254, 255].map(|cost| converted(cost, &params)), [253, 254, 255]);
    };
    // The law of NavFn itself; 252 is lethal for GlobalPlanner.
    check(0.8, 50, [0, 20, 253]);
    check(3.0, 50, [0, 75, 253]);
    check(3.0, 66, [0, 57, 253]);
    let params = GlobalPlannerParams { lethal_cost: 100, ..Default::default() };
    assert_eq!([10, 98, 99].map(|cost| converted(cost, &params)), [38, 61, 253]);
}
