//! Interleaved traversal of several rays, for trees larger than the cache: while the next node of
//! one ray is fetched from memory, the other rays proceed.

use super::{Nearest, RayRows, TriangleMesh};
use crate::bvh::{LEAF_MASK, leaf_range};
use crate::local_ray::{PreparedRay, RayBlock, reach};
use crate::simd::V8;
use crate::traversal::PendingChildren;
use crate::triangle;

/// Number of interleaved rays.
const SLOTS: usize = 16;

/// Maximum number of leaves of a tree that mostly is in the second cache, so that fetching ahead is only
/// work.
const MAX_CACHED_BLOCKS: usize = 4000;

/// Up to eight rays that wait for a slot.
pub(crate) struct QueuedRays<T> {
    pub(crate) block: RayBlock,
    pub(crate) tickets: [T; 8],
    pub(crate) count: usize,
}

/// Source of rays and receiver of their hits.
pub(crate) trait RayQueue {
    /// Identifier of a ray.
    type Ticket: Copy + Default;
    /// Replaces the queued rays by the next ones; none at the end.
    fn fill(&mut self, queued: &mut QueuedRays<Self::Ticket>);
    /// Reports the first hit of the ray with a ticket.
    fn done(&mut self, ticket: Self::Ticket, nearest: Nearest);
}

/// Rays of a queue, one after the other.
struct Source<'a, Q: RayQueue> {
    queue: &'a mut Q,
    queued: QueuedRays<Q::Ticket>,
    next: usize,
}

impl<Q: RayQueue> Source<'_, Q> {
    /// Returns the lane of the next ray.
    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        if self.next >= self.queued.count {
            self.next = 0;
            self.queue.fill(&mut self.queued);
            if self.queued.count == 0 {
                return None;
            }
        }
        self.next += 1;
        Some(self.next - 1)
    }
}

/// A ray during traversal. Its terms are single numbers, broadcast where they are used: they are
/// cheaper to write and to read than rows of eight.
struct InterleavedRay<T> {
    ray: PreparedRay,
    limit: f32,
    nearest: Nearest,
    ticket: T,
    pending: PendingChildren,
}

impl<T: Copy> InterleavedRay<T> {
    /// Replaces the ray by a queued one.
    #[inline(always)]
    fn restart(&mut self, queued: &QueuedRays<T>, lane: usize) {
        let max = queued.block.max.0[lane & 7];
        self.ray = queued.block.ray(lane);
        self.limit = reach(max, self.ray.margin);
        self.nearest = Nearest { distance: max, id: u32::MAX };
        self.ticket = queued.tickets[lane & 7];
        self.pending.restart();
    }

    /// Visits the node that is pending last.
    #[inline(always)]
    fn visit_node<V: V8, const FLAT: bool>(&mut self, mesh: &TriangleMesh) {
        let node = &mesh.nodes[self.pending.pop() as usize];
        let (hits, enter) = self.ray.terms.children::<V, FLAT>(node, self.limit);
        V::push(hits, enter, &node.0[6], node.order(self.ray.octant.into()), &mut self.pending);
    }

    /// Keeps the nearest triangle of a leaf. Nothing here branches on the result of the test: it is known
    /// so late that a wrong guess would discard the work on other rays.
    #[inline(always)]
    fn visit_leaf<V: V8>(&mut self, mesh: &TriangleMesh) {
        let block = &mesh.blocks[leaf_range(self.pending.pop()).0];
        let PreparedRay { origin, shear, min, margin, .. } = self.ray;
        let rows = RayRows::<V>::of(self.ray.axes(), origin, shear, min);
        let [a, b, c] = &block.corners;
        let corners = [rows.corner(a), rows.corner(b), rows.corner(c)];
        let best = V::splat(self.nearest.distance);
        let (hit, distances) = triangle::intersect(corners, rows.shear, rows.min, best);
        let distances = distances.select(V::splat(f32::INFINITY), hit);
        let distance = distances.min_lane();
        let bits = distances.le(V::splat(distance)).and(hit).bits();
        // The first of equally near triangles has the lowest id.
        let id = block.id(bits.trailing_zeros() as usize & 7);
        let known = self.nearest;
        let nearer = (distance < known.distance) | (distance == known.distance) & (id < known.id);
        let nearer = nearer & (bits != 0);
        self.nearest = Nearest {
            distance: if nearer { distance } else { known.distance },
            id: if nearer { id } else { known.id },
        };
        self.limit = reach(self.nearest.distance, margin);
        V::cull(&mut self.pending, self.limit);
    }
}

impl TriangleMesh {
    /// Traces all rays of a queue, each with the same result as [`Self::trace`].
    #[inline(always)]
    pub(crate) fn trace_interleaved<V: V8, Q: RayQueue, const FLAT: bool>(&self, queue: &mut Q) {
        let queued =
            QueuedRays { block: RayBlock::EMPTY, tickets: [Q::Ticket::default(); 8], count: 0 };
        let mut source = Source { queue, queued, next: 0 };
        if self.nodes.is_empty() {
            while let Some(lane) = source.next() {
                let (ticket, max) =
                    (source.queued.tickets[lane & 7], source.queued.block.max.0[lane & 7]);
                source.queue.done(ticket, Nearest { distance: max, id: u32::MAX });
            }
            return;
        }
        let mut slots: Vec<InterleavedRay<Q::Ticket>> = Vec::with_capacity(SLOTS);
        while slots.len() < SLOTS {
            let Some(lane) = source.next() else { break };
            let mut slot = InterleavedRay {
                ray: source.queued.block.ray(lane),
                limit: 0.0,
                nearest: Nearest { distance: 0.0, id: u32::MAX },
                ticket: source.queued.tickets[lane & 7],
                pending: PendingChildren::EMPTY,
            };
            slot.restart(&source.queued, lane);
            slots.push(slot);
        }
        let prefetches = self.blocks.len() > MAX_CACHED_BLOCKS;
        while !slots.is_empty() {
            let mut slot = 0;
            while slot < slots.len() {
                let active = &mut slots[slot];
                let last = active.pending.last();
                if last.is_none() {
                    source.queue.done(active.ticket, active.nearest);
                    if let Some(next) = source.next() {
                        active.restart(&source.queued, next);
                    } else {
                        slots.swap_remove(slot);
                        continue;
                    }
                } else if last.is_node() {
                    active.visit_node::<V, FLAT>(self);
                } else {
                    active.visit_leaf::<V>(self);
                }
                if prefetches {
                    self.prefetch::<V>(active.pending.last().word);
                }
                slot += 1;
            }
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
