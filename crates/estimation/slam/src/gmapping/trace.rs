//! Ray tracing of a scan in the grid.

use periplus_geometry::Pose2;
use periplus_grid::Line;

use super::beams::Beams;
use super::cells::{TILE_SIDE_CELLS, floor};

/// Traces are no longer and no wider \[cells\]; nothing is drawn beyond.
const MAX_TRACE_CELLS: i32 = 1 << 13;

/// Cells passed by the beams of a scan, and the positions where they ended, in cells. A cell counts once
/// however many beams passed it, and not at all if one ended there. The buffers are reused.
#[derive(Default)]
pub(super) struct Trace {
    /// First and last column and row, at borders of tiles.
    low: [i32; 2],
    high: [i32; 2],
    /// Words of 32 cells in a row.
    words: usize,
    /// Bits of cells that were passed, row by row.
    free: Vec<u32>,
    /// True for tiles with such a bit.
    touched: Vec<bool>,
    ends: Vec<[f64; 2]>,
}

impl Trace {
    /// Traces a scan from a pose.
    pub(super) fn fill(&mut self, beams: &Beams, map_from_base: Pose2, per_m: f64) {
        let (s, c) = libm::sincos(map_from_base.yaw_rad);
        let place = |[x, y]: [f32; 2]| {
            let (x, y) = (f64::from(x), f64::from(y));
            [
                (c * x - s * y + map_from_base.x_m) * per_m,
                (s * x + c * y + map_from_base.y_m) * per_m,
            ]
        };
        let start = place(beams.origin).map(floor);
        let (least, most) =
            (start.map(|it| it - MAX_TRACE_CELLS / 2), start.map(|it| it + MAX_TRACE_CELLS / 2));
        let is_near = |at: &[f64; 2]| {
            (0..2).all(|axis| at[axis] > f64::from(least[axis]) && at[axis] < f64::from(most[axis]))
        };
        self.ends.clear();
        self.ends.extend(beams.hits.iter().map(|&end| place(end)).filter(is_near));
        let rims = beams.rims.iter().map(|&end| place(end)).filter(is_near).map(|it| it.map(floor));
        let targets: Vec<[i32; 2]> = self.ends.iter().map(|it| it.map(floor)).chain(rims).collect();
        let (mut low, mut high) = (start, start);
        for at in &targets {
            for axis in 0..2 {
                low[axis] = low[axis].min(at[axis]);
                high[axis] = high[axis].max(at[axis]);
            }
        }
        self.low = low.map(|it| it & !(TILE_SIDE_CELLS - 1));
        self.high = high.map(|it| it | (TILE_SIDE_CELLS - 1));
        self.words = ((self.high[0] - self.low[0] + 1) / TILE_SIDE_CELLS) as usize;
        let rows = (self.high[1] - self.low[1] + 1) as usize;
        self.free.clear();
        self.free.resize(rows * self.words, 0);
        self.touched.clear();
        self.touched.resize(rows / TILE_SIDE_CELLS as usize * self.words, false);
        let local = |at: [i32; 2]| ((at[0] - self.low[0]) as usize, (at[1] - self.low[1]) as usize);
        let from = local(start);
        for target in &targets {
            for (column, row) in Line::between(from, local(*target)) {
                self.free[row * self.words + column / 32] |= 1 << (column % 32);
            }
        }
        for end in &targets[..self.ends.len()] {
            let (column, row) = local(*end);
            self.free[row * self.words + column / 32] &= !(1 << (column % 32));
        }
        for (row, words) in self.free.chunks_exact(self.words).enumerate() {
            let tiles =
                &mut self.touched[row / TILE_SIDE_CELLS as usize * self.words..][..self.words];
            for (is_touched, word) in tiles.iter_mut().zip(words) {
                *is_touched |= *word != 0;
            }
        }
    }

    /// Number of tiles with passed cells.
    pub(super) fn tiles(&self) -> usize {
        self.touched.iter().filter(|it| **it).count()
    }

    /// First and last column and row.
    pub(super) fn bounds(&self) -> ([i32; 2], [i32; 2]) {
        (self.low, self.high)
    }

    /// True if a cell in the tile of a cell was passed.
    pub(super) fn touches(&self, column: i32, row: i32) -> bool {
        let (x, y) =
            ((column - self.low[0]) / TILE_SIDE_CELLS, (row - self.low[1]) / TILE_SIDE_CELLS);
        self.touched[y as usize * self.words + x as usize]
    }

    /// Bits of the passed cells in a row, of the tile that begins at a column.
    pub(super) fn free(&self, column: i32, row: i32) -> u32 {
        let (word, row) = ((column - self.low[0]) / TILE_SIDE_CELLS, row - self.low[1]);
        self.free[row as usize * self.words + word as usize]
    }

    /// Positions of the beam ends.
    pub(super) fn ends(&self) -> &[[f64; 2]] {
        &self.ends
    }
}
