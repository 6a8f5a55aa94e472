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
        let (mut hits, enter) = test.children(node, V::splat(limit));
        // Where to go on: straight to the nearest child, without a detour through the stack.
        let mut next = None;
        if hits != 0 {
            let words = &node.0[6];
            let first = hits.trailing_zeros() as usize & 7;
            hits &= hits - 1;
            if hits == 0 {
                next = Some(words.0[first].to_bits());
            } else {
                let enter = enter.store();
                let key = |slot: usize| {
                    u64::from(enter.0[slot].to_bits()) << 32 | u64::from(words.0[slot].to_bits())
                };
                let mut nearest = key(first);
                let bottom = height;
                while hits != 0 {
                    let slot = hits.trailing_zeros() as usize & 7;
                    hits &= hits - 1;
                    let own = key(slot);
                    let (near, far) = if own < nearest { (own, nearest) } else { (nearest, own) };
                    nearest = near;
                    // The farthest lies lowest.
                    let mut place = height;
                    while place > bottom && stack[(place - 1) % STACK] < far {
                        stack[place % STACK] = stack[(place - 1) % STACK];
                        place -= 1;
                    }
                    stack[place % STACK] = far;
                    height += 1;
                }
                next = Some(word_of(nearest));
            }
        }
        node = loop {
            let word = match next.take() {
                Some(word) => word,
                None => {
                    if height == 0 {
                        return;
                    }
                    height -= 1;
                    let key = stack[height % STACK];
                    if f32::from_bits((key >> 32) as u32) > limit {
                        continue;
                    }
                    word_of(key)
                }
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

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the lower half")]
fn word_of(key: u64) -> u32 {
    key as u32
}
