//! Terrain over a regular grid.

use std::fmt;

use periplus_geometry::DVec3;

/// Heights over a regular grid, two triangles per cell, in double precision. The grid is centred on
/// the origin of its frame, x along columns, y along rows. Each cell is split from its corner of low
/// x and low y to the opposite corner. Triangles are numbered cell by cell, row by row: `2 * cell`
/// has the corner of high x, `2 * cell + 1` the corner of high y.
#[derive(Clone, Debug)]
pub struct Heightfield {
    columns: usize,
    rows: usize,
    /// Distance between samples along x and y \[m\].
    step_m: [f64; 2],
    heights_m: Vec<f64>,
    low_m: f64,
    high_m: f64,
    /// Minimum and maximum height of each cell.
    ranges_m: Vec<[f64; 2]>,
}

/// Reasons that heights cannot form a height field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeightfieldError {
    /// Fewer than two columns or rows, more than 2^30 cells, or not columns times rows heights.
    Count,
    /// The size is not positive, or beyond 1e9 m.
    Size,
    /// This height is not finite, or beyond 1e9 m.
    Height {
        /// Index of the height.
        sample: usize,
    },
}

impl fmt::Display for HeightfieldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count => {
                write!(
                    f,
                    "a height field needs at least two columns and two rows, and columns x rows heights"
                )
            }
            Self::Size => write!(f, "the size of a height field must be between 0 and 1e9 m"),
            Self::Height { sample } => write!(f, "height {sample} is not finite or beyond 1e9 m"),
        }
    }
}

impl std::error::Error for HeightfieldError {}

impl Heightfield {
    /// Builds a height field from heights \[m\] row by row, from low y to high, over a rectangle of
    /// this size along x and y.
    ///
    /// # Errors
    /// When the counts do not match or a value is not finite.
    pub fn new(
        columns: usize,
        rows: usize,
        size_m: [f64; 2],
        heights_m: Vec<f64>,
    ) -> Result<Self, HeightfieldError> {
        if columns < 2
            || rows < 2
            || columns.checked_mul(rows).is_none_or(|n| n != heights_m.len() || n > 1 << 30)
        {
            return Err(HeightfieldError::Count);
        }
        if !size_m.iter().all(|&size| 1e-6 < size && size <= 1e9) {
            return Err(HeightfieldError::Size);
        }
        if let Some(sample) = heights_m.iter().position(|h| h.is_nan() || h.abs() > 1e9) {
            return Err(HeightfieldError::Height { sample });
        }
        let fold = |with: fn(f64, f64) -> f64, from| heights_m.iter().copied().fold(from, with);
        let (low_m, high_m) = (fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY));
        #[expect(clippy::cast_precision_loss, reason = "at most 2³⁰")]
        let step_m = [size_m[0] / (columns - 1) as f64, size_m[1] / (rows - 1) as f64];
        let mut field =
            Self { columns, rows, step_m, heights_m, low_m, high_m, ranges_m: Vec::new() };
        let mut ranges = Vec::with_capacity((columns - 1) * (rows - 1));
        for row in 0..rows - 1 {
            for column in 0..columns - 1 {
                let [a, b, c, d] = field.corners(column, row).map(|corner| corner.z);
                ranges.push([a.min(b).min(c.min(d)), a.max(b).max(c.max(d))]);
            }
        }
        field.ranges_m = ranges;
        Ok(field)
    }

    /// Returns the lower and upper corners of the bounding box \[m\].
    #[must_use]
    pub fn bounds_m(&self) -> (DVec3, DVec3) {
        let [x, y] = self.half();
        (DVec3::new(-x, -y, self.low_m), DVec3::new(x, y, self.high_m))
    }

    #[expect(clippy::cast_precision_loss, reason = "at most 2³⁰")]
    fn half(&self) -> [f64; 2] {
        [
            self.step_m[0] * (self.columns - 1) as f64 / 2.0,
            self.step_m[1] * (self.rows - 1) as f64 / 2.0,
        ]
    }

    #[expect(clippy::cast_precision_loss, reason = "at most 2³⁰")]
    fn corner(&self, column: usize, row: usize) -> DVec3 {
        let [x, y] = self.half();
        DVec3::new(
            column as f64 * self.step_m[0] - x,
            row as f64 * self.step_m[1] - y,
            self.heights_m[row * self.columns + column],
        )
    }

    /// Returns the corners: low x low y, high x low y, high x high y, low x high y.
    fn corners(&self, column: usize, row: usize) -> [DVec3; 4] {
        [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(right, up)| self.corner(column + right, row + up))
    }

    fn triangle(&self, column: usize, row: usize, upper: bool) -> [DVec3; 3] {
        let [a, b, c, d] = self.corners(column, row);
        if upper { [a, c, d] } else { [a, b, c] }
    }

    /// Returns the upward unit normal of a triangle.
    pub(crate) fn normal(&self, primitive: u32) -> DVec3 {
        let cell = primitive as usize / 2;
        let (column, row) = (cell % (self.columns - 1), cell / (self.columns - 1));
        let [a, b, c] = self.triangle(column, row, primitive % 2 == 1);
        (b - a).cross(c - a).normalize_or_zero()
    }

    /// Returns the distance and index of the nearest triangle in `min..=max`.
    ///
    /// The ray's projection onto the grid is traversed cell by cell (Amanatides and Woo 1987). Near
    /// the border of a cell, within rounding, the neighbour is tested as well, so that no hit is
    /// lost at seams.
    pub(crate) fn cast(&self, o: DVec3, d: DVec3, min: f64, max: f64) -> Option<(f64, u32)> {
        let (low, high) = self.bounds_m();
        let mut from = min;
        let mut to = max;
        for axis in 0..3 {
            let room = 1e-9 * (1.0 + o[axis].abs() + high[axis].abs().max(low[axis].abs()));
            let (low, high) = (low[axis] - room, high[axis] + room);
            if d[axis] == 0.0 {
                if o[axis] < low || o[axis] > high {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low - o[axis]) / d[axis], (high - o[axis]) / d[axis]);
            from = from.max(a.min(b));
            to = to.min(a.max(b));
        }
        if from > to {
            return None;
        }
        let ray = ShearedRay::new(o, d);
        let mut best: Option<(f64, u32)> = None;
        let last = [self.columns - 2, self.rows - 2];
        let half = self.half();
        let index = |axis: usize, t: f64| (o[axis] + t * d[axis] + half[axis]) / self.step_m[axis];
        let rounding =
            |axis: usize| 1e-11 * (1.0 + (o[axis].abs() + half[axis]) / self.step_m[axis]);
        let slack = [rounding(0), rounding(1)];
        // Traverse the grid column by column (or row by row) along the dominant axis of the
        // projection.
        let main = if (d.x / self.step_m[0]).abs() >= (d.y / self.step_m[1]).abs() { 0 } else { 1 };
        let side = 1 - main;
        let (start, end) = (index(main, from), index(main, to));
        let (first, after) = (
            cell_of(start.min(end) - slack[main], last[main]),
            cell_of(start.max(end) + slack[main], last[main]),
        );
        let forward = end >= start;
        for step in 0..=after - first {
            let line = if forward { first + step } else { after - step };
            // Interval of the ray over this line of cells, with a margin on both sides.
            let (near, far) = if d[main] == 0.0 {
                (from, to)
            } else {
                #[expect(clippy::cast_precision_loss, reason = "at most 2³⁰")]
                let line = line as f64;
                let border = |index: f64| {
                    ((index * self.step_m[main] - half[main] - o[main]) / d[main]).clamp(from, to)
                };
                let (a, b) = (border(line - slack[main]), border(line + 1.0 + slack[main]));
                (a.min(b), a.max(b))
            };
            // No nearer hit is possible beyond the hit.
            if best.is_some_and(|(t, _)| t < near) {
                break;
            }
            let (a, b) = (index(side, near), index(side, far));
            let (one, other) = (
                cell_of(a.min(b) - slack[side], last[side]),
                cell_of(a.max(b) + slack[side], last[side]),
            );
            let (z1, z2) = (o.z + near * d.z, o.z + far * d.z);
            let room = 1e-9 * (1.0 + o.z.abs() + z1.abs().max(z2.abs()));
            let (z_low, z_high) = (z1.min(z2) - room, z1.max(z2) + room);
            for across in one..=other {
                let (column, row) = if main == 0 { (line, across) } else { (across, line) };
                let cell = row * (self.columns - 1) + column;
                let [min_lane, most] = self.ranges_m[cell];
                if min_lane > z_high || most < z_low {
                    continue;
                }
                for upper in [false, true] {
                    let corners = self.triangle(column, row, upper);
                    let Some(t) = ray.distance(corners) else { continue };
                    #[expect(clippy::cast_possible_truncation, reason = "at most 2³¹ triangles")]
                    let number = (2 * cell + usize::from(upper)) as u32;
                    let better = best.is_none_or(|(t0, n)| t < t0 || t == t0 && number < n);
                    if min <= t && t <= max && better {
                        best = Some((t, number));
                    }
                }
            }
        }
        best
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
fn cell_of(index: f64, last: usize) -> usize {
    if index > 0.0 { (index as usize).min(last) } else { 0 }
}

/// Ray-triangle test of `triangle::intersect`, in double precision.
struct ShearedRay {
    origin: DVec3,
    axes: [usize; 3],
    shear: [f64; 3],
}

impl ShearedRay {
    fn new(origin: DVec3, d: DVec3) -> Self {
        let [x, y, z] = d.abs().to_array();
        let along = if x > y && x > z {
            0
        } else if y > z {
            1
        } else {
            2
        };
        let axes = [[1, 2, 0], [2, 0, 1], [0, 1, 2]][along];
        let shear = [d[axes[0]] / d[along], d[axes[1]] / d[along], 1.0 / d[along]];
        Self { origin, axes, shear }
    }

    fn distance(&self, corners: [DVec3; 3]) -> Option<f64> {
        let [a, b, c] = corners.map(|corner| {
            let [x, y, z] = self.axes.map(|axis| corner[axis] - self.origin[axis]);
            (x - self.shear[0] * z, y - self.shear[1] * z, z)
        });
        let area = |p: (f64, f64, f64), q: (f64, f64, f64)| p.0 * q.1 - p.1 * q.0;
        let (u, v, w) = (area(c, b), area(a, c), area(b, a));
        let same = u >= 0.0 && v >= 0.0 && w >= 0.0 || u <= 0.0 && v <= 0.0 && w <= 0.0;
        let whole = u + v + w;
        (same && whole != 0.0).then(|| (u * a.2 + v * b.2 + w * c.2) * self.shear[2] / whole)
    }
}
