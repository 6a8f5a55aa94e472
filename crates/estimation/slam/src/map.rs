//! Occupancy grids from scans at known poses.

use std::ops::Range;

use periplus_geometry::Pose2;
use periplus_grid::{Grid, GridInfo, Line, OccupancyGrid, occupancy};
use periplus_scan_matching::PackedPlaces;

use crate::keyframe::Keyframe;

/// Log odds in hundredths that a beam adds to a cell that it passes and to the one it ends in, for
/// probabilities of 0.4 and 0.75; sums are limited to ±4, so that changed cells are relearned.
const MISS_LOG_ODDS_PERCENT: i16 = -41;
const HIT_LOG_ODDS_PERCENT: i16 = 110;
const MAX_LOG_ODDS_PERCENT: i16 = 400;
/// Cells beyond a map's edge \[cells\].
const MARGIN_CELL_COUNT: f64 = 4.0;
/// Neither seen nor passed.
const UNSEEN_LOG_ODDS_PERCENT: i16 = i16::MIN;

/// Scans and poses at one moment. It can be rasterized on another thread while mapping continues; the scans
/// are shared.
#[derive(Clone, Debug, Default)]
pub struct MapSnapshot {
    scans: Vec<Drawn>,
    resolution_m: f64,
}

#[derive(Clone, Debug)]
struct Drawn {
    keyframe: Keyframe,
    map_from_keyframe: Pose2,
}

impl Drawn {
    /// Ends of beams, in the frame of the key.
    fn ends(&self) -> &PackedPlaces {
        self.keyframe.ends.as_deref().unwrap_or(self.keyframe.cloud.places())
    }
}

impl MapSnapshot {
    pub(crate) fn new(keyframes: &[Keyframe], poses: &[Pose2], resolution_m: f64) -> Self {
        let drawn = |(keyframe, &map_from_keyframe): (&Keyframe, &Pose2)| Drawn {
            keyframe: keyframe.clone(),
            map_from_keyframe,
        };
        Self { scans: keyframes.iter().zip(poses).map(drawn).collect(), resolution_m }
    }

    /// The map; none when it would be too large to hold.
    #[must_use]
    pub fn draw(self) -> Option<OccupancyGrid> {
        let plan = self.plan()?;
        Some(plan.rows(0..plan.info.height))
    }

    /// Prepares rasterization by rows; `None` if even that would be too large.
    #[must_use]
    pub fn plan(self) -> Option<SnapshotRaster> {
        let (mut low, mut high) = ([f64::MAX; 2], [f64::MIN; 2]);
        let mut spans = Vec::with_capacity(self.scans.len());
        for scan in &self.scans {
            let pose = scan.map_from_keyframe;
            let (mut lowest, mut highest) = (pose.y_m, pose.y_m);
            let mut include = |x: f64, y: f64| {
                low = [low[0].min(x), low[1].min(y)];
                high = [high[0].max(x), high[1].max(y)];
                (lowest, highest) = (lowest.min(y), highest.max(y));
            };
            include(pose.x_m, pose.y_m);
            for end in scan.ends().iter() {
                let (x, y) = pose.transform_point(end[0].into(), end[1].into());
                include(x, y);
            }
            // Beams begin at the scanner, which is not where the base is.
            let [x, y] = scan.keyframe.cloud.places().middle();
            let (_, y) = pose.transform_point(x.into(), y.into());
            spans.push([lowest.min(y), highest.max(y)]);
        }
        if self.scans.is_empty() {
            (low, high) = ([0.0; 2], [0.0; 2]);
        }
        // Corners at whole cells: the same position has the same cell in every run.
        let resolution_m = self.resolution_m;
        let corner =
            low.map(|low| ((low / resolution_m).floor() - MARGIN_CELL_COUNT) * resolution_m);
        let cells = |axis: usize| {
            ((high[axis] - corner[axis]) / resolution_m + MARGIN_CELL_COUNT).ceil().max(1.0)
                as usize
        };
        let origin = Pose2::new(corner[0], corner[1], 0.0);
        let info = GridInfo::new(resolution_m, cells(0), cells(1), origin).ok()?;
        // A cell more on either side, for rounding.
        let row = |y: f64| ((y - corner[1]) / resolution_m).max(0.0) as u32;
        let rows = |[low, high]: [f64; 2]| [row(low).saturating_sub(1), row(high) + 2];
        Some(SnapshotRaster {
            scans: self.scans,
            info,
            spans: spans.into_iter().map(rows).collect(),
        })
    }
}

/// A map that can be drawn a few rows at a time, so that it is never held as a whole.
pub trait Plan {
    /// Returns the geometry of its cells.
    fn info(&self) -> GridInfo;

    /// Some of its rows, counted from the lowest.
    fn rows(&self, rows: Range<usize>) -> OccupancyGrid;
}

/// Scans with the rows of the map that each of them touches.
pub struct SnapshotRaster {
    scans: Vec<Drawn>,
    info: GridInfo,
    /// First row, and the one after the last.
    spans: Vec<[u32; 2]>,
}

impl Plan for SnapshotRaster {
    fn info(&self) -> GridInfo {
        self.info
    }

    /// Rasterizes scans: cells that beams passed are free, those where they ended are occupied. Within a
    /// scan a cell where a beam ends is not passed by others.
    fn rows(&self, rows: Range<usize>) -> OccupancyGrid {
        let part = part(&self.info, &rows);
        let mut odds: Grid<i16> = Grid::new(part, UNSEEN_LOG_ODDS_PERCENT);
        let mut marks = Marks::default();
        for (scan, span) in self.scans.iter().zip(&self.spans) {
            if (span[0] as usize) < rows.end && (span[1] as usize) > rows.start {
                marks.fill(scan, &self.info, &rows);
                marks.vote(&mut odds, rows.start);
            }
        }
        odds.map(percent)
    }
}

/// Some rows of a grid.
pub(crate) fn part(info: &GridInfo, rows: &Range<usize>) -> GridInfo {
    GridInfo { height: rows.len(), ..info.moved(0, rows.start as i64) }
}

/// Bit masks of the cells that the beams of a scan passed, and in which they ended, for some rows. The
/// buffers are reused.
#[derive(Default)]
struct Marks {
    /// First column, at a border of words, and first row.
    low: (usize, usize),
    /// Words of a row.
    words: usize,
    passed: Vec<u64>,
    ended: Vec<u64>,
}

impl Marks {
    fn fill(&mut self, scan: &Drawn, info: &GridInfo, rows: &Range<usize>) {
        self.words = 0;
        let finder = info.finder();
        let (pose, [x, y]) = (scan.map_from_keyframe, scan.keyframe.cloud.places().middle());
        let (x, y) = pose.transform_point(x.into(), y.into());
        let Some(start) = finder.cell_of(x, y) else { return };
        let (s, c) = libm::sincos(pose.yaw_rad);
        let ends: Vec<_> = scan
            .ends()
            .iter()
            .filter_map(|end| {
                let (x, y) = (f64::from(end[0]), f64::from(end[1]));
                finder.cell_of(c * x - s * y + pose.x_m, s * x + c * y + pose.y_m)
            })
            .collect();
        let (mut low, mut high) = (start, start);
        for end in &ends {
            low = (low.0.min(end.0), low.1.min(end.1));
            high = (high.0.max(end.0), high.1.max(end.1));
        }
        let (bottom, top) = (low.1.max(rows.start), (high.1 + 1).min(rows.end));
        if bottom >= top {
            return;
        }
        self.low = (low.0 & !63, bottom);
        self.words = (high.0 - self.low.0) / 64 + 1;
        for bits in [&mut self.passed, &mut self.ended] {
            bits.clear();
            bits.resize(self.words * (top - bottom), 0);
        }
        let place = |(column, row): (usize, usize)| {
            let column = column - self.low.0;
            ((row - bottom) * self.words + column / 64, 1_u64 << (column % 64))
        };
        let is_inside = |row: usize| (bottom..top).contains(&row);
        for &end in &ends {
            if start.1.max(end.1) < bottom || start.1.min(end.1) >= top {
                continue;
            }
            for cell in Line::between(start, end).filter(|cell| is_inside(cell.1)) {
                let (word, bit) = place(cell);
                self.passed[word] |= bit;
            }
            if is_inside(end.1) {
                let (word, bit) = place(end);
                self.ended[word] |= bit;
            }
        }
    }

    /// Adds the log odds of the scan to each of these cells.
    fn vote(&self, odds: &mut Grid<i16>, first_row: usize) {
        if self.words == 0 {
            return;
        }
        let lines = self.passed.chunks_exact(self.words).zip(self.ended.chunks_exact(self.words));
        for (line, (passed, ended)) in lines.enumerate() {
            let begin = odds.info.index((self.low.0, self.low.1 - first_row + line));
            for (word, (&passed, &ended)) in passed.iter().zip(ended).enumerate() {
                for (mut bits, says) in
                    [(ended, HIT_LOG_ODDS_PERCENT), (passed & !ended, MISS_LOG_ODDS_PERCENT)]
                {
                    while bits != 0 {
                        let bit = bits.trailing_zeros() as usize;
                        bits &= bits - 1;
                        vote(&mut odds.cells[begin + 64 * word + bit], says);
                    }
                }
            }
        }
    }
}

/// Occupancy probability of a cell in percent.
fn percent(&odds: &i16) -> i8 {
    if odds == UNSEEN_LOG_ODDS_PERCENT {
        return occupancy::UNKNOWN;
    }
    let chance = 1.0 / (1.0 + libm::exp(-f64::from(odds) / 100.0));
    (100.0 * chance + 0.5) as i8
}

fn vote(cell: &mut i16, by: i16) {
    let before = if *cell == UNSEEN_LOG_ODDS_PERCENT { 0 } else { *cell };
    *cell = (before + by).clamp(-MAX_LOG_ODDS_PERCENT, MAX_LOG_ODDS_PERCENT);
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Stream;
    use periplus_scan_matching::Cloud;

    use super::*;
    use crate::settings::Settings;

    /// Scans of a room from poses in a row.
    fn snapshot() -> MapSnapshot {
        let settings = Settings::default();
        let mut stream = Stream::keyed(1, "sketch", 0);
        let scans = (0..40).map(|scan| {
            let ends: Vec<[f32; 2]> = (0..360)
                .map(|beam| {
                    let (s, c) = libm::sincosf((beam as f32).to_radians());
                    let range = (3.0 / c.abs().max(s.abs())).min(3.5 + 4.0 * stream.unit() as f32);
                    [0.2 + range * c, range * s]
                })
                .collect();
            let step = 1.0_f32.to_radians();
            let cloud =
                Cloud::new(ends.iter().map(|it| Some(*it)), [0.2, 0.0], step, &settings.cloud);
            let keyframe = Keyframe::new(&cloud, Some(PackedPlaces::new(&ends, [0.2, 0.0])), 0.0);
            let at = f64::from(scan);
            Drawn { keyframe, map_from_keyframe: Pose2::new(0.5 * at, -0.4 * at, 0.3 * at) }
        });
        MapSnapshot { scans: scans.collect(), resolution_m: 0.05 }
    }

    /// Every scan on the whole map, cell by cell.
    fn plain(snapshot: &MapSnapshot, info: GridInfo) -> Vec<i16> {
        let mut odds = vec![UNSEEN_LOG_ODDS_PERCENT; info.len()];
        for scan in &snapshot.scans {
            let pose = scan.map_from_keyframe;
            let cell = |[x, y]: [f32; 2]| {
                let (x, y) = pose.transform_point(x.into(), y.into());
                info.cell_of(x, y).unwrap()
            };
            let start = cell(scan.keyframe.cloud.places().middle());
            let ends: std::collections::BTreeSet<_> = scan.ends().iter().map(cell).collect();
            let passed: std::collections::BTreeSet<_> =
                ends.iter().flat_map(|&end| Line::between(start, end)).collect();
            ends.iter().for_each(|&cell| vote(&mut odds[info.index(cell)], HIT_LOG_ODDS_PERCENT));
            passed
                .difference(&ends)
                .for_each(|&cell| vote(&mut odds[info.index(cell)], MISS_LOG_ODDS_PERCENT));
        }
        odds
    }

    #[test]
    fn a_map_in_parts_is_the_whole_map() {
        let plan = snapshot().plan().unwrap();
        let info = plan.info();
        let whole = plan.rows(0..info.height);
        assert_eq!(Some(&whole), snapshot().draw().as_ref());
        let plain = plain(&snapshot(), info);
        assert_eq!(whole.cells, plain.iter().map(percent).collect::<Vec<i8>>());
        for at_once in [1, 7, 64, info.height - 1] {
            let mut cells = Vec::new();
            for low in (0..info.height).step_by(at_once) {
                let band = plan.rows(low..(low + at_once).min(info.height));
                let (x_m, y_m) = band.info.centre_of((3, 0));
                assert_eq!(info.cell_of(x_m, y_m), Some((3, low)));
                cells.extend(band.cells);
            }
            assert!(cells == whole.cells, "{at_once} rows at a time");
        }
    }
}
