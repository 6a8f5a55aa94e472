//! Image of a map with the trajectory of the robot.

use std::io::{self, Write};

use periplus_geometry::Pose2;
use periplus_grid::{GridInfo, Line, OccupancyGrid, occupancy};
use periplus_images::{Layout, pack_png};

/// Longest side of the image \[px\].
const MAX_SIDE_PX: usize = 1600;
/// Colours from the first pose to the last.
const FIRST_COLOUR: [f64; 3] = [40.0, 90.0, 230.0];
const LAST_COLOUR: [f64; 3] = [225.0, 50.0, 40.0];
/// Rings around marked positions: colour, radius in the map \[m\], minimum radius and half the line
/// width \[px\].
const RING_COLOUR: [u8; 3] = [255, 0, 0];
const RING_RADIUS_M: f64 = 1.5;
const MIN_RING_RADIUS_PX: f64 = 12.0;
const HALF_LINE_WIDTH_PX: f64 = 1.5;
/// Order of a ring pixel, instead of the index of a pose.
const RING_ORDER: u32 = u32::MAX;

/// PNG of a map, the trajectory from blue to red, and a red ring around each marked position \[m\].
pub fn draw(map: &OccupancyGrid, trajectory: &[Pose2], marked: &[(f64, f64)]) -> Vec<u8> {
    let drawn = draw_by(map.info, trajectory, marked, |picture| {
        map.rows().rev().try_for_each(|row| picture.push(row))
    });
    debug_assert!(drawn.is_ok(), "{drawn:?}");
    drawn.unwrap_or_default()
}

/// As [`draw`], for a map that is given row by row: neither map nor image is kept in memory as a
/// whole.
pub fn draw_by(
    info: GridInfo,
    trajectory: &[Pose2],
    marked: &[(f64, f64)],
    rows: impl FnOnce(&mut Picture<'_>) -> io::Result<()>,
) -> io::Result<Vec<u8>> {
    let every = info.width.max(info.height).div_ceil(MAX_SIDE_PX).max(1);
    let (width, height) = (info.width.div_ceil(every), info.height.div_ceil(every));
    pack_png(number(width), number(height), Layout::Rgb, |out| {
        rows(&mut Picture {
            out,
            info,
            every,
            left: info.height,
            darkest: vec![i8::MIN; width],
            trajectory: dots(&info, every, trajectory, marked),
            drawn: 0,
            steps: trajectory.len(),
            samples: Vec::with_capacity(3 * width),
        })
    })
}

/// Image that is being written.
pub struct Picture<'a> {
    out: &'a mut dyn Write,
    info: GridInfo,
    /// Rows and columns of the map per pixel.
    every: usize,
    /// Remaining rows of the map.
    left: usize,
    /// Darkest cell of each pixel of a row, so that thin walls stay visible.
    darkest: Vec<i8>,
    /// Pixels of the trajectory by row from the top; of several at the same position the last one
    /// counts.
    trajectory: Vec<Dot>,
    /// Number of pixels drawn so far.
    drawn: usize,
    /// Number of poses of the trajectory.
    steps: usize,
    samples: Vec<u8>,
}

struct Dot {
    row: u32,
    column: u32,
    /// Index of the pose.
    step: u32,
}

impl Picture<'_> {
    /// Adds the cells of the next row of the map, from the top.
    pub fn push(&mut self, cells: &[i8]) -> io::Result<()> {
        let Some(row) = self.left.checked_sub(1) else { return Ok(()) };
        self.left = row;
        for (darkest, cells) in self.darkest.iter_mut().zip(cells.chunks(self.every)) {
            *darkest = cells.iter().fold(*darkest, |darkest, &cell| darkest.max(cell));
        }
        // Lowest of the map rows of a pixel row.
        if row % self.every == 0 { self.end_row(row / self.every) } else { Ok(()) }
    }

    fn end_row(&mut self, from_below: usize) -> io::Result<()> {
        let Self { samples, darkest, .. } = self;
        samples.clear();
        samples.extend(darkest.iter().flat_map(|&value| match value {
            ..0 => [205; 3],
            value => [255 - (f64::from(value.min(100)) * 2.55) as u8; 3],
        }));
        darkest.fill(occupancy::UNKNOWN);
        let row = number(self.info.height.div_ceil(self.every) - 1 - from_below);
        while let Some(dot) = self.trajectory.get(self.drawn).filter(|dot| dot.row <= row) {
            let colour: [u8; 3] = if dot.step == RING_ORDER {
                RING_COLOUR
            } else {
                let part = f64::from(dot.step) / self.steps as f64;
                std::array::from_fn(|i| {
                    (FIRST_COLOUR[i] + part * (LAST_COLOUR[i] - FIRST_COLOUR[i])) as u8
                })
            };
            self.samples[3 * dot.column as usize..][..3].copy_from_slice(&colour);
            self.drawn += 1;
        }
        self.out.write_all(&self.samples)
    }
}

/// Pixels of a trajectory and of rings over it, by row from the top.
fn dots(info: &GridInfo, every: usize, trajectory: &[Pose2], marked: &[(f64, f64)]) -> Vec<Dot> {
    let finder = info.finder();
    let height = info.height.div_ceil(every);
    let mut dots = Vec::new();
    let mut before = None;
    for (step, pose) in trajectory.iter().enumerate() {
        let Some((column, row)) = finder.cell_of(pose.x_m, pose.y_m) else { continue };
        let here = (column / every, height - 1 - row / every);
        for (column, row) in Line::between(before.replace(here).unwrap_or(here), here) {
            dots.push(Dot { row: number(row), column: number(column), step: number(step) });
        }
    }
    for &(x_m, y_m) in marked {
        dots.extend(ring(info, every, x_m, y_m));
    }
    dots.sort_unstable_by_key(|dot| (dot.row, dot.column, std::cmp::Reverse(dot.step)));
    dots.dedup_by_key(|dot| (dot.row, dot.column));
    dots
}

/// Pixels of a ring around a position, clipped to the image.
fn ring(info: &GridInfo, every: usize, x_m: f64, y_m: f64) -> Vec<Dot> {
    let (columns, rows) = info.finder().cells_to(x_m, y_m);
    let (width, height) = (info.width.div_ceil(every), info.height.div_ceil(every));
    let (x, y) = (columns / every as f64, rows / every as f64);
    let radius = (RING_RADIUS_M / (info.resolution_m * every as f64)).max(MIN_RING_RADIUS_PX);
    let reach = radius + HALF_LINE_WIDTH_PX;
    let around = |middle: f64, end: usize| {
        let inside = |value: f64| value.clamp(0.0, end as f64) as usize;
        inside(middle - reach)..inside(middle + reach + 1.0)
    };
    let mut dots = Vec::new();
    for from_below in around(y, height) {
        for column in around(x, width) {
            let away = libm::hypot(column as f64 + 0.5 - x, from_below as f64 + 0.5 - y);
            if (away - radius).abs() <= HALF_LINE_WIDTH_PX {
                let row = number(height - 1 - from_below);
                dots.push(Dot { row, column: number(column), step: RING_ORDER });
            }
        }
    }
    dots
}

fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use periplus_grid::Grid;
    use periplus_images::Raster;

    use super::*;

    #[test]
    fn walls_and_the_way_are_there_at_any_scale() {
        for side in [40, MAX_SIDE_PX, 2 * MAX_SIDE_PX + 7] {
            let info = GridInfo::new(0.05, side, 40, Pose2::new(-1.0, 0.0, 0.0)).unwrap();
            let mut map = Grid::new(info, occupancy::UNKNOWN);
            map.cells[..20 * side].fill(occupancy::FREE);
            map[(7, 3)] = occupancy::OCCUPIED;
            let trajectory =
                [(0.5, 0.5), (0.5, 1.5), (0.52, 1.5)].map(|(x, y)| Pose2::new(x, y, 0.0));
            let picture = Raster::decode(&draw(&map, &trajectory, &[])).unwrap();
            let every = side.div_ceil(MAX_SIDE_PX);
            let height = 40_usize.div_ceil(every);
            assert_eq!(
                (picture.width as usize, picture.height as usize),
                (side.div_ceil(every), height)
            );
            let at = |column: usize, row: usize| {
                let row = height - 1 - row / every;
                picture.sample(row * picture.width as usize + column / every).to_vec()
            };
            assert_eq!(at(7, 3), [1; 3], "{side}");
            assert_eq!(at(20, 3), [255; 3], "{side}");
            assert_eq!(at(20, 39), [205; 3], "{side}");
            // From blue to red.
            let (begin, end) = (at(30, 10), at(30, 30));
            assert!(begin[2] > begin[0] && end[0] > begin[0], "{side}: {begin:?} {end:?}");
        }
    }

    /// Positions in the middle, near a border and outside the map.
    #[test]
    fn a_ring_is_around_each_marked_position() {
        let info = GridInfo::new(0.05, 100, 80, Pose2::new(-1.0, 0.0, 0.0)).unwrap();
        let map = Grid::new(info, occupancy::FREE);
        let marked = [(1.5, 2.0), (-0.9, 0.1), (40.0, 40.0)];
        let picture = Raster::decode(&draw(&map, &[], &marked)).unwrap();
        let at = |column: usize, row: usize| picture.sample((79 - row) * 100 + column).to_vec();
        // 1.5 m are 30 cells.
        for (column, row) in [(80, 40), (20, 40), (50, 70), (50, 10), (32, 2), (2, 32)] {
            assert_eq!(at(column, row), RING_COLOUR, "({column}, {row})");
        }
        assert_eq!(at(50, 40), [255; 3]);
        assert_eq!(at(99, 79), [255; 3]);
    }
}
