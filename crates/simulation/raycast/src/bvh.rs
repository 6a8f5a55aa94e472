//! A tree of boxes, eight to a node.

mod build;

pub(crate) use build::{Bounds, build};

use crate::simd::Row;

/// Marks a child that holds primitives instead of a node.
pub(crate) const LEAF: u32 = 1 << 31;
const COUNT_SHIFT: u32 = 28;
const FIRST_MASK: u32 = (1 << COUNT_SHIFT) - 1;

/// The largest number of primitives that a child word can name.
pub(crate) const MAX_PRIMITIVES: usize = FIRST_MASK as usize;
/// The most primitives in a leaf: one vector of triangles.
pub(crate) const MAX_LEAF: usize = 8;

/// Nodes on the way down are at most this many: see `build`, which stops to look for good splits
/// where a tree gets this deep, and halves.
const MAX_DEPTH: usize = 40;
/// Room for the siblings of every node on the way down, a power of two.
pub(crate) const STACK: usize = 512;
const _: () = assert!(7 * MAX_DEPTH + 8 <= STACK);

/// A node: rows 0 to 2 the lower, 3 to 5 the upper corners of the children's boxes, row 6 the
/// children's words as bits. Four cache lines.
#[repr(C, align(64))]
#[derive(Clone, Debug)]
pub(crate) struct Node(pub(crate) [Row; 8]);

/// Far outside of everything, on the wrong side, and still harmless when multiplied by zero.
const NOWHERE: f32 = 1e30;

impl Node {
    /// A node whose children no ray meets.
    pub(crate) const EMPTY: Self = {
        let (low, high) = (Row([NOWHERE; 8]), Row([-NOWHERE; 8]));
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

    pub(crate) fn is_used(&self, slot: usize) -> bool {
        self.0[0].0[slot] <= self.0[3].0[slot]
    }
}

/// The word of a leaf: `count` (1 to 8) primitives from `first` on.
#[expect(clippy::cast_possible_truncation, reason = "`build` asserts the limits")]
pub(crate) fn leaf(first: usize, count: usize) -> u32 {
    LEAF | (count as u32 - 1) << COUNT_SHIFT | first as u32
}

/// First primitive and count of a leaf's word.
#[inline(always)]
pub(crate) fn leaf_range(child: u32) -> (usize, usize) {
    ((child & FIRST_MASK) as usize, ((child >> COUNT_SHIFT) & 7) as usize + 1)
}
