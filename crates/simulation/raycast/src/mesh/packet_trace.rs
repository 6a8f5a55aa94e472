//! Packets of rays with a common origin against one triangle at a time.

use super::{Block, TriangleMesh};
use crate::bvh::leaf_range;
use crate::local_ray::distance_margin;
use crate::packet::{Frustum, Packet, Pyramid};
use crate::simd::{Row, V8, splat3};
use crate::traversal::{Leaves, Stack, Step, traverse};
use crate::triangle;

/// The nearest triangles found by eight rays. Ids are bit patterns compared as f32, which preserves
/// the order of non-negative values.
#[derive(Clone, Copy)]
pub(crate) struct Best {
    distances: Row,
    ids: Row,
}

/// No triangle: greater than every id.
const NO_TRIANGLE_ID: f32 = f32::INFINITY;

impl Best {
    /// No hits yet; `distances` limit the search.
    pub(crate) const fn within(distances: Row) -> Self {
        Self { distances, ids: Row([NO_TRIANGLE_ID; 8]) }
    }

    /// Returns the distance and id of the triangle that a ray has hit.
    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> Option<(f32, u32)> {
        let id = self.ids.0[lane];
        (id != NO_TRIANGLE_ID).then_some((self.distances.0[lane], id.to_bits()))
    }
}

impl TriangleMesh {
    /// [`Self::trace`] for packets and the pyramid around them, with identical results.
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
        let mut leaves = PacketLeaves::<V> {
            blocks: &self.blocks,
            axes: pyramid.axes,
            origin,
            sides,
            packets,
            best,
            margin,
        };
        let limit = leaves.limit();
        traverse(&self.nodes, &Frustum::<V>::new(pyramid, margin), limit, stack, &mut leaves);
    }
}

/// Slope intervals of a pyramid.
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

    /// Returns the triangles that rays with these slopes may hit. A triangle with all corners on one
    /// side of both ends of an interval is on that side for all slopes between, as computed by the
    /// triangle test: rounding is monotonic.
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
        let (index, depth) = (corner[axis], corner[2]);
        (index.sub(self.low[axis].mul(depth)), index.sub(self.high[axis].mul(depth)))
    }
}

/// Packets during traversal.
struct PacketLeaves<'a, V> {
    blocks: &'a [Block],
    axes: [usize; 3],
    origin: [V; 3],
    sides: Sides<V>,
    packets: &'a [Packet],
    best: &'a mut [Best],
    margin: f32,
}

impl<V: V8> PacketLeaves<'_, V> {
    #[inline(always)]
    fn corner(&self, corner: &[Row; 3]) -> [V; 3] {
        [
            V::load(&corner[self.axes[0]]).sub(self.origin[0]),
            V::load(&corner[self.axes[1]]).sub(self.origin[1]),
            V::load(&corner[self.axes[2]]).sub(self.origin[2]),
        ]
    }

    /// Returns the depth within which any ray can still find a hit.
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

impl<V: V8> Leaves for PacketLeaves<'_, V> {
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
                // At equal distance the lower id wins.
                let id = V::splat(block.ids.0[lane]);
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
