//! Moving, inserting and removing instances.

use std::fmt;
use std::sync::Arc;

use periplus_geometry::Pose;

use super::{
    Frame, InstanceError, InstanceGeometry, Mobility, Part, RaycastWorld, RaycastWorldBuilder,
};
use crate::mesh::{TriangleMesh, TriangleMeshError};
use crate::ray::InstanceId;

/// Reasons that a change is rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstanceChangeError {
    /// The instance does not exist or was removed.
    NoSuchInstance(InstanceId),
    /// Fixed triangles cannot move.
    Fixed(InstanceId),
    /// The new pose is not finite.
    Pose(InstanceId),
}

impl fmt::Display for InstanceChangeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchInstance(InstanceId(number)) => {
                write!(f, "instance {number} does not exist or was removed")
            }
            Self::Fixed(InstanceId(number)) => write!(
                f,
                "instance {number} cannot move: add it as a shape or a mesh, not as fixed triangles"
            ),
            Self::Pose(InstanceId(number)) => {
                write!(f, "the new pose of instance {number} is not finite")
            }
        }
    }
}

impl std::error::Error for InstanceChangeError {}

impl RaycastWorld {
    /// Moves instances. An instance that stays costs nothing; the first move of an instance rebuilds
    /// the tree over all that have not moved.
    ///
    /// # Errors
    /// When one of the instances cannot be moved; then none moves.
    pub fn move_to(&mut self, poses: &[(InstanceId, Pose)]) -> Result<(), InstanceChangeError> {
        for &(id, ref world_from_body) in poses {
            if self.state(id)? == Mobility::Pinned {
                return Err(InstanceChangeError::Fixed(id));
            }
            if !world_from_body.is_finite() {
                return Err(InstanceChangeError::Pose(id));
            }
        }
        let (mut moved, mut started) = (false, false);
        for (id, world_from_body) in poses {
            let instance = &mut self.instances[id.0 as usize];
            let frame = Frame::new(world_from_body);
            if instance.world_from_body == frame {
                continue;
            }
            instance.world_from_body = frame;
            if instance.bounds_m.is_some() {
                moved = true;
                started |= instance.state == Mobility::Resting;
                instance.state = Mobility::Moving;
            }
        }
        if started {
            self.rebuild();
        } else if moved {
            self.moving.refit(&self.instances, self.middle_m);
        }
        Ok(())
    }

    /// Inserts the instances of `more`. Their ids count on from the returned one: the third is
    /// `InstanceId(returned.0 + 2)`. Trees of fixed triangles do not change; those of `more` get
    /// their own trees.
    ///
    /// # Errors
    /// When there are too many instances or triangles; then nothing is inserted.
    pub fn insert(
        &mut self,
        more: RaycastWorldBuilder,
        threads: usize,
    ) -> Result<InstanceId, InstanceError> {
        let too_many = InstanceError::Mesh(TriangleMeshError::TooMany);
        let RaycastWorldBuilder { instances: mut added, positions_m, triangles, parts, starts } =
            more;
        let first = u32::try_from(self.instances.len()).map_err(|_| too_many)?;
        u32::try_from(self.instances.len() + added.len()).map_err(|_| too_many)?;
        for (index, part) in parts.iter().enumerate() {
            let next = parts.get(index + 1).map_or(triangles.len(), |part| part.first as usize);
            let offset = starts[index];
            let end = starts.get(index + 1).map_or(positions_m.len(), |&start| start as usize);
            let corners: Vec<[u32; 3]> = triangles[part.first as usize..next]
                .iter()
                .map(|triangle| triangle.map(|corner| corner - offset))
                .collect();
            let mesh = TriangleMesh::new(&positions_m[offset as usize..end], &corners, threads)
                .map_err(InstanceError::Mesh)?;
            let instance = &mut added[part.instance as usize];
            instance.bounds_m = Some(mesh.bounds_m());
            instance.world_from_body = Frame::new(&Pose::IDENTITY);
            instance.body = InstanceGeometry::Mesh(Arc::new(mesh));
        }
        self.instances.append(&mut added);
        self.rebuild();
        Ok(InstanceId(first))
    }

    /// Removes instances. Their ids are never reused.
    ///
    /// # Errors
    /// When an instance does not exist or is named twice; then all remain.
    pub fn remove(&mut self, ids: &[InstanceId]) -> Result<(), InstanceChangeError> {
        let mut sorted = ids.to_vec();
        sorted.sort_unstable();
        for (index, &id) in sorted.iter().enumerate() {
            self.state(id)?;
            if sorted.get(index + 1) == Some(&id) {
                return Err(InstanceChangeError::NoSuchInstance(id));
            }
        }
        for id in ids {
            let instance = &mut self.instances[id.0 as usize];
            instance.state = Mobility::Gone;
            instance.bounds_m = None;
            // Releases the memory of a mesh, too.
            let body = std::mem::replace(&mut instance.body, InstanceGeometry::Fixed);
            if let InstanceGeometry::Fixed = body {
                let index = self.parts.partition_point(|part| part.instance < id.0);
                let first = self.parts[index].first;
                let after = self.parts.get(index + 1).map(|part| part.first);
                let count = u32::try_from(self.fixed.len()).unwrap_or(u32::MAX);
                self.fixed.erase(first..after.unwrap_or(count));
                self.level.clear();
            }
        }
        self.update_part_filter();
        self.rebuild();
        Ok(())
    }

    fn state(&self, id: InstanceId) -> Result<Mobility, InstanceChangeError> {
        match self.instances.get(id.0 as usize) {
            Some(instance) if instance.state != Mobility::Gone => Ok(instance.state),
            _ => Err(InstanceChangeError::NoSuchInstance(id)),
        }
    }

    /// Assigns instances to their trees and rebuilds these.
    pub(super) fn rebuild(&mut self) {
        let Self { instances, resting, moving, endless, middle_m, .. } = self;
        let all = || (0_u32..).zip(instances.iter());
        let with_end = |moving: bool| {
            all()
                .filter(move |(_, each)| {
                    each.bounds_m.is_some() && (each.state == Mobility::Moving) == moving
                })
                .map(|(number, _)| number)
        };
        resting.rebuild(with_end(false), instances, *middle_m);
        moving.rebuild(with_end(true), instances, *middle_m);
        endless.clear();
        let is_endless = |body: &InstanceGeometry| !matches!(body, InstanceGeometry::Fixed);
        endless.extend(
            all()
                .filter(|(_, each)| each.bounds_m.is_none() && is_endless(&each.body))
                .map(|(number, _)| number),
        );
    }

    /// Updates the masks and groups of the fixed triangles.
    pub(super) fn update_part_filter(&mut self) {
        let instance = |part: &Part| &self.instances[part.instance as usize];
        let there =
            || self.parts.iter().map(instance).filter(|instance| instance.state != Mobility::Gone);
        self.parts_mask = there().fold(u32::MAX, |mask, instance| mask & instance.tags.mask);
        self.parts_groups =
            there().map(|instance| instance.tags.group).filter(|&group| group != 0).collect();
        self.parts_groups.sort_unstable();
        self.parts_groups.dedup();
    }
}
