//! Uniform grid over the bounding boxes of areas.

use crate::plane::Point2;

/// Side of a cell \[m\]: about the distance of queries.
const CELL_M: f64 = 0.5;
/// Maximum number of cells; larger worlds get larger cells.
const MAX_CELL_COUNT: f64 = 1_000_000.0;

/// Areas by cell, one list after the other.
#[derive(Clone, Debug)]
pub(super) struct AreaIndex {
    low: Point2,
    cell_m: f64,
    columns: usize,
    rows: usize,
    /// First entry of each cell in `areas`, and the end of the last.
    starts: Vec<u32>,
    areas: Vec<u32>,
}

impl AreaIndex {
    pub(super) fn new(boxes: impl Iterator<Item = [Point2; 2]> + Clone) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for [from, to] in boxes.clone() {
            low = [low[0].min(from[0]), low[1].min(from[1])];
            high = [high[0].max(to[0]), high[1].max(to[1])];
        }
        if low[0] > high[0] {
            (low, high) = ([0.0; 2], [0.0; 2]);
        }
        let (width_m, height_m) = (high[0] - low[0], high[1] - low[1]);
        let cell_m = CELL_M.max((width_m * height_m / MAX_CELL_COUNT).sqrt());
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "limited")]
        let cells = |length_m: f64| (length_m / cell_m).floor().min(MAX_CELL_COUNT) as usize + 1;
        let (columns, rows) = (cells(width_m), cells(height_m));
        let mut index = Self {
            low,
            cell_m,
            columns,
            rows,
            starts: vec![0; columns * rows + 1],
            areas: Vec::new(),
        };
        // Counts, then their sums, then the entries.
        for bounds in boxes.clone() {
            index.cells(bounds, 0.0, |cell, starts| starts[cell + 1] += 1);
        }
        for cell in 0..columns * rows {
            index.starts[cell + 1] += index.starts[cell];
        }
        let mut next = index.starts.clone();
        let mut areas = vec![0; next.last().map_or(0, |count| *count as usize)];
        for (area, bounds) in (0_u32..).zip(boxes) {
            index.cells(bounds, 0.0, |cell, _| {
                areas[next[cell] as usize] = area;
                next[cell] += 1;
            });
        }
        index.areas = areas;
        index
    }

    /// Calls `visit` for the cells that touch a box with a margin.
    fn cells(
        &mut self,
        bounds: [Point2; 2],
        margin_m: f64,
        mut visit: impl FnMut(usize, &mut [u32]),
    ) {
        let Some([columns, rows]) = self.ranges(bounds, margin_m) else { return };
        for row in rows[0]..=rows[1] {
            for column in columns[0]..=columns[1] {
                visit(row * self.columns + column, &mut self.starts);
            }
        }
    }

    /// First and last column and row that touch a box with a margin.
    fn ranges(&self, [low, high]: [Point2; 2], margin_m: f64) -> Option<[[usize; 2]; 2]> {
        let range = |axis: usize, count: usize| {
            let from = (low[axis] - margin_m - self.low[axis]) / self.cell_m;
            let to = (high[axis] + margin_m - self.low[axis]) / self.cell_m;
            #[expect(clippy::cast_precision_loss, reason = "cells are below a million")]
            let is_outside = !(to >= 0.0 && from < count as f64);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
            let cell = |at: f64| (at.max(0.0) as usize).min(count - 1);
            (!is_outside).then(|| [cell(from), cell(to)])
        };
        Some([range(0, self.columns)?, range(1, self.rows)?])
    }

    /// Calls `visit` with the areas whose boxes may be within a distance of a box, some of them repeatedly.
    pub(super) fn visit(&self, bounds: [Point2; 2], distance_m: f64, mut visit: impl FnMut(usize)) {
        let Some([columns, rows]) = self.ranges(bounds, distance_m) else { return };
        for row in rows[0]..=rows[1] {
            let first = row * self.columns;
            // The lists of neighbours in a row follow each other.
            let from = self.starts[first + columns[0]] as usize;
            let to = self.starts[first + columns[1] + 1] as usize;
            self.areas[from..to].iter().for_each(|area| visit(*area as usize));
        }
    }
}
