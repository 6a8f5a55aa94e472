//! Interleaved traversal of several rays, for trees larger than the cache: while the next node of
//! one ray is fetched from memory, the other rays proceed.

use super::{Nearest, RayLeaves, RayRows, TriangleMesh};
use crate::bvh::{LEAF_MASK, MAX_STACK_ENTRIES};
use crate::local_ray::{BoxTest, LocalRay, distance_margin, reach};
use crate::simd::V8;
use crate::traversal::{Leaves, Stack, Step, open, pop};

/// Number of interleaved rays.
const SLOTS: usize = 16;

/// Source of rays and receiver of their hits.
pub(crate) trait RayQueue {
    /// Identifier of a ray.
    type Ticket: Copy;
    /// Returns the next ray and its maximum distance.
    fn next(&mut self) -> Option<(Self::Ticket, LocalRay, f32)>;
    /// Reports the first hit of the ray with a ticket.
    fn done(&mut self, ticket: Self::Ticket, nearest: Nearest);
}

/// A ray during traversal.
struct InterleavedRay<V, T> {
    ticket: T,
    test: BoxTest<V>,
    rows: RayRows<V>,
    margin: f32,
    limit: f32,
    nearest: Nearest,
    /// Word of the next child to visit.
    next: u32,
    height: usize,
}

/// Ray and stack side by side, so that stacks are not 4096 bytes apart and do not contend for the
/// same cache lines.
struct Slot<V, T> {
    ray: InterleavedRay<V, T>,
    stack: Stack,
}

impl<V: V8, T: Copy> InterleavedRay<V, T> {
    #[inline(always)]
    fn new(mesh: &TriangleMesh, ticket: T, ray: &LocalRay, max: f32) -> Self {
        let margin = distance_margin(mesh.extent, ray.shear[2]);
        Self {
            ticket,
            test: BoxTest::new(ray, margin),
            rows: RayRows::new(ray),
            margin,
            limit: reach(max, margin),
            nearest: Nearest { distance: max, id: u32::MAX },
            next: 0,
            height: 0,
        }
    }

    /// Visits one node or one leaf. Returns false at the end.
    #[inline(always)]
    fn step(&mut self, mesh: &TriangleMesh, stack: &mut Stack) -> bool {
        let mut next = None;
        if self.next & LEAF_MASK == 0 {
            let node = &mesh.nodes[self.next as usize];
            next = open(node, &self.test, self.limit, stack, &mut self.height);
        } else {
            let mut leaves = RayLeaves::<V, _, false> {
                blocks: &mesh.blocks,
                rows: &self.rows,
                margin: self.margin,
                nearest: &mut self.nearest,
                accept: |_| true,
            };
            if let Step::Within(nearer) = leaves.visit(self.next) {
                self.limit = nearer;
            }
        }
        if next.is_none() {
            next = pop(stack, &mut self.height, self.limit);
        }
        let Some(word) = next else { return false };
        self.next = word;
        mesh.prefetch::<V>(word);
        true
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
        let mut slots: Vec<Slot<V, Q::Ticket>> = Vec::with_capacity(SLOTS);
        while slots.len() < SLOTS {
            let Some((ticket, ray, max)) = queue.next() else { break };
            slots.push(Slot {
                ray: InterleavedRay::new(self, ticket, &ray, max),
                stack: [0; MAX_STACK_ENTRIES],
            });
        }
        while !slots.is_empty() {
            let mut slot = 0;
            while slot < slots.len() {
                let Slot { ray: active, stack } = &mut slots[slot];
                if active.step(self, stack) {
                    slot += 1;
                    continue;
                }
                queue.done(active.ticket, active.nearest);
                if let Some((ticket, ray, max)) = queue.next() {
                    *active = InterleavedRay::new(self, ticket, &ray, max);
                    slot += 1;
                } else {
                    slots.swap_remove(slot);
                }
            }
        }
    }

    #[inline(always)]
    fn prefetch<V: V8>(&self, word: u32) {
        if word & LEAF_MASK == 0 {
            V::prefetch(&self.nodes[word as usize]);
        } else {
            V::prefetch(&self.blocks[crate::bvh::leaf_range(word).0]);
        }
    }
}
