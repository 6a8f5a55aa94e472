//! Where cells are.

use std::fmt;

use periplus_geometry::Pose2;

/// A lattice has no more cells: 16,384 by 16,384, at a byte for each what a reader takes in.
pub const MOST_CELLS: usize = 1 << 28;

/// Shortest and longest side of a cell \[m\].
pub const RESOLUTION_RANGE_M: [f64; 2] = [1e-6, 1e5];
/// Largest coordinate of an origin \[m\]: beyond it, distances of a micrometre are lost.
pub const MAX_ORIGIN_M: f64 = 1e9;

/// True for a side of a cell that is a number within [`RESOLUTION_RANGE_M`].
#[must_use]
pub fn is_resolution(resolution_m: f64) -> bool {
    (RESOLUTION_RANGE_M[0]..=RESOLUTION_RANGE_M[1]).contains(&resolution_m)
}

/// True for an origin whose numbers are finite and within [`MAX_ORIGIN_M`].
#[must_use]
pub fn is_origin(origin: Pose2) -> bool {
    origin.is_finite() && origin.x_m.abs().max(origin.y_m.abs()) <= MAX_ORIGIN_M
}

/// Column and row of a cell, from the lower left corner.
pub type Cell = (usize, usize);

/// Square cells in rows and columns.
///
/// Fields are open, as any positive resolution and size makes sense. [`Lattice::new`] checks what
/// comes from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Length of a side of a cell \[m\].
    pub resolution_m: f64,
    /// Columns, along the lattice's own x.
    pub width: usize,
    /// Rows, along its own y.
    pub height: usize,
    /// `map_from_corner`: the lower left corner of cell `(0, 0)` in the frame of the map, with the
    /// direction in which rows run.
    pub origin: Pose2,
}

/// Why a lattice makes no sense.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LatticeError {
    /// The side of a cell is outside of [`RESOLUTION_RANGE_M`] \[m\].
    Resolution(f64),
    /// A number of the origin is not finite, or beyond [`MAX_ORIGIN_M`].
    Origin(Pose2),
    /// There are more than [`MOST_CELLS`]; columns and rows.
    TooLarge(usize, usize),
}

impl fmt::Display for LatticeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Resolution(resolution_m) => {
                let [shortest_m, longest_m] = RESOLUTION_RANGE_M;
                write!(
                    f,
                    "the resolution is {resolution_m:?} m; it must be from {shortest_m:?} m to \
                     {longest_m} m"
                )
            }
            Self::Origin(Pose2 { x_m, y_m, yaw_rad }) => {
                write!(
                    f,
                    "the origin is [{x_m:?}, {y_m:?}, {yaw_rad:?}]; all must be finite, and x and y at \
                 most {MAX_ORIGIN_M:?} m"
                )
            }
            Self::TooLarge(width, height) => write!(
                f,
                "it has {width} by {height} cells, more than {MOST_CELLS} in all; \
                 take a coarser resolution or a part of it"
            ),
        }
    }
}

impl std::error::Error for LatticeError {}

impl Lattice {
    /// Cells of `resolution_m` in `width` columns and `height` rows.
    ///
    /// # Errors
    /// When it has no place on the plane or too many cells. None at all are allowed.
    pub fn new(
        resolution_m: f64,
        width: usize,
        height: usize,
        origin: Pose2,
    ) -> Result<Self, LatticeError> {
        if !is_resolution(resolution_m) {
            return Err(LatticeError::Resolution(resolution_m));
        }
        if !is_origin(origin) {
            return Err(LatticeError::Origin(origin));
        }
        match width.checked_mul(height) {
            Some(0..=MOST_CELLS) => Ok(Self { resolution_m, width, height, origin }),
            _ => Err(LatticeError::TooLarge(width, height)),
        }
    }

    /// How many cells there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.width * self.height
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Place of a cell in a list of rows.
    #[must_use]
    pub fn index(&self, (column, row): Cell) -> usize {
        row * self.width + column
    }

    /// The cell at a place in a list of rows.
    #[must_use]
    pub fn cell(&self, index: usize) -> Cell {
        (index % self.width, index / self.width)
    }

    /// Whether a cell is one of these.
    #[must_use]
    pub fn contains(&self, (column, row): Cell) -> bool {
        column < self.width && row < self.height
    }

    /// The cell in which a point of the map \[m\] lies. Lower and left sides belong to a cell, upper
    /// and right ones to its neighbours.
    ///
    /// For many points of a turned lattice take [`Lattice::finder`].
    #[must_use]
    pub fn cell_of(&self, x_m: f64, y_m: f64) -> Option<Cell> {
        self.finder().cell_of(x_m, y_m)
    }

    /// Finds cells of many points: sine and cosine are computed once.
    #[must_use]
    pub fn finder(&self) -> CellFinder {
        let (sine, cosine) = match self.origin.yaw_rad {
            0.0 => (0.0, 1.0),
            yaw_rad => libm::sincos(yaw_rad),
        };
        CellFinder { lattice: *self, sine, cosine }
    }

    /// Centre of a cell in the map \[m\].
    #[must_use]
    pub fn centre_of(&self, (column, row): Cell) -> (f64, f64) {
        self.point_at(column as f64 + 0.5, row as f64 + 0.5)
    }

    /// The point of the map \[m\] that is so many columns and rows from the corner.
    #[must_use]
    pub fn point_at(&self, columns: f64, rows: f64) -> (f64, f64) {
        self.origin.transform_point(columns * self.resolution_m, rows * self.resolution_m)
    }

    /// Length and height of all cells together \[m\].
    #[must_use]
    pub fn size_m(&self) -> (f64, f64) {
        (self.width as f64 * self.resolution_m, self.height as f64 * self.resolution_m)
    }

    /// Whole cells, columns and rows, from this corner towards a point of the map \[m\]. What is
    /// left over is dropped on either side: -0.9 cells are none. So does `costmap_2d` when a window
    /// rolls (`Costmap2D::updateOrigin`).
    #[must_use]
    pub fn whole_cells_to(&self, x_m: f64, y_m: f64) -> (i64, i64) {
        let (columns, rows) = self.finder().cells_to(x_m, y_m);
        (columns as i64, rows as i64)
    }

    /// The same lattice, so many cells further.
    #[must_use]
    pub fn moved(&self, columns: i64, rows: i64) -> Self {
        let (x_m, y_m) = self.point_at(columns as f64, rows as f64);
        Self { origin: Pose2 { x_m, y_m, ..self.origin }, ..*self }
    }
}

/// Finds the cells of points; see [`Lattice::finder`].
#[derive(Clone, Copy, Debug)]
pub struct CellFinder {
    lattice: Lattice,
    sine: f64,
    cosine: f64,
}

impl CellFinder {
    /// Where a point of the map \[m\] is, in cells and parts of them from the corner.
    #[must_use]
    #[inline]
    pub fn cells_to(&self, x_m: f64, y_m: f64) -> (f64, f64) {
        let Lattice { resolution_m, origin, .. } = self.lattice;
        let (x_m, y_m) = (x_m - origin.x_m, y_m - origin.y_m);
        // Adding `0.0 * y` would turn a point at infinity into no number.
        if self.sine == 0.0 && self.cosine == 1.0 {
            return (x_m / resolution_m, y_m / resolution_m);
        }
        let along_m = self.cosine * x_m + self.sine * y_m;
        let across_m = self.cosine * y_m - self.sine * x_m;
        (along_m / resolution_m, across_m / resolution_m)
    }

    /// As [`Lattice::cell_of`].
    #[must_use]
    #[inline]
    pub fn cell_of(&self, x_m: f64, y_m: f64) -> Option<Cell> {
        let (columns, rows) = self.cells_to(x_m, y_m);
        let Lattice { width, height, .. } = self.lattice;
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
        let lattice = Lattice::new(0.5, 3, 2, Pose2::new(-1.0, 2.0, 0.0)).unwrap();
        assert_eq!(lattice.cell_of(-1.0, 2.0), Some((0, 0)));
        assert_eq!(lattice.cell_of(-0.5, 2.5), Some((1, 1)));
        assert_eq!(lattice.cell_of(0.5, 2.0), None);
        assert_eq!(lattice.cell_of(0.0, 3.0), None);
        assert_eq!(lattice.cell_of(-1.001, 2.0), None);
        assert_eq!(lattice.cell_of(f64::NAN, 2.0), None);
        assert_eq!(lattice.cell_of(f64::INFINITY, 2.0), None);
        assert_eq!((lattice.index((2, 1)), lattice.cell(5)), (5, (2, 1)));
        assert_eq!(lattice.size_m(), (1.5, 1.0));
    }

    #[test]
    fn a_turned_lattice() {
        let lattice = Lattice::new(1.0, 4, 2, Pose2::new(10.0, 0.0, FRAC_PI_2)).unwrap();
        // Rows run up, and the next row lies to the left.
        let (x_m, y_m) = lattice.centre_of((3, 1));
        assert!((x_m - 8.5).abs() < 1e-12 && (y_m - 3.5).abs() < 1e-12);
        assert_eq!(lattice.cell_of(8.5, 3.5), Some((3, 1)));
        assert_eq!(lattice.cell_of(10.5, 3.5), None);
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        let make = |resolution_m, width, x_m| {
            Lattice::new(resolution_m, width, 2, Pose2::new(x_m, 0.0, 0.0)).map(|_| ())
        };
        assert_eq!(make(0.05, 0, 0.0), Ok(()));
        assert_eq!(make(0.0, 2, 0.0), Err(LatticeError::Resolution(0.0)));
        assert!(make(f64::NAN, 2, 0.0).is_err() && make(f64::INFINITY, 2, 0.0).is_err());
        assert!(make(0.05, 2, f64::NAN).is_err());
        assert_eq!(make(0.05, usize::MAX, 0.0), Err(LatticeError::TooLarge(usize::MAX, 2)));
        assert!(make(0.05, MOST_CELLS, 0.0).is_err());
    }

    proptest! {
        #[test]
        fn a_centre_lies_in_its_cell(
            resolution_m in 0.01..2.0,
            x_m in -50.0..50.0, y_m in -50.0..50.0, yaw_rad in -4.0..4.0_f64,
            column in 0..300_usize, row in 0..300_usize,
        ) {
            let origin = Pose2::new(x_m, y_m, yaw_rad);
            let lattice = Lattice::new(resolution_m, 300, 300, origin).unwrap();
            let (x_m, y_m) = lattice.centre_of((column, row));
            prop_assert_eq!(lattice.cell_of(x_m, y_m), Some((column, row)));
        }

        #[test]
        fn moving_there_and_back(columns in -99..99_i64, rows in -99..99_i64, yaw_rad in -4.0..4.0) {
            let lattice = Lattice::new(0.05, 9, 9, Pose2::new(1.0, 2.0, yaw_rad)).unwrap();
            let there = lattice.moved(columns, rows);
            let back = there.moved(-columns, -rows);
            prop_assert!((back.origin.x_m - 1.0).abs() < 1e-12);
            prop_assert!((back.origin.y_m - 2.0).abs() < 1e-12);
        }
    }
}
