//! Rays in the frame of a tree, prepared for traversal in single precision.

use periplus_geometry::DVec3;

use crate::bvh::Node;
use crate::simd::{V8, splat3};
use crate::traversal::NodeTest;

/// Relative rounding error of one f32 operation.
pub(crate) const ROUNDING_RATIO: f32 = 1.2e-7;
/// Minimum absolute value of a direction component: keeps its inverse finite.
pub(crate) const MIN_DIRECTION_RATIO: f32 = 1e-18;

/// A ray in the frame of a tree.
///
/// Boxes are tested with margins that cover every rounding of the box test and of the triangle test
/// (Ize 2013, "Robust BVH ray traversal", extended to fused arithmetic). No box is skipped that
/// holds a triangle which the triangle test would accept, in any order of traversal: single rays and
/// packets, vector and scalar code find identical hits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalRay {
    pub(crate) origin: [f32; 3],
    pub(crate) direction: [f32; 3],
    /// The two minor axes and the dominant axis of the direction.
    pub(crate) axes: [usize; 3],
    /// Shear that turns the ray into the axis `axes[2]`.
    pub(crate) shear: [f32; 3],
    pub(crate) min: f32,
}

impl LocalRay {
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "single precision is the point")]
    pub(crate) fn new(origin: DVec3, direction: DVec3, min: f64) -> Self {
        let origin = [origin.x as f32, origin.y as f32, origin.z as f32];
        let direction = [direction.x as f32, direction.y as f32, direction.z as f32];
        let [x, y, z] = direction;
        let (x, y, z) = (x.abs(), y.abs(), z.abs());
        let along = if x > y {
            if x > z { 0 } else { 2 }
        } else if y > z {
            1
        } else {
            2
        };
        let axes = [[1, 2, 0], [2, 0, 1], [0, 1, 2]][along];
        let length = direction[along];
        let shear = [direction[axes[0]] / length, direction[axes[1]] / length, 1.0 / length];
        Self { origin, direction, axes, shear, min: min.max(0.0) as f32 }
    }
}

/// Returns the absolute error of distances to the triangles of a tree, besides their relative
/// rounding. `extent` is the largest extent of a triangle.
#[inline(always)]
pub(crate) fn distance_margin(extent: f32, shear: f32) -> f32 {
    32.0 * ROUNDING_RATIO * extent * shear.abs()
}

/// Returns the distance up to which boxes must be visited when a hit at `best` is known.
#[inline(always)]
pub(crate) fn reach(best: f32, margin: f32) -> f32 {
    best * (1.0 + 32.0 * ROUNDING_RATIO) + margin
}

/// Precomputed terms of the slab test of a ray, one number each.
pub(crate) struct BoxTerms {
    near_rows: [usize; 3],
    far_rows: [usize; 3],
    near: [f32; 3],
    near_offset: [f32; 3],
    far: [f32; 3],
    far_offset: [f32; 3],
    min: f32,
}

impl BoxTerms {
    #[inline(always)]
    pub(crate) fn new(ray: &LocalRay, margin: f32) -> Self {
        let mut near_rows = [0; 3];
        let mut far_rows = [0; 3];
        let mut near = [0.0; 3];
        let mut near_offset = [0.0; 3];
        let mut far = [0.0; 3];
        let mut far_offset = [0.0; 3];
        for axis in 0..3 {
            let d = ray.direction[axis];
            let d = if d.abs() < MIN_DIRECTION_RATIO { MIN_DIRECTION_RATIO.copysign(d) } else { d };
            let back = d < 0.0;
            near_rows[axis] = axis + 3 * usize::from(back);
            far_rows[axis] = axis + 3 * usize::from(!back);
            let inverse = 1.0 / d;
            near[axis] = inverse * (1.0 - 4.0 * ROUNDING_RATIO);
            far[axis] = inverse * (1.0 + 4.0 * ROUNDING_RATIO);
            let (start, end) = (ray.origin[axis] * near[axis], ray.origin[axis] * far[axis]);
            near_offset[axis] = -start - start.abs() * (4.0 * ROUNDING_RATIO);
            far_offset[axis] = -end + end.abs() * (4.0 * ROUNDING_RATIO);
        }
        let min = ray.min * (1.0 - 32.0 * ROUNDING_RATIO) - margin;
        let min = if min > 0.0 { min } else { 0.0 };
        Self { near_rows, far_rows, near, near_offset, far, far_offset, min }
    }

    /// Returns the octant of the direction: bit `axis` is set if the ray runs backwards along it.
    #[inline(always)]
    pub(crate) fn octant(&self) -> usize {
        let [x, y, z] = self.near_rows;
        usize::from(x == 3) | usize::from(y == 4) << 1 | usize::from(z == 5) << 2
    }

    #[inline(always)]
    fn near<V: V8>(&self, node: &Node, axis: usize) -> V {
        let row = V::load(&node.0[self.near_rows[axis] & 7]);
        row.mul_add_about(V::splat(self.near[axis]), V::splat(self.near_offset[axis]))
    }

    #[inline(always)]
    fn far<V: V8>(&self, node: &Node, axis: usize) -> V {
        let row = V::load(&node.0[self.far_rows[axis] & 7]);
        row.mul_add_about(V::splat(self.far[axis]), V::splat(self.far_offset[axis]))
    }

    /// Returns a mask of the children that may be hit within `reach`, and their entry distances.
    #[inline(always)]
    pub(crate) fn children<V: V8>(&self, node: &Node, reach: f32) -> (V, V) {
        let enter = self.near::<V>(node, 0).max(self.near(node, 1));
        let enter = enter.max(self.near::<V>(node, 2).max(V::splat(self.min)));
        let leave = self.far::<V>(node, 0).min(self.far(node, 1));
        let leave = leave.min(self.far::<V>(node, 2).min(V::splat(reach)));
        (enter.le(leave), enter)
    }
}

/// [`BoxTerms`] in registers.
pub(crate) struct BoxTest<V> {
    near_rows: [usize; 3],
    far_rows: [usize; 3],
    near: [V; 3],
    near_offset: [V; 3],
    far: [V; 3],
    far_offset: [V; 3],
    min: V,
}

impl<V: V8> BoxTest<V> {
    #[inline(always)]
    pub(crate) fn new(ray: &LocalRay, margin: f32) -> Self {
        let terms = BoxTerms::new(ray, margin);
        Self {
            near_rows: terms.near_rows,
            far_rows: terms.far_rows,
            near: splat3(terms.near),
            near_offset: splat3(terms.near_offset),
            far: splat3(terms.far),
            far_offset: splat3(terms.far_offset),
            min: V::splat(terms.min),
        }
    }

    /// Returns the same test for all rays of this direction that start within `off` of its origin,
    /// on either side.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "with room for rounding")]
    pub(crate) fn around(mut self, off: DVec3) -> Self {
        let off = off.to_array();
        for axis in 0..3 {
            let off = V::splat(off[axis] as f32 * (1.0 + 16.0 * ROUNDING_RATIO));
            let zero = V::splat(0.0);
            let near = self.near[axis].max(zero.sub(self.near[axis]));
            let far = self.far[axis].max(zero.sub(self.far[axis]));
            self.near_offset[axis] = self.near_offset[axis].sub(off.mul(near));
            self.far_offset[axis] = self.far_offset[axis].add(off.mul(far));
        }
        self
    }

    #[inline(always)]
    fn near(&self, node: &Node, axis: usize) -> V {
        let row = V::load(&node.0[self.near_rows[axis] & 7]);
        row.mul_add_about(self.near[axis], self.near_offset[axis])
    }

    #[inline(always)]
    fn far(&self, node: &Node, axis: usize) -> V {
        let row = V::load(&node.0[self.far_rows[axis] & 7]);
        row.mul_add_about(self.far[axis], self.far_offset[axis])
    }
}

impl<V: V8> NodeTest<V> for BoxTest<V> {
    #[inline(always)]
    fn children(&self, node: &Node, reach: V) -> (u32, V) {
        let enter = self.near(node, 0).max(self.near(node, 1));
        let enter = enter.max(self.near(node, 2).max(self.min));
        let leave = self.far(node, 0).min(self.far(node, 1)).min(self.far(node, 2).min(reach));
        (enter.le(leave).bits(), enter)
    }
}
