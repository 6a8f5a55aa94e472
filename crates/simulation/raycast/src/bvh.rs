//! Bounding volume hierarchy with eight children per node.

mod build;

pub(crate) use build::{Bounds, build};

use crate::simd::Row;

/// Bit of a child word that marks a leaf.
pub(crate) const LEAF_MASK: u32 = 1 << 31;
const COUNT_SHIFT_BITS: u32 = 28;
const FIRST_MASK: u32 = (1 << COUNT_SHIFT_BITS) - 1;

/// Maximum number of primitives that a child word can address.
pub(crate) const MAX_PRIMITIVE_COUNT: usize = FIRST_MASK as usize;
/// Maximum number of primitives in a leaf: one vector of triangles.
pub(crate) const MAX_LEAF_TRIANGLES: usize = 8;

/// Maximum depth of a tree: near it, `build` no longer searches for good splits and halves the
/// ranges.
const MAX_DEPTH: usize = 40;
/// Capacity for the siblings of every node on a path, a power of two.
pub(crate) const MAX_STACK_ENTRIES: usize = 512;
const _: () = assert!(MAX_PENDING_CHILD_COUNT <= MAX_STACK_ENTRIES);
/// Maximum number of siblings of the nodes on a path, and of the children of the last.
pub(crate) const MAX_PENDING_CHILD_COUNT: usize = 7 * MAX_DEPTH + 8;

/// A node: rows 0 to 2 the lower, 3 to 5 the upper corners of the children's boxes, row 6 the child
/// words as bits, row 7 for each octant of ray directions the order of the children, the farthest
/// first. Four cache lines.
#[repr(C, align(64))]
#[derive(Clone, Debug)]
pub(crate) struct Node(pub(crate) [Row; 8]);

/// Coordinate of an empty box: far outside, inverted, and finite when multiplied by zero.
const EMPTY_BOX_COORDINATE_M: f32 = 1e30;

impl Node {
    /// A node whose children are never hit.
    pub(crate) const EMPTY: Self = {
        let (low, high) = (Row([EMPTY_BOX_COORDINATE_M; 8]), Row([-EMPTY_BOX_COORDINATE_M; 8]));
        Self([low, low, low, high, high, high, Row([0.0; 8]), Row([0.0; 8])])
    };

    pub(crate) fn set(&mut self, slot: usize, bounds: &Bounds, child: u32) {
        for axis in 0..3 {
            self.0[axis].0[slot] = bounds.low(axis);
            self.0[axis + 3].0[slot] = bounds.high(axis);
        }
        self.0[6].0[slot] = f32::from_bits(child);
    }

    pub(crate) fn child(&self, slot: usize) -> u32 {
        self.0[6].0[slot].to_bits()
    }

    pub(crate) fn set_child(&mut self, slot: usize, child: u32) {
        self.0[6].0[slot] = f32::from_bits(child);
    }

    /// Returns the order of the children for rays of an octant (bit `axis` is set for rays that run
    /// backwards along it): three bits for each position, the farthest child in the lowest.
    #[inline(always)]
    pub(crate) fn order(&self, octant: usize) -> u32 {
        self.0[7].0[octant & 7].to_bits()
    }

    pub(crate) fn set_orders(&mut self, orders: &[[u8; 8]; 8]) {
        for (row, order) in self.0[7].0.iter_mut().zip(orders) {
            let packed =
                order.iter().rev().fold(0_u32, |packed, &slot| packed << 3 | u32::from(slot));
            *row = f32::from_bits(packed);
        }
    }

    pub(crate) fn is_used(&self, slot: usize) -> bool {
        self.0[0].0[slot] <= self.0[3].0[slot]
    }
}

/// Returns the child word of a leaf: `count` (1 to 8) primitives from `first` on.
#[expect(clippy::cast_possible_truncation, reason = "`build` asserts the limits")]
pub(crate) fn leaf(first: usize, count: usize) -> u32 {
    LEAF_MASK | (count as u32 - 1) << COUNT_SHIFT_BITS | first as u32
}

/// Returns the first primitive and the count of a leaf's child word.
#[inline(always)]
pub(crate) fn leaf_range(child: u32) -> (usize, usize) {
    ((child & FIRST_MASK) as usize, ((child >> COUNT_SHIFT_BITS) & 7) as usize + 1)
}
