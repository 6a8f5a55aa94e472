//! Picture of paths over a map, seen from above.

use std::path::Path;

use periplus_geometry::Pose2;
use periplus_grid::{GridInfo, Line, OccupancyGrid};
use periplus_images::{Layout, write_png};

use super::scores::RunScores;
use crate::error::CliError;
use crate::paths;

/// Longest side of the picture \[px\].
const MAX_SIDE_PX: f64 = 1600.0;
/// Shortest length of the longest side \[px\]; cells of small maps are several pixels wide.
const MIN_SIDE_PX: f64 = 800.0;
/// Border around the paths \[m\].
const BORDER_M: f64 = 1.0;

/// Colours of true paths and of estimated paths, of the first and of the second run.
const COLOURS: [[[u8; 3]; 2]; 2] = [[[20, 150, 60], [40, 90, 230]], [[190, 150, 0], [225, 50, 40]]];

/// Colour of unknown cells.
const UNKNOWN_COLOUR: [u8; 3] = [205; 3];

/// Writes a picture of the true and the estimated path of each run over the map of the first run that has
/// one.
pub(crate) fn write_picture(path: &Path, runs: &[&RunScores]) -> Result<(), CliError> {
    let map = runs.iter().find_map(|run| run.map.as_ref());
    let Some(canvas) = Canvas::around(map, runs) else {
        return Err(CliError::failed("there are no paths to draw"));
    };
    let png = canvas.draw(map, runs);
    paths::write(path, &png)?;
    Ok(())
}

/// Pixels as cells of a grid in the frame of the truth.
struct Canvas {
    info: GridInfo,
    pixels: Vec<[u8; 3]>,
}

impl Canvas {
    /// Canvas around the map and all paths; none without both.
    fn around(map: Option<&OccupancyGrid>, runs: &[&RunScores]) -> Option<Self> {
        let mut points: Vec<[f64; 2]> = Vec::new();
        for run in runs {
            for [x, y] in run.truth_m.iter().chain(&run.estimate_m) {
                points.push([x - BORDER_M, y - BORDER_M]);
                points.push([x + BORDER_M, y + BORDER_M]);
            }
        }
        if let Some(map) = map {
            let (width, height) = (map.info.width as f64, map.info.height as f64);
            for (column, row) in [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)] {
                let (x, y) = map.info.point_at(column, row);
                points.push([x, y]);
            }
        }
        let first = *points.first()?;
        let low = points.iter().fold(first, |a, b| [a[0].min(b[0]), a[1].min(b[1])]);
        let high = points.iter().fold(first, |a, b| [a[0].max(b[0]), a[1].max(b[1])]);
        let size_m = [high[0] - low[0], high[1] - low[1]];
        let longest_m = size_m[0].max(size_m[1]);
        let finest_m = map.map_or(0.0, |map| map.info.resolution_m);
        let side_m = finest_m.clamp(longest_m / MAX_SIDE_PX, longest_m / MIN_SIDE_PX);
        let [width, height] = size_m.map(|it| ((it / side_m).ceil() as usize).max(1));
        let origin = Pose2::new(low[0], low[1], 0.0);
        let info = GridInfo::new(side_m, width, height, origin).ok()?;
        Some(Self { info, pixels: vec![[255; 3]; info.len()] })
    }

    fn draw(mut self, map: Option<&OccupancyGrid>, runs: &[&RunScores]) -> Vec<u8> {
        if let Some(map) = map {
            self.draw_map(map);
        }
        for (run, [truth, estimate]) in runs.iter().zip(COLOURS) {
            self.draw_path(&run.truth_m, truth);
            self.draw_path(&run.estimate_m, estimate);
        }
        let GridInfo { width, height, .. } = self.info;
        let rows = self.pixels.chunks_exact(width).rev();
        let samples: Vec<u8> = rows.flatten().flatten().copied().collect();
        let side = |it: usize| u32::try_from(it).unwrap_or(u32::MAX);
        write_png(side(width), side(height), Layout::Rgb, &samples)
    }

    /// Each pixel has the highest occupancy in it, so that thin walls stay visible.
    fn draw_map(&mut self, map: &OccupancyGrid) {
        let finder = map.info.finder();
        let per_side = (self.info.resolution_m / map.info.resolution_m).ceil().clamp(1.0, 8.0);
        for index in 0..self.pixels.len() {
            let (column, row) = self.info.cell(index);
            let mut value = i8::MIN;
            for step in 0..(per_side * per_side) as usize {
                let (right, up) = (step % per_side as usize, step / per_side as usize);
                let at = |cell: usize, step: usize| cell as f64 + (step as f64 + 0.5) / per_side;
                let (x, y) = self.info.point_at(at(column, right), at(row, up));
                let found = finder.cell_of(x, y).and_then(|cell| map.get(cell));
                value = value.max(found.copied().unwrap_or(i8::MIN));
            }
            self.pixels[index] = match value {
                ..0 => UNKNOWN_COLOUR,
                value => [(255 - i32::from(value.min(100)) * 255 / 100) as u8; 3],
            };
        }
    }

    fn draw_path(&mut self, path_m: &[[f64; 2]], colour: [u8; 3]) {
        let cells: Vec<_> = path_m.iter().filter_map(|[x, y]| self.info.cell_of(*x, *y)).collect();
        let mut before = None;
        for here in cells {
            for (column, row) in Line::between(before.replace(here).unwrap_or(here), here) {
                // A line of two pixels is visible on a large map.
                for at in [(column, row), (column + 1, row), (column, row + 1)] {
                    if self.info.contains(at) {
                        let index = self.info.index(at);
                        self.pixels[index] = colour;
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use periplus_grid::{Grid, occupancy};
    use periplus_images::Raster;

    use super::*;

    #[test]
    fn paths_are_over_the_map() {
        let info = GridInfo::new(0.1, 40, 30, Pose2::IDENTITY).unwrap();
        let mut map = Grid::new(info, occupancy::FREE);
        map[(5, 5)] = occupancy::OCCUPIED;
        let run = RunScores {
            truth_m: vec![[1.5, 1.5], [2.5, 1.5]],
            estimate_m: vec![[1.5, 2.0], [2.5, 2.0]],
            map: Some(map),
            ..RunScores::default()
        };
        let canvas = Canvas::around(run.map.as_ref(), &[&run]).unwrap();
        let png = canvas.draw(run.map.as_ref(), &[&run]);
        let picture = Raster::decode(&png).unwrap();
        // 4 m by 3 m in pixels of 5 mm: a cell has a side of 20.
        assert_eq!((picture.width, picture.height), (800, 600));
        let at = |column: usize, row: usize| {
            picture.sample((599 - 20 * row) * 800 + 20 * column).to_vec()
        };
        assert_eq!(at(5, 5), [0; 3]);
        assert_eq!(at(20, 15), COLOURS[0][0]);
        assert_eq!(at(20, 20), COLOURS[0][1]);
        assert_eq!(at(0, 0), [255; 3]);
    }
}
