//! Everything rays can meet, in two levels.

mod builder;
mod change;
mod company;
mod dark;
mod instances;
mod lanes;
mod many;
mod near;
mod query;
mod shares;

use std::sync::Arc;

use periplus_geometry::{DVec3, Pose};

pub use builder::{BadInstance, WorldBuilder};
pub use change::BadChange;

use self::instances::InstanceTree;
use crate::heightfield::Heightfield;
use crate::mesh::TriangleMesh;
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

/// Everything rays can meet, in three trees: triangles that never move; instances of shapes, meshes
/// and height fields that have not moved yet; and those that have. Only the last is touched when
/// something moves, so a robot costs the same in an empty room and among a thousand walls.
///
/// Answers do not depend on the number of threads, on the processor, on the history of the trees,
/// or on whether a ray is asked alone or among others.
#[derive(Clone, Debug)]
pub struct World {
    /// Triangles fixed from the start.
    fixed: TriangleMesh,
    /// For every part of `fixed`, in order: the first triangle, the instance.
    parts: Vec<Part>,
    /// Bits that all parts have.
    parts_mask: u32,
    /// Groups of parts, sorted.
    parts_groups: Vec<u32>,
    /// Instances in the order of their numbers.
    instances: Vec<Instance>,
    /// Over instances with an end that have not moved.
    resting: InstanceTree,
    /// Over instances with an end that have.
    moving: InstanceTree,
    /// Instances without an end.
    endless: Vec<u32>,
    /// Origin of the frame of the trees over instances \[m\]: that of the fixed triangles.
    middle_m: DVec3,
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
    state: State,
    tags: Tags,
    world_from_body: Frame,
    /// Middle and half sides of the box in the body's frame; `None` when endless.
    bounds_m: Option<(DVec3, DVec3)>,
}

/// What becomes of an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// It cannot move.
    Pinned,
    /// It can, and has not so far.
    Resting,
    Moving,
    /// It was taken away.
    Gone,
}

/// A pose as the columns of its rotation matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
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

impl World {
    /// Starts a world.
    #[must_use]
    pub fn builder() -> WorldBuilder {
        WorldBuilder::default()
    }

    /// How many instances there are, without those taken away.
    #[must_use]
    pub fn len(&self) -> usize {
        self.instances.iter().filter(|instance| instance.state != State::Gone).count()
    }

    /// Whether there is nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.instances.iter().all(|instance| instance.state == State::Gone)
    }

    /// What trees and fixed triangles take in memory.
    #[must_use]
    pub fn size_bytes(&self) -> usize {
        self.fixed.size_bytes()
            + self.resting.size_bytes()
            + self.moving.size_bytes()
            + size_of_val(&*self.instances)
    }
}
