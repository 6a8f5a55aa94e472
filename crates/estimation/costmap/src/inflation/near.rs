//! Squared distances to obstacles that are near, many cells at a time.
//!
//! A distance is made in two steps, as in Meijster's transform: down and up the columns, and then
//! along the rows. As nothing further than the radius counts, both have short numbers: distances
//! along columns have a byte, and squares a byte too up to a radius of 15 cells. So a vector register
//! holds many cells, and the minimum over a row's neighbours is a few instructions for all of them,
//! without a branch. Where no obstacle is near, nothing is done.

use crate::Window;
use crate::cost::{LETHAL, UNKNOWN};

use super::{CostTable, Inflation, Write};

/// Rows done together, so that what is between the two steps stays in the cache.
const ROWS: usize = 64;

/// Cells done together.
const BLOCK: usize = 64;

/// Numbers that squared distances fit into, or else stop at the highest.
pub(super) trait Squares: Copy + Ord + Default {
    /// Nothing is near.
    const FAR: Self;
    fn square(distance: u8) -> Self;
    fn from_square(square: u32) -> Self;
    fn plus(self, other: Self) -> Self;
    fn index(self) -> usize;
    /// The row of such numbers.
    fn row(near: &mut Near) -> &mut Vec<Self>;
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
    fn row(near: &mut Near) -> &mut Vec<Self> {
        &mut near.bytes
    }
}

impl Squares for u16 {
    const FAR: Self = Self::MAX;
    #[inline(always)]
    fn square(distance: u8) -> Self {
        // 255 stands for whatever is further than the radius, 254 at the most.
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
    fn row(near: &mut Near) -> &mut Vec<Self> {
        &mut near.words
    }
}

/// Memory for the distances of a band of rows.
#[derive(Clone, Debug, Default)]
pub(super) struct Near {
    /// Distance down the column to the nearest obstacle, for each cell of a band.
    below: Vec<u8>,
    /// The same for one row, while rows go up.
    running: Vec<u8>,
    /// Distance up the column, for one row.
    above: Vec<u8>,
    /// Squared distances along columns for one row, with room beyond both ends.
    bytes: Vec<u8>,
    words: Vec<u16>,
}

impl Near {
    /// Inflates a window; `area` is the window with all around it that counts.
    #[expect(clippy::too_many_arguments, reason = "one call, and each is another thing")]
    pub(super) fn run<S: Squares>(
        &mut self,
        costs: &mut [u8],
        width: usize,
        window: &Window,
        area: &Window,
        table: &CostTable,
        how: Inflation,
        write: &Write<'_>,
    ) {
        let radius = table.radius_cells() as usize;
        let mut padded = std::mem::take(S::row(self));
        padded.clear();
        padded.resize(area.width() + 2 * BLOCK + 2 * radius, S::FAR);
        let squares: Vec<S> =
            (0..=table.radius_cells()).map(|cells| S::from_square(cells * cells)).collect();
        let Self { below, running, above, .. } = self;
        let mut band = Band { costs, width, area, radius, how, below, running, above };
        let mut first = window.y0;
        while first < window.yn {
            let last = (first + ROWS).min(window.yn);
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

/// Distances along columns for some rows.
struct Band<'a> {
    costs: &'a mut [u8],
    width: usize,
    area: &'a Window,
    radius: usize,
    how: Inflation,
    below: &'a mut Vec<u8>,
    running: &'a mut Vec<u8>,
    above: &'a mut Vec<u8>,
}

impl Band<'_> {
    /// Measures distances down for rows from `first` up to `last`, and up from the row at `last`;
    /// false when no obstacle is near any of them.
    fn look(&mut self, first: usize, last: usize) -> bool {
        let count = self.area.width();
        let far = self.radius as u8 + 1;
        let start = first.saturating_sub(self.radius).max(self.area.y0);
        let end = (last + self.radius).min(self.area.yn);
        // Obstacles do not change while others are inflated: only they are lethal, and unknown cells
        // that count as such become lethal.
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

    /// Writes the squared distances along columns of one row; rows must come from the last to the
    /// first. False when nothing is near.
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

/// Whether a value of a range is among some.
fn has(cells: &[u8], low: u8, high: u8) -> bool {
    // Without leaving early: so it is done for many at a time.
    cells
        .chunks(1024)
        .any(|chunk| chunk.iter().fold(false, |any, cell| any | ((low..=high).contains(cell))))
}

/// From the distances of a row to those of the next one.
fn step(distances: &mut [u8], cells: &[u8], far: u8, how: Inflation) {
    let lowest = LETHAL;
    let highest = if how.around_unknown { UNKNOWN } else { LETHAL };
    for (distance, cell) in distances.iter_mut().zip(cells) {
        let next = distance.saturating_add(1).min(far);
        let is_obstacle = *cell >= lowest && *cell <= highest;
        *distance = if is_obstacle { 0 } else { next };
    }
}

/// From squares along columns to those in the plane, and to costs. `padded` has a radius more at
/// either end.
fn along_row<S: Squares>(
    padded: &[S],
    squares: &[S],
    start: usize,
    cells: &mut [u8],
    write: &Write<'_>,
) {
    let radius = squares.len() - 1;
    for (block, cells) in cells.chunks_mut(BLOCK).enumerate() {
        // The place of the first cell's leftmost neighbour.
        let left = start + block * BLOCK;
        let around = &padded[left..left + BLOCK + 2 * radius];
        if around.iter().fold(S::FAR, |least, square| least.min(*square)) == S::FAR {
            continue;
        }
        let mut least = [S::FAR; BLOCK];
        nearest(around, squares, &mut least);
        write.row(cells, &least);
    }
}

/// The least sum of a neighbour's square and that of the way to it, for a block of cells.
#[inline(always)]
fn nearest<S: Squares>(around: &[S], squares: &[S], least: &mut [S; BLOCK]) {
    let radius = squares.len() - 1;
    for shift in 0..=2 * radius {
        let way = squares[shift.abs_diff(radius)];
        let Some(neighbours) = around[shift..].first_chunk::<BLOCK>() else { return };
        for (least, neighbour) in least.iter_mut().zip(neighbours) {
            *least = (*least).min(neighbour.plus(way));
        }
    }
}
