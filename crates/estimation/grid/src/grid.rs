//! Grid with a value for each cell.

use std::ops::{Index, IndexMut};

use crate::info::{Cell, GridInfo};

/// A value for each cell of a [`GridInfo`].
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<T> {
    /// Resolution, size and origin.
    pub info: GridInfo,
    /// Values of the cells, row by row from the lower left corner.
    pub cells: Vec<T>,
}

impl<T> Grid<T> {
    /// Creates a grid from existing values.
    ///
    /// # Errors
    /// The values, if their number differs from the number of cells.
    pub fn from_cells(info: GridInfo, cells: Vec<T>) -> Result<Self, Vec<T>> {
        if cells.len() == info.len() { Ok(Self { info, cells }) } else { Err(cells) }
    }

    /// Returns the value of a cell; none outside the grid.
    #[must_use]
    pub fn get(&self, cell: Cell) -> Option<&T> {
        if self.info.contains(cell) { self.cells.get(self.info.index(cell)) } else { None }
    }

    /// Returns the value at a point of the map \[m\]; none outside the grid.
    #[must_use]
    pub fn at(&self, x_m: f64, y_m: f64) -> Option<&T> {
        self.get(self.info.cell_of(x_m, y_m)?)
    }

    /// Iterates over the rows from the lowest to the highest.
    pub fn rows(&self) -> impl DoubleEndedIterator<Item = &[T]> + ExactSizeIterator {
        // Chunks of length zero are an error, and a grid without columns has no rows.
        self.cells.chunks_exact(self.info.width.max(1))
    }

    /// Converts the value of each cell.
    #[must_use]
    pub fn map<U>(&self, make: impl FnMut(&T) -> U) -> Grid<U> {
        Grid { info: self.info, cells: self.cells.iter().map(make).collect() }
    }
}

impl<T: Clone> Grid<T> {
    /// Creates a grid with the same value in all cells.
    #[must_use]
    pub fn new(info: GridInfo, value: T) -> Self {
        Self { info, cells: vec![value; info.len()] }
    }

    /// Moves the window by whole cells over the plane. Cells that stay in the window keep their
    /// values, new cells get `fresh`.
    pub fn roll(&mut self, columns: i64, rows: i64, fresh: T) {
        let GridInfo { width, height, .. } = self.info;
        self.info = self.info.moved(columns, rows);
        let (Some((from_x, to_x, count_x)), Some((from_y, to_y, count_y))) =
            (overlap(width, columns), overlap(height, rows))
        else {
            self.cells.fill(fresh);
            return;
        };
        if (columns, rows) == (0, 0) {
            return;
        }
        let mut cells = vec![fresh; self.cells.len()];
        for row in 0..count_y {
            let from = (from_y + row) * width + from_x;
            let to = (to_y + row) * width + to_x;
            cells[to..to + count_x].clone_from_slice(&self.cells[from..from + count_x]);
        }
        self.cells = cells;
    }

    /// Moves the window so that its corner is within one cell of a point of the map \[m\] and not
    /// beyond it; the rule of `Costmap2D::updateOrigin`.
    pub fn roll_to(&mut self, x_m: f64, y_m: f64, fresh: T) {
        let (columns, rows) = self.info.whole_cells_to(x_m, y_m);
        self.roll(columns, rows, fresh);
    }
}

/// Overlap of `size` cells with the window moved by `shift`: first cell in the old window, first
/// cell in the new window, and number of cells.
fn overlap(size: usize, shift: i64) -> Option<(usize, usize, usize)> {
    let distance = usize::try_from(shift.unsigned_abs()).ok()?;
    let count = size.checked_sub(distance).filter(|&count| count > 0)?;
    Some(if shift >= 0 { (distance, 0, count) } else { (0, distance, count) })
}

impl<T> Index<Cell> for Grid<T> {
    type Output = T;

    fn index(&self, cell: Cell) -> &T {
        debug_assert!(self.info.contains(cell), "{cell:?} is not in {:?}", self.info);
        &self.cells[self.info.index(cell)]
    }
}

impl<T> IndexMut<Cell> for Grid<T> {
    fn index_mut(&mut self, cell: Cell) -> &mut T {
        debug_assert!(self.info.contains(cell), "{cell:?} is not in {:?}", self.info);
        &mut self.cells[self.info.index(cell)]
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use proptest::prelude::*;

    use super::*;

    fn numbered(width: usize, height: usize) -> Grid<usize> {
        let info = GridInfo::new(1.0, width, height, Pose2::IDENTITY).unwrap();
        Grid { info, cells: (1..=width * height).collect() }
    }

    #[test]
    fn values_are_found_by_cell_and_by_point() {
        let grid = numbered(3, 2);
        assert_eq!(grid[(2, 0)], 3);
        assert_eq!(grid.at(0.5, 1.5), Some(&4));
        assert_eq!(grid.get((3, 0)), None, "not the first of the next row");
        assert_eq!(grid.rows().collect::<Vec<_>>(), [[1, 2, 3], [4, 5, 6]]);
        assert_eq!(grid.map(|value| value * 2)[(0, 1)], 8);
        assert_eq!(Grid::from_cells(grid.info, vec![1]), Err(vec![1]));
    }

    #[test]
    fn a_window_rolls_over_the_plane() {
        let mut grid = numbered(3, 2);
        grid.roll_to(1.9, -1.0, 0);
        assert_eq!((grid.info.origin.x_m, grid.info.origin.y_m), (1.0, -1.0));
        assert_eq!(grid.cells, [0, 0, 0, 2, 3, 0]);
        grid.roll_to(99.0, 0.0, 7);
        assert_eq!(grid.cells, [7; 6]);
    }

    #[test]
    fn less_than_a_cell_moves_nothing() {
        let mut grid = numbered(2, 2);
        grid.roll_to(-0.9, 0.9, 0);
        assert_eq!(grid, numbered(2, 2));
    }

    proptest! {
        #[test]
        fn what_stays_in_the_window_keeps_its_place(columns in -6..6_i64, rows in -6..6_i64) {
            let before = numbered(5, 4);
            let mut after = before.clone();
            after.roll(columns, rows, 0);
            for index in 0..after.cells.len() {
                let (x_m, y_m) = after.info.centre_of(after.info.cell(index));
                prop_assert_eq!(after.cells[index], before.at(x_m, y_m).copied().unwrap_or(0));
            }
        }
    }
}
