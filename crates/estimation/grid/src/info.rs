//! Resolution, size and origin of grids.

use std::fmt;

use periplus_geometry::Pose2;

/// Maximum number of cells: 16,384 by 16,384, 256 MiB at one byte per cell.
pub const MAX_CELL_COUNT: usize = 1 << 28;

/// Smallest and largest resolution \[m\].
pub const RESOLUTION_RANGE_M: [f64; 2] = [1e-6, 1e5];
/// Largest coordinate of an origin \[m\]; beyond it, micrometres are lost to rounding.
pub const MAX_ORIGIN_M: f64 = 1e9;

/// Returns true for a resolution within [`RESOLUTION_RANGE_M`] \[m\].
#[must_use]
pub fn is_resolution(resolution_m: f64) -> bool {
    (RESOLUTION_RANGE_M[0]..=RESOLUTION_RANGE_M[1]).contains(&resolution_m)
}

/// Returns true for an origin with finite numbers within [`MAX_ORIGIN_M`].
#[must_use]
pub fn is_origin(origin: Pose2) -> bool {
    origin.is_finite() && origin.x_m.abs().max(origin.y_m.abs()) <= MAX_ORIGIN_M
}

/// Column and row of a cell, from the lower left corner.
pub type Cell = (usize, usize);

/// Resolution, size and origin of a grid of square cells; the `info` of `nav_msgs/OccupancyGrid`.
/// The fields are public, since any positive resolution and any size are valid. [`GridInfo::new`]
/// checks values from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridInfo {
    /// Side length of a cell \[m\].
    pub resolution_m: f64,
    /// Number of columns, along the x axis of the grid.
    pub width: usize,
    /// Number of rows, along the y axis of the grid.
    pub height: usize,
    /// `map_from_grid`: pose of the lower left corner of cell `(0, 0)` in the map frame.
    pub origin: Pose2,
}

/// Reason for which resolution, size or origin are invalid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GridInfoError {
    /// The resolution is outside [`RESOLUTION_RANGE_M`] \[m\].
    Resolution(f64),
    /// A number of the origin is not finite, or is beyond [`MAX_ORIGIN_M`].
    Origin(Pose2),
    /// There are more than [`MAX_CELL_COUNT`] cells; columns and rows.
    TooLarge(usize, usize),
}

impl fmt::Display for GridInfoError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Resolution(resolution_m) => {
                let [min_m, max_m] = RESOLUTION_RANGE_M;
                write!(
                    f,
                    "the resolution is {resolution_m:?} m; it must be from {min_m:?} m to \
                     {max_m} m"
                )
            }
            Self::Origin(Pose2 { x_m, y_m, yaw_rad }) => {
                write!(
                    f,
                    "the origin is [{x_m:?}, {y_m:?}, {yaw_rad:?}]; the numbers must be finite, and |x| and |y| at \
                 most {MAX_ORIGIN_M:?} m"
                )
            }
            Self::TooLarge(width, height) => write!(
                f,
                "it has {width} by {height} cells, more than the limit of {MAX_CELL_COUNT}; \
                 use a coarser resolution or crop the map"
            ),
        }
    }
}

impl std::error::Error for GridInfoError {}

impl GridInfo {
    /// Creates the description of a grid with `width` columns and `height` rows of cells of
    /// `resolution_m`.
    ///
    /// # Errors
    /// When resolution or origin are invalid or the grid has too many cells. Zero cells are
    /// allowed.
    pub fn new(
        resolution_m: f64,
        width: usize,
        height: usize,
        origin: Pose2,
    ) -> Result<Self, GridInfoError> {
        if !is_resolution(resolution_m) {
            return Err(GridInfoError::Resolution(resolution_m));
        }
        if !is_origin(origin) {
            return Err(GridInfoError::Origin(origin));
        }
        match width.checked_mul(height) {
            Some(0..=MAX_CELL_COUNT) => Ok(Self { resolution_m, width, height, origin }),
            _ => Err(GridInfoError::TooLarge(width, height)),
        }
    }

    /// Returns the number of cells.
    #[must_use]
    pub fn len(&self) -> usize {
        self.width * self.height
    }

    /// Returns true if there are no cells.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the index of a cell in row-major order.
    #[must_use]
    pub fn index(&self, (column, row): Cell) -> usize {
        row * self.width + column
    }

    /// Returns the cell at an index in row-major order.
    #[must_use]
    pub fn cell(&self, index: usize) -> Cell {
        (index % self.width, index / self.width)
    }

    /// Returns true if a cell is inside the grid.
    #[must_use]
    pub fn contains(&self, (column, row): Cell) -> bool {
        column < self.width && row < self.height
    }

    /// Returns the cell that contains a point of the map \[m\]. Lower and left sides belong to a
    /// cell, upper and right sides to its neighbours.
    /// For many points of a rotated grid use [`GridInfo::finder`].
    #[must_use]
    pub fn cell_of(&self, x_m: f64, y_m: f64) -> Option<Cell> {
        self.finder().cell_of(x_m, y_m)
    }

    /// Returns a converter from points to cells that computes sine and cosine once.
    #[must_use]
    pub fn finder(&self) -> CellFinder {
        let (sine, cosine) = match self.origin.yaw_rad {
            0.0 => (0.0, 1.0),
            yaw_rad => libm::sincos(yaw_rad),
        };
        CellFinder { info: *self, sine, cosine }
    }

    /// Returns the centre of a cell in the map \[m\].
    #[must_use]
    pub fn centre_of(&self, (column, row): Cell) -> (f64, f64) {
        self.point_at(column as f64 + 0.5, row as f64 + 0.5)
    }

    /// Returns the point of the map \[m\] at a distance of `columns` and `rows` from the corner.
    #[must_use]
    pub fn point_at(&self, columns: f64, rows: f64) -> (f64, f64) {
        self.origin.transform_point(columns * self.resolution_m, rows * self.resolution_m)
    }

    /// Returns the size of the grid along x and y \[m\].
    #[must_use]
    pub fn size_m(&self) -> (f64, f64) {
        (self.width as f64 * self.resolution_m, self.height as f64 * self.resolution_m)
    }

    /// Returns the number of whole cells, columns and rows, from the corner of the grid to a point
    /// of the map \[m\], truncated towards zero: -0.9 cells are 0. This is the rounding with which
    /// `costmap_2d` moves a rolling window (`Costmap2D::updateOrigin`).
    #[must_use]
    pub fn whole_cells_to(&self, x_m: f64, y_m: f64) -> (i64, i64) {
        let (columns, rows) = self.finder().cells_to(x_m, y_m);
        (columns as i64, rows as i64)
    }

    /// Returns the same grid moved by whole cells.
    #[must_use]
    pub fn moved(&self, columns: i64, rows: i64) -> Self {
        let (x_m, y_m) = self.point_at(columns as f64, rows as f64);
        Self { origin: Pose2 { x_m, y_m, ..self.origin }, ..*self }
    }
}

/// Converter from points to cells; see [`GridInfo::finder`].
#[derive(Clone, Copy, Debug)]
pub struct CellFinder {
    info: GridInfo,
    sine: f64,
    cosine: f64,
}

impl CellFinder {
    /// Returns the position of a point of the map \[m\] relative to the corner, in fractional
    /// cells.
    #[must_use]
    #[inline]
    pub fn cells_to(&self, x_m: f64, y_m: f64) -> (f64, f64) {
        let GridInfo { resolution_m, origin, .. } = self.info;
        let (x_m, y_m) = (x_m - origin.x_m, y_m - origin.y_m);
        // Adding `0.0 * y` would turn a point at infinity into NaN.
        if self.sine == 0.0 && self.cosine == 1.0 {
            return (x_m / resolution_m, y_m / resolution_m);
        }
        let along_m = self.cosine * x_m + self.sine * y_m;
        let across_m = self.cosine * y_m - self.sine * x_m;
        (along_m / resolution_m, across_m / resolution_m)
    }

    /// Like [`GridInfo::cell_of`].
    #[must_use]
    #[inline]
    pub fn cell_of(&self, x_m: f64, y_m: f64) -> Option<Cell> {
        let (columns, rows) = self.cells_to(x_m, y_m);
        let GridInfo { width, height, .. } = self.info;
        let is_inside =
            columns >= 0.0 && rows >= 0.0 && columns < width as f64 && rows < height as f64;
        is_inside.then_some((columns as usize, rows as usize))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn low_sides_belong_to_a_cell_and_high_ones_do_not() {
        let info = GridInfo::new(0.5, 3, 2, Pose2::new(-1.0, 2.0, 0.0)).unwrap();
        assert_eq!(info.cell_of(-1.0, 2.0), Some((0, 0)));
        assert_eq!(info.cell_of(-0.5, 2.5), Some((1, 1)));
        assert_eq!(info.cell_of(0.5, 2.0), None);
        assert_eq!(info.cell_of(0.0, 3.0), None);
        assert_eq!(info.cell_of(-1.001, 2.0), None);
        assert_eq!(info.cell_of(f64::NAN, 2.0), None);
        assert_eq!(info.cell_of(f64::INFINITY, 2.0), None);
        assert_eq!((info.index((2, 1)), info.cell(5)), (5, (2, 1)));
        assert_eq!(info.size_m(), (1.5, 1.0));
    }

    #[test]
    fn a_rotated_grid() {
        let info = GridInfo::new(1.0, 4, 2, Pose2::new(10.0, 0.0, FRAC_PI_2)).unwrap();
        // Rows run up, and the next row is to the left.
        let (x_m, y_m) = info.centre_of((3, 1));
        assert!((x_m - 8.5).abs() < 1e-12 && (y_m - 3.5).abs() < 1e-12);
        assert_eq!(info.cell_of(8.5, 3.5), Some((3, 1)));
        assert_eq!(info.cell_of(10.5, 3.5), None);
    }

    #[test]
    fn invalid_values_are_rejected() {
        let make = |resolution_m, width, x_m| {
            GridInfo::new(resolution_m, width, 2, Pose2::new(x_m, 0.0, 0.0)).map(|_| ())
        };
        assert_eq!(make(0.05, 0, 0.0), Ok(()));
        assert_eq!(make(0.0, 2, 0.0), Err(GridInfoError::Resolution(0.0)));
        assert!(make(f64::NAN, 2, 0.0).is_err() && make(f64::INFINITY, 2, 0.0).is_err());
        assert!(make(0.05, 2, f64::NAN).is_err());
        assert_eq!(make(0.05, usize::MAX, 0.0), Err(GridInfoError::TooLarge(usize::MAX, 2)));
        assert!(make(0.05, MAX_CELL_COUNT, 0.0).is_err());
    }

    proptest! {
        #[test]
        fn a_centre_lies_in_its_cell(
            resolution_m in 0.01..2.0,
            x_m in -50.0..50.0, y_m in -50.0..50.0, yaw_rad in -4.0..4.0_f64,
            column in 0..300_usize, row in 0..300_usize,
        ) {
            let origin = Pose2::new(x_m, y_m, yaw_rad);
            let info = GridInfo::new(resolution_m, 300, 300, origin).unwrap();
            let (x_m, y_m) = info.centre_of((column, row));
            prop_assert_eq!(info.cell_of(x_m, y_m), Some((column, row)));
        }

        #[test]
        fn moving_there_and_back(columns in -99..99_i64, rows in -99..99_i64, yaw_rad in -4.0..4.0) {
            let info = GridInfo::new(0.05, 9, 9, Pose2::new(1.0, 2.0, yaw_rad)).unwrap();
            let there = info.moved(columns, rows);
            let back = there.moved(-columns, -rows);
            prop_assert!((back.origin.x_m - 1.0).abs() < 1e-12);
            prop_assert!((back.origin.y_m - 2.0).abs() < 1e-12);
        }
    }
}
