//! A value in every cell.

use std::ops::{Index, IndexMut};

use crate::lattice::{Cell, Lattice};

/// A value in every cell of a lattice.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<T> {
    /// Where the cells are.
    pub lattice: Lattice,
    /// Their values, row by row from the lower left corner.
    pub cells: Vec<T>,
}

impl<T> Grid<T> {
    /// A grid over values that are there already.
    ///
    /// # Errors
    /// The values again when there are not as many as cells.
    pub fn from_cells(lattice: Lattice, cells: Vec<T>) -> Result<Self, Vec<T>> {
        if cells.len() == lattice.len() { Ok(Self { lattice, cells }) } else { Err(cells) }
    }

    /// The value of a cell, if it is one of these.
    #[must_use]
    pub fn get(&self, cell: Cell) -> Option<&T> {
        if self.lattice.contains(cell) { self.cells.get(self.lattice.index(cell)) } else { None }
    }

    /// The value at a point of the map \[m\], if a cell is there.
    #[must_use]
    pub fn at(&self, x_m: f64, y_m: f64) -> Option<&T> {
        self.get(self.lattice.cell_of(x_m, y_m)?)
    }

    /// Rows from the lowest to the highest.
    pub fn rows(&self) -> impl DoubleEndedIterator<Item = &[T]> + ExactSizeIterator {
        // Chunks of no length are an error, and a lattice without columns has no rows to show.
        self.cells.chunks_exact(self.lattice.width.max(1))
    }

    /// A value made of each.
    #[must_use]
    pub fn map<U>(&self, make: impl FnMut(&T) -> U) -> Grid<U> {
        Grid { lattice: self.lattice, cells: self.cells.iter().map(make).collect() }
    }
}

impl<T: Clone> Grid<T> {
    /// The same value everywhere.
    #[must_use]
    pub fn new(lattice: Lattice, value: T) -> Self {
        Self { lattice, cells: vec![value; lattice.len()] }
    }

    /// Moves the window by whole cells over a plane that stays where it is: what is still in the
    /// window is kept, what comes into it is `fresh`.
    pub fn roll(&mut self, columns: i64, rows: i64, fresh: T) {
        let Lattice { width, height, .. } = self.lattice;
        self.lattice = self.lattice.moved(columns, rows);
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

    /// Rolls the window so that its corner comes as near to a point of the map \[m\] as whole cells
    /// allow without passing it; the rule of `Costmap2D::updateOrigin`.
    pub fn roll_to(&mut self, x_m: f64, y_m: f64, fresh: T) {
        let (columns, rows) = self.lattice.whole_cells_to(x_m, y_m);
        self.roll(columns, rows, fresh);
    }
}

/// What stays of `size` cells when the window moves by `shift`: first in the old window, first in
/// the new one, and how many.
fn overlap(size: usize, shift: i64) -> Option<(usize, usize, usize)> {
    let distance = usize::try_from(shift.unsigned_abs()).ok()?;
    let count = size.checked_sub(distance).filter(|&count| count > 0)?;
    Some(if shift >= 0 { (distance, 0, count) } else { (0, distance, count) })
}

impl<T> Index<Cell> for Grid<T> {
    type Output = T;

    fn index(&self, cell: Cell) -> &T {
        debug_assert!(self.lattice.contains(cell), "{cell:?} is not in {:?}", self.lattice);
        &self.cells[self.lattice.index(cell)]
    }
}

impl<T> IndexMut<Cell> for Grid<T> {
    fn index_mut(&mut self, cell: Cell) -> &mut T {
        debug_assert!(self.lattice.contains(cell), "{cell:?} is not in {:?}", self.lattice);
        &mut self.cells[self.lattice.index(cell)]
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use proptest::prelude::*;

    use super::*;

    fn numbered(width: usize, height: usize) -> Grid<usize> {
        let lattice = Lattice::new(1.0, width, height, Pose2::IDENTITY).unwrap();
        Grid { lattice, cells: (1..=width * height).collect() }
    }

    #[test]
    fn values_are_found_by_cell_and_by_point() {
        let grid = numbered(3, 2);
        assert_eq!(grid[(2, 0)], 3);
        assert_eq!(grid.at(0.5, 1.5), Some(&4));
        assert_eq!(grid.get((3, 0)), None, "not the first of the next row");
        assert_eq!(grid.rows().collect::<Vec<_>>(), [[1, 2, 3], [4, 5, 6]]);
        assert_eq!(grid.map(|value| value * 2)[(0, 1)], 8);
        assert_eq!(Grid::from_cells(grid.lattice, vec![1]), Err(vec![1]));
    }

    #[test]
    fn a_window_rolls_over_the_plane() {
        let mut grid = numbered(3, 2);
        grid.roll_to(1.9, -1.0, 0);
        assert_eq!((grid.lattice.origin.x_m, grid.lattice.origin.y_m), (1.0, -1.0));
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
                let (x_m, y_m) = after.lattice.centre_of(after.lattice.cell(index));
                prop_assert_eq!(after.cells[index], before.at(x_m, y_m).copied().unwrap_or(0));
            }
        }
    }
}
