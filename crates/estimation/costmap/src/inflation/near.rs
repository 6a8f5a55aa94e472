//! Squared distances to near obstacles, vectorized over cells.
//!
//! A distance transform in two passes, as in Meijster's algorithm: down and up the columns, then
//! along the rows. Distances beyond the radius are irrelevant, so both passes use short integers: a
//! byte for distances along columns, and a byte for squares up to a radius of 15 cells. A vector
//! register then holds many cells, and the minimum over the neighbours in a row is a few
//! instructions without a branch. Areas without a near obstacle are skipped.

use crate::CellWindow;
use crate::cost::{LETHAL, UNKNOWN};

use super::{CostTable, InflationSettings, Write};

/// Rows per band; the data between both passes stays in the cache.
const BAND_ROWS: usize = 64;

/// Cells per block.
const BLOCK_CELLS: usize = 64;

/// Saturating integers for squared distances.
pub(super) trait Squares: Copy + Ord + Default {
    /// No obstacle is near.
    const FAR: Self;
    fn square(distance: u8) -> Self;
    fn from_square(square: u32) -> Self;
    fn plus(self, other: Self) -> Self;
    fn index(self) -> usize;
    /// Returns the row buffer of this integer type.
    fn row(near: &mut NearBuffers) -> &mut Vec<Self>;
}

impl Squares for u8 {
    const FAR: Self = Self::MAX;
    #[inline(always)]
    fn square(distance: u8) -> Self {
        let square = u16::from(distance) * u16::from(distance);
        square.min(255) as Self
    }
    fn from_square(square: u32) -> Self {
        square.min(255) as Self
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.saturating_add(other)
    }
    #[inline(always)]
    fn index(self) -> usize {
        usize::from(self)
    }
    fn row(near: &mut NearBuffers) -> &mut Vec<Self> {
        &mut near.bytes
    }
}

impl Squares for u16 {
    const FAR: Self = Self::MAX;
    #[inline(always)]
    fn square(distance: u8) -> Self {
        // 255 represents all distances beyond the radius, which is at most 254.
        if distance == u8::MAX { Self::MAX } else { Self::from(distance) * Self::from(distance) }
    }
    fn from_square(square: u32) -> Self {
        square.min(65535) as Self
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.saturating_add(other)
    }
    #[inline(always)]
    fn index(self) -> usize {
        usize::from(self)
    }
    fn row(near: &mut NearBuffers) -> &mut Vec<Self> {
        &mut near.words
    }
}

/// Buffers for the distances of a band of rows.
#[derive(Clone, Debug, Default)]
pub(super) struct NearBuffers {
    /// Distance down the column to the nearest obstacle, for each cell of a band.
    below: Vec<u8>,
    /// Distance of the current row while rows go up.
    running: Vec<u8>,
    /// Distance up the column, for one row.
    above: Vec<u8>,
    /// Squared distances along columns for one row, padded at both ends.
    bytes: Vec<u8>,
    words: Vec<u16>,
}

impl NearBuffers {
    /// Inflates a window; `area` is the window with the margin of obstacles that count.
    #[expect(clippy::too_many_arguments, reason = "one call, and each is a different argument")]
    pub(super) fn run<S: Squares>(
        &mut self,
        costs: &mut [u8],
        width: usize,
        window: &CellWindow,
        area: &CellWindow,
        table: &CostTable,
        how: InflationSettings,
        write: &Write<'_>,
    ) {
        let radius = table.radius_cells() as usize;
        let mut padded = std::mem::take(S::row(self));
        padded.clear();
        padded.resize(area.width() + 2 * BLOCK_CELLS + 2 * radius, S::FAR);
        let squares: Vec<S> =
            (0..=table.radius_cells()).map(|cells| S::from_square(cells * cells)).collect();
        let Self { below, running, above, .. } = self;
        let mut band = Band { costs, width, area, radius, how, below, running, above };
        let mut first = window.y0;
        while first < window.yn {
            let last = (first + BAND_ROWS).min(window.yn);
            if band.look(first, last) {
                for row in (first..last).rev() {
                    let is_near = band.square_row(row, &mut padded[radius..]);
                    if is_near {
                        let start = window.x0 - area.x0;
                        let cells = &mut band.costs[row * width + window.x0..][..window.width()];
                        along_row(&padded, &squares, start, cells, write);
                    }
                }
            }
            first = last;
        }
        *S::row(self) = padded;
    }
}

/// Distances along columns for a band of rows.
struct Band<'a> {
    costs: &'a mut [u8],
    width: usize,
    area: &'a CellWindow,
    radius: usize,
    how: InflationSettings,
    below: &'a mut Vec<u8>,
    running: &'a mut Vec<u8>,
    above: &'a mut Vec<u8>,
}

impl Band<'_> {
    /// Computes distances downward for rows from `first` up to `last`, and upward from the row at
    /// `last`; returns false when no obstacle is near any of them.
    fn look(&mut self, first: usize, last: usize) -> bool {
        let count = self.area.width();
        let far = self.radius as u8 + 1;
        let start = first.saturating_sub(self.radius).max(self.area.y0);
        let end = (last + self.radius).min(self.area.yn);
        // Obstacles do not change during inflation: only they are lethal, and unknown cells that
        // count as obstacles become lethal.
        let obstacle = if self.how.around_unknown { LETHAL..=UNKNOWN } else { LETHAL..=LETHAL };
        let any = (start..end).any(|row| {
            let cells = &self.costs[row * self.width + self.area.x0..][..count];
            has(cells, *obstacle.start(), *obstacle.end())
        });
        if !any {
            return false;
        }
        self.below.clear();
        self.below.resize((last - first) * count, far);
        self.above.clear();
        self.above.resize(count, far);
        self.running.clear();
        self.running.resize(count, far);
        for row in start..last {
            let cells = &self.costs[row * self.width + self.area.x0..][..count];
            step(self.running, cells, far, self.how);
            if row >= first {
                self.below[(row - first) * count..][..count].copy_from_slice(self.running);
            }
        }
        for row in (last..end).rev() {
            let cells = &self.costs[row * self.width + self.area.x0..][..count];
            step(self.above, cells, far, self.how);
        }
        true
    }

    /// Writes the squared distances along columns of one row; rows must be in descending order.
    /// Returns false when no obstacle is near.
    fn square_row<S: Squares>(&mut self, row: usize, squares: &mut [S]) -> bool {
        let count = self.area.width();
        let far = self.radius as u8 + 1;
        let index = self.below.len() / count - 1;
        let below = &self.below[index * count..];
        let cells = &self.costs[row * self.width + self.area.x0..][..count];
        step(self.above, cells, far, self.how);
        let mut nearest = far;
        for ((square, below), above) in squares.iter_mut().zip(below).zip(&*self.above) {
            let distance = (*below).min(*above);
            nearest = nearest.min(distance);
            *square = if distance == far { S::FAR } else { S::square(distance) };
        }
        self.below.truncate(index * count);
        nearest < far
    }
}

/// Returns true if a cell has a value in the range.
fn has(cells: &[u8], low: u8, high: u8) -> bool {
    // Without early exit, so that the loop is vectorized.
    cells
        .chunks(1024)
        .any(|chunk| chunk.iter().fold(false, |any, cell| any | ((low..=high).contains(cell))))
}

/// Advances distances from one row to the next.
fn step(distances: &mut [u8], cells: &[u8], far: u8, how: InflationSettings) {
    let lowest = LETHAL;
    let highest = if how.around_unknown { UNKNOWN } else { LETHAL };
    for (distance, cell) in distances.iter_mut().zip(cells) {
        let next = distance.saturating_add(1).min(far);
        let is_obstacle = *cell >= lowest && *cell <= highest;
        *distance = if is_obstacle { 0 } else { next };
    }
}

/// Converts squares along columns to squares in the plane, and to costs. `padded` has a margin of
/// one radius at either end.
fn along_row<S: Squares>(
    padded: &[S],
    squares: &[S],
    start: usize,
    cells: &mut [u8],
    write: &Write<'_>,
) {
    let radius = squares.len() - 1;
    for (block, cells) in cells.chunks_mut(BLOCK_CELLS).enumerate() {
        // Index of the leftmost neighbour of the first cell.
        let left = start + block * BLOCK_CELLS;
        let around = &padded[left..left + BLOCK_CELLS + 2 * radius];
        if around.iter().fold(S::FAR, |least, square| least.min(*square)) == S::FAR {
            continue;
        }
        let mut least = [S::FAR; BLOCK_CELLS];
        nearest(around, squares, &mut least);
        write.row(cells, &least);
    }
}

/// Minimum over the neighbours of their square plus that of the horizontal distance, for a block of
/// cells.
#[inline(always)]
fn nearest<S: Squares>(around: &[S], squares: &[S], least: &mut [S; BLOCK_CELLS]) {
    let radius = squares.len() - 1;
    for shift in 0..=2 * radius {
        let way = squares[shift.abs_diff(radius)];
        let Some(neighbours) = around[shift..].first_chunk::<BLOCK_CELLS>() else { return };
        for (least, neighbour) in least.iter_mut().zip(neighbours) {
            *least = (*least).min(neighbour.plus(way));
        }
    }
}
