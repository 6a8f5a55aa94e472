//! The way through a tree, nearest first.

use crate::bvh::{LEAF, Node, STACK};
use crate::simd::V8;

/// Where nodes wait: entry distance in the upper half, word in the lower. Distances are not
/// negative, so their bits compare as they do.
pub(crate) type Stack = [u64; STACK];

/// What is tested against boxes: a ray, or several at once.
pub(crate) trait NodeTest<V> {
    /// The children that may be met not farther than `reach`, as bits, and where they are entered.
    fn children(&self, node: &Node, reach: V) -> (u32, V);
}

/// What a leaf says to the walk.
pub(crate) enum Step {
    /// Go on.
    On,
    /// Go on, but not farther than this.
    Within(f32),
    /// Enough.
    Stop,
}

/// What is done with leaves.
pub(crate) trait Leaves {
    /// Looks into the leaf of a word.
    fn visit(&mut self, word: u32) -> Step;
}

/// Shows all leaves that `test` may meet within `limit` to `leaves`.
#[inline(always)]
pub(crate) fn walk<V: V8>(
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
                None => match take(stack, &mut height, limit) {
                    Some(word) => word,
                    None => return,
                },
            };
            if word & LEAF == 0 {
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

/// The child of a node to go on to, the nearest, without a detour through the stack; the others
/// are stacked, the farthest lowest.
#[inline(always)]
pub(crate) fn open<V: V8>(
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
        let mut place = *height;
        while place > bottom && stack[(place - 1) % STACK] < far {
            stack[place % STACK] = stack[(place - 1) % STACK];
            place -= 1;
        }
        stack[place % STACK] = far;
        *height += 1;
    }
    Some(word_of(nearest))
}

/// The next that waits, if it is not too far by now.
#[inline(always)]
pub(crate) fn take(stack: &Stack, height: &mut usize, limit: f32) -> Option<u32> {
    while *height > 0 {
        *height -= 1;
        let key = stack[*height % STACK];
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
