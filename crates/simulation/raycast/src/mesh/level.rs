//! The part of a mesh that level rays can meet: triangles that reach into a slab between two heights.

use super::{Block, TriangleMesh, assemble, bounds};
use crate::bvh::{Bounds, MAX_LEAF_TRIANGLES, build};
use crate::local_ray::ROUNDING_RATIO;

impl TriangleMesh {
    /// Returns the largest absolute coordinate along x and y in the tree's frame \[m\], rounded up.
    #[expect(clippy::cast_possible_truncation, reason = "with room for rounding")]
    pub(crate) fn half_width(&self) -> f32 {
        let half = (self.high_m - self.low_m) * 0.5;
        half.x.max(half.y) as f32 * (1.0 + 4.0 * ROUNDING_RATIO)
    }

    /// Returns the largest absolute coordinate along z in the tree's frame \[m\].
    pub(crate) fn half_height_m(&self) -> f64 {
        (self.high_m.z - self.low_m.z) * 0.5
    }

    /// Returns the triangles that reach into `low..=high` along z (tree's frame \[m\]), with their
    /// numbers, in a separate tree; `None` if they are more than `max_count`.
    ///
    /// A ray that stays within the slab, less a margin of `64 * ROUNDING_RATIO` of the lengths
    /// involved, finds in it what it finds in the whole mesh, to the bit: the triangles are the same
    /// numbers in the same test, and that test, whose error is a fraction of the margin, accepts none
    /// of those left out. The boxes of the tree are endless along z, so that the heuristic of its
    /// construction is the one for two dimensions: probabilities in proportion to circumferences.
    pub(crate) fn level(&self, low: f32, high: f32, max_count: usize) -> Option<Self> {
        let middle = 0.5 * (low + high);
        let height = 8.0 * self.half_width() + (high - low);
        let mut boxes = Vec::new();
        let mut places = Vec::new();
        for (index, block) in self.blocks.iter().enumerate() {
            for lane in 0..MAX_LEAF_TRIANGLES {
                if block.id(lane) == u32::MAX {
                    break;
                }
                let [a, b, c] = [0, 1, 2].map(|corner: usize| block.corners[corner][2].0[lane]);
                let above = (a > high) & (b > high) & (c > high);
                let below = (a < low) & (b < low) & (c < low);
                if above | below {
                    continue;
                }
                if boxes.len() == max_count {
                    return None;
                }
                #[expect(clippy::cast_possible_truncation, reason = "fewer than 2²⁸ triangles")]
                let number = boxes.len() as u32;
                let (own, _) = bounds(block.triangle(lane), number);
                let (mut low, mut high) = ([0.0; 3], [0.0; 3]);
                for axis in 0..2 {
                    (low[axis], high[axis]) = (own.low(axis), own.high(axis));
                }
                (low[2], high[2]) = (middle - height, middle + height);
                boxes.push(Bounds::new(low, high, number));
                places.push((index, lane));
            }
        }
        let mut nodes = build(&mut boxes, MAX_LEAF_TRIANGLES, 1);
        let triangle = |number: u32| {
            let (index, lane) = places[number as usize];
            let block: &Block = &self.blocks[index];
            (block.id(lane), block.triangle(lane))
        };
        let blocks = assemble(&mut nodes, &boxes, triangle);
        Some(Self { nodes, blocks, slots: Vec::new(), ..*self })
    }
}
