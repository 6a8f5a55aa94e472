//! Upper bounds of how well points fit on a map, for squares of positions at one heading.
//!
//! The largest likelihood over a square of cells bounds the likelihood of any position within it (Olson
//! 2009, "Real-time correlative scan matching"). The largest squares of all of the map are looked into
//! together, for one heading at a time: the bounds of neighbouring squares lie side by side, so that a
//! point adds to a whole row of them at once.

use periplus_geometry::{Pose2, normalize_angle};

/// The largest squares have 2 to the power of this cells on a side.
pub(crate) const TOP: usize = 4;
const SIDE: usize = 1 << TOP;
/// After so many points it is seen whether the rest can matter.
const AT_ONCE: usize = 12;
/// How far from a wall a point may be that belongs to it: one standard deviation, in cells.
const SIGMA_CELLS: f32 = 1.2;
/// Farther it does not count.
const REACH_CELLS: usize = 2;
/// No bound is larger for a point.
pub(crate) const FULL: u32 = 255;
/// To add to so many bounds that lie side by side takes as long as one lookup.
const SIDE_BY_SIDE: u64 = 8;

/// Likelihoods of points over a map, with the largest over ever larger squares.
#[derive(Clone, Debug)]
pub(crate) struct Pyramid {
    pub(crate) cell_m: f64,
    /// Corner of cell (0, 0) \[m\].
    corner_m: [f64; 2],
    width: usize,
    height: usize,
    /// `levels[k]` at a cell is the largest over the square of 2^k cells that begins there.
    levels: Vec<Vec<u8>>,
    /// The last level, sorted by the place of cells within the largest squares: for each such place,
    /// row by row, one value of each square.
    sorted: Vec<u8>,
    /// Whether the robot can be anywhere in such a square.
    free: Vec<Vec<u8>>,
    /// In each row of the largest squares, from which to which the robot can be.
    spans: Vec<[usize; 2]>,
}

/// Points at one heading, relative to the robot, in cells.
pub(crate) struct Turned<'a> {
    pub(crate) offsets: &'a [[i32; 2]],
    /// The box around them.
    pub(crate) reach: Reach,
}

/// A box of cells, both ends in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    low: [i32; 2],
    high: [i32; 2],
}

impl Reach {
    pub(crate) fn of(offsets: &[[i32; 2]]) -> Self {
        let mut reach = Self { low: [0; 2], high: [0; 2] };
        for offset in offsets {
            for (axis, &cells) in offset.iter().enumerate() {
                reach.low[axis] = reach.low[axis].min(cells);
                reach.high[axis] = reach.high[axis].max(cells);
            }
        }
        reach
    }
}

/// A square of positions: its lowest cell, and its side as a power of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Square {
    pub(crate) x: u16,
    pub(crate) y: u16,
    pub(crate) level: u8,
}

impl Square {
    /// Its quarters: the lowest, that to the right, that above, and that above on the right.
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

impl Pyramid {
    /// Of walls and free positions within a box \[m\].
    pub(crate) fn new(
        walls: impl Iterator<Item = (f64, f64)>,
        free: impl Iterator<Item = (f64, f64)>,
        [low_m, high_m]: [[f64; 2]; 2],
        cell_m: f64,
    ) -> Self {
        // On the low side there is room for squares that begin outside and reach in.
        let (before, after) = (SIDE + REACH_CELLS, REACH_CELLS + 1);
        let cells = |axis: usize| {
            let cells = ((high_m[axis] - low_m[axis]) / cell_m) as usize + before + after;
            cells.next_multiple_of(SIDE)
        };
        let (width, height) = (cells(0), cells(1));
        let corner_m = low_m.map(|low| low - before as f64 * cell_m);
        let cell_of = |(x, y): (f64, f64)| {
            let column = (((x - corner_m[0]) / cell_m) as usize).clamp(REACH_CELLS, width - 4);
            let row = (((y - corner_m[1]) / cell_m) as usize).clamp(REACH_CELLS, height - 4);
            (column, row)
        };
        let mut finest = vec![0_u8; width * height];
        for wall in walls {
            let (column, row) = cell_of(wall);
            finest[row * width + column] = FULL as u8;
        }
        blur(&mut finest, width);
        let mut places = vec![0_u8; width * height];
        for place in free {
            let (column, row) = cell_of(place);
            places[row * width + column] = 1;
        }
        grow(&mut places, width);
        let raised = |finest: Vec<u8>| {
            let mut levels = vec![finest];
            for level in 1..=TOP {
                let mut next = levels[level - 1].clone();
                widen(&mut next, width, 1 << (level - 1));
                levels.push(next);
            }
            levels
        };
        let (levels, free) = (raised(finest), raised(places));
        let (across, up) = (width / SIDE, height / SIDE);
        let mut sorted = vec![0; width * height];
        for (cell, value) in levels[TOP].iter().enumerate() {
            let (column, row) = (cell % width, cell / width);
            let kind = row % SIDE * SIDE + column % SIDE;
            sorted[(kind * up + row / SIDE) * across + column / SIDE] = *value;
        }
        let spans = (0..up).map(|row| {
            let is_free = |column: &usize| free[TOP][row * SIDE * width + column * SIDE] > 0;
            let first = (0..across).find(is_free).unwrap_or(across);
            let last = (0..across).rev().find(is_free).map_or(first, |last| last + 1);
            [first, last]
        });
        let spans = spans.collect();
        Self { cell_m, corner_m, width, height, levels, sorted, free, spans }
    }

    /// The cell of a position, or the nearest one of the map.
    pub(crate) fn cell_near(&self, (x_m, y_m): (f64, f64)) -> [u16; 2] {
        let cell = |at_m: f64, corner_m: f64, most: usize| {
            (((at_m - corner_m) / self.cell_m).max(0.0) as usize).min(most - 1) as u16
        };
        [cell(x_m, self.corner_m[0], self.width), cell(y_m, self.corner_m[1], self.height)]
    }

    /// The middle of the lowest cell of a square \[m\].
    pub(crate) fn pose(&self, square: Square, yaw_rad: f64) -> Pose2 {
        let at = |cell: u16, corner_m: f64| corner_m + (f64::from(cell) + 0.5) * self.cell_m;
        let (x_m, y_m) = (at(square.x, self.corner_m[0]), at(square.y, self.corner_m[1]));
        Pose2::new(x_m, y_m, normalize_angle(yaw_rad))
    }

    /// Whether the robot can be anywhere in a square.
    pub(crate) fn is_free(&self, square: Square) -> bool {
        let cell = usize::from(square.y) * self.width + usize::from(square.x);
        self.free[usize::from(square.level)][cell] > 0
    }

    /// The bounds of all of the largest squares where the robot can be: each that is above `threshold`.
    /// `sums` is only used while this runs. Returns how much that was, in lookups.
    pub(crate) fn sweep(
        &self,
        points: &Turned<'_>,
        threshold: u32,
        sums: &mut Vec<u16>,
        mut found: impl FnMut(Square, u32),
    ) -> u64 {
        let (across, up) = (self.width / SIDE, self.height / SIDE);
        sums.clear();
        sums.resize(across * up, 0);
        let mut count = 0;
        for &[dx, dy] in points.offsets {
            let kind = dy.rem_euclid(SIDE as i32) * SIDE as i32 + dx.rem_euclid(SIDE as i32);
            let [right, above] = [dx, dy].map(|it| it.div_euclid(SIDE as i32) as isize);
            let values = &self.sorted[kind as usize * up * across..][..up * across];
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
                let (x, y) = ((column * SIDE) as u16, (row * SIDE) as u16);
                let square = Square { x, y, level: TOP as u8 };
                if bound > threshold && self.is_free(square) {
                    found(square, bound);
                }
            }
        }
        count as u64 / SIDE_BY_SIDE
    }

    /// The bounds of a square and of its neighbours of the same size to the right, above, and above on the
    /// right. Those that cannot exceed `threshold` may be less than they are. Besides, how much that was,
    /// in lookups.
    pub(crate) fn bounds(
        &self,
        square: Square,
        points: &Turned<'_>,
        threshold: u32,
    ) -> ([u32; 4], u64) {
        let values = &self.levels[usize::from(square.level)];
        let half = 1_usize << square.level;
        let Turned { offsets, reach } = points;
        let (x, y) = (i32::from(square.x), i32::from(square.y));
        let is_inside = x + reach.low[0] >= 0
            && y + reach.low[1] >= 0
            && ((x + reach.high[0]) as usize) + half < self.width
            && ((y + reach.high[1]) as usize) + half < self.height;
        let (last, top) = (self.width as i32 - 1, self.height as i32 - 1);
        let up = half * self.width;
        let (mut sums, mut rest) = ([0_u32; 4], FULL * offsets.len() as u32);
        let mut work = 0;
        for points in offsets.chunks(AT_ONCE) {
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
                // Along its border the map has nothing.
                for &[dx, dy] in points {
                    let columns = [x + dx, x + dx + half as i32].map(|it| it.clamp(0, last));
                    let rows = [y + dy, y + dy + half as i32].map(|it| it.clamp(0, top));
                    for (index, sum) in sums.iter_mut().enumerate() {
                        let (column, row) = (columns[index % 2], rows[index / 2]);
                        *sum += u32::from(values[row as usize * self.width + column as usize]);
                    }
                }
            }
            work += 4 * points.len() as u64;
            rest -= FULL * points.len() as u32;
            if sums.iter().all(|sum| sum + rest <= threshold) {
                break;
            }
        }
        (sums, work)
    }

    /// Which part of points fits at a pose.
    pub(crate) fn score(&self, points: &[[f32; 2]], pose: Pose2) -> f64 {
        let at = |point: &[f32; 2]| {
            let (x, y) = pose.transform_point(point[0].into(), point[1].into());
            let (u, v) =
                ((x - self.corner_m[0]) / self.cell_m, (y - self.corner_m[1]) / self.cell_m);
            let is_inside = u >= 0.0 && v >= 0.0 && u < self.width as f64 && v < self.height as f64;
            let cell = if is_inside { v as usize * self.width + u as usize } else { 0 };
            f64::from(self.levels[0][cell]) / f64::from(FULL)
        };
        points.iter().map(at).sum::<f64>() / points.len().max(1) as f64
    }
}

/// Draws what is around walls.
fn blur(finest: &mut [u8], width: usize) {
    let is_wall = finest.to_vec();
    let side = 2 * REACH_CELLS + 1;
    for index in (0..is_wall.len()).filter(|it| is_wall[*it] > 0) {
        for near in 0..side * side {
            let (right, up) = (near % side, near / side);
            let (x, y) = (right as f32 - REACH_CELLS as f32, up as f32 - REACH_CELLS as f32);
            let squared = (x * x + y * y) / (SIGMA_CELLS * SIGMA_CELLS);
            let value = (FULL as f32 * libm::expf(-0.5 * squared)) as u8;
            let cell = index + up * width + right - REACH_CELLS * (width + 1);
            finest[cell] = finest[cell].max(value);
        }
    }
}

/// A map may have a piece of furniture where the robot can be by now.
fn grow(places: &mut [u8], width: usize) {
    let known = places.to_vec();
    for index in (0..known.len()).filter(|it| known[*it] > 0) {
        let (column, row) = (index % width, index / width);
        let around = [index - 1, index + 1, index - width, index + width];
        if around.iter().all(|it| known[*it] > 0) {
            continue;
        }
        for up in row - REACH_CELLS..=row + REACH_CELLS {
            let begin = up * width + column - REACH_CELLS;
            places[begin..=begin + 2 * REACH_CELLS].fill(1);
        }
    }
}

/// The largest of each value and that `step` further, along both axes.
fn widen(cells: &mut [u8], width: usize, step: usize) {
    for row in cells.chunks_exact_mut(width) {
        for column in 0..width.saturating_sub(step) {
            row[column] = row[column].max(row[column + step]);
        }
    }
    for index in 0..cells.len().saturating_sub(step * width) {
        cells[index] = cells[index].max(cells[index + step * width]);
    }
}
