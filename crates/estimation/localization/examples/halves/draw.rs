//! Pictures of a comparison.

use periplus_geometry::Pose2;
use periplus_grid::{Line, OccupancyGrid};
use periplus_images::{Layout, write_png};

use crate::compare::{ASKED_M, Compared};

type Colour = [u8; 3];

const SLAM: Colour = [40, 90, 230];
const SURE: Colour = [20, 150, 60];
const UNSURE: Colour = [240, 140, 20];
/// Color of tracking scans beyond the required agreement.
const WRONG: Colour = [225, 30, 40];
const GRID: Colour = [225; 3];
const INK: Colour = [70; 3];
const OFF_MAP: Colour = [235, 235, 245];

/// Maximum side of the map picture \[px\].
const MAX_SIDE_PX: usize = 2400;
/// Size and margins of the error picture \[px\].
const WIDTH_PX: usize = 1600;
const HEIGHT_PX: usize = 500;
const MARGIN_X_PX: usize = 60;
const MARGIN_Y_PX: usize = 30;
/// Error at the upper edge \[m\].
const MOST_M: f64 = 0.3;

struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<Colour>,
}

impl Canvas {
    fn new(width: usize, height: usize, colour: Colour) -> Self {
        Self { width, height, pixels: vec![colour; width * height] }
    }

    fn set(&mut self, (column, row): (usize, usize), colour: Colour) {
        if column < self.width && row < self.height {
            self.pixels[row * self.width + column] = colour;
        }
    }

    fn dot(&mut self, (column, row): (usize, usize), half: usize, colour: Colour) {
        for y in row.saturating_sub(half)..=row + half {
            for x in column.saturating_sub(half)..=column + half {
                self.set((x, y), colour);
            }
        }
    }

    fn line(&mut self, from: (usize, usize), to: (usize, usize), colour: Colour) {
        for cell in Line::between(from, to) {
            self.set(cell, colour);
        }
    }

    /// Digits and points, twelve pixels high.
    fn number(&mut self, (column, row): (usize, usize), text: &str) {
        for (place, letter) in text.chars().enumerate() {
            let rows = match letter {
                '0' => [7, 5, 5, 5, 7],
                '1' => [2, 6, 2, 2, 7],
                '2' => [7, 1, 7, 4, 7],
                '3' => [7, 1, 7, 1, 7],
                '4' => [5, 5, 7, 1, 1],
                '5' => [7, 4, 7, 1, 7],
                '6' => [7, 4, 7, 5, 7],
                '7' => [7, 1, 1, 2, 2],
                '8' => [7, 5, 7, 5, 7],
                '9' => [7, 5, 7, 1, 7],
                '.' => [0, 0, 0, 0, 2],
                'm' => [0, 7, 7, 5, 5],
                's' => [3, 4, 2, 1, 6],
                _ => [0; 5],
            };
            for (down, bits) in rows.into_iter().enumerate() {
                for right in 0..3 {
                    if bits & (4 >> right) != 0 {
                        self.dot((column + 10 * place + 2 * right, row + 2 * down), 1, INK);
                    }
                }
            }
        }
    }

    fn png(&self) -> Vec<u8> {
        let side = |pixels: usize| u32::try_from(pixels).unwrap_or(u32::MAX);
        write_png(side(self.width), side(self.height), Layout::Rgb, self.pixels.as_flattened())
    }
}

/// Draws the map, the trajectory of SLAM in blue, and that of localization: green while tracking,
/// orange otherwise, red while tracking beyond the required agreement. Scale: a bar of ten metres.
pub(crate) fn ways(map: &OccupancyGrid, compared: &Compared) -> Vec<u8> {
    let info = map.info;
    let margin = 0.5 * info.resolution_m;
    let corner = |index: usize| {
        info.point_at([0, info.width][index % 2] as f64, [0, info.height][index / 2] as f64)
    };
    let corners = (0..4).map(corner);
    let places = compared.rows.iter().flat_map(|row| [Some(row.slam), row.found]).flatten();
    let all = corners.chain(places.map(|it| (it.x_m, it.y_m)));
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (x, y) in all {
        (low[0], low[1]) = (low[0].min(x - margin), low[1].min(y - margin));
        (high[0], high[1]) = (high[0].max(x + margin), high[1].max(y + margin));
    }
    let span = (high[0] - low[0]).max(high[1] - low[1]);
    let pixel_m = (span / MAX_SIDE_PX as f64).max(info.resolution_m / 2.0);
    let (width, height) =
        (((high[0] - low[0]) / pixel_m) as usize + 1, ((high[1] - low[1]) / pixel_m) as usize + 1);
    let mut canvas = Canvas::new(width, height, [205; 3]);
    let cell_transform = info.finder();
    for row in 0..height {
        for column in 0..width {
            let x = low[0] + (column as f64 + 0.5) * pixel_m;
            let y = low[1] + ((height - row) as f64 - 0.5) * pixel_m;
            let value = cell_transform.cell_of(x, y).map_or(-1, |cell| map[cell]);
            let grey = if value < 0 { 205 } else { 255 - (f64::from(value.min(100)) * 2.55) as u8 };
            canvas.set((column, row), [grey; 3]);
        }
    }
    let pixel = |pose: Pose2| {
        let (x, y) = ((pose.x_m - low[0]) / pixel_m, (pose.y_m - low[1]) / pixel_m);
        (x as usize, height.saturating_sub(1 + y as usize))
    };
    for pair in compared.rows.windows(2) {
        canvas.line(pixel(pair[0].slam), pixel(pair[1].slam), SLAM);
    }
    for row in &compared.rows {
        let Some(found) = row.found else { continue };
        let is_wrong = row.is_sure() && row.nearby_m() > ASKED_M;
        let (half, colour) = match (is_wrong, row.is_sure()) {
            (true, _) => (2, WRONG),
            (false, true) => (1, SURE),
            (false, false) => (1, UNSURE),
        };
        canvas.dot(pixel(found), half, colour);
    }
    let bar = (10.0 / pixel_m) as usize;
    canvas.line((10, height.saturating_sub(12)), (10 + bar, height.saturating_sub(12)), INK);
    canvas.number((12, height.saturating_sub(30)), "10 m");
    canvas.png()
}

/// Draws the difference between localization and SLAM over time, in the colors of the map. The line
/// is the required agreement; shaded times are off the map.
pub(crate) fn errors(compared: &Compared) -> Vec<u8> {
    let mut canvas = Canvas::new(WIDTH_PX, HEIGHT_PX, [255; 3]);
    let end_s = compared.rows.last().map_or(1.0, |row| row.after_s).max(1.0);
    let (wide, high) = (WIDTH_PX - 2 * MARGIN_X_PX, HEIGHT_PX - 2 * MARGIN_Y_PX);
    let column = |after_s: f64| MARGIN_X_PX + (after_s / end_s * wide as f64) as usize;
    let row = |off_m: f64| MARGIN_Y_PX + high - (off_m.min(MOST_M) / MOST_M * high as f64) as usize;
    for pair in compared.rows.windows(2).filter(|pair| !pair[0].is_covered) {
        for x in column(pair[0].after_s)..column(pair[1].after_s).max(column(pair[0].after_s) + 1) {
            canvas.line((x, MARGIN_Y_PX), (x, MARGIN_Y_PX + high), OFF_MAP);
        }
    }
    for step in 0..=6_u32 {
        let off_m = 0.05 * f64::from(step);
        let y = row(off_m);
        canvas.line(
            (MARGIN_X_PX, y),
            (MARGIN_X_PX + wide, y),
            if off_m == ASKED_M { WRONG } else { GRID },
        );
        canvas.number((4, y - 4), &format!("{off_m:.2}"));
    }
    canvas.number((MARGIN_X_PX + 4, MARGIN_Y_PX - 18), "m");
    let every_s = [10.0, 30.0, 60.0, 300.0, 1800.0].into_iter().find(|it| end_s / it < 20.0);
    let every_s = every_s.unwrap_or(7200.0);
    let mut tick_s = 0.0;
    while tick_s <= end_s {
        canvas.line(
            (column(tick_s), MARGIN_Y_PX + high),
            (column(tick_s), MARGIN_Y_PX + high + 5),
            INK,
        );
        canvas.number((column(tick_s), MARGIN_Y_PX + high + 10), &format!("{tick_s:.0} s"));
        tick_s += every_s;
    }
    for it in compared.rows.iter().filter(|it| it.found.is_some()) {
        let is_wrong = it.is_sure() && it.is_covered && it.nearby_m() > ASKED_M;
        let colour = match (is_wrong, it.is_sure()) {
            (true, _) => WRONG,
            (false, true) => SURE,
            (false, false) => UNSURE,
        };
        canvas.dot((column(it.after_s), row(it.nearby_m())), 1, colour);
    }
    canvas.png()
}
