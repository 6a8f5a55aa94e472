//! Columns of voxels, each a 32-bit integer.
//!
//! Bits `z` and `16 + z` encode voxel `z`: both set for marked, only the lower one for unknown,
//! none for free. Source: `nav2_voxel_grid/voxel_grid.hpp`.

use periplus_grid::{Cell, Grid, GridInfo};

/// Maximum number of voxels in a column.
pub const MAX_VOXEL_COUNT: u32 = 16;

/// Column of unknown voxels.
const UNKNOWN_COLUMN_MASK: u32 = 0x0000_ffff;

/// State of a voxel or column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Voxel {
    /// Free.
    Free,
    /// Unknown.
    Unknown,
    /// Marked as an obstacle.
    Marked,
}

/// Voxels over the cells of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct VoxelGrid {
    columns: Grid<u32>,
    height: u32,
}

/// Returns both bits of a voxel.
fn bits(z: u32) -> u32 {
    0x0001_0001 << z
}

/// Returns the number of marked voxels of a column.
#[must_use]
#[inline]
pub(crate) fn marked(column: u32) -> u32 {
    (column >> 16).count_ones()
}

/// Returns the number of unknown voxels of a column. All 16 count, also those above the grid.
#[must_use]
#[inline]
pub(crate) fn unknown(column: u32) -> u32 {
    ((column >> 16 ^ column) & 0xffff).count_ones()
}

impl VoxelGrid {
    /// Creates a grid of unknown voxels; the height is limited to [`MAX_VOXEL_COUNT`].
    #[must_use]
    pub fn new(info: GridInfo, height: u32) -> Self {
        Self { columns: Grid::new(info, UNKNOWN_COLUMN_MASK), height: height.min(MAX_VOXEL_COUNT) }
    }

    /// Returns the number of voxels in a column.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Returns resolution, size and origin of the columns.
    #[must_use]
    pub fn info(&self) -> &GridInfo {
        &self.columns.info
    }

    /// Returns the columns, row by row from the lower left corner.
    #[must_use]
    pub fn columns(&self) -> &[u32] {
        &self.columns.cells
    }

    /// Sets all voxels to unknown.
    pub fn reset(&mut self) {
        self.columns.cells.fill(UNKNOWN_COLUMN_MASK);
    }

    /// Moves to the origin of another grid with cells of the same size; new columns are unknown.
    pub fn follow(&mut self, there: &GridInfo) {
        let here = self.columns.info;
        let cells = |to: f64, from: f64| libm::round((to - from) / here.resolution_m) as i64;
        let columns = cells(there.origin.x_m, here.origin.x_m);
        let rows = cells(there.origin.y_m, here.origin.y_m);
        if (columns, rows) != (0, 0) {
            self.columns.roll(columns, rows, UNKNOWN_COLUMN_MASK);
            self.columns.info.origin = there.origin;
        }
    }

    /// Returns the state of a voxel; unknown outside the grid.
    #[must_use]
    pub fn voxel(&self, cell: Cell, z: u32) -> Voxel {
        let Some(column) = self.columns.get(cell).filter(|_| z < self.height) else {
            return Voxel::Unknown;
        };
        match (column & bits(z)).count_ones() {
            0 => Voxel::Free,
            1 => Voxel::Unknown,
            _ => Voxel::Marked,
        }
    }

    /// Returns the state of a column: marked with more than `mark_threshold` marked voxels, else
    /// unknown with more than `unknown_threshold` unknown ones.
    #[must_use]
    pub fn column(&self, cell: Cell, unknown_threshold: u32, mark_threshold: u32) -> Voxel {
        match self.columns.get(cell) {
            Some(&column) if marked(column) > mark_threshold => Voxel::Marked,
            Some(&column) if unknown(column) <= unknown_threshold => Voxel::Free,
            _ => Voxel::Unknown,
        }
    }

    /// Marks a voxel; returns true if more than `mark_threshold` voxels of its column are marked
    /// now.
    pub fn mark(&mut self, cell: Cell, z: u32, mark_threshold: u32) -> bool {
        if !self.columns.info.contains(cell) || z >= self.height {
            return false;
        }
        let column = &mut self.columns[cell];
        *column |= bits(z);
        marked(*column) > mark_threshold
    }

    /// Clears a voxel.
    pub fn clear(&mut self, cell: Cell, z: u32) {
        if self.columns.info.contains(cell) && z < self.height {
            self.columns[cell] &= !bits(z);
        }
    }

    /// Clears all voxels of a column.
    pub fn clear_column(&mut self, index: usize) {
        if let Some(column) = self.columns.cells.get_mut(index) {
            *column = 0;
        }
    }

    /// Marks the voxels along a line; positions are in cells from the lowest corner.
    pub fn mark_line(&mut self, start: [f64; 3], end: [f64; 3]) {
        let columns = &mut self.columns.cells;
        if let Some(line) = VoxelLine::within(self.columns.info.width, start, end, 0, u32::MAX) {
            line.walk(|index, z| columns[index] |= bits(z));
        }
    }

    /// Clears the voxels along a line; positions are in cells from the lowest corner.
    pub fn clear_line(&mut self, start: [f64; 3], end: [f64; 3]) {
        self.clear_along(start, end, 0, u32::MAX, |_, _| {});
    }

    /// Clears the voxels along a line between two distances \[cells\], and calls `visit` with the
    /// index and the new value of each column. A line with an end outside the grid has no effect.
    pub fn clear_along(
        &mut self,
        start: [f64; 3],
        end: [f64; 3],
        shortest: u32,
        longest: u32,
        mut touched: impl FnMut(usize, u32),
    ) {
        let GridInfo { width, height, .. } = self.columns.info;
        let is_inside = |[x, y, z]: [f64; 3]| {
            // Written such that NaN is outside.
            x >= 0.0
                && y >= 0.0
                && z >= 0.0
                && x < width as f64
                && y < height as f64
                && z < f64::from(self.height)
        };
        if !is_inside(start) || !is_inside(end) {
            return;
        }
        let columns = &mut self.columns.cells;
        if let Some(line) = VoxelLine::within(width, start, end, shortest, longest) {
            line.walk(|index, z| {
                let column = &mut columns[index];
                *column &= !bits(z);
                touched(index, *column);
            });
        }
    }
}

/// Line of voxels: Bresenham's algorithm in three dimensions with integers.
#[derive(Clone, Copy, Debug)]
pub struct VoxelLine {
    index: usize,
    z: u32,
    /// Number of steps along the longest side.
    steps: u32,
    /// Side lengths, longest first.
    sides: [u32; 3],
    /// Increments of index and z for a step along each side.
    adds: [(isize, i32); 3],
}

impl VoxelLine {
    /// Creates the part of a line between `min_length` and `max_length` cells from its start;
    /// positions are in cells from the lowest corner, columns are in rows of `width`. None when the
    /// line is shorter.
    #[must_use]
    pub fn within(
        width: usize,
        start: [f64; 3],
        end: [f64; 3],
        shortest: u32,
        longest: u32,
    ) -> Option<Self> {
        let [dx, dy, dz] = [0, 1, 2].map(|axis| end[axis] - start[axis]);
        let length = (dx * dx + dy * dy + dz * dz).sqrt();
        if (length as u32) < shortest {
            return None;
        }
        let mut begin = start;
        let mut part = 1.0;
        if length > 0.0 {
            part = (f64::from(longest) / length).min(1.0);
            if shortest > 0 {
                let along = f64::from(shortest);
                begin = [
                    start[0] + dx / length * along,
                    start[1] + dy / length * along,
                    start[2] + dz / length * along,
                ];
            }
        }
        let cells = |axis: usize| (begin[axis] as i64, end[axis] as i64);
        let side = |axis: usize| {
            let (from, to) = cells(axis);
            ((to - from).unsigned_abs() as u32, (to - from).signum())
        };
        let [(x, toward_x), (y, toward_y), (z, toward_z)] = [side(0), side(1), side(2)];
        let along_x = (x, (toward_x as isize, 0));
        let along_y = (y, (toward_y as isize * width as isize, 0));
        let along_z = (z, (0, toward_z as i32));
        let [a, b, c] = if x >= y.max(z) {
            [along_x, along_y, along_z]
        } else if y >= z {
            [along_y, along_x, along_z]
        } else {
            [along_z, along_x, along_y]
        };
        Some(Self {
            index: begin[1] as usize * width + begin[0] as usize,
            z: begin[2] as u32,
            steps: ((part * f64::from(a.0)) as u32).min(a.0),
            sides: [a.0, b.0, c.0],
            adds: [a.1, b.1, c.1],
        })
    }

    /// Calls `visit` with the column index and z of each voxel.
    #[inline(always)]
    pub fn walk(&self, mut visit: impl FnMut(usize, u32)) {
        let [a, b, c] = self.sides;
        let [(add_a, z_a), (add_b, z_b), (add_c, z_c)] = self.adds;
        let (mut index, mut z) = (self.index, self.z);
        let (mut error_b, mut error_c) = (a / 2, a / 2);
        for _ in 0..self.steps {
            visit(index, z);
            index = index.wrapping_add_signed(add_a);
            z = z.wrapping_add_signed(z_a);
            error_b += b;
            if error_b >= a {
                index = index.wrapping_add_signed(add_b);
                z = z.wrapping_add_signed(z_b);
                error_b -= a;
            }
            error_c += c;
            if error_c >= a {
                index = index.wrapping_add_signed(add_c);
                z = z.wrapping_add_signed(z_c);
                error_c -= a;
            }
        }
        visit(index, z);
    }

    /// Returns the number of steps along the longest side.
    #[must_use]
    pub fn steps(&self) -> u32 {
        self.steps
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;
    use proptest::prelude::*;

    use super::*;

    fn grid() -> VoxelGrid {
        VoxelGrid::new(GridInfo::new(1.0, 50, 10, Pose2::IDENTITY).unwrap(), 17)
    }

    #[test]
    fn a_voxel_is_marked_and_cleared() {
        let mut grid = grid();
        assert_eq!(grid.height(), 16);
        assert_eq!(grid.voxel((5, 5), 3), Voxel::Unknown);
        assert!(grid.mark((5, 5), 3, 0));
        assert!(!grid.mark((5, 6), 3, 1), "one is not more than one");
        assert_eq!(grid.voxel((5, 5), 3), Voxel::Marked);
        assert_eq!(grid.column((5, 5), 15, 0), Voxel::Marked);
        grid.clear_line([0.5, 5.5, 3.5], [9.5, 5.5, 3.5]);
        assert_eq!(grid.voxel((5, 5), 3), Voxel::Free);
        assert_eq!(grid.column((5, 5), 15, 0), Voxel::Free);
        assert_eq!(grid.column((5, 5), 14, 0), Voxel::Unknown, "15 are still unknown");
        assert_eq!(grid.column((50, 5), 16, 0), Voxel::Unknown, "outside");
    }

    #[test]
    fn ends_outside_free_nothing() {
        let mut grid = grid();
        let before = grid.clone();
        grid.clear_line([0.5, 0.5, 0.5], [50.0, 0.5, 0.5]);
        grid.clear_line([0.5, f64::NAN, 0.5], [5.0, 0.5, 0.5]);
        assert_eq!(grid, before);
    }

    proptest! {
        #[test]
        fn lines_stay_between_their_ends(
            start in (0.0..50.0, 0.0..10.0, 0.0..16.0),
            end in (0.0..50.0, 0.0..10.0, 0.0..16.0),
            shortest in 0..20_u32, longest in 0..60_u32,
        ) {
            let (start, end) = (<[f64; 3]>::from(start), <[f64; 3]>::from(end));
            if let Some(line) = VoxelLine::within(50, start, end, shortest, longest) {
                line.walk(|index, z| {
                    let cell = [(index % 50) as f64, (index / 50) as f64, f64::from(z)];
                    for axis in 0..3 {
                        let low = start[axis].min(end[axis]).floor();
                        assert!((low..=start[axis].max(end[axis])).contains(&cell[axis]));
                    }
                });
            }
        }
    }
}
