//! Trees over instances.

use periplus_geometry::DVec3;

use super::Instance;
use crate::bvh::{Bounds, LEAF, Node, build, leaf_range};

/// A tree is refitted to instances that move until its boxes have become this much larger than
/// they were when it was built.
const WORN: f32 = 1.25;

/// A tree over some of a world's instances. It can lag behind in quality, never in truth.
#[derive(Clone, Debug, Default)]
pub(super) struct InstanceTree {
    pub(super) nodes: Vec<Node>,
    /// Instances as the leaves name them.
    pub(super) order: Vec<u32>,
    /// Of all nodes' boxes together, when the tree was built.
    built_area: f32,
    /// Room to work in.
    boxes: Vec<Bounds>,
}

impl InstanceTree {
    /// Starts anew with these instances, all of which have an end.
    pub(super) fn plant(
        &mut self,
        numbers: impl Iterator<Item = u32>,
        instances: &[Instance],
        middle_m: DVec3,
    ) {
        self.order.clear();
        self.order.extend(numbers);
        self.build(instances, middle_m);
    }

    /// After instances moved.
    pub(super) fn refit(&mut self, instances: &[Instance], middle_m: DVec3) {
        if self.fit(instances, middle_m) > WORN * self.built_area {
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

    /// Makes all boxes fit; gives the area of all nodes' boxes together.
    fn fit(&mut self, instances: &[Instance], middle_m: DVec3) -> f32 {
        self.boxes.clear();
        self.boxes.resize(self.nodes.len(), Bounds::EMPTY);
        let mut area = 0.0;
        // Children come after their parents.
        for (index, node) in self.nodes.iter_mut().enumerate().rev() {
            let mut whole = Bounds::EMPTY;
            for slot in 0..8 {
                if !node.is_used(slot) {
                    continue;
                }
                let word = node.child(slot);
                let own = if word & LEAF == 0 {
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
    let middle = frame.translation + frame.turn(middle) - middle_m;
    let [x, y, z] = frame.columns.map(DVec3::abs);
    let half = x * half.x + y * half.y + z * half.z;
    // Room for the rounding of the frame, of f32, and of a ray's way into the body.
    let half = half + (half + middle.abs()).max_element() * 1e-6 + 1e-9;
    #[expect(clippy::cast_possible_truncation, reason = "there is room for rounding")]
    let single = |v: DVec3| v.to_array().map(|x| x as f32);
    Bounds::new(single(middle - half), single(middle + half), number)
}
