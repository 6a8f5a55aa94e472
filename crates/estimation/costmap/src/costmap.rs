//! Grid of costs.
//!
//! Source of the rules: `nav2_costmap_2d/src/costmap_2d.cpp`.

use periplus_geometry::Pose2;
use periplus_grid::{Cell, CellFinder, Grid, GridInfo};

use crate::{CellWindow, Nav2Release, UpdateBounds};

/// Two-dimensional grid of costs with a default cost. Its axes are those of the global frame: it is
/// never rotated.
#[derive(Clone, Debug, PartialEq)]
pub struct Costmap {
    grid: Grid<u8>,
    /// Cost of new and reset cells.
    pub default_cost: u8,
}

impl Costmap {
    /// Creates a costmap with the default cost in all cells. A rotation of the origin is dropped.
    #[must_use]
    pub fn new(info: GridInfo, default_cost: u8) -> Self {
        let info = GridInfo { origin: Pose2 { yaw_rad: 0.0, ..info.origin }, ..info };
        Self { grid: Grid::new(info, default_cost), default_cost }
    }

    /// Creates a costmap without cells.
    #[must_use]
    pub fn empty(default_cost: u8) -> Self {
        let info = GridInfo { resolution_m: 1.0, width: 0, height: 0, origin: Pose2::IDENTITY };
        Self::new(info, default_cost)
    }

    /// Returns resolution, size and origin.
    #[must_use]
    pub fn info(&self) -> &GridInfo {
        &self.grid.info
    }

    /// Returns the costs, row by row from the lower left corner.
    #[must_use]
    pub fn costs(&self) -> &[u8] {
        &self.grid.cells
    }

    /// Returns the mutable costs, row by row from the lower left corner.
    #[must_use]
    pub fn costs_mut(&mut self) -> &mut [u8] {
        &mut self.grid.cells
    }

    /// Hands the costs to a function and keeps what it returns, without a copy. Costs of another length are
    /// replaced by the default cost.
    ///
    /// ```
    /// use periplus_costmap::Costmap;
    /// use periplus_geometry::Pose2;
    /// use periplus_grid::GridInfo;
    ///
    /// let info = GridInfo { width: 2, height: 1, resolution_m: 1.0, origin: Pose2::IDENTITY };
    /// let mut costmap = Costmap::new(info, 7);
    /// costmap.replace_costs(|costs| costs.iter().map(|cost| cost + 1).collect());
    /// assert_eq!(costmap.costs(), [8, 8]);
    /// ```
    pub fn replace_costs(&mut self, change: impl FnOnce(Vec<u8>) -> Vec<u8>) {
        let cells = &mut self.grid.cells;
        let count = cells.len();
        *cells = change(std::mem::take(cells));
        if cells.len() != count {
            *cells = vec![self.default_cost; count];
        }
    }

    /// Returns the side length of a cell \[m\].
    #[must_use]
    pub fn resolution_m(&self) -> f64 {
        self.grid.info.resolution_m
    }

    /// Returns the cost of a cell; none outside the grid.
    #[must_use]
    pub fn cost(&self, cell: Cell) -> Option<u8> {
        self.grid.get(cell).copied()
    }

    /// Returns the cost at a point of the global frame \[m\]; none outside the grid.
    #[must_use]
    pub fn cost_at(&self, x_m: f64, y_m: f64) -> Option<u8> {
        self.grid.at(x_m, y_m).copied()
    }

    /// Sets the cost of a cell; no effect outside the grid.
    pub fn set(&mut self, cell: Cell, cost: u8) {
        if self.grid.info.contains(cell) {
            self.grid[cell] = cost;
        }
    }

    /// Returns the converter from points to cells.
    #[must_use]
    pub fn finder(&self) -> CellFinder {
        self.grid.info.finder()
    }

    /// Returns the cell of a point, also outside the grid, truncated towards the corner
    /// (`worldToMapNoBounds`).
    #[must_use]
    pub fn cell_anywhere(&self, x_m: f64, y_m: f64) -> (i64, i64) {
        self.grid.info.whole_cells_to(x_m, y_m)
    }

    /// Returns the number of cells along a length, rounded up (`cellDistance`).
    #[must_use]
    pub fn cells_along(&self, length_m: f64) -> u32 {
        let cells = libm::ceil(length_m / self.resolution_m());
        if cells > 0.0 { cells as u32 } else { 0 }
    }

    /// Returns the window of cells of an update within bounds; none when the bounds are empty.
    #[must_use]
    pub fn window_of(&self, bounds: &UpdateBounds) -> Option<CellWindow> {
        let info = self.info();
        if info.is_empty() {
            return None;
        }
        let (x0, y0) = cell_clamped(info, bounds.min_x, bounds.min_y);
        let (xn, yn) = cell_clamped(info, bounds.max_x, bounds.max_y);
        let (xn, yn) = ((xn + 1).min(info.width), (yn + 1).min(info.height));
        (xn >= x0 && yn >= y0).then_some(CellWindow { x0, y0, xn, yn })
    }

    /// Sets all cells to one cost.
    pub fn fill(&mut self, cost: u8) {
        self.grid.cells.fill(cost);
    }

    /// Sets all cells to the default cost.
    pub fn reset(&mut self) {
        self.fill(self.default_cost);
    }

    /// Sets the cells of a window to the default cost.
    pub fn reset_window(&mut self, window: &CellWindow) {
        for span in window.spans(self.grid.info.width) {
            self.grid.cells[span].fill(self.default_cost);
        }
    }

    /// Copies a window from a grid with the same cells.
    pub fn copy_window(&mut self, from: &Self, window: &CellWindow) {
        debug_assert_eq!(self.info(), from.info());
        for span in window.spans(self.grid.info.width) {
            self.grid.cells[span.clone()].copy_from_slice(&from.grid.cells[span]);
        }
    }

    /// Replaces the grid; all cells get the default cost.
    pub fn resize(&mut self, info: GridInfo) {
        *self = Self::new(info, self.default_cost);
    }

    /// Moves the grid by whole cells to centre it on the robot. Costs of cells that remain inside
    /// keep their position in the global frame; new cells get the default cost.
    pub fn roll_around(&mut self, robot: Pose2, compat: Nav2Release) {
        let (half_width_m, half_height_m) = half_size_m(self.info(), compat);
        let (x_m, y_m) = (robot.x_m - half_width_m, robot.y_m - half_height_m);
        // A robot at infinity would move the grid there for good.
        if x_m.is_finite() && y_m.is_finite() {
            self.grid.roll_to(x_m, y_m, self.default_cost);
        }
    }
}

/// Returns the distance of the lower left corner of a grid from a robot at its centre, along x and
/// y \[m\].
pub(crate) fn half_size_m(info: &GridInfo, compat: Nav2Release) -> (f64, f64) {
    let length = |cells: usize| (cells as f64 - compat.missing_cells()) * info.resolution_m;
    (length(info.width) / 2.0, length(info.height) / 2.0)
}

/// Returns the cell of a point, clamped to the grid; a point on the upper edge gets the cell after
/// the last (`worldToMapEnforceBounds`).
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
