//! Fields of cylinders, similar to the worlds of the BARN challenge: a cellular automaton decides which cells have a
//! cylinder (Perille, Truong, Xiao, Stone 2020, `Benchmarking Metric Ground Navigation`). The first and the last metre
//! along x are free.

use periplus_geometry::Stream;

use super::cellular::{AutomatonRule, WallCells};
use super::plan::{FloorPlan, PlanCylinder};
use super::{WorldGeneratorParams, count_of, real};

/// Side of a cell, which is the diameter of a cylinder \[m\].
const CELL_M: f64 = 0.15;
/// Probability of a cell to start filled, without and with full clutter.
const FILL_RANGE_RATIO: [f64; 2] = [0.08, 0.26];
/// Number of steps of the automaton.
const STEPS: usize = 3;
/// Length without cylinders at both ends of x \[m\].
const FREE_END_M: f64 = 1.0;

pub(super) fn build(params: &WorldGeneratorParams, stream: &mut Stream, plan: &mut FloorPlan) {
    plan.add_outer_walls(params);
    let [columns, rows] = [params.size_x_m, params.size_y_m].map(|side| count_of(side, CELL_M));
    let fill = FILL_RANGE_RATIO[0] + (FILL_RANGE_RATIO[1] - FILL_RANGE_RATIO[0]) * params.clutter;
    let rule = AutomatonRule { min_fill: 5, max_clear: 1, is_outside_wall: false };
    let random = WallCells::random(columns, rows, fill, stream);
    let cells = (0..STEPS).fold(random, |cells, _| cells.stepped(rule));
    for (index, _) in cells.is_wall.iter().enumerate().filter(|(_, is_wall)| **is_wall) {
        let (column, row) = (index % columns, index / columns);
        let along = |cell: usize, count: usize, side_m: f64| {
            side_m * ((real(cell) + 0.5) / real(count) - 0.5)
        };
        let centre = [along(column, columns, params.size_x_m), along(row, rows, params.size_y_m)];
        if centre[0].abs() < params.size_x_m / 2.0 - FREE_END_M {
            let (radius_m, height_m) = (CELL_M / 2.0, params.wall_height_m);
            plan.cylinders.push(PlanCylinder { centre, radius_m, height_m });
        }
    }
}
