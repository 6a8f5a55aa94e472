//! Up to eight rays side by side.

use super::query::NearestHit;
use crate::ray::Ray;
use crate::simd8::DVec3x8;

/// Up to eight rays; unused lanes repeat the first.
pub(super) struct Lanes {
    pub(super) origins_m: DVec3x8,
    pub(super) directions: DVec3x8,
    /// Non-negative.
    pub(super) min: [f64; 8],
    pub(super) max: [f64; 8],
}

impl Lanes {
    /// `rays` is not empty.
    #[inline(always)]
    pub(super) fn new(rays: &[&Ray]) -> Self {
        let first = rays[0];
        let mut lanes = Self {
            origins_m: DVec3x8::splat(first.origin_m),
            directions: DVec3x8::splat(first.direction),
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

    /// Returns results without a hit.
    #[inline(always)]
    pub(super) fn nothing(&self) -> [NearestHit; 8] {
        let mut found = [NearestHit::nothing(self.max[0]); 8];
        for (found, &max) in found.iter_mut().zip(&self.max) {
            found.distance = max;
        }
        found
    }
}
