//! Likelihood field over a window.

/// Settings of a field.
#[derive(Clone, Copy, Debug)]
pub struct FieldSettings {
    /// Cell size \[m\].
    pub resolution_m: f32,
    /// Standard deviation of the distance between corresponding points \[m\].
    pub sigma_m: f32,
    /// Maximum half width along each axis \[m\].
    pub most_half_m: f32,
    /// Number of coarser levels; level k has the maximum over 2^k by 2^k cells.
    pub levels: usize,
}

impl Default for FieldSettings {
    fn default() -> Self {
        Self { resolution_m: 0.1, sigma_m: 0.1, most_half_m: 40.0, levels: 4 }
    }
}

/// Likelihood of points over a window, 0 to 255, with maxima over squares of growing size, which
/// bound the score of every pose in a square (Olson 2009, "Real-time correlative scan matching";
/// Hess et al. 2016).
#[derive(Clone, Debug)]
pub struct ScoreField {
    pub(crate) resolution_m: f32,
    /// Corner of cell (0, 0) \[m\].
    pub(crate) corner: [f32; 2],
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// `levels[k]` at a cell is the maximum over the square of 2^k cells that begins there.
    pub(crate) levels: Vec<Vec<u8>>,
}

impl ScoreField {
    /// Creates the field of points around a center \[m\].
    #[must_use]
    pub fn new(points: &[[f32; 2]], middle: [f32; 2], settings: &FieldSettings) -> Self {
        let resolution_m = settings.resolution_m.max(1e-3);
        let half = settings.most_half_m;
        let is_near =
            |p: &&[f32; 2]| (p[0] - middle[0]).abs() < half && (p[1] - middle[1]).abs() < half;
        let (mut low, mut high) = (middle, middle);
        for point in points.iter().filter(is_near) {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        let stamp = Stamp::new(settings.sigma_m / resolution_m);
        // Padding on the low side for squares that begin outside of the field.
        let before = (1 << settings.levels) + stamp.reach + 1;
        let after = stamp.reach + 2;
        let cells =
            |axis: usize| ((high[axis] - low[axis]) / resolution_m) as usize + before + after;
        let (width, height) = (cells(0), cells(1));
        let corner = [low[0] - before as f32 * resolution_m, low[1] - before as f32 * resolution_m];
        let mut finest = vec![0; width * height];
        for point in points.iter().filter(is_near) {
            let column = ((point[0] - corner[0]) / resolution_m) as usize;
            let row = ((point[1] - corner[1]) / resolution_m) as usize;
            stamp.press(&mut finest, width, column, row);
        }
        let mut levels = vec![finest];
        for level in 1..=settings.levels {
            levels.push(widened(&levels[level - 1], width, height, 1 << (level - 1)));
        }
        Self { resolution_m, corner, width, height, levels }
    }

    /// Likelihood at a position \[m\], 0 to 1.
    #[must_use]
    pub fn at(&self, x: f32, y: f32) -> f32 {
        let (u, v) =
            ((x - self.corner[0]) / self.resolution_m, (y - self.corner[1]) / self.resolution_m);
        if !(u >= 0.0 && v >= 0.0 && u < self.width as f32 && v < self.height as f32) {
            return 0.0;
        }
        f32::from(self.levels[0][v as usize * self.width + u as usize]) / 255.0
    }

    /// Size in memory \[bytes\].
    #[must_use]
    pub fn size(&self) -> usize {
        self.levels.len() * self.width * self.height
    }
}

/// Maximum of each value and the one `step` further, along both axes.
fn widened(from: &[u8], width: usize, height: usize, step: usize) -> Vec<u8> {
    let mut wide = from.to_vec();
    for row in wide.chunks_exact_mut(width) {
        for column in 0..width.saturating_sub(step) {
            row[column] = row[column].max(row[column + step]);
        }
    }
    for row in 0..height.saturating_sub(step) {
        let (low, high) = wide.split_at_mut((row + step) * width);
        let here = &mut low[row * width..(row + 1) * width];
        for (value, other) in here.iter_mut().zip(&high[..width]) {
            *value = (*value).max(*other);
        }
    }
    wide
}

/// Likelihood around a point.
struct Stamp {
    reach: usize,
    values: Vec<u8>,
}

impl Stamp {
    fn new(sigma_cells: f32) -> Self {
        let reach = ((2.2 * sigma_cells) as usize).clamp(1, 32);
        let side = 2 * reach + 1;
        let mut values = Vec::with_capacity(side * side);
        for row in 0..side {
            for column in 0..side {
                let (x, y) = (column as f32 - reach as f32, row as f32 - reach as f32);
                let squared = (x * x + y * y) / (sigma_cells * sigma_cells).max(1e-6);
                values.push((255.0 * libm::expf(-0.5 * squared)) as u8);
            }
        }
        Self { reach, values }
    }

    fn press(&self, cells: &mut [u8], width: usize, column: usize, row: usize) {
        let side = 2 * self.reach + 1;
        for (line, values) in self.values.chunks_exact(side).enumerate() {
            let start = (row + line - self.reach) * width + column - self.reach;
            let Some(target) = cells.get_mut(start..start + side) else { continue };
            for (cell, value) in target.iter_mut().zip(values) {
                *cell = (*cell).max(*value);
            }
        }
    }
}
