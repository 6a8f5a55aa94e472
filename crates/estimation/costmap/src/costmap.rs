//! A grid of costs.
//!
//! Source of the rules: `nav2_costmap_2d/src/costmap_2d.cpp`.

use periplus_geometry::Pose2;
use periplus_grid::{Cell, CellFinder, Grid, GridInfo};

use crate::{Bounds, Compat, Window};

/// A cost in every cell, and one for cells of which nothing is known. Its rows run along x of the
/// global frame: it is never turned.
#[derive(Clone, Debug, PartialEq)]
pub struct Costmap {
    grid: Grid<u8>,
    /// What new and reset cells hold.
    pub default_cost: u8,
}

impl Costmap {
    /// With the default everywhere. A turn of the grid is dropped.
    #[must_use]
    pub fn new(info: GridInfo, default_cost: u8) -> Self {
        let info = GridInfo { origin: Pose2 { yaw_rad: 0.0, ..info.origin }, ..info };
        Self { grid: Grid::new(info, default_cost), default_cost }
    }

    /// Without a cell.
    #[must_use]
    pub fn empty(default_cost: u8) -> Self {
        let info = GridInfo { resolution_m: 1.0, width: 0, height: 0, origin: Pose2::IDENTITY };
        Self::new(info, default_cost)
    }

    /// Where the cells are.
    #[must_use]
    pub fn info(&self) -> &GridInfo {
        &self.grid.info
    }

    /// Costs, row by row from the lower left corner.
    #[must_use]
    pub fn costs(&self) -> &[u8] {
        &self.grid.cells
    }

    /// The same, to be changed.
    #[must_use]
    pub fn costs_mut(&mut self) -> &mut [u8] {
        &mut self.grid.cells
    }

    /// Length of a side of a cell \[m\].
    #[must_use]
    pub fn resolution_m(&self) -> f64 {
        self.grid.info.resolution_m
    }

    /// The cost of a cell; none outside.
    #[must_use]
    pub fn cost(&self, cell: Cell) -> Option<u8> {
        self.grid.get(cell).copied()
    }

    /// The cost at a point of the global frame \[m\]; none outside.
    #[must_use]
    pub fn cost_at(&self, x_m: f64, y_m: f64) -> Option<u8> {
        self.grid.at(x_m, y_m).copied()
    }

    /// Sets the cost of a cell; nothing outside.
    pub fn set(&mut self, cell: Cell, cost: u8) {
        if self.grid.info.contains(cell) {
            self.grid[cell] = cost;
        }
    }

    /// Finds the cells of points.
    #[must_use]
    pub fn finder(&self) -> CellFinder {
        self.grid.info.finder()
    }

    /// The cell of a point, also beyond the grid; what is left over is dropped towards the corner
    /// (`worldToMapNoBounds`).
    #[must_use]
    pub fn cell_anywhere(&self, x_m: f64, y_m: f64) -> (i64, i64) {
        self.grid.info.whole_cells_to(x_m, y_m)
    }

    /// How many cells a length covers, the last one counted whole (`cellDistance`).
    #[must_use]
    pub fn cells_along(&self, length_m: f64) -> u32 {
        let cells = libm::ceil(length_m / self.resolution_m());
        if cells > 0.0 { cells as u32 } else { 0 }
    }

    /// The cells that an update within some bounds concerns; none when the bounds are empty.
    #[must_use]
    pub fn window_of(&self, bounds: &Bounds) -> Option<Window> {
        let info = self.info();
        if info.is_empty() {
            return None;
        }
        let (x0, y0) = cell_clamped(info, bounds.min_x, bounds.min_y);
        let (xn, yn) = cell_clamped(info, bounds.max_x, bounds.max_y);
        let (xn, yn) = ((xn + 1).min(info.width), (yn + 1).min(info.height));
        (xn >= x0 && yn >= y0).then_some(Window { x0, y0, xn, yn })
    }

    /// Puts one cost into all cells.
    pub fn fill(&mut self, cost: u8) {
        self.grid.cells.fill(cost);
    }

    /// Puts the default into all cells.
    pub fn reset(&mut self) {
        self.fill(self.default_cost);
    }

    /// Puts the default into a part.
    pub fn reset_window(&mut self, window: &Window) {
        for span in window.spans(self.grid.info.width) {
            self.grid.cells[span].fill(self.default_cost);
        }
    }

    /// Copies a part of another grid with the same cells.
    pub fn copy_window(&mut self, from: &Self, window: &Window) {
        debug_assert_eq!(self.info(), from.info());
        for span in window.spans(self.grid.info.width) {
            self.grid.cells[span.clone()].copy_from_slice(&from.grid.cells[span]);
        }
    }

    /// Takes other cells; what was in the old ones is forgotten.
    pub fn resize(&mut self, info: GridInfo) {
        *self = Self::new(info, self.default_cost);
    }

    /// Moves by whole cells so that a robot is in the middle. What is still in the window keeps its
    /// place in the world, new cells hold the default.
    pub fn roll_around(&mut self, robot: Pose2, compat: Compat) {
        let (half_width_m, half_height_m) = half_size_m(self.info(), compat);
        let (x_m, y_m) = (robot.x_m - half_width_m, robot.y_m - half_height_m);
        // A robot at infinity would move the grid there for good.
        if x_m.is_finite() && y_m.is_finite() {
            self.grid.roll_to(x_m, y_m, self.default_cost);
        }
    }
}

/// Distance of the lower left corner of a grid from a robot in its middle, along x and y \[m\].
pub(crate) fn half_size_m(info: &GridInfo, compat: Compat) -> (f64, f64) {
    let length = |cells: usize| (cells as f64 - compat.missing_cells()) * info.resolution_m;
    (length(info.width) / 2.0, length(info.height) / 2.0)
}

/// The cell of a point; points beyond a side get the cell at that side, and one on the upper edge the
/// cell after the last (`worldToMapEnforceBounds`).
pub(crate) fn cell_clamped(info: &GridInfo, x_m: f64, y_m: f64) -> Cell {
    let GridInfo { resolution_m, width, height, origin } = *info;
    let clamp = |at: f64, start: f64, count: usize| {
        if at < start {
            0
        } else if at > resolution_m * count as f64 + start {
            count.saturating_sub(1)
        } else {
            ((at - start) / resolution_m) as usize
        }
    };
    (clamp(x_m, origin.x_m, width), clamp(y_m, origin.y_m, height))
}
