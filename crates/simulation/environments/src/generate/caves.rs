//! Caves: a cellular automaton smooths random rock (Johnson, Yannakakis, Togelius 2010, "Cellular automata for
//! real-time generation of infinite cave levels").

use periplus_geometry::{Pose2, Stream};
use periplus_grid::{Grid, GridInfo, occupancy};
use periplus_maps::wall_boxes;

use super::cellular::{AutomatonRule, WallCells};
use super::plan::{FloorPlan, PlanBox};
use super::{WorldGeneratorParams, count_of, real};

/// Side of a cell \[m\].
const CELL_M: f64 = 0.25;
/// Probability of a cell to start as rock, without and with full clutter.
const FILL_RANGE_RATIO: [f64; 2] = [0.36, 0.46];
/// Number of steps of the automaton.
const STEPS: usize = 5;
/// Minimum fraction of the cells in the largest cave.
const MIN_CAVE_FRACTION: f64 = 0.35;
/// Number of caves that are drawn until one is large enough.
const MAX_DRAW_COUNT: usize = 32;

pub(super) fn build(params: &WorldGeneratorParams, stream: &mut Stream, plan: &mut FloorPlan) {
    plan.add_outer_walls(params);
    let [columns, rows] = [params.size_x_m, params.size_y_m].map(|side| count_of(side, CELL_M));
    let fill = FILL_RANGE_RATIO[0] + (FILL_RANGE_RATIO[1] - FILL_RANGE_RATIO[0]) * params.clutter;
    let rule = AutomatonRule { min_fill: 5, max_clear: 3, is_outside_wall: true };
    let mut draw = || {
        let random = WallCells::random(columns, rows, fill, stream);
        (0..STEPS).fold(random, |cells, _| cells.stepped(rule))
    };
    let mut cells = draw();
    for _ in 0..MAX_DRAW_COUNT {
        if real(cells.largest_free_area()) > MIN_CAVE_FRACTION * real(columns * rows) {
            break;
        }
        cells = draw();
    }
    let Ok(info) = GridInfo::new(CELL_M, columns, rows, Pose2::IDENTITY) else { return };
    let mut map = Grid::new(info, occupancy::FREE);
    for (cell, is_wall) in map.cells.iter_mut().zip(&cells.is_wall) {
        *cell = if *is_wall { occupancy::OCCUPIED } else { occupancy::FREE };
    }
    let scale = [params.size_x_m / real(columns), params.size_y_m / real(rows)];
    for rock in wall_boxes(&map) {
        let size_m = [real(rock.columns) * scale[0], real(rock.rows) * scale[1]];
        let low = [
            real(rock.column) * scale[0] - params.size_x_m / 2.0,
            real(rock.row) * scale[1] - params.size_y_m / 2.0,
        ];
        let centre = [low[0] + size_m[0] / 2.0, low[1] + size_m[1] / 2.0];
        plan.boxes.push(PlanBox { centre, size_m, yaw_rad: 0.0, height_m: params.wall_height_m });
    }
}
