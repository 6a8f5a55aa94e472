//! Everything rays can meet, in two levels.

mod builder;
mod many;
mod query;

use std::sync::Arc;

use periplus_base::{DVec3, Pose};

pub use builder::{BadInstance, WorldBuilder};

use crate::bvh::{Bounds, Node, build};
use crate::heightfield::Heightfield;
use crate::mesh::TriangleMesh;
use crate::ray::InstanceId;
use crate::shape::Solid;

/// Who sees an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tags {
    /// A ray sees it when its mask and this have a bit in common (SDF `visibility_flags`).
    pub mask: u32,
    /// The link or robot it belongs to, so that a sensor can look past its own; 0 is nobody's.
    pub group: u32,
}

impl Default for Tags {
    fn default() -> Self {
        Self { mask: u32::MAX, group: 0 }
    }
}

/// What rays look for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filter {
    /// Compared with [`Tags::mask`] (SDF `visibility_mask`).
    pub mask: u32,
    /// Instances of this group are not there; 0 is nobody.
    pub except_group: u32,
}

impl Default for Filter {
    fn default() -> Self {
        Self { mask: u32::MAX, except_group: 0 }
    }
}

impl Filter {
    #[inline(always)]
    fn lets_pass(self, tags: Tags) -> bool {
        self.mask & tags.mask != 0 && (tags.group == 0 || tags.group != self.except_group)
    }
}

/// Everything rays can meet: triangles that never move, in one tree, and instances of shapes,
/// meshes and height fields that may, in a small tree over theirs that is made anew when they do.
///
/// Answers do not depend on the number of threads, on the processor, or on whether a ray is asked
/// alone or among others.
#[derive(Clone, Debug)]
pub struct World {
    /// All fixed triangles.
    fixed: TriangleMesh,
    /// For every part of `fixed`, in order: the first triangle, the instance.
    parts: Vec<Part>,
    /// Bits that all parts have.
    parts_mask: u32,
    /// Groups of parts, sorted.
    parts_groups: Vec<u32>,
    /// Instances in the order of their numbers.
    instances: Vec<Instance>,
    /// Over instances with an end; leaves name places in `order`.
    top: Vec<Node>,
    order: Vec<u32>,
    /// Instances without an end.
    endless: Vec<u32>,
    /// Origin of the frame of `top` \[m\].
    middle_m: DVec3,
    boxes: Vec<Bounds>,
}

/// One set of fixed triangles.
#[derive(Clone, Copy, Debug)]
struct Part {
    first: u32,
    instance: u32,
}

/// What an instance is made of.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "most instances are solids, and close at hand")]
enum Body {
    /// Its triangles are part of [`World::fixed`].
    Fixed,
    Solid(Solid),
    Mesh(Arc<TriangleMesh>),
    Heights(Arc<Heightfield>),
}

#[derive(Clone, Debug)]
struct Instance {
    body: Body,
    tags: Tags,
    world_from_body: Frame,
    /// Middle and half sides of the box in the body's frame; `None` when endless.
    bounds_m: Option<(DVec3, DVec3)>,
}

/// A pose as the columns of its rotation matrix.
#[derive(Clone, Copy, Debug)]
struct Frame {
    translation: DVec3,
    columns: [DVec3; 3],
}

impl Frame {
    fn new(pose: &Pose) -> Self {
        Self {
            translation: pose.translation,
            columns: [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| pose.rotation * axis),
        }
    }

    /// From the world into the body.
    #[inline(always)]
    fn unturn(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.columns;
        DVec3::new(x.dot(v), y.dot(v), z.dot(v))
    }

    #[inline(always)]
    fn turn(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.columns;
        x * v.x + y * v.y + z * v.z
    }

    #[inline(always)]
    fn point_in_body(&self, point: DVec3) -> DVec3 {
        self.unturn(point - self.translation)
    }
}

/// An instance that cannot be moved: fixed triangles, or no instance at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotMovable(pub InstanceId);

impl std::fmt::Display for NotMovable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let InstanceId(number) = self.0;
        write!(
            f,
            "instance {number} does not move: add it as a shape or a mesh, not as fixed triangles"
        )
    }
}

impl std::error::Error for NotMovable {}

impl World {
    /// Starts a world.
    #[must_use]
    pub fn builder() -> WorldBuilder {
        WorldBuilder::default()
    }

    /// How many instances there are; their ids count from 0.
    #[must_use]
    pub fn len(&self) -> usize {
        self.instances.len()
    }

    /// Whether there is nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.instances.is_empty()
    }

    /// What trees and fixed triangles take in memory.
    #[must_use]
    pub fn size_bytes(&self) -> usize {
        self.fixed.size_bytes() + size_of_val(&*self.top) + size_of_val(&*self.instances)
    }

    /// Puts instances elsewhere.
    ///
    /// # Errors
    /// When one cannot move; those before it have moved.
    pub fn move_to(&mut self, poses: &[(InstanceId, Pose)]) -> Result<(), NotMovable> {
        let mut result = Ok(());
        for (id, world_from_body) in poses {
            match self.instances.get_mut(id.0 as usize) {
                Some(instance) if !matches!(instance.body, Body::Fixed) => {
                    instance.world_from_body = Frame::new(world_from_body);
                }
                _ => {
                    result = Err(NotMovable(*id));
                    break;
                }
            }
        }
        self.refit();
        result
    }

    /// Makes the top level anew.
    fn refit(&mut self) {
        self.boxes.clear();
        for (number, instance) in (0_u32..).zip(&self.instances) {
            let Some((middle, half)) = instance.bounds_m else { continue };
            let frame = &instance.world_from_body;
            let middle = frame.translation + frame.turn(middle) - self.middle_m;
            let [x, y, z] = frame.columns.map(DVec3::abs);
            let half = x * half.x + y * half.y + z * half.z;
            // Room for the rounding of the frame, of f32, and of a ray's way into the body.
            let half = half + (half + middle.abs()).max_element() * 1e-6 + 1e-9;
            #[expect(clippy::cast_possible_truncation, reason = "there is room for rounding")]
            let single = |v: DVec3| v.to_array().map(|x| x as f32);
            self.boxes.push(Bounds::new(single(middle - half), single(middle + half), number));
        }
        self.top = build(&mut self.boxes, 1, 1);
        self.order.clear();
        self.order.extend(self.boxes.iter().map(Bounds::number));
    }
}
