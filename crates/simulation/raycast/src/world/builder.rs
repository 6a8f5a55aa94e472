//! Filling a world.

use std::fmt;
use std::sync::Arc;

use periplus_geometry::{DVec3, Pose};

use super::instances::InstanceTree;
use super::{Body, Frame, Instance, Part, State, Tags, World};
use crate::heightfield::Heightfield;
use crate::mesh::{MeshError, TriangleMesh};
use crate::ray::InstanceId;
use crate::shape::{BadSize, Shape, Solid};

/// Collects what a [`World`] is made of, or what is added to one. Ids are given in the order of
/// adding.
#[derive(Clone, Debug, Default)]
pub struct WorldBuilder {
    pub(super) instances: Vec<Instance>,
    pub(super) positions_m: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) parts: Vec<Part>,
    /// The first position of every part.
    pub(super) starts: Vec<u32>,
}

/// Why something cannot be part of a world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BadInstance {
    /// The pose has numbers that are not finite.
    Pose,
    /// A shape without a proper size.
    Size(BadSize),
    /// Triangles that make no mesh.
    Mesh(MeshError),
}

impl fmt::Display for BadInstance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pose => write!(f, "the pose is not finite"),
            Self::Size(error) => error.fmt(f),
            Self::Mesh(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for BadInstance {}

impl WorldBuilder {
    /// Triangles that will never move: the fastest to trace.
    ///
    /// # Errors
    /// When the pose, a position or a corner is unusable.
    pub fn add_fixed(
        &mut self,
        positions_m: &[[f64; 3]],
        triangles: &[[u32; 3]],
        world_from_body: &Pose,
        tags: Tags,
    ) -> Result<InstanceId, BadInstance> {
        if !world_from_body.is_finite() {
            return Err(BadInstance::Pose);
        }
        let known = |t: &[u32; 3]| t.iter().all(|&corner| (corner as usize) < positions_m.len());
        if let Some(triangle) = triangles.iter().position(|t| !known(t)) {
            return Err(BadInstance::Mesh(MeshError::NoSuchCorner { triangle }));
        }
        let usable = |p: &[f64; 3]| p.iter().all(|x| x.abs() < 1e11);
        if let Some(position) = positions_m.iter().position(|p| !usable(p)) {
            return Err(BadInstance::Mesh(MeshError::BadPosition { position }));
        }
        let (Ok(offset), Ok(first)) =
            (u32::try_from(self.positions_m.len()), u32::try_from(self.triangles.len()))
        else {
            return Err(BadInstance::Mesh(MeshError::TooMany));
        };
        if u32::try_from(self.positions_m.len() + positions_m.len()).is_err() {
            return Err(BadInstance::Mesh(MeshError::TooMany));
        }
        let here = *world_from_body == Pose::IDENTITY;
        self.positions_m.extend(positions_m.iter().map(|&p| {
            if here { p } else { world_from_body.transform_point(DVec3::from_array(p)).to_array() }
        }));
        self.triangles.extend(triangles.iter().map(|t| t.map(|corner| corner + offset)));
        let id = self.push(Body::Fixed, world_from_body, tags, None)?;
        self.parts.push(Part { first, instance: id.0 });
        self.starts.push(offset);
        Ok(id)
    }

    /// A mesh that may move, and that instances may share.
    ///
    /// # Errors
    /// When the pose is unusable.
    pub fn add_mesh(
        &mut self,
        mesh: Arc<TriangleMesh>,
        world_from_body: &Pose,
        tags: Tags,
    ) -> Result<InstanceId, BadInstance> {
        let bounds = mesh.bounds_m();
        self.push(Body::Mesh(mesh), world_from_body, tags, Some(bounds))
    }

    /// A shape that may move.
    ///
    /// # Errors
    /// When the pose or a size is unusable.
    pub fn add_shape(
        &mut self,
        shape: &Shape,
        world_from_body: &Pose,
        tags: Tags,
    ) -> Result<InstanceId, BadInstance> {
        let solid = Solid::new(shape).map_err(BadInstance::Size)?;
        let bounds = Solid::half_extents(shape).map(|half| (DVec3::ZERO, half));
        self.push(Body::Solid(solid), world_from_body, tags, bounds)
    }

    /// Ground that may move.
    ///
    /// # Errors
    /// When the pose is unusable.
    pub fn add_heightfield(
        &mut self,
        heights: Arc<Heightfield>,
        world_from_body: &Pose,
        tags: Tags,
    ) -> Result<InstanceId, BadInstance> {
        let (low, high) = heights.bounds_m();
        let bounds = ((low + high) / 2.0, (high - low) / 2.0);
        self.push(Body::Heights(heights), world_from_body, tags, Some(bounds))
    }

    fn push(
        &mut self,
        body: Body,
        world_from_body: &Pose,
        tags: Tags,
        bounds_m: Option<(DVec3, DVec3)>,
    ) -> Result<InstanceId, BadInstance> {
        if !world_from_body.is_finite() {
            return Err(BadInstance::Pose);
        }
        let number = u32::try_from(self.instances.len())
            .map_err(|_| BadInstance::Mesh(MeshError::TooMany))?;
        let world_from_body = Frame::new(world_from_body);
        let state = if let Body::Fixed = body { State::Pinned } else { State::Resting };
        self.instances.push(Instance { body, state, tags, world_from_body, bounds_m });
        Ok(InstanceId(number))
    }

    /// Builds the trees with this many threads; the world is the same for any number.
    ///
    /// # Errors
    /// When there are too many triangles.
    pub fn build(self, threads: usize) -> Result<World, BadInstance> {
        let fixed = TriangleMesh::new(&self.positions_m, &self.triangles, threads)
            .map_err(BadInstance::Mesh)?;
        let mut world = World {
            middle_m: fixed.middle_m,
            fixed,
            parts: self.parts,
            parts_mask: u32::MAX,
            parts_groups: Vec::new(),
            instances: self.instances,
            resting: InstanceTree::default(),
            moving: InstanceTree::default(),
            endless: Vec::new(),
        };
        world.survey_parts();
        world.plant();
        Ok(world)
    }
}
