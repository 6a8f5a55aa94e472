//! Two-level scene of everything that rays can hit.

mod batch;
mod builder;
mod change;
mod instances;
mod lanes;
mod level;
mod occlusion;
mod packet_group;
mod partition;
mod proximity;
mod query;

use std::sync::Arc;

use periplus_geometry::{DVec3, Pose};

pub use builder::{InstanceError, RaycastWorldBuilder};
pub use change::InstanceChangeError;

use self::instances::InstanceTree;
use self::level::LevelTrees;
use crate::heightfield::Heightfield;
use crate::mesh::TriangleMesh;
use crate::shape::Solid;

/// Visibility of an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tags {
    /// An instance is visible to a ray when this and the ray's mask have a bit in common (SDF
    /// `visibility_flags`).
    pub mask: u32,
    /// Link or robot of the instance, so that a sensor can ignore its own robot; 0 means no group.
    pub group: u32,
}

impl Default for Tags {
    fn default() -> Self {
        Self { mask: u32::MAX, group: 0 }
    }
}

/// Visibility filter of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filter {
    /// Compared with [`Tags::mask`] (SDF `visibility_mask`).
    pub mask: u32,
    /// Instances of this group are invisible; 0 excludes none.
    pub except_group: u32,
}

impl Default for Filter {
    fn default() -> Self {
        Self { mask: u32::MAX, except_group: 0 }
    }
}

impl Filter {
    #[inline(always)]
    fn accepts(self, tags: Tags) -> bool {
        self.mask & tags.mask != 0 && (tags.group == 0 || tags.group != self.except_group)
    }
}

/// Everything that rays can hit, in three trees: triangles that never move, instances of shapes,
/// meshes and height fields that have not moved yet, and instances that have moved. Only the last
/// tree is updated when something moves, so a moving robot costs the same in an empty room and among
/// a thousand walls.
///
/// Results do not depend on the number of threads, on the processor, on the history of the trees, or
/// on batching.
#[derive(Clone, Debug)]
pub struct RaycastWorld {
    /// Triangles that never move.
    fixed: TriangleMesh,
    /// Trees over those of them that level rays can meet.
    level: LevelTrees,
    /// First triangle and instance of each part of `fixed`, in order.
    parts: Vec<Part>,
    /// Intersection of the masks of all parts.
    parts_mask: u32,
    /// Groups of the parts, sorted.
    parts_groups: Vec<u32>,
    /// Instances by id.
    instances: Vec<Instance>,
    /// Tree over bounded instances that have not moved.
    resting: InstanceTree,
    /// Tree over bounded instances that have moved.
    moving: InstanceTree,
    /// Unbounded instances.
    endless: Vec<u32>,
    /// Origin of the frame of the instance trees \[m\]: that of the fixed triangles.
    middle_m: DVec3,
}

/// One set of fixed triangles.
#[derive(Clone, Copy, Debug)]
struct Part {
    first: u32,
    instance: u32,
}

/// Geometry of an instance.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "most instances are solids, and close at hand")]
enum InstanceGeometry {
    /// The triangles are part of [`RaycastWorld::fixed`].
    Fixed,
    Solid(Solid),
    Mesh(Arc<TriangleMesh>),
    Heights(Arc<Heightfield>),
}

#[derive(Clone, Debug)]
struct Instance {
    body: InstanceGeometry,
    state: Mobility,
    tags: Tags,
    world_from_body: Frame,
    /// Middle and half extents of the bounding box in the body's frame; `None` when unbounded.
    bounds_m: Option<(DVec3, DVec3)>,
}

/// Mobility of an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mobility {
    /// Cannot move.
    Pinned,
    /// Can move, and has not moved yet.
    Resting,
    Moving,
    /// Removed.
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

    /// Rotates a vector from the world into the body.
    #[inline(always)]
    fn rotate_into_body(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.columns;
        DVec3::new(x.dot(v), y.dot(v), z.dot(v))
    }

    #[inline(always)]
    fn rotate_into_world(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.columns;
        x * v.x + y * v.y + z * v.z
    }

    #[inline(always)]
    fn point_in_body(&self, point: DVec3) -> DVec3 {
        self.rotate_into_body(point - self.translation)
    }
}

impl RaycastWorld {
    /// Returns a builder of a world.
    #[must_use]
    pub fn builder() -> RaycastWorldBuilder {
        RaycastWorldBuilder::default()
    }

    /// Returns the number of instances, without removed ones.
    #[must_use]
    pub fn len(&self) -> usize {
        self.instances.iter().filter(|instance| instance.state != Mobility::Gone).count()
    }

    /// Returns true if there are no instances.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.instances.iter().all(|instance| instance.state == Mobility::Gone)
    }

    /// Returns the memory used by trees and fixed triangles.
    #[must_use]
    pub fn size_bytes(&self) -> usize {
        self.fixed.size_bytes()
            + self.level.size_bytes()
            + self.resting.size_bytes()
            + self.moving.size_bytes()
            + size_of_val(&*self.instances)
    }
}
