//! Eight rays of one origin, together.

use crate::bvh::Node;
use crate::local::{FLAT, LocalRay, ROUND, reach};
use crate::simd::{Row, V8};
use crate::walk::NodeTest;

/// Rays that start at one point and go most along the same axis, the same way. Nodes are tested
/// against the pyramid around all of them, triangles against each.
pub(crate) struct Packet {
    pub(crate) origin: [f32; 3],
    pub(crate) axes: [usize; 3],
    forward: bool,
    shear: [Row; 3],
    /// Depth along the main axis per distance.
    steep: Row,
    min: Row,
}

impl Packet {
    /// From one to eight rays, if they fit together; lanes beyond are copies of the first.
    #[inline(always)]
    pub(crate) fn new(rays: &[LocalRay]) -> Option<Self> {
        let first = rays.first()?;
        let along = first.axes[2];
        let forward = first.direction[along] > 0.0;
        let mut packet = Self {
            origin: first.origin,
            axes: first.axes,
            forward,
            shear: first.shear.map(|value| Row([value; 8])),
            steep: Row([first.direction[along].abs(); 8]),
            min: Row([first.min; 8]),
        };
        for (lane, ray) in rays.iter().enumerate().skip(1) {
            let fits = ray.origin == first.origin
                && ray.axes[2] == along
                && (ray.direction[along] > 0.0) == forward;
            if !fits {
                return None;
            }
            for axis in 0..3 {
                packet.shear[axis].0[lane] = ray.shear[axis];
            }
            packet.steep.0[lane] = ray.direction[along].abs();
            packet.min.0[lane] = ray.min;
        }
        Some(packet)
    }

    /// How far the slopes lie apart, the larger of both axes.
    #[inline(always)]
    pub(crate) fn spread(&self) -> f32 {
        let [(a, b), (c, d)] = [range(&self.shear[0]), range(&self.shear[1])];
        if b - a > d - c { b - a } else { d - c }
    }

    /// The depth up to which boxes have to be looked into when hits at these distances are known.
    #[inline(always)]
    pub(crate) fn reach(&self, best: &Row, margin: f32) -> f32 {
        let mut deepest = 0.0_f32;
        for lane in 0..8 {
            let depth = best.0[lane] * self.steep.0[lane];
            deepest = if depth > deepest { depth } else { deepest };
        }
        reach(deepest, margin)
    }
}

#[inline(always)]
fn range(row: &Row) -> (f32, f32) {
    let (mut low, mut high) = (row.0[0], row.0[0]);
    for &value in &row.0[1..] {
        low = if value < low { value } else { low };
        high = if value > high { value } else { high };
    }
    (low, high)
}

/// A packet as the triangle test wants it.
pub(crate) struct PacketRows<V> {
    pub(crate) shear: [V; 3],
    pub(crate) min: V,
}

impl<V: V8> PacketRows<V> {
    #[inline(always)]
    pub(crate) fn new(packet: &Packet) -> Self {
        let [x, y, z] = &packet.shear;
        Self { shear: [V::load(x), V::load(y), V::load(z)], min: V::load(&packet.min) }
    }
}

/// One condition on the depth: a row of a node times a factor plus an offset.
#[derive(Clone, Copy)]
struct Bound<V> {
    row: usize,
    factor: V,
    offset: V,
}

impl<V: V8> Bound<V> {
    /// Where the slope `1 / inverse` from `origin` reaches the coordinate in a row, rounded
    /// towards the eye (`-1.0`) or away (`1.0`).
    #[inline(always)]
    fn new(row: usize, inverse: f32, origin: f32, away: f32) -> Self {
        let factor = inverse * (1.0 + away * (4.0 * ROUND));
        let start = origin * factor;
        let offset = -start + away * start.abs() * (4.0 * ROUND);
        Self { row, factor: V::splat(factor), offset: V::splat(offset) }
    }

    #[inline(always)]
    fn at(&self, node: &Node) -> V {
        V::load(&node.0[self.row & 7]).mul_add_about(self.factor, self.offset)
    }
}

/// The pyramid around a packet, as conditions on the depth along its main axis: the slab test with
/// intervals of slopes for slopes.
pub(crate) struct Frustum<V> {
    enter: Bound<V>,
    leave: Bound<V>,
    /// For both lesser axes the depths at which the pyramid can have come to the box ...
    from: [[Bound<V>; 2]; 2],
    /// ... and at which it has left.
    to: [Bound<V>; 2],
    min: V,
}

impl<V: V8> Frustum<V> {
    /// `margin` is that of depths.
    #[inline(always)]
    pub(crate) fn new(packet: &Packet, margin: f32) -> Self {
        let [first, second, along] = packet.axes;
        let back = !packet.forward;
        let sign = if back { -1.0 } else { 1.0 };
        let origin = packet.origin[along];
        let (from_first, to_first) = Self::side(packet, 0, first);
        let (from_second, to_second) = Self::side(packet, 1, second);
        let mut min = f32::INFINITY;
        for lane in 0..8 {
            let depth = packet.min.0[lane] * packet.steep.0[lane];
            min = if depth < min { depth } else { min };
        }
        let min = min * (1.0 - 32.0 * ROUND) - margin;
        Self {
            enter: Bound::new(row_of(along, back), sign, origin, -1.0),
            leave: Bound::new(row_of(along, !back), sign, origin, 1.0),
            from: [from_first, from_second],
            to: [to_first, to_second],
            min: V::splat(if min > 0.0 { min } else { 0.0 }),
        }
    }

    /// The bounds of one lesser axis.
    #[inline(always)]
    fn side(packet: &Packet, which: usize, axis: usize) -> ([Bound<V>; 2], Bound<V>) {
        let (low, high) = range(&packet.shear[which]);
        let (low, high) = if packet.forward { (low, high) } else { (-high, -low) };
        let start = packet.origin[axis];
        // Slopes themselves are rounded.
        let (low, high) = (low - low.abs() * ROUND, high + high.abs() * ROUND);
        let (lower, upper) = (row_of(axis, false), row_of(axis, true));
        if low > FLAT {
            let from = Bound::new(lower, 1.0 / high, start, -1.0);
            ([from, from], Bound::new(upper, 1.0 / low, start, 1.0))
        } else if high < -FLAT {
            let from = Bound::new(upper, 1.0 / low, start, -1.0);
            ([from, from], Bound::new(lower, 1.0 / high, start, 1.0))
        } else {
            let (low, high) = (low.min(-FLAT), high.max(FLAT));
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

/// The row of a node with the lower or the upper corners along an axis.
#[inline(always)]
fn row_of(axis: usize, upper: bool) -> usize {
    axis + 3 * usize::from(upper)
}

impl<V: V8> NodeTest<V> for Frustum<V> {
    #[inline(always)]
    fn children(&self, node: &Node, reach: V) -> (u32, V) {
        let enter = self.enter.at(node).max(self.min);
        let enter = enter.max(self.from(0, node).max(self.from(1, node)));
        let leave = self.to[0].at(node).min(self.to[1].at(node));
        let leave = leave.min(self.leave.at(node).min(reach));
        (enter.le(leave).bits(), enter)
    }
}
