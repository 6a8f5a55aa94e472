//! Up to eight rays side by side.

use super::query::Found;
use crate::eight::Eight;
use crate::ray::Ray;

/// Up to eight rays; lanes beyond are copies of the first.
pub(super) struct Lanes {
    pub(super) origins_m: Eight,
    pub(super) directions: Eight,
    /// Not below 0.
    pub(super) min: [f64; 8],
    pub(super) max: [f64; 8],
}

impl Lanes {
    /// There is one ray at least.
    #[inline(always)]
    pub(super) fn new(rays: &[&Ray]) -> Self {
        let first = rays[0];
        let mut lanes = Self {
            origins_m: Eight::splat(first.origin_m),
            directions: Eight::splat(first.direction),
            min: [first.min_m.max(0.0); 8],
            max: [first.max_m; 8],
        };
        for (lane, ray) in rays.iter().enumerate().take(8).skip(1) {
            lanes.origins_m.set(lane, ray.origin_m);
            lanes.directions.set(lane, ray.direction);
            lanes.min[lane] = ray.min_m.max(0.0);
            lanes.max[lane] = ray.max_m;
        }
        lanes
    }

    /// Nothing is known of any yet.
    #[inline(always)]
    pub(super) fn nothing(&self) -> [Found; 8] {
        let mut found = [Found::nothing(self.max[0]); 8];
        for (found, &max) in found.iter_mut().zip(&self.max) {
            found.distance = max;
        }
        found
    }
}
