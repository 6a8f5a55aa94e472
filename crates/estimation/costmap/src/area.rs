//! Rectangular areas of the plane and of a grid.

use periplus_grid::GridInfo;

/// Axis-aligned bounding box in the global frame \[m\]. Initially empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UpdateBounds {
    /// Minimum x.
    pub min_x: f64,
    /// Minimum y.
    pub min_y: f64,
    /// Maximum x.
    pub max_x: f64,
    /// Maximum y.
    pub max_y: f64,
}

impl Default for UpdateBounds {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl UpdateBounds {
    /// The empty box.
    pub const EMPTY: Self =
        Self { min_x: f64::MAX, min_y: f64::MAX, max_x: -f64::MAX, max_y: -f64::MAX };

    /// The whole plane.
    pub const ALL: Self =
        Self { min_x: -f64::MAX, min_y: -f64::MAX, max_x: f64::MAX, max_y: f64::MAX };

    /// Returns the area of a grid.
    #[must_use]
    pub fn of(info: &GridInfo) -> Self {
        let (width_m, height_m) = info.size_m();
        let (min_x, min_y) = (info.origin.x_m, info.origin.y_m);
        Self { min_x, min_y, max_x: min_x + width_m, max_y: min_y + height_m }
    }

    /// Enlarges the box to contain a point.
    #[inline]
    pub fn touch(&mut self, x_m: f64, y_m: f64) {
        self.min_x = self.min_x.min(x_m);
        self.min_y = self.min_y.min(y_m);
        self.max_x = self.max_x.max(x_m);
        self.max_y = self.max_y.max(y_m);
    }

    /// Enlarges the box to contain another box.
    pub fn include(&mut self, other: &Self) {
        self.min_x = self.min_x.min(other.min_x);
        self.min_y = self.min_y.min(other.min_y);
        self.max_x = self.max_x.max(other.max_x);
        self.max_y = self.max_y.max(other.max_y);
    }

    /// Returns the box enlarged by a margin on all sides \[m\].
    #[must_use]
    pub fn grown(self, margin_m: f64) -> Self {
        Self {
            min_x: self.min_x - margin_m,
            min_y: self.min_y - margin_m,
            max_x: self.max_x + margin_m,
            max_y: self.max_y + margin_m,
        }
    }

    /// Returns true if another box is inside this one.
    #[must_use]
    pub fn contains(&self, other: &Self) -> bool {
        self.min_x <= other.min_x
            && self.min_y <= other.min_y
            && self.max_x >= other.max_x
            && self.max_y >= other.max_y
    }
}

/// Cells from `(x0, y0)` up to and excluding `(xn, yn)`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CellWindow {
    /// First column.
    pub x0: usize,
    /// First row.
    pub y0: usize,
    /// One past the last column.
    pub xn: usize,
    /// One past the last row.
    pub yn: usize,
}

impl CellWindow {
    /// Returns the window of all cells of a grid.
    #[must_use]
    pub fn all(info: &GridInfo) -> Self {
        Self { x0: 0, y0: 0, xn: info.width, yn: info.height }
    }

    /// Returns the number of columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.xn.saturating_sub(self.x0)
    }

    /// Returns the number of rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.yn.saturating_sub(self.y0)
    }

    /// Returns true if the window has no cells.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.width() == 0 || self.height() == 0
    }

    /// Returns true if a cell is inside the window.
    #[must_use]
    pub fn contains(&self, (x, y): (usize, usize)) -> bool {
        (self.x0..self.xn).contains(&x) && (self.y0..self.yn).contains(&y)
    }

    /// Returns the window enlarged by a margin on all sides, clipped to the grid.
    #[must_use]
    pub fn grown(&self, cells: usize, info: &GridInfo) -> Self {
        Self {
            x0: self.x0.saturating_sub(cells),
            y0: self.y0.saturating_sub(cells),
            xn: (self.xn.saturating_add(cells)).min(info.width),
            yn: (self.yn.saturating_add(cells)).min(info.height),
        }
    }

    /// Returns the smallest window that contains both; an empty window has no effect.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        if self.is_empty() {
            return *other;
        }
        if other.is_empty() {
            return *self;
        }
        Self {
            x0: self.x0.min(other.x0),
            y0: self.y0.min(other.y0),
            xn: self.xn.max(other.xn),
            yn: self.yn.max(other.yn),
        }
    }

    /// Returns the cells that are in both windows.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        Self {
            x0: self.x0.max(other.x0),
            y0: self.y0.max(other.y0),
            xn: self.xn.min(other.xn),
            yn: self.yn.min(other.yn),
        }
    }

    /// Iterates over the rows of the window: the index range of each in row-major order with rows
    /// of `width` cells.
    pub fn spans(&self, width: usize) -> impl Iterator<Item = std::ops::Range<usize>> + use<> {
        let (x0, xn) = (self.x0, self.xn.max(self.x0));
        (self.y0..self.yn).map(move |y| y * width + x0..y * width + xn)
    }
}
