//! Interleaved traversal of several rays, for trees larger than the cache: while the next node of
//! one ray is fetched from memory, the other rays proceed.

use super::{Block, Nearest, RayRows, TriangleMesh};
use crate::bvh::{LEAF_MASK, leaf_range};
use crate::local_ray::{BoxTerms, LocalRay, distance_margin, reach};
use crate::simd::V8;
use crate::traversal::PendingChildren;
use crate::triangle;

/// Number of interleaved rays.
const SLOTS: usize = 32;

/// Indices of slots. Whether one is added is no branch.
#[derive(Clone, Copy)]
struct Slots {
    indices: [u8; SLOTS],
    count: usize,
}

impl Default for Slots {
    fn default() -> Self {
        Self { indices: [0; SLOTS], count: 0 }
    }
}

impl Slots {
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "fewer than 256 slots")]
    fn push(&mut self, slot: usize, added: bool) {
        self.indices[self.count % SLOTS] = slot as u8;
        self.count += usize::from(added);
    }

    #[inline(always)]
    fn iter(&self) -> impl Iterator<Item = usize> {
        self.indices[..self.count.min(SLOTS)].iter().map(|&slot| usize::from(slot))
    }
}

/// Greater than every distance and, as bits, than every triangle's number.
const NO_TRIANGLE: f32 = f32::INFINITY;

/// Source of rays and receiver of their hits.
pub(crate) trait RayQueue {
    /// Identifier of a ray.
    type Ticket: Copy;
    /// Returns the next ray and its maximum distance.
    fn next(&mut self) -> Option<(Self::Ticket, LocalRay, f32)>;
    /// Reports the first hit of the ray with a ticket.
    fn done(&mut self, ticket: Self::Ticket, nearest: Nearest);
}

/// A ray during traversal. Its terms are single numbers, broadcast where they are used: they are
/// cheaper to write and to read than rows of eight.
struct InterleavedRay<T> {
    terms: BoxTerms,
    octant: usize,
    limit: f32,
    ray: LocalRay,
    margin: f32,
    nearest: Nearest,
    ticket: T,
    pending: PendingChildren,
}

impl<T: Copy> InterleavedRay<T> {
    #[inline(always)]
    fn new(mesh: &TriangleMesh, ticket: T, ray: &LocalRay, max: f32) -> Self {
        let mut slot = Self {
            terms: BoxTerms::new(ray, 0.0),
            octant: 0,
            limit: 0.0,
            ray: *ray,
            margin: 0.0,
            nearest: Nearest { distance: max, id: u32::MAX },
            ticket,
            pending: PendingChildren::EMPTY,
        };
        slot.restart(mesh, ticket, ray, max);
        slot
    }

    /// Replaces the ray.
    #[inline(always)]
    fn restart(&mut self, mesh: &TriangleMesh, ticket: T, ray: &LocalRay, max: f32) {
        self.margin = distance_margin(mesh.extent, ray.shear[2]);
        self.terms = BoxTerms::new(ray, self.margin);
        self.octant = self.terms.octant();
        self.limit = reach(max, self.margin);
        self.ray = *ray;
        self.nearest = Nearest { distance: max, id: u32::MAX };
        self.ticket = ticket;
        self.pending.restart();
    }

    /// Visits the node that is pending last.
    #[inline(always)]
    fn visit_node<V: V8>(&mut self, mesh: &TriangleMesh) {
        let node = &mesh.nodes[self.pending.pop() as usize];
        let (hits, enter) = self.terms.children::<V>(node, self.limit);
        V::push(hits, enter, &node.0[6], node.order(self.octant), &mut self.pending);
    }

    /// Keeps the nearest triangle of a leaf. Nothing here branches on the result of the test: it is known
    /// so late that a wrong guess would discard the work on other rays.
    #[inline(always)]
    fn visit_leaf<V: V8>(&mut self, mesh: &TriangleMesh) {
        let block = &mesh.blocks[leaf_range(self.pending.pop()).0];
        let rows = RayRows::<V>::new(&self.ray);
        let [a, b, c] = &block.corners;
        let corners = [rows.corner(a), rows.corner(b), rows.corner(c)];
        let best = V::splat(self.nearest.distance);
        let (hit, distances) = triangle::intersect(corners, rows.shear, rows.min, best);
        let none = V::splat(NO_TRIANGLE);
        let distances = distances.select(none, hit);
        let distance = distances.min_lane();
        let nearest = distances.le(V::splat(distance)).and(hit);
        let id = V::load(&block.ids).select(none, nearest).min_lane().to_bits();
        let known = self.nearest;
        let nearer = (distance < known.distance) | (distance == known.distance) & (id < known.id);
        let nearer = nearer & (id != NO_TRIANGLE.to_bits());
        self.nearest = Nearest {
            distance: if nearer { distance } else { known.distance },
            id: if nearer { id } else { known.id },
        };
        self.limit = reach(self.nearest.distance, self.margin);
        V::cull(&mut self.pending, self.limit);
    }
}

impl TriangleMesh {
    /// Traces all rays of a queue, each with the same result as [`Self::trace`].
    #[inline(always)]
    pub(crate) fn trace_interleaved<V: V8, Q: RayQueue>(&self, queue: &mut Q) {
        if self.nodes.is_empty() {
            while let Some((ticket, _, max)) = queue.next() {
                queue.done(ticket, Nearest { distance: max, id: u32::MAX });
            }
            return;
        }
        let mut slots: Vec<InterleavedRay<Q::Ticket>> = Vec::with_capacity(SLOTS);
        let mut at_nodes = Slots::default();
        while slots.len() < SLOTS {
            let Some((ticket, ray, max)) = queue.next() else { break };
            at_nodes.push(slots.len(), true);
            slots.push(InterleavedRay::new(self, ticket, &ray, max));
        }
        let mut at_leaves = Slots::default();
        while at_nodes.count + at_leaves.count > 0 {
            let (mut next_nodes, mut next_leaves) = (Slots::default(), Slots::default());
            let mut ended = Slots::default();
            for slot in at_leaves.iter() {
                slots[slot].visit_leaf::<V>(self);
                let next = slots[slot].pending.last();
                next_nodes.push(slot, next.is_node());
                next_leaves.push(slot, next.is_leaf());
                ended.push(slot, next.is_none());
                self.prefetch::<V>(next.word);
            }
            for slot in at_nodes.iter() {
                slots[slot].visit_node::<V>(self);
                let next = slots[slot].pending.last();
                next_nodes.push(slot, next.is_node());
                next_leaves.push(slot, next.is_leaf());
                ended.push(slot, next.is_none());
                self.prefetch::<V>(next.word);
            }
            for slot in ended.iter() {
                let active = &mut slots[slot];
                queue.done(active.ticket, active.nearest);
                if let Some((ticket, ray, max)) = queue.next() {
                    active.restart(self, ticket, &ray, max);
                    next_nodes.push(slot, true);
                }
            }
            (at_nodes, at_leaves) = (next_nodes, next_leaves);
        }
    }

    /// Prefetches the node or the triangles of a child, without a branch.
    #[inline(always)]
    fn prefetch<V: V8>(&self, word: u32) {
        let node = self.nodes.as_ptr().wrapping_add(word as usize).cast::<u8>();
        let block = self.blocks.as_ptr().wrapping_add(leaf_range(word).0).cast::<u8>();
        V::prefetch(if word & LEAF_MASK == 0 { node } else { block });
    }
}
