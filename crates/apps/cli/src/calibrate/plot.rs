//! Plot of residuals over time.

use std::path::Path;

use periplus_images::{Layout, write_png};

use crate::error::CliError;
use crate::paths;

/// Size of the plot, and of the part for each of x, y and yaw \[px\].
const WIDTH_PX: usize = 1000;
const PART_HEIGHT_PX: usize = 200;
/// Half the side of a point \[px\].
const HALF_POINT_PX: usize = 1;

const COLOURS: [[u8; 3]; 3] = [[225, 50, 40], [20, 150, 60], [40, 90, 230]];
const LIMIT_COLOUR: [u8; 3] = [210; 3];
const ZERO_COLOUR: [u8; 3] = [160; 3];
const BORDER_COLOUR: [u8; 3] = [0; 3];

/// Writes a plot of residuals (stamp \[s\]; x, y \[m\], yaw \[rad\]): x in red, y in green and yaw in blue from top to
/// bottom, each scaled to its largest value, with lines at zero and at two standard deviations.
pub(super) fn write(path: &Path, residuals: &[(f64, [f64; 3])]) -> Result<(), CliError> {
    let png = draw(residuals);
    paths::write(path, &png)?;
    Ok(())
}

fn draw(residuals: &[(f64, [f64; 3])]) -> Vec<u8> {
    let height = 3 * PART_HEIGHT_PX;
    let mut pixels = vec![[255_u8; 3]; WIDTH_PX * height];
    let stamps = || residuals.iter().map(|it| it.0);
    let (first_s, last_s) =
        (stamps().fold(f64::INFINITY, f64::min), stamps().fold(f64::NEG_INFINITY, f64::max));
    for (part, colour) in COLOURS.into_iter().enumerate() {
        let top = part * PART_HEIGHT_PX;
        let middle = PART_HEIGHT_PX / 2;
        for column in 0..WIDTH_PX {
            pixels[(top + middle) * WIDTH_PX + column] = ZERO_COLOUR;
            pixels[top * WIDTH_PX + column] = BORDER_COLOUR;
        }
        let values = || residuals.iter().map(|it| it.1[part]);
        let largest = values().fold(f64::MIN_POSITIVE, |largest, it| largest.max(it.abs()));
        let squares: f64 = values().map(|it| it * it).sum();
        let limit = 2.0 * (squares / residuals.len().max(1) as f64).sqrt() / largest;
        if limit < 1.0 {
            let up = (limit * (middle - HALF_POINT_PX - 1) as f64) as usize;
            for row in [top + middle - up, top + middle + up] {
                pixels[row * WIDTH_PX..(row + 1) * WIDTH_PX].fill(LIMIT_COLOUR);
            }
        }
        for (stamp_s, values) in residuals {
            let along = (stamp_s - first_s) / (last_s - first_s).max(f64::MIN_POSITIVE);
            let margin = HALF_POINT_PX + 1;
            let column = margin + (along * (WIDTH_PX - 2 * margin - 1) as f64) as usize;
            let up = values[part] / largest * (middle - margin) as f64;
            let row = top + (middle as f64 - up) as usize;
            for row in row - HALF_POINT_PX..=row + HALF_POINT_PX {
                for column in column - HALF_POINT_PX..=column + HALF_POINT_PX {
                    if let Some(pixel) = pixels.get_mut(row * WIDTH_PX + column) {
                        *pixel = colour;
                    }
                }
            }
        }
    }
    let side = |it: usize| u32::try_from(it).unwrap_or(u32::MAX);
    write_png(side(WIDTH_PX), side(height), Layout::Rgb, pixels.as_flattened())
}

#[cfg(test)]
mod tests {
    use periplus_images::Raster;

    use super::*;

    #[test]
    fn the_largest_residual_is_at_the_top_of_its_part() {
        let picture = Raster::decode(&draw(&[(0.0, [0.1, 0.0, 0.0]), (1.0, [0.0; 3])])).unwrap();
        let at = |column: usize, row: usize| picture.sample(row * WIDTH_PX + column).to_vec();
        assert_eq!(at(2, 2), COLOURS[0]);
        assert_eq!(at(2, 300), COLOURS[1]);
        assert_eq!(at(500, 100), ZERO_COLOUR);
        // Two standard deviations of one 0.1 and nine zeros are 0.063, so 62 of 98 pixels from the middle.
        let mut residuals = vec![(1.0, [0.0; 3]); 9];
        residuals.push((0.0, [0.1, 0.0, 0.0]));
        let picture = Raster::decode(&draw(&residuals)).unwrap();
        let at = |column: usize, row: usize| picture.sample(row * WIDTH_PX + column).to_vec();
        assert_eq!(
            (at(500, 100 - 61), at(500, 100 + 61)),
            (LIMIT_COLOUR.into(), LIMIT_COLOUR.into())
        );
        // Without residuals the plot is empty.
        assert!(Raster::decode(&draw(&[])).is_ok());
    }
}
