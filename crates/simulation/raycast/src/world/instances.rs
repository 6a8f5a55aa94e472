//! Trees over instances.

use periplus_geometry::DVec3;

use super::Instance;
use crate::bvh::{Bounds, LEAF_MASK, Node, build, leaf_range};

/// Growth of the boxes' area since the tree was built, beyond which it is rebuilt instead of
/// refitted.
const REBUILD_AREA_RATIO: f32 = 1.25;

/// A tree over a subset of a world's instances. Refitting degrades its speed, never its results.
#[derive(Clone, Debug, Default)]
pub(super) struct InstanceTree {
    pub(super) nodes: Vec<Node>,
    /// Instances in the order of the leaves.
    pub(super) order: Vec<u32>,
    /// Total area of all nodes' boxes when the tree was built.
    built_area: f32,
    /// Working memory.
    boxes: Vec<Bounds>,
}

impl InstanceTree {
    /// Replaces the instances, all of which are bounded.
    pub(super) fn rebuild(
        &mut self,
        numbers: impl Iterator<Item = u32>,
        instances: &[Instance],
        middle_m: DVec3,
    ) {
        self.order.clear();
        self.order.extend(numbers);
        self.build(instances, middle_m);
    }

    /// Updates the boxes after instances moved.
    pub(super) fn refit(&mut self, instances: &[Instance], middle_m: DVec3) {
        if self.fit(instances, middle_m) > REBUILD_AREA_RATIO * self.built_area {
            self.build(instances, middle_m);
        }
    }

    pub(super) fn size_bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.order)
    }

    fn build(&mut self, instances: &[Instance], middle_m: DVec3) {
        let bounds = |&number: &u32| bounds(&instances[number as usize], number, middle_m);
        self.boxes.clear();
        self.boxes.extend(self.order.iter().map(bounds));
        self.nodes = build(&mut self.boxes, 1, 1);
        self.order.clear();
        self.order.extend(self.boxes.iter().map(Bounds::number));
        self.built_area = self.fit(instances, middle_m);
    }

    /// Refits all boxes and returns the total area of the nodes' boxes.
    fn fit(&mut self, instances: &[Instance], middle_m: DVec3) -> f32 {
        self.boxes.clear();
        self.boxes.resize(self.nodes.len(), Bounds::EMPTY);
        let mut area = 0.0;
        // Children are stored after their parents.
        for (index, node) in self.nodes.iter_mut().enumerate().rev() {
            let mut whole = Bounds::EMPTY;
            for slot in 0..8 {
                if !node.is_used(slot) {
                    continue;
                }
                let word = node.child(slot);
                let own = if word & LEAF_MASK == 0 {
                    self.boxes[word as usize]
                } else {
                    let (first, _) = leaf_range(word);
                    let number = self.order[first];
                    bounds(&instances[number as usize], number, middle_m)
                };
                node.set(slot, &own, word);
                whole.include(&own);
            }
            area += whole.half_area();
            self.boxes[index] = whole;
        }
        area
    }
}

/// The box around an instance, in the frame of the trees.
fn bounds(instance: &Instance, number: u32, middle_m: DVec3) -> Bounds {
    let (middle, half) = instance.bounds_m.unwrap_or_default();
    let frame = &instance.world_from_body;
    let middle = frame.translation + frame.rotate_into_world(middle) - middle_m;
    let [x, y, z] = frame.columns.map(DVec3::abs);
    let half = x * half.x + y * half.y + z * half.z;
    // Margin for the rounding of the frame, of f32, and of the transform of a ray into the body.
    let half = half + (half + middle.abs()).max_element() * 1e-6 + 1e-9;
    #[expect(clippy::cast_possible_truncation, reason = "there is room for rounding")]
    let to_f32 = |v: DVec3| v.to_array().map(|x| x as f32);
    Bounds::new(to_f32(middle - half), to_f32(middle + half), number)
}
