//! Packets of rays with a common origin against one triangle at a time.

use super::{Block, TriangleMesh};
use crate::bvh::{LEAF_MASK, MAX_PENDING_CHILD_COUNT, leaf_range};
use crate::local_ray::distance_margin;
use crate::packet::{Frustum, MAX_GROUP_COUNT, Packet, Pyramid, SlopeTest, Slopes};
use crate::simd::{Row, V8, splat3};
use crate::traversal::PendingChildren;
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
        stack: &mut GroupStack,
    ) {
        if self.nodes.is_empty() {
            return;
        }
        let margin = distance_margin(self.extent, 1.0);
        let [x, y, z] = pyramid.axes;
        let origin = splat3([pyramid.origin[x], pyramid.origin[y], pyramid.origin[z]]);
        let mut leaves = PacketLeaves::<V> {
            blocks: &self.blocks,
            axes: pyramid.axes,
            origin,
            sides: Sides::new(pyramid),
            packets,
            best,
            margin,
            bounds: PacketBounds::new(packets),
        };
        leaves.update_limits(u32::MAX);
        let frustum = Frustum::<V>::new(pyramid, margin);
        let slope_test = SlopeTest::<V>::new(pyramid);
        let octant = pyramid.octant();
        let GroupStack { words, distances, packets: masks, height, children } = stack;
        (words[0], distances[0], masks[0], *height) = (0, 0.0, u8::MAX, 1);
        while *height > 0 {
            *height = height.wrapping_sub(1).min(MAX_PENDING_CHILD_COUNT);
            let word = words[*height];
            let active = u32::from(masks[*height]) & leaves.within::<V>(distances[*height]);
            if active == 0 {
                continue;
            }
            if word & LEAF_MASK != 0 {
                leaves.visit(word, active);
                continue;
            }
            let node = &self.nodes[word as usize];
            let (hits, enter) = frustum.mask(node, V::splat(leaves.bounds.max_limit));
            children.height = 0;
            V::push(hits, enter, &CHILD_NUMBERS, node.order(octant), children);
            let count = children.height.min(8);
            if active & (active - 1) == 0 {
                // The pyramid may be wider than the packet, but there is nothing to share.
                for index in 0..count {
                    let child = children.words[index] as usize & 7;
                    let at = height.wrapping_add(index).min(MAX_PENDING_CHILD_COUNT);
                    words[at] = node.child(child);
                    distances[at] = children.distances[index];
                    masks[at] = active as u8;
                }
                *height += count;
                continue;
            }
            if count == 0 {
                continue;
            }
            let slopes = slope_test.of(node);
            for index in 0..count {
                let child = children.words[index] as usize & 7;
                let distance = children.distances[index];
                let own = active & leaves.bounds.seeing::<V>(&slopes, child, distance);
                let at = (*height).min(MAX_PENDING_CHILD_COUNT);
                words[at] = node.child(child);
                distances[at] = distance;
                masks[at] = own as u8;
                *height = at + usize::from(own != 0);
            }
        }
    }
}

/// Numbers of the children of a node, as bits.
const CHILD_NUMBERS: Row = {
    let mut row = Row([0.0; 8]);
    let mut child = 0;
    while child < 8 {
        row.0[child] = f32::from_bits(child as u32);
        child += 1;
    }
    row
};

/// Pending children of a group of packets, the nearest last.
pub(crate) struct GroupStack {
    words: [u32; MAX_PENDING_CHILD_COUNT + 8],
    /// Depths at which the pyramid enters them.
    distances: [f32; MAX_PENDING_CHILD_COUNT + 8],
    /// Packets that may hit them, as bits.
    packets: [u8; MAX_PENDING_CHILD_COUNT + 8],
    height: usize,
    /// Children of one node.
    children: PendingChildren,
}

impl GroupStack {
    pub(crate) const EMPTY: Self = Self {
        words: [0; MAX_PENDING_CHILD_COUNT + 8],
        distances: [0.0; MAX_PENDING_CHILD_COUNT + 8],
        packets: [0; MAX_PENDING_CHILD_COUNT + 8],
        height: 0,
        children: PendingChildren::EMPTY,
    };
}

/// Slopes and limits of up to eight packets side by side.
struct PacketBounds {
    low: [Row; 2],
    high: [Row; 2],
    /// Depths within which the packets can still find hits; -1 in unused lanes.
    limits: Row,
    max_limit: f32,
}

impl PacketBounds {
    #[inline(always)]
    fn new(packets: &[Packet]) -> Self {
        let none = Row([f32::INFINITY; 8]);
        let mut own =
            Self { low: [none; 2], high: [none; 2], limits: Row([-1.0; 8]), max_limit: -1.0 };
        for (lane, packet) in packets.iter().take(MAX_GROUP_COUNT).enumerate() {
            for axis in 0..2 {
                own.low[axis].0[lane] = packet.pyramid.low[axis];
                own.high[axis].0[lane] = packet.pyramid.high[axis];
            }
        }
        own
    }

    /// Returns the packets that may hit a child that is entered at a distance, as bits.
    #[inline(always)]
    fn seeing<V: V8>(&self, slopes: &Slopes, child: usize, distance: f32) -> u32 {
        let mut own = V::splat(distance).le(V::load(&self.limits));
        for axis in 0..2 {
            let (low, high) = (slopes.low[axis].0[child], slopes.high[axis].0[child]);
            own = own.and(V::load(&self.low[axis]).le(V::splat(high)));
            own = own.and(V::splat(low).le(V::load(&self.high[axis])));
        }
        own.bits()
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
    bounds: PacketBounds,
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

    /// Updates the depths within which these packets, as bits, can still find hits.
    #[inline(always)]
    fn update_limits(&mut self, updated: u32) {
        for (number, (packet, best)) in self.packets.iter().zip(&*self.best).enumerate() {
            if updated >> number & 1 != 0 {
                let limit = packet.reach(V::load(&best.distances), self.margin);
                self.bounds.limits.0[number % MAX_GROUP_COUNT] = limit;
            }
        }
        let zero = V::splat(0.0);
        self.bounds.max_limit = -zero.sub(V::load(&self.bounds.limits)).min_lane();
    }

    /// Returns the packets that may hit something beyond a depth, as bits.
    #[inline(always)]
    fn within<W: V8>(&self, distance: f32) -> u32 {
        W::splat(distance).le(W::load(&self.bounds.limits)).bits()
    }

    /// Tests the triangles of a leaf against packets, as bits.
    #[inline(always)]
    fn visit(&mut self, word: u32, active: u32) {
        let (number, count) = leaf_range(word);
        let block = &self.blocks[number];
        let [a, b, c] = &block.corners;
        let corners = [self.corner(a), self.corner(b), self.corner(c)];
        let candidates = self.sides.candidates(&corners) & ((2 << (count - 1)) - 1);
        if candidates == 0 {
            return;
        }
        let [a, b, c] = &corners;
        let rows = [stored(a), stored(b), stored(c)];
        let mut updated = 0_u32;
        let mut remaining = active;
        while remaining != 0 {
            let number = remaining.trailing_zeros() as usize;
            remaining &= remaining - 1;
            let (packet, best) = (&self.packets[number], &mut self.best[number]);
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
                updated |= 1 << number;
                // At equal distance the lower id wins.
                let id = V::splat(block.ids.0[lane]);
                let ids = V::load(&best.ids);
                let stays = nearest.le(distances).and(ids.le(id));
                best.distances = distances.select(nearest, hit).store();
                best.ids = ids.select(id, stays).select(ids, hit).store();
            }
        }
        if updated != 0 {
            self.update_limits(updated);
        }
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
