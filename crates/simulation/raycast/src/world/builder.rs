//! Builder of worlds.

use std::fmt;
use std::sync::Arc;

use periplus_geometry::{DVec3, Pose};

use super::instances::InstanceTree;
use super::level::LevelTrees;
use super::{Frame, Instance, InstanceGeometry, Mobility, Part, RaycastWorld, Tags};
use crate::heightfield::Heightfield;
use crate::mesh::{TriangleMesh, TriangleMeshError};
use crate::ray::InstanceId;
use crate::shape::{RaycastShape, ShapeSizeError, Solid};

/// Collects the instances of a [`RaycastWorld`], or instances to insert into one. Ids count in the order of
/// adding.
#[derive(Clone, Debug, Default)]
pub struct RaycastWorldBuilder {
    pub(super) instances: Vec<Instance>,
    pub(super) positions_m: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) parts: Vec<Part>,
    /// Index of the first position of each part.
    pub(super) starts: Vec<u32>,
}

/// Reasons that an instance cannot be added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InstanceError {
    /// The pose is not finite.
    Pose,
    /// A shape with an invalid size.
    Size(ShapeSizeError),
    /// Triangles that cannot form a mesh.
    Mesh(TriangleMeshError),
}

impl fmt::Display for InstanceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pose => write!(f, "the pose is not finite"),
            Self::Size(error) => error.fmt(f),
            Self::Mesh(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for InstanceError {}

impl RaycastWorldBuilder {
    /// Adds triangles that never move: the fastest to trace.
    ///
    /// # Errors
    /// When the pose, a position or a corner is invalid.
    pub fn add_fixed(
        &mut self,
        positions_m: &[[f64; 3]],
        triangles: &[[u32; 3]],
        world_from_body: &Pose,
        tags: Tags,
    ) -> Result<InstanceId, InstanceError> {
        if !world_from_body.is_finite() {
            return Err(InstanceError::Pose);
        }
        let known = |t: &[u32; 3]| t.iter().all(|&corner| (corner as usize) < positions_m.len());
        if let Some(triangle) = triangles.iter().position(|t| !known(t)) {
            return Err(InstanceError::Mesh(TriangleMeshError::NoSuchCorner { triangle }));
        }
        let usable = |p: &[f64; 3]| p.iter().all(|x| x.abs() < 1e11);
        if let Some(position) = positions_m.iter().position(|p| !usable(p)) {
            return Err(InstanceError::Mesh(TriangleMeshError::BadPosition { position }));
        }
        let (Ok(offset), Ok(first)) =
            (u32::try_from(self.positions_m.len()), u32::try_from(self.triangles.len()))
        else {
            return Err(InstanceError::Mesh(TriangleMeshError::TooMany));
        };
        if u32::try_from(self.positions_m.len() + positions_m.len()).is_err() {
            return Err(InstanceError::Mesh(TriangleMeshError::TooMany));
        }
        let here = *world_from_body == Pose::IDENTITY;
        self.positions_m.extend(positions_m.iter().map(|&p| {
            if here { p } else { world_from_body.transform_point(DVec3::from_array(p)).to_array() }
        }));
        self.triangles.extend(triangles.iter().map(|t| t.map(|corner| corner + offset)));
        let id = self.push(InstanceGeometry::Fixed, world_from_body, tags, None)?;
        self.parts.push(Part { first, instance: id.0 });
        self.starts.push(offset);
        Ok(id)
    }

    /// Adds a mesh that can move and that instances can share.
    ///
    /// # Errors
    /// When the pose is invalid.
    pub fn add_mesh(
        &mut self,
        mesh: Arc<TriangleMesh>,
        world_from_body: &Pose,
        tags: Tags,
    ) -> Result<InstanceId, InstanceError> {
        let bounds = mesh.bounds_m();
        self.push(InstanceGeometry::Mesh(mesh), world_from_body, tags, Some(bounds))
    }

    /// Adds a shape that can move.
    ///
    /// # Errors
    /// When the pose or a size is invalid.
    pub fn add_shape(
        &mut self,
        shape: &RaycastShape,
        world_from_body: &Pose,
        tags: Tags,
    ) -> Result<InstanceId, InstanceError> {
        let solid = Solid::new(shape).map_err(InstanceError::Size)?;
        let bounds = Solid::half_extents(shape).map(|half| (DVec3::ZERO, half));
        self.push(InstanceGeometry::Solid(solid), world_from_body, tags, bounds)
    }

    /// Adds a height field that can move.
    ///
    /// # Errors
    /// When the pose is invalid.
    pub fn add_heightfield(
        &mut self,
        heights: Arc<Heightfield>,
        world_from_body: &Pose,
        tags: Tags,
    ) -> Result<InstanceId, InstanceError> {
        let (low, high) = heights.bounds_m();
        let bounds = ((low + high) / 2.0, (high - low) / 2.0);
        self.push(InstanceGeometry::Heights(heights), world_from_body, tags, Some(bounds))
    }

    fn push(
        &mut self,
        body: InstanceGeometry,
        world_from_body: &Pose,
        tags: Tags,
        bounds_m: Option<(DVec3, DVec3)>,
    ) -> Result<InstanceId, InstanceError> {
        if !world_from_body.is_finite() {
            return Err(InstanceError::Pose);
        }
        let number = u32::try_from(self.instances.len())
            .map_err(|_| InstanceError::Mesh(TriangleMeshError::TooMany))?;
        let world_from_body = Frame::new(world_from_body);
        let state =
            if let InstanceGeometry::Fixed = body { Mobility::Pinned } else { Mobility::Resting };
        self.instances.push(Instance { body, state, tags, world_from_body, bounds_m });
        Ok(InstanceId(number))
    }

    /// Builds the trees with this many threads; the result is the same for any number.
    ///
    /// # Errors
    /// When there are too many triangles.
    pub fn build(self, threads: usize) -> Result<RaycastWorld, InstanceError> {
        let fixed = TriangleMesh::new(&self.positions_m, &self.triangles, threads)
            .map_err(InstanceError::Mesh)?;
        let mut world = RaycastWorld {
            middle_m: fixed.middle_m,
            fixed,
            level: LevelTrees::default(),
            parts: self.parts,
            parts_mask: u32::MAX,
            parts_groups: Vec::new(),
            instances: self.instances,
            resting: InstanceTree::default(),
            moving: InstanceTree::default(),
            endless: Vec::new(),
        };
        world.update_part_filter();
        world.rebuild();
        Ok(world)
    }
}
