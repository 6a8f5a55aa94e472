//! Multi-resolution likelihood grid: upper bounds of the score of points for squares of positions
//! at one heading.
//!
//! The maximum likelihood over a square of cells bounds the likelihood of each position within it
//! (Olson 2009, "Real-time correlative scan matching"). The coarsest squares of the whole map are
//! evaluated together for one heading: bounds of adjacent squares are contiguous in memory, so that
//! a point adds to a row of them at once.

use periplus_geometry::{Pose2, normalize_angle};

/// Level of the coarsest squares, with 2^[`TOP_LEVEL_INDEX`] cells on a side.
pub(crate) const TOP_LEVEL_INDEX: usize = 4;
const SIDE_CELLS: usize = 1 << TOP_LEVEL_INDEX;
/// Number of points between checks whether the rest can still reach the threshold.
const CHECK_POINTS: usize = 12;
/// Standard deviation of the distance between a point and its wall \[cells\].
const SIGMA_CELL_COUNT: f32 = 1.2;
/// Range of the likelihood around a wall \[cells\].
const LIKELIHOOD_RANGE_CELLS: usize = 2;
/// Maximum score of a point.
pub(crate) const MAX_SCORE_PER_POINT: u32 = 255;
/// Number of contiguous additions that take as long as one lookup.
const CONTIGUOUS_ADDITION_COUNT: u64 = 8;

/// Likelihoods over a map, with maxima over squares of growing size.
#[derive(Clone, Debug)]
pub(crate) struct LikelihoodPyramid {
    pub(crate) cell_m: f64,
    /// Corner of cell (0, 0) in the map \[m\].
    corner_m: [f64; 2],
    width: usize,
    height: usize,
    /// `levels[k]` at a cell is the maximum over the square of 2^k cells that begins there.
    levels: Vec<Vec<u8>>,
    /// The coarsest level, ordered by the offset of cells within the coarsest squares: per offset,
    /// row by row, one value of each square.
    by_offset: Vec<u8>,
    /// Per level and cell, non-zero if the square contains free space.
    free: Vec<Vec<u8>>,
    /// Per row of the coarsest squares, the range of columns with free space.
    spans: Vec<[usize; 2]>,
}

/// Points at one heading, relative to the base \[cells\].
pub(crate) struct RotatedPoints<'a> {
    pub(crate) offsets: &'a [[i32; 2]],
    /// Their bounding box.
    pub(crate) bounding_box: CellBox,
}

/// Box of cells, both ends included.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CellBox {
    low: [i32; 2],
    high: [i32; 2],
}

impl CellBox {
    pub(crate) fn around(offsets: &[[i32; 2]]) -> Self {
        let mut bounds = Self { low: [0; 2], high: [0; 2] };
        for offset in offsets {
            for (axis, &cells) in offset.iter().enumerate() {
                bounds.low[axis] = bounds.low[axis].min(cells);
                bounds.high[axis] = bounds.high[axis].max(cells);
            }
        }
        bounds
    }
}

/// Square of positions: its lowest cell, and its side as a power of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Square {
    pub(crate) x: u16,
    pub(crate) y: u16,
    pub(crate) level: u8,
}

impl Square {
    /// Quarters: lower left, lower right, upper left, upper right.
    pub(crate) fn quarters(self) -> [Self; 4] {
        let level = self.level - 1;
        let half = 1 << level;
        [(0, 0), (half, 0), (0, half), (half, half)].map(|(dx, dy)| Self {
            x: self.x + dx,
            y: self.y + dy,
            level,
        })
    }
}

impl LikelihoodPyramid {
    /// Builds the grid of walls and free positions within a box \[m\].
    pub(crate) fn new(
        walls: impl Iterator<Item = (f64, f64)>,
        free: impl Iterator<Item = (f64, f64)>,
        [low_m, high_m]: [[f64; 2]; 2],
        cell_m: f64,
    ) -> Self {
        // Padding on the low side for squares that begin outside of the map.
        let (before, after) = (SIDE_CELLS + LIKELIHOOD_RANGE_CELLS, LIKELIHOOD_RANGE_CELLS + 1);
        let cells = |axis: usize| {
            let cells = ((high_m[axis] - low_m[axis]) / cell_m) as usize + before + after;
            cells.next_multiple_of(SIDE_CELLS)
        };
        let (width, height) = (cells(0), cells(1));
        let corner_m = low_m.map(|low| low - before as f64 * cell_m);
        let cell_of = |(x, y): (f64, f64)| {
            let column =
                (((x - corner_m[0]) / cell_m) as usize).clamp(LIKELIHOOD_RANGE_CELLS, width - 4);
            let row =
                (((y - corner_m[1]) / cell_m) as usize).clamp(LIKELIHOOD_RANGE_CELLS, height - 4);
            (column, row)
        };
        let mut finest = vec![0_u8; width * height];
        for wall in walls {
            let (column, row) = cell_of(wall);
            finest[row * width + column] = MAX_SCORE_PER_POINT as u8;
        }
        add_likelihoods(&mut finest, width);
        let mut free_cells = vec![0_u8; width * height];
        for position in free {
            let (column, row) = cell_of(position);
            free_cells[row * width + column] = 1;
        }
        dilate(&mut free_cells, width);
        let raised = |finest: Vec<u8>| {
            let mut levels = vec![finest];
            for level in 1..=TOP_LEVEL_INDEX {
                let mut next = levels[level - 1].clone();
                maximum_over(&mut next, width, 1 << (level - 1));
                levels.push(next);
            }
            levels
        };
        let (levels, free) = (raised(finest), raised(free_cells));
        let (across, up) = (width / SIDE_CELLS, height / SIDE_CELLS);
        let mut by_offset = vec![0; width * height];
        for (cell, value) in levels[TOP_LEVEL_INDEX].iter().enumerate() {
            let (column, row) = (cell % width, cell / width);
            let offset = row % SIDE_CELLS * SIDE_CELLS + column % SIDE_CELLS;
            by_offset[(offset * up + row / SIDE_CELLS) * across + column / SIDE_CELLS] = *value;
        }
        let spans = (0..up).map(|row| {
            let is_free = |column: &usize| {
                free[TOP_LEVEL_INDEX][row * SIDE_CELLS * width + column * SIDE_CELLS] > 0
            };
            let first = (0..across).find(is_free).unwrap_or(across);
            let last = (0..across).rev().find(is_free).map_or(first, |last| last + 1);
            [first, last]
        });
        let spans = spans.collect();
        Self { cell_m, corner_m, width, height, levels, by_offset, free, spans }
    }

    /// Returns the cell of a position, clamped to the map.
    pub(crate) fn cell_near(&self, (x_m, y_m): (f64, f64)) -> [u16; 2] {
        let cell = |at_m: f64, corner_m: f64, size: usize| {
            (((at_m - corner_m) / self.cell_m).max(0.0) as usize).min(size - 1) as u16
        };
        [cell(x_m, self.corner_m[0], self.width), cell(y_m, self.corner_m[1], self.height)]
    }

    /// Returns the pose at the center of the lowest cell of a square.
    pub(crate) fn pose(&self, square: Square, yaw_rad: f64) -> Pose2 {
        let at = |cell: u16, corner_m: f64| corner_m + (f64::from(cell) + 0.5) * self.cell_m;
        let (x_m, y_m) = (at(square.x, self.corner_m[0]), at(square.y, self.corner_m[1]));
        Pose2::new(x_m, y_m, normalize_angle(yaw_rad))
    }

    /// True if a square contains free space.
    pub(crate) fn is_free(&self, square: Square) -> bool {
        let cell = usize::from(square.y) * self.width + usize::from(square.x);
        self.free[usize::from(square.level)][cell] > 0
    }

    /// Computes the bounds of all coarsest squares with free space and visits each that exceeds
    /// `threshold`. `sums` is a scratch buffer. Returns the cost in lookups.
    pub(crate) fn visit_bounds(
        &self,
        points: &RotatedPoints<'_>,
        threshold: u32,
        sums: &mut Vec<u16>,
        mut found: impl FnMut(Square, u32),
    ) -> u64 {
        let (across, up) = (self.width / SIDE_CELLS, self.height / SIDE_CELLS);
        sums.clear();
        sums.resize(across * up, 0);
        let mut count = 0;
        for &[dx, dy] in points.offsets {
            let offset = dy.rem_euclid(SIDE_CELLS as i32) * SIDE_CELLS as i32
                + dx.rem_euclid(SIDE_CELLS as i32);
            let [right, above] = [dx, dy].map(|it| it.div_euclid(SIDE_CELLS as i32) as isize);
            let values = &self.by_offset[offset as usize * up * across..][..up * across];
            for (row, [first, last]) in self.spans.iter().enumerate() {
                let Some(other) = row.checked_add_signed(above).filter(|it| *it < up) else {
                    continue;
                };
                let first = (*first as isize).max(-right) as usize;
                let last = (*last as isize).min(across as isize - right);
                if last <= first as isize {
                    continue;
                }
                let last = last as usize;
                let from = (other * across + first).wrapping_add_signed(right);
                let values = &values[from..from + last - first];
                let sums = &mut sums[row * across + first..row * across + last];
                for (sum, value) in sums.iter_mut().zip(values) {
                    *sum += u16::from(*value);
                }
                count += last - first;
            }
        }
        for (row, [first, last]) in self.spans.iter().enumerate() {
            for column in *first..*last {
                let bound = u32::from(sums[row * across + column]);
                let (x, y) = ((column * SIDE_CELLS) as u16, (row * SIDE_CELLS) as u16);
                let square = Square { x, y, level: TOP_LEVEL_INDEX as u8 };
                if bound > threshold && self.is_free(square) {
                    found(square, bound);
                }
            }
        }
        count as u64 / CONTIGUOUS_ADDITION_COUNT
    }

    /// Computes the bounds of a square and of its neighbours of the same size to the right, above,
    /// and above right; bounds that cannot exceed `threshold` may be too low. Also returns the
    /// number of lookups.
    pub(crate) fn bounds(
        &self,
        square: Square,
        points: &RotatedPoints<'_>,
        threshold: u32,
    ) -> ([u32; 4], u64) {
        let values = &self.levels[usize::from(square.level)];
        let half = 1_usize << square.level;
        let RotatedPoints { offsets, bounding_box } = points;
        let (x, y) = (i32::from(square.x), i32::from(square.y));
        let is_inside = x + bounding_box.low[0] >= 0
            && y + bounding_box.low[1] >= 0
            && ((x + bounding_box.high[0]) as usize) + half < self.width
            && ((y + bounding_box.high[1]) as usize) + half < self.height;
        let (last, top) = (self.width as i32 - 1, self.height as i32 - 1);
        let up = half * self.width;
        let (mut sums, mut rest) = ([0_u32; 4], MAX_SCORE_PER_POINT * offsets.len() as u32);
        let mut lookup_count = 0;
        for points in offsets.chunks(CHECK_POINTS) {
            if is_inside {
                for &[dx, dy] in points {
                    let cell = (y + dy) as usize * self.width + (x + dx) as usize;
                    let below = &values[cell..=cell + half];
                    let above = &values[cell + up..=cell + up + half];
                    sums[0] += u32::from(below[0]);
                    sums[1] += u32::from(below[half]);
                    sums[2] += u32::from(above[0]);
                    sums[3] += u32::from(above[half]);
                }
            } else {
                // The likelihood at the border of the map is zero.
                for &[dx, dy] in points {
                    let columns = [x + dx, x + dx + half as i32].map(|it| it.clamp(0, last));
                    let rows = [y + dy, y + dy + half as i32].map(|it| it.clamp(0, top));
                    for (index, sum) in sums.iter_mut().enumerate() {
                        let (column, row) = (columns[index % 2], rows[index / 2]);
                        *sum += u32::from(values[row as usize * self.width + column as usize]);
                    }
                }
            }
            lookup_count += 4 * points.len() as u64;
            rest -= MAX_SCORE_PER_POINT * points.len() as u32;
            if sums.iter().all(|sum| sum + rest <= threshold) {
                break;
            }
        }
        (sums, lookup_count)
    }

    /// Mean likelihood of points at a pose, 0 to 1.
    pub(crate) fn score(&self, points: &[[f32; 2]], pose: Pose2) -> f64 {
        let at = |point: &[f32; 2]| {
            let (x, y) = pose.transform_point(point[0].into(), point[1].into());
            let (u, v) =
                ((x - self.corner_m[0]) / self.cell_m, (y - self.corner_m[1]) / self.cell_m);
            let is_inside = u >= 0.0 && v >= 0.0 && u < self.width as f64 && v < self.height as f64;
            let cell = if is_inside { v as usize * self.width + u as usize } else { 0 };
            f64::from(self.levels[0][cell]) / f64::from(MAX_SCORE_PER_POINT)
        };
        points.iter().map(at).sum::<f64>() / points.len().max(1) as f64
    }
}

/// Adds the likelihood around walls.
fn add_likelihoods(finest: &mut [u8], width: usize) {
    let is_wall = finest.to_vec();
    let side = 2 * LIKELIHOOD_RANGE_CELLS + 1;
    for index in (0..is_wall.len()).filter(|it| is_wall[*it] > 0) {
        for near in 0..side * side {
            let (right, up) = (near % side, near / side);
            let (x, y) = (
                right as f32 - LIKELIHOOD_RANGE_CELLS as f32,
                up as f32 - LIKELIHOOD_RANGE_CELLS as f32,
            );
            let squared = (x * x + y * y) / (SIGMA_CELL_COUNT * SIGMA_CELL_COUNT);
            let value = (MAX_SCORE_PER_POINT as f32 * libm::expf(-0.5 * squared)) as u8;
            let cell = index + up * width + right - LIKELIHOOD_RANGE_CELLS * (width + 1);
            finest[cell] = finest[cell].max(value);
        }
    }
}

/// Grows the free space, since furniture of the map may have been moved.
fn dilate(free_cells: &mut [u8], width: usize) {
    let known = free_cells.to_vec();
    for index in (0..known.len()).filter(|it| known[*it] > 0) {
        let (column, row) = (index % width, index / width);
        let around = [index - 1, index + 1, index - width, index + width];
        if around.iter().all(|it| known[*it] > 0) {
            continue;
        }
        for up in row - LIKELIHOOD_RANGE_CELLS..=row + LIKELIHOOD_RANGE_CELLS {
            let begin = up * width + column - LIKELIHOOD_RANGE_CELLS;
            free_cells[begin..=begin + 2 * LIKELIHOOD_RANGE_CELLS].fill(1);
        }
    }
}

/// Maximum of each value and the one `step` further, along both axes.
fn maximum_over(cells: &mut [u8], width: usize, step: usize) {
    for row in cells.chunks_exact_mut(width) {
        for column in 0..width.saturating_sub(step) {
            row[column] = row[column].max(row[column + step]);
        }
    }
    for index in 0..cells.len().saturating_sub(step * width) {
        cells[index] = cells[index].max(cells[index + step * width]);
    }
}
