//! Ranges between rays, as Classic makes them for a `<resolution>` other than 1.

use super::Beams;

/// How ranges come from rays: each lies between two columns and two rows.
#[derive(Clone, Debug)]
pub(super) struct Blend {
    columns: Vec<Between>,
    rows: Vec<Between>,
    rays_across: usize,
}

/// Between two rays: the first, the second, and how far towards it.
#[derive(Clone, Copy, Debug)]
struct Between(usize, usize, f64);

impl Blend {
    /// None where every range is a ray.
    pub(super) fn new(beams: &Beams) -> Option<Self> {
        (beams.rays != beams.ranges).then(|| Self {
            columns: places(beams.rays[0], beams.ranges[0]),
            rows: places(beams.rays[1], beams.ranges[1]),
            rays_across: beams.rays[0],
        })
    }

    /// Values of ranges, in proportion to how near the four rays around each are.
    pub(super) fn linear(&self, of_ray: impl Fn(usize) -> f64) -> impl Iterator<Item = f32> {
        self.with_corners(move |corners, across, up| {
            let [a, b, c, d] = corners.map(&of_ray);
            (1.0 - up) * ((1.0 - across) * a + across * b) + up * ((1.0 - across) * c + across * d)
        })
    }

    /// Plain means of the four rays around each range.
    pub(super) fn mean(&self, of_ray: impl Fn(usize) -> f64) -> impl Iterator<Item = f32> {
        self.with_corners(move |corners, _, _| corners.map(&of_ray).iter().sum::<f64>() / 4.0)
    }

    fn with_corners(
        &self,
        value: impl Fn([usize; 4], f64, f64) -> f64,
    ) -> impl Iterator<Item = f32> {
        (0..self.rows.len() * self.columns.len()).map(move |index| {
            let Between(left, right, across) = self.columns[index % self.columns.len()];
            let Between(low, high, up) = self.rows[index / self.columns.len()];
            let ray = |row: usize, column: usize| row * self.rays_across + column;
            let corners = [ray(low, left), ray(low, right), ray(high, left), ray(high, right)];
            super::single(value(corners, across, up))
        })
    }
}

/// Range `i` of `ranges` lies at ray `i (rays - 1) / (ranges - 1)`.
#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "fewer than 2^22, not negative"
)]
fn places(rays: usize, ranges: usize) -> Vec<Between> {
    let place = |range: usize| {
        let at = if ranges > 1 {
            (range * (rays - 1)) as f64 / (ranges - 1) as f64
        } else {
            // A single range is the middle ray, as its angle says.
            (rays - 1) as f64 / 2.0
        };
        let before = (at as usize).min(rays - 1);
        Between(before, (before + 1).min(rays - 1), at - before as f64)
    };
    (0..ranges).map(place).collect()
}
