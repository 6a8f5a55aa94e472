//! The map with the way of the robot.

use periplus_base::Pose2;
use periplus_grid::{Line, OccupancyGrid};
use periplus_pictures::{Layout, write_png};

/// Longest side of the picture.
const LONGEST: usize = 1600;
/// From the first pose to the last.
const BEGIN: [f64; 3] = [40.0, 90.0, 230.0];
const END: [f64; 3] = [225.0, 50.0, 40.0];

/// A PNG of a map, and the way from blue to red.
pub(crate) fn draw(map: &OccupancyGrid, way: &[Pose2]) -> Vec<u8> {
    let lattice = map.lattice;
    let every = lattice.width.max(lattice.height).div_ceil(LONGEST).max(1);
    let (width, height) = (lattice.width.div_ceil(every), lattice.height.div_ceil(every));
    let mut pixels = vec![[205_u8; 3]; width * height];
    // The darkest of the cells that share a pixel: walls must not vanish.
    let mut darkest = vec![i8::MIN; width * height];
    for (index, &value) in map.cells.iter().enumerate() {
        let (column, row) = lattice.cell(index);
        let pixel = (height - 1 - row / every) * width + column / every;
        if value > darkest[pixel] {
            darkest[pixel] = value;
            pixels[pixel] = match value {
                ..0 => [205; 3],
                value => [255 - (f64::from(value.min(100)) * 2.55) as u8; 3],
            };
        }
    }
    let finder = lattice.finder();
    let cells: Vec<_> = way
        .iter()
        .filter_map(|pose| finder.cell_of(pose.x_m, pose.y_m))
        .map(|(column, row)| (column / every, height - 1 - row / every))
        .collect();
    for (index, pair) in cells.windows(2).enumerate() {
        let part = index as f64 / cells.len() as f64;
        let colour: [u8; 3] =
            std::array::from_fn(|i| (BEGIN[i] + part * (END[i] - BEGIN[i])) as u8);
        for (column, row) in Line::between(pair[0], pair[1]) {
            pixels[row * width + column] = colour;
        }
    }
    let side = |cells: usize| u32::try_from(cells).unwrap_or(u32::MAX);
    write_png(side(width), side(height), Layout::Rgb, pixels.as_flattened())
}
