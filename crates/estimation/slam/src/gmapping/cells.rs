//! The map of one particle, shared with those of others as far as they are the same.

use std::ops::Range;
use std::sync::Arc;

use periplus_geometry::Pose2;
use periplus_grid::{Grid, GridInfo, OccupancyGrid, occupancy};

use super::trace::Trace;
use crate::map::{Plan, part};

/// Cells along a side of a tile, and tiles along a side of a page.
pub(super) const TILE_SIDE_CELLS: i32 = 32;
const TILES: i32 = 8;
const PAGE_SIDE_CELLS: i32 = TILE_SIDE_CELLS * TILES;
/// Pages of a map, at most: 3 km by 3 km with cells of 0.05 m. What lies beyond is not drawn, so that
/// a wild jump of odometry does not ask for all memory.
const MAX_PAGE_COUNT: i64 = 1 << 16;
/// Counts of a cell are halved when they get here, so that what changed is learnt in the end.
const MOST_COUNT: u8 = 250;

/// Minimum number of passes of a free cell.
const MIN_FREE_PASS_COUNT: u8 = 3;

/// Content of a map around a beam end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Seen {
    /// A solid cell at this squared distance \[cells²\].
    Near(f64),
    /// Too little was seen there.
    Nothing,
    /// Beams went through there.
    Through,
}

/// Beam counts of a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Cell {
    /// Beams that ended in it.
    pub(super) hits: u8,
    /// Beams that ended in it or passed.
    pub(super) beams: u8,
    /// Mean of where they ended, from the lower left corner, in parts of 256 of a side.
    mean: [u8; 2],
}

/// Beams that ended in a cell: how many, and the mean of where.
#[derive(Clone, Copy)]
struct End {
    hits: u8,
    mean: [u8; 2],
}

/// A square of cells. Beams end in few of them: those are found by bits, and so are the solid ones.
#[derive(Clone)]
struct Tile {
    /// Beams that ended in a cell or passed.
    beams: [u8; (TILE_SIDE_CELLS * TILE_SIDE_CELLS) as usize],
    /// For each row a bit for each cell that is solid, and for each in which beams ended.
    solid: [u32; TILE_SIDE_CELLS as usize],
    ended: [u32; TILE_SIDE_CELLS as usize],
    /// Number of hit cells before each row.
    before: [u16; TILE_SIDE_CELLS as usize],
    /// Those cells in order.
    ends: Vec<End>,
}

#[derive(Clone)]
struct Page {
    tiles: [Option<Arc<Tile>>; (TILES * TILES) as usize],
}

/// The map of one particle. A clone shares everything; what is written to is copied at the first
/// write, a tile at a time.
#[derive(Clone)]
pub(super) struct Cells {
    per_m: f64,
    resolution_m: f64,
    solid_share: f64,
    /// Column and row of the first page.
    first: [i32; 2],
    /// Columns and rows of pages.
    size: [i32; 2],
    pages: Vec<Option<Arc<Page>>>,
}

/// Bytes of a tile, about.
pub(super) const TILE_BYTES: usize = size_of::<Tile>() + 32 * size_of::<End>();

impl Default for Tile {
    fn default() -> Self {
        Self {
            beams: [0; (TILE_SIDE_CELLS * TILE_SIDE_CELLS) as usize],
            solid: [0; TILE_SIDE_CELLS as usize],
            ended: [0; TILE_SIDE_CELLS as usize],
            before: [0; TILE_SIDE_CELLS as usize],
            ends: Vec::new(),
        }
    }
}

impl Default for Page {
    fn default() -> Self {
        Self { tiles: std::array::from_fn(|_| None) }
    }
}

impl Cells {
    /// An empty map. Scans are laid onto cells in which more than this share of beams ended.
    pub(super) fn new(resolution_m: f64, solid_share: f64) -> Self {
        Self {
            per_m: 1.0 / resolution_m,
            resolution_m,
            solid_share,
            first: [0; 2],
            size: [0; 2],
            pages: Vec::new(),
        }
    }

    pub(super) fn resolution_m(&self) -> f64 {
        self.resolution_m
    }

    /// Cells per metre.
    pub(super) fn per_m(&self) -> f64 {
        self.per_m
    }

    fn page_index(&self, column: i32, row: i32) -> Option<usize> {
        let (x, y) = (
            column.div_euclid(PAGE_SIDE_CELLS) - self.first[0],
            row.div_euclid(PAGE_SIDE_CELLS) - self.first[1],
        );
        let is_inside = x >= 0 && y >= 0 && x < self.size[0] && y < self.size[1];
        is_inside.then_some((y * self.size[0] + x) as usize)
    }

    /// The tile of a cell.
    #[inline]
    fn tile(&self, column: i32, row: i32) -> Option<&Tile> {
        let page = self.pages[self.page_index(column, row)?].as_deref()?;
        page.tiles[tile_index(column, row)].as_deref()
    }

    /// The tile of a cell, to be written to; none when the map does not reach there.
    fn tile_mut(&mut self, column: i32, row: i32) -> Option<&mut Tile> {
        let index = self.page_index(column, row)?;
        let page = Arc::make_mut(self.pages[index].get_or_insert_default());
        Some(Arc::make_mut(page.tiles[tile_index(column, row)].get_or_insert_default()))
    }

    /// Lets the map reach over the pages of some cells, if it may become so large.
    fn reach(&mut self, low: [i32; 2], high: [i32; 2]) {
        let mut first = [0; 2];
        let mut size = [0; 2];
        for axis in 0..2 {
            let (mut from, mut to) =
                (low[axis].div_euclid(PAGE_SIDE_CELLS), high[axis].div_euclid(PAGE_SIDE_CELLS) + 1);
            if !self.pages.is_empty() {
                from = from.min(self.first[axis]);
                to = to.max(self.first[axis] + self.size[axis]);
            }
            (first[axis], size[axis]) = (from, to - from);
        }
        let is_larger = first != self.first || size != self.size;
        if !is_larger || i64::from(size[0]) * i64::from(size[1]) > MAX_PAGE_COUNT {
            return;
        }
        let mut pages = vec![None; (size[0] * size[1]) as usize];
        for y in 0..self.size[1] {
            for x in 0..self.size[0] {
                let (to_x, to_y) = (x + self.first[0] - first[0], y + self.first[1] - first[1]);
                pages[(to_y * size[0] + to_x) as usize] =
                    self.pages[(y * self.size[0] + x) as usize].take();
            }
        }
        (self.first, self.size, self.pages) = (first, size, pages);
    }

    /// Draws what a scan traced.
    pub(super) fn draw(&mut self, trace: &Trace) {
        let (low, high) = trace.bounds();
        self.reach(low, high);
        let share = self.solid_share;
        for row in (low[1]..=high[1]).step_by(TILE_SIDE_CELLS as usize) {
            for column in (low[0]..=high[0]).step_by(TILE_SIDE_CELLS as usize) {
                if !trace.touches(column, row) {
                    continue;
                }
                let Some(tile) = self.tile_mut(column, row) else { continue };
                for line in 0..TILE_SIDE_CELLS {
                    let mut free = trace.free(column, row + line);
                    while free != 0 {
                        let bit = free.trailing_zeros();
                        free &= free - 1;
                        tile.pass((line as usize) << 5 | bit as usize, share);
                    }
                }
            }
        }
        for &[x, y] in trace.ends() {
            let (column, row) = (floor(x), floor(y));
            if let Some(tile) = self.tile_mut(column, row) {
                let part = [x - f64::from(column), y - f64::from(row)];
                tile.hit(cell_index(column, row), part, share);
            }
        }
    }

    /// Returns the nearest mean of a solid cell within `kernel` cells, as an offset from it to the
    /// position. All in cells.
    #[inline]
    pub(super) fn nearest(&self, x: f64, y: f64, kernel: i32) -> Option<[f64; 2]> {
        let (column, row) = (floor(x), floor(y));
        let (left, low) = (column - kernel, row - kernel);
        let mut best = (f64::INFINITY, [0.0; 2]);
        let is_in_one = (left & (TILE_SIDE_CELLS - 1)) + 2 * kernel < TILE_SIDE_CELLS
            && (low & (TILE_SIDE_CELLS - 1)) + 2 * kernel < TILE_SIDE_CELLS;
        if is_in_one {
            self.tile(left, low)?.nearest([left, low], 2 * kernel + 1, [x, y], &mut best);
        } else {
            // The window lies over two or four tiles.
            let split = |from: i32| {
                (
                    ((from | (TILE_SIDE_CELLS - 1)) + 1).min(from + 2 * kernel + 1),
                    from + 2 * kernel + 1,
                )
            };
            let ((middle_x, end_x), (middle_y, end_y)) = (split(left), split(low));
            for (from_y, to_y) in [(low, middle_y), (middle_y, end_y)] {
                for (from_x, to_x) in [(left, middle_x), (middle_x, end_x)] {
                    if from_x >= to_x || from_y >= to_y {
                        continue;
                    }
                    if let Some(tile) = self.tile(from_x, from_y) {
                        tile.nearest_in([from_x, from_y], [to_x, to_y], [x, y], &mut best);
                    }
                }
            }
        }
        best.0.is_finite().then_some(best.1)
    }

    /// Returns the content of the map around a beam end at most `kernel` cells away. Position in cells.
    pub(super) fn seen(&self, x: f64, y: f64, kernel: i32) -> Seen {
        if let Some([dx, dy]) = self.nearest(x, y, kernel) {
            return Seen::Near(dx * dx + dy * dy);
        }
        let (column, row) = (floor(x), floor(y));
        let beams = self.tile(column, row).map_or(0, |tile| tile.beams[cell_index(column, row)]);
        if beams < MIN_FREE_PASS_COUNT { Seen::Nothing } else { Seen::Through }
    }

    /// Number of solid cells that a scan sees through.
    pub(super) fn passed(&self, trace: &Trace) -> u32 {
        let (low, high) = trace.bounds();
        let mut sum = 0;
        for row in (low[1]..=high[1]).step_by(TILE_SIDE_CELLS as usize) {
            for column in (low[0]..=high[0]).step_by(TILE_SIDE_CELLS as usize) {
                if !trace.touches(column, row) {
                    continue;
                }
                let Some(tile) = self.tile(column, row) else { continue };
                for (line, solid) in tile.solid.iter().enumerate().filter(|it| *it.1 != 0) {
                    sum += (solid & trace.free(column, row + line as i32)).count_ones();
                }
            }
        }
        sum
    }

    /// A map with one scan from the origin, of walls at these points.
    #[cfg(test)]
    pub(super) fn of_points(points: &[periplus_scan_matching::Point]) -> Self {
        let beams = super::beams::Beams {
            points: points.to_vec(),
            hits: points.iter().map(|it| [it.x, it.y]).collect(),
            rims: Vec::new(),
            origin: [0.0; 2],
        };
        let mut cells = Self::new(0.05, 0.1);
        let mut trace = Trace::default();
        trace.fill(&beams, Pose2::IDENTITY, cells.per_m());
        cells.draw(&trace);
        cells
    }

    #[cfg(test)]
    pub(super) fn cell(&self, column: i32, row: i32) -> Cell {
        self.tile(column, row).map_or(Cell::default(), |tile| tile.cell(cell_index(column, row)))
    }

    /// Least and most columns and rows of tiles that were drawn to.
    fn extent(&self) -> Option<([i32; 2], [i32; 2])> {
        let (mut low, mut high) = ([i32::MAX; 2], [i32::MIN; 2]);
        self.each_tile(|corner, _, tile| {
            for (line, cells) in tile.beams.chunks_exact(TILE_SIDE_CELLS as usize).enumerate() {
                for (place, &beams) in cells.iter().enumerate() {
                    if beams > 0 {
                        let at = [corner[0] + place as i32, corner[1] + line as i32];
                        for axis in 0..2 {
                            low[axis] = low[axis].min(at[axis]);
                            high[axis] = high[axis].max(at[axis]);
                        }
                    }
                }
            }
        });
        (low[0] <= high[0]).then_some((low, high))
    }

    /// Calls for each tile with its first cell, and how many maps share it.
    fn each_tile(&self, mut call: impl FnMut([i32; 2], f64, &Tile)) {
        for (index, page) in self.pages.iter().enumerate() {
            let Some(page) = page else { continue };
            let at = [index as i32 % self.size[0], index as i32 / self.size[0]];
            for (place, tile) in page.tiles.iter().enumerate() {
                let Some(tile) = tile else { continue };
                let inside = [place as i32 % TILES, place as i32 / TILES];
                let corner: [i32; 2] = std::array::from_fn(|axis| {
                    (self.first[axis] + at[axis]) * PAGE_SIDE_CELLS + inside[axis] * TILE_SIDE_CELLS
                });
                let shared = Arc::strong_count(page) as f64 * Arc::strong_count(tile) as f64;
                call(corner, shared, tile);
            }
        }
    }

    /// Bytes held, about; what is shared counts in part.
    pub(super) fn size(&self) -> usize {
        let mut bytes = self.pages.len() as f64 * 8.0;
        for page in self.pages.iter().flatten() {
            bytes += size_of::<Page>() as f64 / Arc::strong_count(page) as f64;
        }
        self.each_tile(|_, shared, tile| bytes += tile.size() as f64 / shared);
        bytes as usize
    }

    /// Prepares the occupancy grid: cells in which more than a fraction of the beams ended are occupied. It
    /// covers everything observed and the given corners \[m\]; `None` if it would be too large.
    pub(super) fn plan(self, occupied_share: f64, bounds_m: [Option<f64>; 4]) -> Option<CellsPlan> {
        const MARGIN_CELLS: i32 = 4;
        let seen = self.extent();
        let (mut low, mut high) = seen.unwrap_or(([0; 2], [0; 2]));
        let [x0, y0, x1, y1] = bounds_m;
        let cell = |metres: f64| floor((metres * self.per_m).clamp(-1e6, 1e6));
        for (axis, (from, to)) in [(x0, x1), (y0, y1)].into_iter().enumerate() {
            (low[axis], high[axis]) = (low[axis] - MARGIN_CELLS, high[axis] + MARGIN_CELLS);
            if let (Some(from), Some(to)) = (from, to)
                && from < to
            {
                (low[axis], high[axis]) = (low[axis].min(cell(from)), high[axis].max(cell(to) - 1));
            }
        }
        let origin = low.map(|low| f64::from(low) * self.resolution_m);
        let origin = Pose2::new(origin[0], origin[1], 0.0);
        let size: [usize; 2] = std::array::from_fn(|axis| (high[axis] - low[axis] + 1) as usize);
        let info = GridInfo::new(self.resolution_m, size[0], size[1], origin).ok()?;
        Some(CellsPlan { cells: self, info, low, occupied_share })
    }
}

/// A map of cells, to be drawn a few rows at a time.
pub(super) struct CellsPlan {
    cells: Cells,
    info: GridInfo,
    /// The cell at the corner.
    low: [i32; 2],
    occupied_share: f64,
}

impl Plan for CellsPlan {
    fn info(&self) -> GridInfo {
        self.info
    }

    fn rows(&self, rows: Range<usize>) -> OccupancyGrid {
        let mut grid = Grid::new(part(&self.info, &rows), occupancy::UNKNOWN);
        let low = [self.low[0], self.low[1] + rows.start as i32];
        let count = rows.len() as i32;
        self.cells.each_tile(|corner, _, tile| {
            let first = corner[1] - low[1];
            if first >= count || first + TILE_SIDE_CELLS <= 0 {
                return;
            }
            for (place, &beams) in tile.beams.iter().enumerate() {
                let row = first + place as i32 / TILE_SIDE_CELLS;
                if beams == 0 || row < 0 || row >= count {
                    continue;
                }
                let column = corner[0] + place as i32 % TILE_SIDE_CELLS - low[0];
                let is_occupied = tile.cell(place).share() > self.occupied_share;
                grid[(column as usize, row as usize)] =
                    if is_occupied { occupancy::OCCUPIED } else { occupancy::FREE };
            }
        });
        grid
    }
}

impl Cell {
    /// Fraction of the beams that ended in the cell.
    fn share(&self) -> f64 {
        f64::from(self.hits) / f64::from(self.beams.max(1))
    }
}

impl Tile {
    /// Beam counts of a cell.
    fn cell(&self, index: usize) -> Cell {
        let beams = self.beams[index];
        let end = self.has_end(index).then(|| self.ends[self.end(index)]);
        end.map_or(Cell { beams, ..Cell::default() }, |End { hits, mean }| Cell {
            hits,
            beams,
            mean,
        })
    }

    #[inline]
    fn has_end(&self, index: usize) -> bool {
        self.ended[index >> 5] >> (index & 31) & 1 == 1
    }

    /// Index of the end of a cell, or where it would be inserted.
    #[inline]
    fn end(&self, index: usize) -> usize {
        let (row, bit) = (index >> 5, index & 31);
        let before = self.ended[row] & ((1 << bit) - 1);
        usize::from(self.before[row]) + before.count_ones() as usize
    }

    /// Bytes held.
    fn size(&self) -> usize {
        size_of::<Self>() + self.ends.capacity() * size_of::<End>()
    }

    fn halve(&mut self, index: usize) {
        if self.beams[index] >= MOST_COUNT {
            self.beams[index] /= 2;
            if self.has_end(index) {
                let end = self.end(index);
                self.ends[end].hits /= 2;
            }
        }
    }

    #[inline]
    fn pass(&mut self, index: usize, solid_share: f64) {
        self.halve(index);
        self.beams[index] += 1;
        if self.has_end(index) {
            self.judge(index, solid_share);
        }
    }

    fn hit(&mut self, index: usize, part: [f64; 2], solid_share: f64) {
        self.halve(index);
        self.beams[index] += 1;
        let end = self.end(index);
        if !self.has_end(index) {
            self.ends.insert(end, End { hits: 0, mean: [0; 2] });
            self.ended[index >> 5] |= 1 << (index & 31);
            self.before[(index >> 5) + 1..].iter_mut().for_each(|it| *it += 1);
        }
        let End { hits, mean } = &mut self.ends[end];
        *hits += 1;
        for (mean, part) in mean.iter_mut().zip(part) {
            let new = 256.0 * part - 0.5;
            let old = f64::from(*mean);
            *mean = (old + (new - old) / f64::from(*hits) + 0.5).clamp(0.0, 255.0) as u8;
        }
        self.judge(index, solid_share);
    }

    fn judge(&mut self, index: usize, solid_share: f64) {
        let is_solid = self.cell(index).share() > solid_share;
        let bit = 1 << (index & 31);
        let row = &mut self.solid[index >> 5];
        *row = if is_solid { *row | bit } else { *row & !bit };
    }

    /// [`Cells::nearest`] in a square window that lies in this tile.
    #[inline]
    fn nearest(&self, from: [i32; 2], side: i32, place: [f64; 2], best: &mut (f64, [f64; 2])) {
        self.nearest_in(from, [from[0] + side, from[1] + side], place, best);
    }

    #[inline]
    fn nearest_in(
        &self,
        from: [i32; 2],
        to: [i32; 2],
        place: [f64; 2],
        best: &mut (f64, [f64; 2]),
    ) {
        let shift = (from[0] & (TILE_SIDE_CELLS - 1)) as u32;
        let mask = (!0_u32) >> (TILE_SIDE_CELLS - (to[0] - from[0])) as u32;
        for row in from[1]..to[1] {
            let line = (row & (TILE_SIDE_CELLS - 1)) as usize;
            let mut bits = (self.solid[line] >> shift) & mask;
            while bits != 0 {
                let bit = bits.trailing_zeros();
                bits &= bits - 1;
                let end = &self.ends[self.end(line << 5 | (shift + bit) as usize)];
                let mean = end.mean.map(|it| (f64::from(it) + 0.5) * (1.0 / 256.0));
                let x = place[0] - (f64::from(from[0] + bit as i32) + mean[0]);
                let y = place[1] - (f64::from(row) + mean[1]);
                let squared = x * x + y * y;
                if squared < best.0 {
                    *best = (squared, [x, y]);
                }
            }
        }
    }
}

fn tile_index(column: i32, row: i32) -> usize {
    let inside = |at: i32| at.rem_euclid(PAGE_SIDE_CELLS) / TILE_SIDE_CELLS;
    (inside(row) * TILES + inside(column)) as usize
}

fn cell_index(column: i32, row: i32) -> usize {
    ((row & (TILE_SIDE_CELLS - 1)) * TILE_SIDE_CELLS + (column & (TILE_SIDE_CELLS - 1))) as usize
}

/// Rounds down without a call; for positions within a million cells of the origin and more.
#[inline]
pub(super) fn floor(value: f64) -> i32 {
    const MAX_COORDINATE_CELL_COUNT: f64 = 1_073_741_824.0;
    (value + MAX_COORDINATE_CELL_COUNT) as i32 - 1_073_741_824
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gmapping::beams::Beams;

    /// A map with a scan from the origin whose beams end at these positions [cells of 1 m].
    fn drawn(ends: &[[f32; 2]]) -> Cells {
        let mut cells = Cells::new(1.0, 0.1);
        draw(&mut cells, Pose2::new(0.5, 0.5, 0.0), ends);
        cells
    }

    fn draw(cells: &mut Cells, pose: Pose2, ends: &[[f32; 2]]) {
        let beams =
            Beams { points: Vec::new(), hits: ends.to_vec(), rims: Vec::new(), origin: [0.0; 2] };
        let mut trace = Trace::default();
        trace.fill(&beams, pose, 1.0);
        cells.draw(&trace);
    }

    #[test]
    fn beams_pass_cells_and_end_in_one() {
        let mut cells = drawn(&[[4.0, 0.25]]);
        let at = |cells: &Cells, column| {
            let cell = cells.cell(column, 0);
            (cell.hits, cell.beams)
        };
        assert_eq!(
            (0..6).map(|it| at(&cells, it)).collect::<Vec<_>>(),
            [(0, 1), (0, 1), (0, 1), (0, 1), (1, 1), (0, 0)]
        );
        // The map has the exact position: 4.5, 0.75; queried from 4.1, 0.75 it is 0.4 to the right.
        let off = cells.nearest(4.1, 0.75, 1).unwrap();
        assert!((off[0] + 0.4).abs() < 0.01 && off[1].abs() < 0.01, "{off:?}");
        assert_eq!(cells.nearest(2.5, 0.5, 1), None);
        // Seen through, it is half a wall, and after ten more no wall at all.
        draw(&mut cells, Pose2::new(0.5, 0.5, 0.0), &[[6.0, 0.0]]);
        assert_eq!(at(&cells, 4), (1, 2));
        for _ in 0..10 {
            draw(&mut cells, Pose2::new(0.5, 0.5, 0.0), &[[6.0, 0.0]]);
        }
        assert_eq!(cells.nearest(4.1, 0.75, 1), None);
    }

    #[test]
    fn a_copy_shares_all_and_copies_what_it_writes_to() {
        let mut first = drawn(&[[4.0, 0.0], [100.0, 0.0], [0.0, -50.0]]);
        let alone = first.size();
        let mut second = first.clone();
        assert_eq!(first.size() + second.size(), alone + 8 * second.pages.len());
        let before = first.cell(4, 0);
        draw(&mut second, Pose2::new(0.5, 0.5, 0.0), &[[4.0, 0.0]]);
        assert_eq!((first.cell(4, 0), second.cell(4, 0).hits), (before, 2));
        // One tile was copied, with the pointers of its page; all else is still shared.
        let copied = first.tile(0, 0).unwrap().size() + size_of::<Page>();
        let both = first.size() + second.size();
        assert!(both.abs_diff(alone + copied + 8 * second.pages.len()) <= 24, "{both} {alone}");
        let shares = |cells: &Cells, column: i32, row: i32| {
            std::ptr::from_ref(cells.tile(column, row).unwrap())
        };
        assert_ne!(shares(&first, 0, 0), shares(&second, 0, 0));
        assert_eq!(shares(&first, 99, 0), shares(&second, 99, 0));
        draw(&mut first, Pose2::new(90.5, 0.5, 0.0), &[[4.0, 0.0]]);
        assert_ne!(shares(&first, 90, 0), shares(&second, 90, 0));
    }

    #[test]
    fn a_wild_jump_does_not_take_all_memory() {
        let mut cells = drawn(&[[4.0, 0.0]]);
        let size = cells.size();
        draw(&mut cells, Pose2::new(5e8, 5e8, 0.0), &[[4.0, 0.0]]);
        assert_eq!(cells.size(), size);
        assert!(cells.plan(0.25, [None; 4]).is_some());
    }

    #[test]
    fn the_grid_has_what_was_seen() {
        let cells = drawn(&[[3.0, 0.0]]);
        let drawn = |bounds_m| {
            let plan = cells.clone().plan(0.25, bounds_m).unwrap();
            let whole = plan.rows(0..plan.info.height);
            for low in 0..plan.info.height - 2 {
                let band = plan.rows(low..low + 3);
                let width = plan.info.width;
                assert_eq!(band.cells, whole.cells[low * width..(low + 3) * width]);
            }
            whole
        };
        let grid = drawn([None; 4]);
        assert_eq!(grid.at(1.5, 0.5), Some(&occupancy::FREE));
        assert_eq!(grid.at(3.5, 0.5), Some(&occupancy::OCCUPIED));
        assert_eq!(grid.at(4.5, 0.5), Some(&occupancy::UNKNOWN));
        let wide = drawn([Some(-10.0), Some(-20.0), Some(10.0), Some(20.0)]);
        assert_eq!((wide.info.width, wide.info.height), (20, 40));
        assert_eq!(wide.at(3.5, 0.5), Some(&occupancy::OCCUPIED));
    }

    #[test]
    fn places_round_down() {
        for (place, cell) in [(0.0, 0), (0.99, 0), (-0.01, -1), (-1.0, -1), (70_000.5, 70_000)] {
            assert_eq!(floor(place), cell);
        }
    }

    proptest::proptest! {
        #[test]
        fn the_nearest_is_the_nearest_of_all(
            ends in proptest::collection::vec((-60.0..60.0_f32, -60.0..60.0_f32), 1..40),
            x in -62.0..62.0_f64,
            y in -62.0..62.0_f64,
            kernel in 1..4_i32,
        ) {
            let ends: Vec<[f32; 2]> = ends.into_iter().map(|(x, y)| [x, y]).collect();
            let cells = drawn(&ends);
            let found = cells.nearest(x, y, kernel).map(|off| off[0] * off[0] + off[1] * off[1]);
            let (column, row) = (floor(x), floor(y));
            let mut best: Option<f64> = None;
            for at_y in row - kernel..=row + kernel {
                for at_x in column - kernel..=column + kernel {
                    let cell = cells.cell(at_x, at_y);
                    if cell.hits == 0 || cell.share() <= 0.1 {
                        continue;
                    }
                    let mean = cell.mean.map(|it| (f64::from(it) + 0.5) / 256.0);
                    let (dx, dy) = (x - f64::from(at_x) - mean[0], y - f64::from(at_y) - mean[1]);
                    let squared = dx * dx + dy * dy;
                    best = Some(best.map_or(squared, |best| best.min(squared)));
                }
            }
            match (found, best) {
                (Some(found), Some(best)) => proptest::prop_assert!((found - best).abs() < 1e-9),
                (found, best) => proptest::prop_assert_eq!(found.is_some(), best.is_some()),
            }
        }
    }
}
