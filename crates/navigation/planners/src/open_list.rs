//! Priority queue of a search.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Open list: the lowest cost first, and the lowest node among equal costs. A node may be in it several
/// times; the caller skips those that are outdated.
#[derive(Debug, Default)]
pub(crate) struct OpenList {
    heap: BinaryHeap<Reverse<u64>>,
}

impl OpenList {
    pub(crate) fn clear(&mut self) {
        self.heap.clear();
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.heap.is_empty()
    }

    /// Adds a node. The bits of costs that are not negative have their order.
    #[inline]
    pub(crate) fn push(&mut self, cost: f32, node: usize) {
        self.heap.push(Reverse(key(cost, node)));
    }

    /// Removes the node with the lowest cost.
    #[inline]
    pub(crate) fn pop(&mut self) -> Option<(f32, usize)> {
        self.heap.pop().map(|Reverse(key)| parts(key))
    }

    /// Changes the costs of all entries.
    pub(crate) fn reprioritize(&mut self, cost: impl Fn(usize) -> f32) {
        let mut keys = std::mem::take(&mut self.heap).into_vec();
        for Reverse(entry) in &mut keys {
            let (_, node) = parts(*entry);
            *entry = key(cost(node), node);
        }
        self.heap = BinaryHeap::from(keys);
    }
}

fn key(cost: f32, node: usize) -> u64 {
    (u64::from(cost.max(0.0).to_bits()) << 32) | node as u64
}

fn parts(key: u64) -> (f32, usize) {
    (f32::from_bits((key >> 32) as u32), (key & 0xffff_ffff) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_cost_is_first() {
        let mut open = OpenList::default();
        for (cost, node) in [(2.5, 1), (0.0, 7), (2.5, 0), (1.0e9, 3)] {
            open.push(cost, node);
        }
        let order: Vec<usize> = std::iter::from_fn(|| open.pop()).map(|(_, node)| node).collect();
        assert_eq!(order, [7, 0, 1, 3]);
        open.push(1.0, 4);
        open.push(2.0, 5);
        open.reprioritize(|node| 9.0 - node as f32);
        assert_eq!(open.pop(), Some((4.0, 5)));
    }
}
