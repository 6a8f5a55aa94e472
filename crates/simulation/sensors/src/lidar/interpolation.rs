//! Interpolation of ranges between rays, as in Classic for a `<resolution>` other than 1.

use super::LidarBeams;

/// Interpolation weights: each range is between two columns and two rows.
#[derive(Clone, Debug)]
pub(super) struct RangeInterpolation {
    columns: Vec<RayPosition>,
    rows: Vec<RayPosition>,
    rays_across: usize,
}

/// A position between two rays: the first, the second, and the fraction towards it.
#[derive(Clone, Copy, Debug)]
struct RayPosition(usize, usize, f64);

impl RangeInterpolation {
    /// Returns `None` if every range is a ray.
    pub(super) fn new(beams: &LidarBeams) -> Option<Self> {
        (beams.rays != beams.ranges).then(|| Self {
            columns: ray_positions(beams.rays[0], beams.ranges[0]),
            rows: ray_positions(beams.rays[1], beams.ranges[1]),
            rays_across: beams.rays[0],
        })
    }

    /// Returns ranges by bilinear interpolation of the four surrounding rays.
    pub(super) fn linear(&self, of_ray: impl Fn(usize) -> f64) -> impl Iterator<Item = f32> {
        self.with_corners(move |corners, across, up| {
            let [a, b, c, d] = corners.map(&of_ray);
            (1.0 - up) * ((1.0 - across) * a + across * b) + up * ((1.0 - across) * c + across * d)
        })
    }

    /// Returns the mean of the four rays around each range.
    pub(super) fn mean(&self, of_ray: impl Fn(usize) -> f64) -> impl Iterator<Item = f32> {
        self.with_corners(move |corners, _, _| corners.map(&of_ray).iter().sum::<f64>() / 4.0)
    }

    fn with_corners(
        &self,
        value: impl Fn([usize; 4], f64, f64) -> f64,
    ) -> impl Iterator<Item = f32> {
        (0..self.rows.len() * self.columns.len()).map(move |index| {
            let RayPosition(left, right, across) = self.columns[index % self.columns.len()];
            let RayPosition(low, high, up) = self.rows[index / self.columns.len()];
            let ray = |row: usize, column: usize| row * self.rays_across + column;
            let corners = [ray(low, left), ray(low, right), ray(high, left), ray(high, right)];
            super::single(value(corners, across, up))
        })
    }
}

/// Range `i` of `ranges` is at ray `i (rays - 1) / (ranges - 1)`.
#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "fewer than 2^22, not negative"
)]
fn ray_positions(rays: usize, ranges: usize) -> Vec<RayPosition> {
    let position = |range: usize| {
        let at = if ranges > 1 {
            (range * (rays - 1)) as f64 / (ranges - 1) as f64
        } else {
            // A single range is the middle ray, like its angle.
            (rays - 1) as f64 / 2.0
        };
        let before = (at as usize).min(rays - 1);
        RayPosition(before, (before + 1).min(rays - 1), at - before as f64)
    };
    (0..ranges).map(position).collect()
}
