//! The map with the way of the robot.

use std::io::{self, Write};

use periplus_base::Pose2;
use periplus_grid::{Lattice, Line, OccupancyGrid, occupancy};
use periplus_pictures::{Layout, pack_png};

/// Longest side of the picture.
const LONGEST: usize = 1600;
/// From the first pose to the last.
const BEGIN: [f64; 3] = [40.0, 90.0, 230.0];
const END: [f64; 3] = [225.0, 50.0, 40.0];

/// A PNG of a map, and the way from blue to red.
pub(crate) fn draw(map: &OccupancyGrid, way: &[Pose2]) -> Vec<u8> {
    let drawn =
        draw_by(map.lattice, way, |picture| map.rows().rev().try_for_each(|row| picture.push(row)));
    debug_assert!(drawn.is_ok(), "{drawn:?}");
    drawn.unwrap_or_default()
}

/// The same, of a map whose rows are given one by one: neither it nor the picture is held as a whole.
pub(crate) fn draw_by(
    lattice: Lattice,
    way: &[Pose2],
    rows: impl FnOnce(&mut Picture<'_>) -> io::Result<()>,
) -> io::Result<Vec<u8>> {
    let every = lattice.width.max(lattice.height).div_ceil(LONGEST).max(1);
    let (width, height) = (lattice.width.div_ceil(every), lattice.height.div_ceil(every));
    pack_png(number(width), number(height), Layout::Rgb, |out| {
        rows(&mut Picture {
            out,
            lattice,
            every,
            left: lattice.height,
            darkest: vec![i8::MIN; width],
            way: dots(&lattice, every, way),
            drawn: 0,
            steps: way.len(),
            samples: Vec::with_capacity(3 * width),
        })
    })
}

/// Such a picture, as far as it is drawn.
pub(crate) struct Picture<'a> {
    out: &'a mut dyn Write,
    lattice: Lattice,
    /// Rows and columns of the map that share a pixel.
    every: usize,
    /// Rows of the map still to come.
    left: usize,
    /// Of each pixel of a row the darkest of its cells: walls must not vanish.
    darkest: Vec<i8>,
    /// Pixels of the way, by row from the top; of those at the same place the last one counts.
    way: Vec<Dot>,
    /// How many of them are drawn.
    drawn: usize,
    /// Poses of the way.
    steps: usize,
    samples: Vec<u8>,
}

struct Dot {
    row: u32,
    column: u32,
    /// Which step of the way it belongs to.
    step: u32,
}

impl Picture<'_> {
    /// The cells of the next row of the map; the highest comes first.
    pub(crate) fn push(&mut self, cells: &[i8]) -> io::Result<()> {
        let Some(row) = self.left.checked_sub(1) else { return Ok(()) };
        self.left = row;
        for (darkest, cells) in self.darkest.iter_mut().zip(cells.chunks(self.every)) {
            *darkest = cells.iter().fold(*darkest, |darkest, &cell| darkest.max(cell));
        }
        // The lowest of the rows that share one.
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
        let row = number(self.lattice.height.div_ceil(self.every) - 1 - from_below);
        while let Some(dot) = self.way.get(self.drawn).filter(|dot| dot.row <= row) {
            let part = f64::from(dot.step) / self.steps as f64;
            let colour: [u8; 3] =
                std::array::from_fn(|i| (BEGIN[i] + part * (END[i] - BEGIN[i])) as u8);
            self.samples[3 * dot.column as usize..][..3].copy_from_slice(&colour);
            self.drawn += 1;
        }
        self.out.write_all(&self.samples)
    }
}

/// The pixels of a way, by row from the top.
fn dots(lattice: &Lattice, every: usize, way: &[Pose2]) -> Vec<Dot> {
    let finder = lattice.finder();
    let height = lattice.height.div_ceil(every);
    let mut dots = Vec::new();
    let mut before = None;
    for (step, pose) in way.iter().enumerate() {
        let Some((column, row)) = finder.cell_of(pose.x_m, pose.y_m) else { continue };
        let here = (column / every, height - 1 - row / every);
        for (column, row) in Line::between(before.replace(here).unwrap_or(here), here) {
            dots.push(Dot { row: number(row), column: number(column), step: number(step) });
        }
    }
    dots.sort_unstable_by_key(|dot| (dot.row, dot.column, std::cmp::Reverse(dot.step)));
    dots.dedup_by_key(|dot| (dot.row, dot.column));
    dots
}

fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use periplus_grid::Grid;
    use periplus_pictures::Raster;

    use super::*;

    #[test]
    fn walls_and_the_way_are_there_at_any_scale() {
        for side in [40, LONGEST, 2 * LONGEST + 7] {
            let lattice = Lattice::new(0.05, side, 40, Pose2::new(-1.0, 0.0, 0.0)).unwrap();
            let mut map = Grid::new(lattice, occupancy::UNKNOWN);
            map.cells[..20 * side].fill(occupancy::FREE);
            map[(7, 3)] = occupancy::OCCUPIED;
            let way = [(0.5, 0.5), (0.5, 1.5), (0.52, 1.5)].map(|(x, y)| Pose2::new(x, y, 0.0));
            let picture = Raster::decode(&draw(&map, &way)).unwrap();
            let every = side.div_ceil(LONGEST);
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
}
