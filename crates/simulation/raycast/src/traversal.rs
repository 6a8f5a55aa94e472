//! Traversal of a tree, nearest first.

use crate::bvh::{LEAF_MASK, MAX_PENDING_CHILD_COUNT, MAX_STACK_ENTRIES, Node};
use crate::simd::V8;

/// Stack of pending nodes: entry distance in the upper half, child word in the lower. Distances are
/// not negative, so their bits compare in the same order.
pub(crate) type Stack = [u64; MAX_STACK_ENTRIES];

/// Pending children of one ray, the nearest last, with their entry distances. Eight entries are written
/// at a time, wherever the stack ends.
pub(crate) struct PendingChildren {
    pub(crate) distances: [f32; MAX_PENDING_CHILD_COUNT + 8],
    pub(crate) words: [u32; MAX_PENDING_CHILD_COUNT + 8],
    pub(crate) height: usize,
}

impl PendingChildren {
    pub(crate) const EMPTY: Self = Self {
        distances: [0.0; MAX_PENDING_CHILD_COUNT + 8],
        words: [0; MAX_PENDING_CHILD_COUNT + 8],
        height: 0,
    };

    /// Starts with the root only.
    #[inline(always)]
    pub(crate) fn restart(&mut self) {
        (self.distances[0], self.words[0], self.height) = (0.0, 0, 1);
    }

    /// Removes the last child and returns its word.
    #[inline(always)]
    pub(crate) fn pop(&mut self) -> u32 {
        self.height = self.height.wrapping_sub(1).min(MAX_PENDING_CHILD_COUNT);
        self.words[self.height]
    }

    #[inline(always)]
    pub(crate) fn last(&self) -> LastChild {
        let word = self.words[self.height.wrapping_sub(1).min(MAX_PENDING_CHILD_COUNT)];
        LastChild { word, exists: self.height > 0 }
    }
}

/// The child to be visited next. Its kind is asked for without branches.
#[derive(Clone, Copy)]
pub(crate) struct LastChild {
    /// Word of the child, any word if there is none.
    pub(crate) word: u32,
    exists: bool,
}

impl LastChild {
    #[inline(always)]
    pub(crate) fn is_node(self) -> bool {
        self.exists & (self.word & LEAF_MASK == 0)
    }

    #[inline(always)]
    pub(crate) fn is_none(self) -> bool {
        !self.exists
    }
}

/// A ray or packet that is tested against boxes.
pub(crate) trait NodeTest<V> {
    /// Returns the children that may be hit within `reach` as bits, and their entry distances.
    fn children(&self, node: &Node, reach: V) -> (u32, V);
}

/// Instruction of a leaf visitor to the traversal.
pub(crate) enum Step {
    /// Continue.
    On,
    /// Continue up to this distance.
    Within(f32),
    /// Stop.
    Stop,
}

/// Visitor of leaves.
pub(crate) trait Leaves {
    /// Visits the leaf of a child word.
    fn visit(&mut self, word: u32) -> Step;
}

/// Passes all leaves that `test` may hit within `limit` to `leaves`.
#[inline(always)]
pub(crate) fn traverse<V: V8>(
    nodes: &[Node],
    test: &impl NodeTest<V>,
    mut limit: f32,
    stack: &mut Stack,
    leaves: &mut impl Leaves,
) {
    let Some(mut node) = nodes.first() else { return };
    let mut height = 0_usize;
    loop {
        let mut next = open(node, test, limit, stack, &mut height);
        node = loop {
            let word = match next.take() {
                Some(word) => word,
                None => match pop(stack, &mut height, limit) {
                    Some(word) => word,
                    None => return,
                },
            };
            if word & LEAF_MASK == 0 {
                break &nodes[word as usize];
            }
            match leaves.visit(word) {
                Step::On => {}
                Step::Within(nearer) => limit = nearer,
                Step::Stop => return,
            }
        };
    }
}

/// Returns the nearest child of a node, without a detour through the stack, and pushes the others,
/// the farthest first.
#[inline(always)]
fn open<V: V8>(
    node: &Node,
    test: &impl NodeTest<V>,
    limit: f32,
    stack: &mut Stack,
    height: &mut usize,
) -> Option<u32> {
    let (mut hits, enter) = test.children(node, V::splat(limit));
    if hits == 0 {
        return None;
    }
    let words = &node.0[6];
    let first = hits.trailing_zeros() as usize & 7;
    hits &= hits - 1;
    if hits == 0 {
        return Some(words.0[first].to_bits());
    }
    let enter = enter.store();
    let key =
        |slot: usize| u64::from(enter.0[slot].to_bits()) << 32 | u64::from(words.0[slot].to_bits());
    let mut nearest = key(first);
    let bottom = *height;
    while hits != 0 {
        let slot = hits.trailing_zeros() as usize & 7;
        hits &= hits - 1;
        let own = key(slot);
        let (near, far) = if own < nearest { (own, nearest) } else { (nearest, own) };
        nearest = near;
        let mut index = *height;
        while index > bottom && stack[(index - 1) % MAX_STACK_ENTRIES] < far {
            stack[index % MAX_STACK_ENTRIES] = stack[(index - 1) % MAX_STACK_ENTRIES];
            index -= 1;
        }
        stack[index % MAX_STACK_ENTRIES] = far;
        *height += 1;
    }
    Some(word_of(nearest))
}

/// Pops the next node that is within the limit.
#[inline(always)]
fn pop(stack: &Stack, height: &mut usize, limit: f32) -> Option<u32> {
    while *height > 0 {
        *height -= 1;
        let key = stack[*height % MAX_STACK_ENTRIES];
        if f32::from_bits((key >> 32) as u32) <= limit {
            return Some(word_of(key));
        }
    }
    None
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the lower half")]
fn word_of(key: u64) -> u32 {
    key as u32
}
