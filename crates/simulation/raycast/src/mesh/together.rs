//! Rays of one origin against one triangle at a time.

use super::{Block, TriangleMesh};
use crate::bvh::leaf_range;
use crate::local::distance_margin;
use crate::packet::{Frustum, Packet, Pyramid};
use crate::simd::{Row, V8, splat3};
use crate::triangle;
use crate::walk::{Leaves, Stack, Step, walk};

/// The nearest triangles that eight rays have found so far. Numbers are bits that are compared as
/// f32, which for what is not negative is the same.
#[derive(Clone, Copy)]
pub(crate) struct Best {
    distances: Row,
    ids: Row,
}

/// No triangle: above all numbers of triangles.
const NONE: f32 = f32::INFINITY;

impl Best {
    /// Nothing so far, and nothing to look for beyond these distances.
    pub(crate) const fn within(distances: Row) -> Self {
        Self { distances, ids: Row([NONE; 8]) }
    }

    /// Distance and number of the triangle that a ray has found.
    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> Option<(f32, u32)> {
        let id = self.ids.0[lane];
        (id != NONE).then_some((self.distances.0[lane], id.to_bits()))
    }
}

impl TriangleMesh {
    /// [`Self::trace`] for packets and the pyramid around them, to the very same results.
    #[inline(always)]
    pub(crate) fn trace_packets<V: V8>(
        &self,
        pyramid: &Pyramid,
        packets: &[Packet],
        best: &mut [Best],
        stack: &mut Stack,
    ) {
        let margin = distance_margin(self.extent, 1.0);
        let sides = Sides::new(pyramid);
        let origin = splat3([0, 1, 2].map(|axis: usize| pyramid.origin[pyramid.axes[axis]]));
        let mut leaves = Together::<V> {
            blocks: &self.blocks,
            axes: pyramid.axes,
            origin,
            sides,
            packets,
            best,
            margin,
        };
        let limit = leaves.limit();
        walk(&self.nodes, &Frustum::<V>::new(pyramid, margin), limit, stack, &mut leaves);
    }
}

/// The intervals of a pyramid's slopes.
struct Sides<V> {
    low: [V; 2],
    high: [V; 2],
}

impl<V: V8> Sides<V> {
    #[inline(always)]
    fn new(pyramid: &Pyramid) -> Self {
        let ([a, b], [c, d]) = (pyramid.low, pyramid.high);
        Self { low: [V::splat(a), V::splat(b)], high: [V::splat(c), V::splat(d)] }
    }

    /// The triangles that rays of these slopes may meet. What is on one side of both ends of an
    /// interval with all corners is there for all slopes between, as the triangle test computes
    /// it: rounding keeps the order.
    #[inline(always)]
    fn candidates(&self, corners: &[[V; 3]; 3]) -> u32 {
        let zero = V::splat(0.0);
        let (low, high) = self.range(corners, 0);
        let first = low.le(zero).and(zero.le(high));
        let (low, high) = self.range(corners, 1);
        first.and(low.le(zero)).and(zero.le(high)).bits()
    }

    #[inline(always)]
    fn range(&self, [a, b, c]: &[[V; 3]; 3], axis: usize) -> (V, V) {
        let ((a, d), (b, e), (c, f)) = (self.ends(a, axis), self.ends(b, axis), self.ends(c, axis));
        (a.min(d).min(b.min(e)).min(c.min(f)), a.max(d).max(b.max(e)).max(c.max(f)))
    }

    #[inline(always)]
    fn ends(&self, corner: &[V; 3], axis: usize) -> (V, V) {
        let (place, depth) = (corner[axis], corner[2]);
        (place.sub(self.low[axis].mul(depth)), place.sub(self.high[axis].mul(depth)))
    }
}

/// Packets on their way.
struct Together<'a, V> {
    blocks: &'a [Block],
    axes: [usize; 3],
    origin: [V; 3],
    sides: Sides<V>,
    packets: &'a [Packet],
    best: &'a mut [Best],
    margin: f32,
}

impl<V: V8> Together<'_, V> {
    #[inline(always)]
    fn corner(&self, corner: &[Row; 3]) -> [V; 3] {
        [
            V::load(&corner[self.axes[0]]).sub(self.origin[0]),
            V::load(&corner[self.axes[1]]).sub(self.origin[1]),
            V::load(&corner[self.axes[2]]).sub(self.origin[2]),
        ]
    }

    /// The depth within which any ray may still find something.
    #[inline(always)]
    fn limit(&self) -> f32 {
        let mut limit = 0.0_f32;
        for (packet, best) in self.packets.iter().zip(&*self.best) {
            let own = packet.reach(V::load(&best.distances), self.margin);
            limit = if own > limit { own } else { limit };
        }
        limit
    }
}

impl<V: V8> Leaves for Together<'_, V> {
    #[inline(always)]
    fn visit(&mut self, word: u32) -> Step {
        let (number, count) = leaf_range(word);
        let block = &self.blocks[number];
        let [a, b, c] = &block.corners;
        let corners = [self.corner(a), self.corner(b), self.corner(c)];
        let candidates = self.sides.candidates(&corners) & ((2 << (count - 1)) - 1);
        if candidates == 0 {
            return Step::On;
        }
        let [a, b, c] = &corners;
        let rows = [stored(a), stored(b), stored(c)];
        let mut found = false;
        for (packet, best) in self.packets.iter().zip(&mut *self.best) {
            let mut own = candidates;
            if self.packets.len() > 1 && own & (own - 1) != 0 {
                own &= Sides::new(&packet.pyramid).candidates(&corners);
            }
            let [x, y, z] = &packet.shear;
            let shear = [V::load(x), V::load(y), V::load(z)];
            while own != 0 {
                let lane = own.trailing_zeros() as usize & 7;
                own &= own - 1;
                let [a, b, c] = &rows;
                let triangle = [lane_of(a, lane), lane_of(b, lane), lane_of(c, lane)];
                let nearest = V::load(&best.distances);
                let (hit, distances) =
                    triangle::intersect(triangle, shear, V::load(&packet.min), nearest);
                if hit.bits() == 0 {
                    continue;
                }
                found = true;
                // Of equal distances the one of the lower number counts.
                let id = V::splat(f32::from_bits(block.ids[lane]));
                let ids = V::load(&best.ids);
                let stays = nearest.le(distances).and(ids.le(id));
                best.distances = distances.select(nearest, hit).store();
                best.ids = ids.select(id, stays).select(ids, hit).store();
            }
        }
        if found { Step::Within(self.limit()) } else { Step::On }
    }
}

#[inline(always)]
fn stored<V: V8>([x, y, z]: &[V; 3]) -> [Row; 3] {
    [x.store(), y.store(), z.store()]
}

#[inline(always)]
fn lane_of<V: V8>([x, y, z]: &[Row; 3], lane: usize) -> [V; 3] {
    splat3([x.0[lane], y.0[lane], z.0[lane]])
}
