//! Packets of rays with a common origin.

use periplus_geometry::DVec3;

use crate::bvh::Node;
use crate::local_ray::{MIN_DIRECTION_RATIO, ROUNDING_RATIO, reach};
use crate::simd::{Row, V8, splat3};
use crate::traversal::NodeTest;

/// Maximum number of packets that traverse a tree together.
pub(crate) const MAX_GROUP_COUNT: usize = 8;

/// All half lines from one point with a common dominant axis and slopes within intervals.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pyramid {
    pub(crate) origin: [f32; 3],
    /// As in `LocalRay::axes`.
    pub(crate) axes: [usize; 3],
    forward: bool,
    /// Minimum and maximum shear along both minor axes.
    pub(crate) low: [f32; 2],
    pub(crate) high: [f32; 2],
    /// Minimum depth of a hit along the dominant axis.
    min: f32,
}

impl Pyramid {
    /// Returns the pyramid around both, if they have the same apex and axis.
    #[inline(always)]
    pub(crate) fn with(&self, other: &Self) -> Option<Self> {
        let fits = self.origin == other.origin
            && self.axes[2] == other.axes[2]
            && self.forward == other.forward;
        fits.then(|| Self {
            low: [min_lane(self.low[0], other.low[0]), min_lane(self.low[1], other.low[1])],
            high: [
                -min_lane(-self.high[0], -other.high[0]),
                -min_lane(-self.high[1], -other.high[1]),
            ],
            min: min_lane(self.min, other.min),
            ..*self
        })
    }

    /// Returns the octant of the direction in the middle: bit `axis` is set if it runs backwards.
    #[inline(always)]
    pub(crate) fn octant(&self) -> usize {
        let [first, second, along] = self.axes;
        let back = |which: usize| (self.low[which] + self.high[which] < 0.0) == self.forward;
        usize::from(!self.forward) << along
            | usize::from(back(0)) << first
            | usize::from(back(1)) << second
    }

    /// Returns the spread of the slopes, the larger of both axes.
    #[inline(always)]
    pub(crate) fn spread(&self) -> f32 {
        -min_lane(self.low[0] - self.high[0], self.low[1] - self.high[1])
    }
}

#[inline(always)]
fn min_lane(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// Eight rays with a common origin, dominant axis and sign. Nodes are tested against the pyramid
/// around all of them, triangles against each ray.
pub(crate) struct Packet {
    pub(crate) pyramid: Pyramid,
    pub(crate) shear: [Row; 3],
    /// Depth along the dominant axis per distance.
    pub(crate) steep: Row,
    pub(crate) min: Row,
}

impl Packet {
    /// Builds a packet from the directions of eight rays if they fit together, each with the values
    /// of `LocalRay::new`.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "single precision is the point")]
    pub(crate) fn new<V: V8>(origin: DVec3, directions: [&DVec3; 8], min: Row) -> Option<Self> {
        let rows = V::transpose(directions, DVec3::ZERO);
        let (x, y, z) = (size(rows[0]), size(rows[1]), size(rows[2]));
        let (x_least, x_less, y_less) = (x.le(y).bits(), x.le(z).bits(), y.le(z).bits());
        // The same choice of axes in every lane.
        let along = match (x_least, x_less, y_less) {
            (0, 0, _) => 0,
            (ALL_LANES_MASK, _, 0) => 1,
            (0, ALL_LANES_MASK, _) | (ALL_LANES_MASK, _, ALL_LANES_MASK) => 2,
            _ if (!x_least & x_less | x_least & y_less) & ALL_LANES_MASK == ALL_LANES_MASK => 2,
            _ => return None,
        };
        let axes = [[1, 2, 0], [2, 0, 1], [0, 1, 2]][along];
        let [first, second, length] = match along {
            0 => [rows[1], rows[2], rows[0]],
            1 => [rows[2], rows[0], rows[1]],
            _ => rows,
        };
        let zero = V::splat(0.0);
        let forward = match zero.le(length).bits() {
            ALL_LANES_MASK => true,
            0 => false,
            _ => return None,
        };
        let (first, second) = (first.div(length), second.div(length));
        let steep = size(length);
        let pyramid = Pyramid {
            origin: [origin.x as f32, origin.y as f32, origin.z as f32],
            axes,
            forward,
            low: [first.min_lane(), second.min_lane()],
            high: [-zero.sub(first).min_lane(), -zero.sub(second).min_lane()],
            min: V::load(&min).mul(steep).min_lane(),
        };
        let shear = [first.store(), second.store(), V::splat(1.0).div(length).store()];
        Some(Self { pyramid, shear, steep: steep.store(), min })
    }

    /// Returns the depth up to which boxes must be visited when hits at these distances are known.
    #[inline(always)]
    pub(crate) fn reach<V: V8>(&self, best: V, margin: f32) -> f32 {
        let depth = best.mul(V::load(&self.steep));
        reach(-V::splat(0.0).sub(depth).min_lane(), margin)
    }
}

/// Bits of a mask with every lane set.
const ALL_LANES_MASK: u32 = 0xff;

#[inline(always)]
fn size<V: V8>(row: V) -> V {
    row.max(V::splat(0.0).sub(row))
}

/// One bound on the depth: a row of a node times a factor plus an offset.
#[derive(Clone, Copy)]
struct Bound<V> {
    row: usize,
    factor: V,
    offset: V,
}

impl<V: V8> Bound<V> {
    /// Depth at which the slope `1 / inverse` from `origin` reaches the coordinate in a row, rounded
    /// towards the origin (`-1.0`) or away (`1.0`).
    #[inline(always)]
    fn new(row: usize, inverse: f32, origin: f32, away: f32) -> Self {
        let factor = inverse * (1.0 + away * (4.0 * ROUNDING_RATIO));
        let start = origin * factor;
        let offset = -start + away * start.abs() * (4.0 * ROUNDING_RATIO);
        Self { row, factor: V::splat(factor), offset: V::splat(offset) }
    }

    #[inline(always)]
    fn at(&self, node: &Node) -> V {
        V::load(&node.0[self.row & 7]).mul_add_about(self.factor, self.offset)
    }
}

/// A pyramid as bounds on the depth along its dominant axis: the slab test with intervals of slopes
/// instead of slopes.
pub(crate) struct Frustum<V> {
    enter: Bound<V>,
    leave: Bound<V>,
    /// For both minor axes the depths at which the pyramid can have entered the box ...
    from: [[Bound<V>; 2]; 2],
    /// ... and at which it has left.
    to: [Bound<V>; 2],
    min: V,
}

impl<V: V8> Frustum<V> {
    /// `margin` applies to depths.
    #[inline(always)]
    pub(crate) fn new(pyramid: &Pyramid, margin: f32) -> Self {
        let [first, second, along] = pyramid.axes;
        let back = !pyramid.forward;
        let sign = if back { -1.0 } else { 1.0 };
        let origin = pyramid.origin[along];
        let (from_first, to_first) = Self::side(pyramid, 0, first);
        let (from_second, to_second) = Self::side(pyramid, 1, second);
        let min = pyramid.min * (1.0 - 32.0 * ROUNDING_RATIO) - margin;
        Self {
            enter: Bound::new(row_of(along, back), sign, origin, -1.0),
            leave: Bound::new(row_of(along, !back), sign, origin, 1.0),
            from: [from_first, from_second],
            to: [to_first, to_second],
            min: V::splat(if min > 0.0 { min } else { 0.0 }),
        }
    }

    /// Returns the bounds of one minor axis.
    #[inline(always)]
    fn side(pyramid: &Pyramid, which: usize, axis: usize) -> ([Bound<V>; 2], Bound<V>) {
        let (low, high) = (pyramid.low[which], pyramid.high[which]);
        let (low, high) = if pyramid.forward { (low, high) } else { (-high, -low) };
        let start = pyramid.origin[axis];
        // Slopes are rounded themselves.
        let (low, high) = (low - low.abs() * ROUNDING_RATIO, high + high.abs() * ROUNDING_RATIO);
        let (lower, upper) = (row_of(axis, false), row_of(axis, true));
        if low > MIN_DIRECTION_RATIO {
            let from = Bound::new(lower, 1.0 / high, start, -1.0);
            ([from, from], Bound::new(upper, 1.0 / low, start, 1.0))
        } else if high < -MIN_DIRECTION_RATIO {
            let from = Bound::new(upper, 1.0 / low, start, -1.0);
            ([from, from], Bound::new(lower, 1.0 / high, start, 1.0))
        } else {
            let (low, high) = (low.min(-MIN_DIRECTION_RATIO), high.max(MIN_DIRECTION_RATIO));
            let never =
                Bound { row: lower, factor: V::splat(0.0), offset: V::splat(f32::INFINITY) };
            let right = Bound::new(lower, 1.0 / high, start, -1.0);
            let left = Bound::new(upper, 1.0 / low, start, -1.0);
            ([right, left], never)
        }
    }

    #[inline(always)]
    fn from(&self, side: usize, node: &Node) -> V {
        self.from[side][0].at(node).max(self.from[side][1].at(node))
    }
}

/// Slopes under which the children of a node are seen from the apex of a pyramid, as `Packet::shear`
/// has them.
pub(crate) struct SlopeTest<V> {
    /// Rows with the near and the far ends of boxes along the minor axes and the dominant axis.
    near_rows: [usize; 3],
    far_rows: [usize; 3],
    /// Origin along these axes, times the sign.
    origin: [V; 3],
    /// -1 if the pyramid opens backwards along its dominant axis, else 1.
    sign: V,
}

/// Minimum and maximum slopes of eight boxes along both minor axes.
pub(crate) struct Slopes {
    pub(crate) low: [Row; 2],
    pub(crate) high: [Row; 2],
}

impl<V: V8> SlopeTest<V> {
    /// Minimum depth in a division: boxes that begin behind the apex reach any slope.
    const MIN_DEPTH_M: f32 = 1e-30;

    #[inline(always)]
    pub(crate) fn new(pyramid: &Pyramid) -> Self {
        let [x, y, z] = pyramid.axes;
        let back = !pyramid.forward;
        let sign = if back { -1.0 } else { 1.0 };
        let origin = &pyramid.origin;
        Self {
            near_rows: [row_of(x, back), row_of(y, back), row_of(z, back)],
            far_rows: [row_of(x, !back), row_of(y, !back), row_of(z, !back)],
            origin: splat3([sign * origin[x], sign * origin[y], sign * origin[z]]),
            sign: V::splat(sign),
        }
    }

    /// Returns the end of the boxes along an axis, seen from the apex, mirrored with the pyramid.
    #[inline(always)]
    fn end(&self, node: &Node, rows: &[usize; 3], axis: usize) -> V {
        V::load(&node.0[rows[axis] & 7]).mul(self.sign).sub(self.origin[axis])
    }

    /// Slopes with a margin for rounding: of the divisions, and of the triangle test as in
    /// [`crate::local_ray::LocalRay`].
    #[inline(always)]
    pub(crate) fn of(&self, node: &Node) -> Slopes {
        let floor = V::splat(Self::MIN_DEPTH_M);
        let one = V::splat(1.0);
        let near = one.div(self.end(node, &self.near_rows, 2).max(floor));
        let far = one.div(self.end(node, &self.far_rows, 2).max(floor));
        let (less, more) =
            (V::splat(1.0 - 32.0 * ROUNDING_RATIO), V::splat(1.0 + 32.0 * ROUNDING_RATIO));
        let mut slopes = Slopes { low: [Row([0.0; 8]); 2], high: [Row([0.0; 8]); 2] };
        for axis in 0..2 {
            let low = self.end(node, &self.near_rows, axis);
            let high = self.end(node, &self.far_rows, axis);
            let low = low.mul(near).min(low.mul(far));
            let high = high.mul(near).max(high.mul(far));
            slopes.low[axis] = low.mul(less).min(low.mul(more)).store();
            slopes.high[axis] = high.mul(less).max(high.mul(more)).store();
        }
        slopes
    }
}

/// Returns the row of a node with the lower or upper corners along an axis.
#[inline(always)]
fn row_of(axis: usize, upper: bool) -> usize {
    axis + 3 * usize::from(upper)
}

impl<V: V8> NodeTest<V> for Frustum<V> {
    #[inline(always)]
    fn children(&self, node: &Node, reach: V) -> (u32, V) {
        let (hits, enter) = self.mask(node, reach);
        (hits.bits(), enter)
    }
}

impl<V: V8> Frustum<V> {
    /// Returns a mask of the children that may be hit within `reach`, and the depths at which the
    /// pyramid enters them.
    #[inline(always)]
    pub(crate) fn mask(&self, node: &Node, reach: V) -> (V, V) {
        let enter = self.enter.at(node).max(self.min);
        let enter = enter.max(self.from(0, node).max(self.from(1, node)));
        let leave = self.to[0].at(node).min(self.to[1].at(node));
        let leave = leave.min(self.leave.at(node).min(reach));
        (enter.le(leave), enter)
    }
}
