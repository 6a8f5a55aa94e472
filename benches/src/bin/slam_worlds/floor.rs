//! Free space of a small robot, and paths in it.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use periplus_geometry::{Pose2, Stream};
use periplus_grid::{Cell, Grid, GridInfo, Line, squared_distances};

use crate::stage::Stage;

/// Side of a cell \[m\].
const CELL_M: f64 = 0.05;
/// Minimum distance of the robot's center from all obstacles \[m\].
const CLEARANCE_M: f64 = 0.3;
/// Heights at which obstacles block the robot: wheels, deck and laser \[m\].
const HEIGHTS_M: [f64; 5] = [0.015, 0.045, 0.06, 0.075, 0.095];
/// Maximum distance between successive goals on a straight path \[m\].
const STEP_M: f64 = 0.5;
/// Minimum distance between goals \[m\].
const APART_M: f64 = 2.0;

/// The floor as a robot sees it.
pub(crate) struct Floor {
    /// Distance to the nearest thing, squared, in cells.
    room: Grid<u32>,
}

impl Floor {
    /// Sweeps the world with rays along rows and columns.
    pub(crate) fn of(stage: &Stage) -> Self {
        let [x0, y0, x1, y1] = stage.bounds_m;
        let cells = |length: f64| (length / CELL_M).ceil() as usize;
        let origin = Pose2::new(x0, y0, 0.0);
        let info = GridInfo::new(CELL_M, cells(x1 - x0), cells(y1 - y0), origin)
            .unwrap_or_else(|why| panic!("bounds of a world are sound: {why}"));
        let mut things = Grid::new(info, false);
        let mut sweep = |from: [f64; 2], angle_rad: f64, length_m: f64| {
            for z in HEIGHTS_M {
                let mut gone_m = 0.0;
                while gone_m < length_m {
                    let (x, y) =
                        (from[0] + gone_m * angle_rad.cos(), from[1] + gone_m * angle_rad.sin());
                    let Some(hit_m) = stage.cast([x, y, z], angle_rad, length_m - gone_m) else {
                        break;
                    };
                    let (x, y) = (x + hit_m * angle_rad.cos(), y + hit_m * angle_rad.sin());
                    if let Some(cell) = info.cell_of(x, y) {
                        things.cells[info.index(cell)] = true;
                    }
                    gone_m += hit_m + 0.01;
                }
            }
        };
        let quarter = std::f64::consts::FRAC_PI_2;
        for row in 0..info.height {
            let y = y0 + (row as f64 + 0.5) * CELL_M;
            sweep([x0, y], 0.0, x1 - x0);
            sweep([x1, y], 2.0 * quarter, x1 - x0);
        }
        for column in 0..info.width {
            let x = x0 + (column as f64 + 0.5) * CELL_M;
            sweep([x, y0], quarter, y1 - y0);
            sweep([x, y1], -quarter, y1 - y0);
        }
        Self { room: squared_distances(&things, |it| *it) }
    }

    fn room_m(&self, cell: Cell) -> f64 {
        f64::from(self.room.cells[self.room.info.index(cell)]).sqrt() * CELL_M
    }

    /// Goals on paths to random positions, up to a total path length \[m\].
    pub(crate) fn wander(
        &self,
        start: [f64; 2],
        length_m: f64,
        stream: &mut Stream,
    ) -> Vec<[f64; 2]> {
        let info = self.room.info;
        let Some(mut here) = info.cell_of(start[0], start[1]) else { return Vec::new() };
        let mut way: Vec<[f64; 2]> = Vec::new();
        let mut gone_m = 0.0;
        while gone_m < length_m {
            let costs = self.costs(here);
            let reached: Vec<usize> = (0..info.len())
                .filter(|&index| {
                    let (column, row) = info.cell(index);
                    let (dx, dy) = (column.abs_diff(here.0) as f64, row.abs_diff(here.1) as f64);
                    costs[index].is_some() && dx.hypot(dy) * CELL_M > APART_M
                })
                .collect();
            if reached.is_empty() {
                break;
            }
            let goal = reached[(stream.unit() * reached.len() as f64) as usize];
            let mut cells = vec![info.cell(goal)];
            while let Some(Some((_, before))) = costs.get(info.index(cells[cells.len() - 1])) {
                if *before == cells[cells.len() - 1] {
                    break;
                }
                cells.push(*before);
            }
            cells.reverse();
            let mut last = here;
            for cell in self.corners(&cells) {
                let ((x, y), (to_x, to_y)) = (info.centre_of(last), info.centre_of(cell));
                let length_m = (to_x - x).hypot(to_y - y);
                let steps = (length_m / STEP_M).ceil().max(1.0);
                // Far goals are reached in arcs, which leave the straight path.
                for step in 1..=steps as usize {
                    let part = step as f64 / steps;
                    way.push([x + part * (to_x - x), y + part * (to_y - y)]);
                }
                gone_m += length_m;
                last = cell;
            }
            here = last;
        }
        way
    }

    /// Cheapest paths from a cell to all others: cost, and the previous cell.
    fn costs(&self, start: Cell) -> Vec<Option<(u32, Cell)>> {
        let info = self.room.info;
        let mut best: Vec<Option<(u32, Cell)>> = vec![None; info.len()];
        let mut settled = vec![false; info.len()];
        let mut heap = BinaryHeap::new();
        best[info.index(start)] = Some((0, start));
        heap.push(Reverse((0, start)));
        while let Some(Reverse((cost, cell))) = heap.pop() {
            if std::mem::replace(&mut settled[info.index(cell)], true) {
                continue;
            }
            for (dx, dy, length) in [
                (-1, 0, 10),
                (1, 0, 10),
                (0, -1, 10),
                (0, 1, 10),
                (-1, -1, 14),
                (-1, 1, 14),
                (1, -1, 14),
                (1, 1, 14),
            ] {
                let Some(column) = cell.0.checked_add_signed(dx) else { continue };
                let Some(row) = cell.1.checked_add_signed(dy) else { continue };
                let next = (column, row);
                if !info.contains(next) || self.room_m(next) < CLEARANCE_M {
                    continue;
                }
                // Where there is room it is better to stay away from things.
                let tightness = (0.8 - self.room_m(next)).max(0.0);
                let cost = cost + (f64::from(length) * (1.0 + 4.0 * tightness)) as u32;
                let known = &mut best[info.index(next)];
                if known.is_none_or(|(known, _)| cost < known) {
                    *known = Some((cost, cell));
                    heap.push(Reverse((cost, next)));
                }
            }
        }
        best
    }

    /// Corners of a path: the cells left when straight segments with enough clearance replace the others.
    fn corners(&self, cells: &[Cell]) -> Vec<Cell> {
        let mut corners = Vec::new();
        let mut at = 0;
        while at + 1 < cells.len() {
            let is_free = |to: &usize| {
                Line::between(cells[at], cells[*to]).all(|it| self.room_m(it) >= CLEARANCE_M)
            };
            let to = (at + 1..cells.len()).rev().find(is_free).unwrap_or(at + 1);
            corners.push(cells[to]);
            at = to;
        }
        corners
    }
}
