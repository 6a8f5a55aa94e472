//! Several rays in turns, for trees larger than the cache: while what one needs next is on its way
//! from memory, the others go on.

use super::{Nearest, OneRay, RayRows, TriangleMesh};
use crate::bvh::{LEAF, STACK};
use crate::local::{BoxTest, LocalRay, distance_margin, reach};
use crate::simd::V8;
use crate::walk::{Leaves, Stack, Step, open, take};

/// How many rays are on their way.
const SLOTS: usize = 16;

/// Rays to be traced and what becomes of them.
pub(crate) trait Queue {
    /// What tells a ray from others.
    type Ticket: Copy;
    /// The next ray, and how far it is followed.
    fn next(&mut self) -> Option<(Self::Ticket, LocalRay, f32)>;
    /// The ray of a ticket meets this first.
    fn done(&mut self, ticket: Self::Ticket, nearest: Nearest);
}

/// A ray on its way.
struct Turn<V, T> {
    ticket: T,
    test: BoxTest<V>,
    rows: RayRows<V>,
    margin: f32,
    limit: f32,
    nearest: Nearest,
    /// The word to look into next.
    next: u32,
    height: usize,
}

/// Both beside each other, so that the stacks do not lie 4096 bytes apart and contend for the same
/// lines of the cache.
struct Slot<V, T> {
    turn: Turn<V, T>,
    stack: Stack,
}

impl<V: V8, T: Copy> Turn<V, T> {
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

    /// One node or one leaf. False at the end.
    #[inline(always)]
    fn step(&mut self, mesh: &TriangleMesh, stack: &mut Stack) -> bool {
        let mut next = None;
        if self.next & LEAF == 0 {
            let node = &mesh.nodes[self.next as usize];
            next = open(node, &self.test, self.limit, stack, &mut self.height);
        } else {
            let mut leaves = OneRay::<V, _, false> {
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
            next = take(stack, &mut self.height, self.limit);
        }
        let Some(word) = next else { return false };
        self.next = word;
        mesh.fetch::<V>(word);
        true
    }
}

impl TriangleMesh {
    /// Traces all rays of a queue, each to the very same result as [`Self::trace`].
    #[inline(always)]
    pub(crate) fn trace_in_turns<V: V8, Q: Queue>(&self, queue: &mut Q) {
        if self.nodes.is_empty() {
            while let Some((ticket, _, max)) = queue.next() {
                queue.done(ticket, Nearest { distance: max, id: u32::MAX });
            }
            return;
        }
        let mut turns: Vec<Slot<V, Q::Ticket>> = Vec::with_capacity(SLOTS);
        while turns.len() < SLOTS {
            let Some((ticket, ray, max)) = queue.next() else { break };
            turns.push(Slot { turn: Turn::new(self, ticket, &ray, max), stack: [0; STACK] });
        }
        while !turns.is_empty() {
            let mut slot = 0;
            while slot < turns.len() {
                let Slot { turn, stack } = &mut turns[slot];
                if turn.step(self, stack) {
                    slot += 1;
                    continue;
                }
                queue.done(turn.ticket, turn.nearest);
                if let Some((ticket, ray, max)) = queue.next() {
                    *turn = Turn::new(self, ticket, &ray, max);
                    slot += 1;
                } else {
                    turns.swap_remove(slot);
                }
            }
        }
    }

    #[inline(always)]
    fn fetch<V: V8>(&self, word: u32) {
        if word & LEAF == 0 {
            V::fetch(&self.nodes[word as usize]);
        } else {
            V::fetch(&self.blocks[crate::bvh::leaf_range(word).0]);
        }
    }
}
