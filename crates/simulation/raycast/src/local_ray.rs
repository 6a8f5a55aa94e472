//! Rays in the frame of a tree, prepared for traversal in single precision.

use periplus_geometry::DVec3;

use crate::bvh::Node;
use crate::simd::{Row, V8, splat3};
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

/// Rows of a node with the lower corners along the axes.
const ROWS: [u8; 3] = [0, 1, 2];

#[inline(always)]
fn wide([a, b, c]: [u8; 3]) -> [usize; 3] {
    [a.into(), b.into(), c.into()]
}

/// Precomputed terms of the slab test of a ray, one number each.
#[derive(Clone, Copy)]
pub(crate) struct BoxTerms {
    near_rows: [u8; 3],
    far_rows: [u8; 3],
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
            near_rows[axis] = ROWS[axis] + 3 * u8::from(back);
            far_rows[axis] = ROWS[axis] + 3 * u8::from(!back);
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

    #[inline(always)]
    fn near<V: V8>(&self, node: &Node, axis: usize) -> V {
        let row = V::load(&node.0[usize::from(self.near_rows[axis] & 7)]);
        row.mul_add_about(V::splat(self.near[axis]), V::splat(self.near_offset[axis]))
    }

    #[inline(always)]
    fn far<V: V8>(&self, node: &Node, axis: usize) -> V {
        let row = V::load(&node.0[usize::from(self.far_rows[axis] & 7)]);
        row.mul_add_about(V::splat(self.far[axis]), V::splat(self.far_offset[axis]))
    }

    /// Returns a mask of the children that may be hit within `reach`, and their entry distances. With
    /// `FLAT` the boxes are endless along z.
    #[inline(always)]
    pub(crate) fn children<V: V8, const FLAT: bool>(&self, node: &Node, reach: f32) -> (V, V) {
        let mut enter = self.near::<V>(node, 0).max(self.near(node, 1)).max(V::splat(self.min));
        let mut leave = self.far::<V>(node, 0).min(self.far(node, 1)).min(V::splat(reach));
        if !FLAT {
            enter = enter.max(self.near(node, 2));
            leave = leave.min(self.far(node, 2));
        }
        (enter.le(leave), enter)
    }
}

/// Up to eight rays in the frame of a tree with what the tests of boxes and triangles need, prepared
/// in vectors. Every number of the triangle test is that of [`LocalRay::new`], bit for bit.
pub(crate) struct RayBlock {
    /// Origins and shears along the two minor axes and the dominant axis of each ray.
    origin: [Row; 3],
    shear: [Row; 3],
    min: Row,
    pub(crate) max: Row,
    margin: Row,
    box_min: Row,
    near: [Row; 3],
    near_offset: [Row; 3],
    far: [Row; 3],
    far_offset: [Row; 3],
    /// Rays that run forward along an axis, as bits.
    forward: [u32; 3],
    /// Comparisons of the directions' components, as bits: x <= y, x <= z, y <= z.
    order: [u32; 3],
}

/// A ray of a [`RayBlock`].
#[derive(Clone, Copy)]
pub(crate) struct PreparedRay {
    pub(crate) terms: BoxTerms,
    /// Octant of the direction: bit `axis` is set if the ray runs backwards along it.
    pub(crate) octant: u8,
    axes: [u8; 3],
    pub(crate) origin: [f32; 3],
    pub(crate) shear: [f32; 3],
    pub(crate) min: f32,
    pub(crate) margin: f32,
}

impl RayBlock {
    pub(crate) const EMPTY: Self = {
        let row = Row([0.0; 8]);
        let three = [row; 3];
        Self {
            origin: three,
            shear: three,
            min: row,
            max: row,
            margin: row,
            box_min: row,
            near: three,
            near_offset: three,
            far: three,
            far_offset: three,
            forward: [0; 3],
            order: [0; 3],
        }
    };

    /// Prepares eight rays for a tree at `middle` whose triangles have this extent. `min` and `max` are
    /// distances, not negative.
    #[inline(always)]
    pub(crate) fn prepare<V: V8>(
        &mut self,
        origins: [&DVec3; 8],
        directions: [&DVec3; 8],
        (min, max): (Row, Row),
        middle: DVec3,
        extent: f32,
    ) {
        let origin = V::transpose(origins, middle);
        let direction = V::transpose(directions, DVec3::ZERO);
        let zero = V::splat(0.0);
        let [x, y, z] = direction;
        let (x, y, z) = (x.max(zero.sub(x)), y.max(zero.sub(y)), z.max(zero.sub(z)));
        let order = [x.le(y), x.le(z), y.le(z)];
        self.order = [order[0].bits(), order[1].bits(), order[2].bits()];
        let one = V::splat(1.0);
        let length = dominant(direction, order, 0);
        let shear = [
            dominant(direction, order, 1).div(length),
            dominant(direction, order, 2).div(length),
            one.div(length),
        ];
        let (narrow, wide) =
            (V::splat(1.0 - 4.0 * ROUNDING_RATIO), V::splat(1.0 + 4.0 * ROUNDING_RATIO));
        let least = V::splat(MIN_DIRECTION_RATIO);
        let step = V::splat(4.0 * ROUNDING_RATIO);
        for axis in 0..3 {
            self.shear[axis] = shear[axis].store();
            self.origin[axis] = dominant(origin, order, (axis + 1) % 3).store();
            let d = direction[axis];
            let forward = zero.le(d);
            self.forward[axis] = forward.bits();
            let d = d.max(least).select(d.min(zero.sub(least)), forward);
            let inverse = one.div(d);
            let (near, far) = (inverse.mul(narrow), inverse.mul(wide));
            let (start, end) = (origin[axis].mul(near), origin[axis].mul(far));
            let (back, ahead) = (zero.sub(start), zero.sub(end));
            self.near[axis] = near.store();
            self.far[axis] = far.store();
            self.near_offset[axis] = back.sub(start.max(back).mul(step)).store();
            self.far_offset[axis] = ahead.add(end.max(ahead).mul(step)).store();
        }
        let steep = shear[2].max(zero.sub(shear[2]));
        let margin = V::splat(32.0 * ROUNDING_RATIO * extent).mul(steep);
        let least = V::load(&min).mul(V::splat(1.0 - 32.0 * ROUNDING_RATIO)).sub(margin);
        self.box_min = least.max(zero).store();
        self.margin = margin.store();
        (self.min, self.max) = (min, max);
    }

    #[inline(always)]
    pub(crate) fn ray(&self, lane: usize) -> PreparedRay {
        let lane = lane & 7;
        let [x_y, x_z, y_z] = self.order;
        let (x, y, z) =
            (bit(!self.forward[0], lane), bit(!self.forward[1], lane), bit(!self.forward[2], lane));
        PreparedRay {
            terms: BoxTerms {
                near_rows: [3 * x, 1 + 3 * y, 2 + 3 * z],
                far_rows: [3 - 3 * x, 4 - 3 * y, 5 - 3 * z],
                near: three(&self.near, lane),
                near_offset: three(&self.near_offset, lane),
                far: three(&self.far, lane),
                far_offset: three(&self.far_offset, lane),
                min: self.box_min.0[lane],
            },
            octant: x | y << 1 | z << 2,
            axes: AXIS_INDEX
                [usize::from(bit(x_y, lane) | bit(x_z, lane) << 1 | bit(y_z, lane) << 2)],
            origin: three(&self.origin, lane),
            shear: three(&self.shear, lane),
            min: self.min.0[lane],
            margin: self.margin.0[lane],
        }
    }
}

#[inline(always)]
fn bit(mask: u32, lane: usize) -> u8 {
    u8::from(mask >> lane & 1 != 0)
}

#[inline(always)]
fn three(rows: &[Row; 3], lane: usize) -> [f32; 3] {
    [rows[0].0[lane], rows[1].0[lane], rows[2].0[lane]]
}

impl PreparedRay {
    /// Returns the two minor axes and the dominant axis of the direction.
    #[inline(always)]
    pub(crate) fn axes(&self) -> [usize; 3] {
        wide(self.axes)
    }
}

/// Minor axes and dominant axis for each outcome of [`RayBlock::order`].
const AXIS_INDEX: [[u8; 3]; 8] = {
    let (x, y, z) = ([1, 2, 0], [2, 0, 1], [0, 1, 2]);
    [x, y, z, y, x, z, z, z]
};

/// Returns the component along the dominant axis of each direction (0), or along the first or second
/// minor axis (1, 2).
#[inline(always)]
fn dominant<V: V8>([x, y, z]: [V; 3], [x_y, x_z, y_z]: [V; 3], which: usize) -> V {
    let [x, y, z] = match which {
        0 => [x, y, z],
        1 => [y, z, x],
        _ => [z, x, y],
    };
    z.select(y, y_z).select(z.select(x, x_z), x_y)
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
            near_rows: wide(terms.near_rows),
            far_rows: wide(terms.far_rows),
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
