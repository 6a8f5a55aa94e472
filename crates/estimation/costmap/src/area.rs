//! Parts of the plane and parts of a grid.

use periplus_grid::GridInfo;

/// An upright rectangle of the global frame \[m\] that grows as things change. Empty at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lowest x.
    pub min_x: f64,
    /// Lowest y.
    pub min_y: f64,
    /// Highest x.
    pub max_x: f64,
    /// Highest y.
    pub max_y: f64,
}

impl Default for Bounds {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Bounds {
    /// Nothing.
    pub const EMPTY: Self =
        Self { min_x: f64::MAX, min_y: f64::MAX, max_x: -f64::MAX, max_y: -f64::MAX };

    /// Everything.
    pub const ALL: Self =
        Self { min_x: -f64::MAX, min_y: -f64::MAX, max_x: f64::MAX, max_y: f64::MAX };

    /// What a grid covers.
    #[must_use]
    pub fn of(info: &GridInfo) -> Self {
        let (width_m, height_m) = info.size_m();
        let (min_x, min_y) = (info.origin.x_m, info.origin.y_m);
        Self { min_x, min_y, max_x: min_x + width_m, max_y: min_y + height_m }
    }

    /// Grows until it holds a point.
    #[inline]
    pub fn touch(&mut self, x_m: f64, y_m: f64) {
        self.min_x = self.min_x.min(x_m);
        self.min_y = self.min_y.min(y_m);
        self.max_x = self.max_x.max(x_m);
        self.max_y = self.max_y.max(y_m);
    }

    /// Grows until it holds another.
    pub fn include(&mut self, other: &Self) {
        self.min_x = self.min_x.min(other.min_x);
        self.min_y = self.min_y.min(other.min_y);
        self.max_x = self.max_x.max(other.max_x);
        self.max_y = self.max_y.max(other.max_y);
    }

    /// The same with a margin on all sides \[m\].
    #[must_use]
    pub fn grown(self, margin_m: f64) -> Self {
        Self {
            min_x: self.min_x - margin_m,
            min_y: self.min_y - margin_m,
            max_x: self.max_x + margin_m,
            max_y: self.max_y + margin_m,
        }
    }

    /// Whether another lies within.
    #[must_use]
    pub fn contains(&self, other: &Self) -> bool {
        self.min_x <= other.min_x
            && self.min_y <= other.min_y
            && self.max_x >= other.max_x
            && self.max_y >= other.max_y
    }
}

/// Cells from `(x0, y0)` up to, and without, `(xn, yn)`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Window {
    /// First column.
    pub x0: usize,
    /// First row.
    pub y0: usize,
    /// One past the last column.
    pub xn: usize,
    /// One past the last row.
    pub yn: usize,
}

impl Window {
    /// All cells of a grid.
    #[must_use]
    pub fn all(info: &GridInfo) -> Self {
        Self { x0: 0, y0: 0, xn: info.width, yn: info.height }
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.xn.saturating_sub(self.x0)
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.yn.saturating_sub(self.y0)
    }

    /// Whether there is no cell in it.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.width() == 0 || self.height() == 0
    }

    /// Whether a cell is in it.
    #[must_use]
    pub fn contains(&self, (x, y): (usize, usize)) -> bool {
        (self.x0..self.xn).contains(&x) && (self.y0..self.yn).contains(&y)
    }

    /// The same with a margin on all sides, as far as the grid goes.
    #[must_use]
    pub fn grown(&self, cells: usize, info: &GridInfo) -> Self {
        Self {
            x0: self.x0.saturating_sub(cells),
            y0: self.y0.saturating_sub(cells),
            xn: (self.xn.saturating_add(cells)).min(info.width),
            yn: (self.yn.saturating_add(cells)).min(info.height),
        }
    }

    /// The smallest that holds both; an empty one counts for nothing.
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

    /// The cells that are in both.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        Self {
            x0: self.x0.max(other.x0),
            y0: self.y0.max(other.y0),
            xn: self.xn.min(other.xn),
            yn: self.yn.min(other.yn),
        }
    }

    /// For each row of it, where its cells lie in a list of rows that are `width` long.
    pub fn spans(&self, width: usize) -> impl Iterator<Item = std::ops::Range<usize>> + use<> {
        let (x0, xn) = (self.x0, self.xn.max(self.x0));
        (self.y0..self.yn).map(move |y| y * width + x0..y * width + xn)
    }
}
