//! Moving, adding and taking away.

use std::fmt;
use std::sync::Arc;

use periplus_geometry::Pose;

use super::{BadInstance, Body, Frame, Part, State, World, WorldBuilder};
use crate::mesh::{MeshError, TriangleMesh};
use crate::ray::InstanceId;

/// Why a world stays as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BadChange {
    /// There is no such instance, or none any more.
    NoSuchInstance(InstanceId),
    /// Fixed triangles do not move.
    Fixed(InstanceId),
    /// The new pose of this one has numbers that are not finite.
    Pose(InstanceId),
}

impl fmt::Display for BadChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchInstance(InstanceId(number)) => {
                write!(f, "there is no instance {number}: never was, or it was taken away")
            }
            Self::Fixed(InstanceId(number)) => write!(
                f,
                "instance {number} does not move: add it as a shape or a mesh, not as fixed triangles"
            ),
            Self::Pose(InstanceId(number)) => {
                write!(f, "the new pose of instance {number} is not finite")
            }
        }
    }
}

impl std::error::Error for BadChange {}

impl World {
    /// Puts instances elsewhere. What stays where it is costs nothing; what moves for the first
    /// time costs a new tree over all that rest.
    ///
    /// # Errors
    /// When one cannot be moved so; then none has moved.
    pub fn move_to(&mut self, poses: &[(InstanceId, Pose)]) -> Result<(), BadChange> {
        for &(id, ref world_from_body) in poses {
            if self.state(id)? == State::Pinned {
                return Err(BadChange::Fixed(id));
            }
            if !world_from_body.is_finite() {
                return Err(BadChange::Pose(id));
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
                started |= instance.state == State::Resting;
                instance.state = State::Moving;
            }
        }
        if started {
            self.plant();
        } else if moved {
            self.moving.refit(&self.instances, self.middle_m);
        }
        Ok(())
    }

    /// Adds what `more` has collected. The ids that it gave count on from the one returned: the
    /// third of them is `InstanceId(returned.0 + 2)`. Trees of fixed triangles stay as they are;
    /// those in `more` get trees of their own.
    ///
    /// # Errors
    /// When there are too many instances or triangles; then nothing is added.
    pub fn insert(
        &mut self,
        more: WorldBuilder,
        threads: usize,
    ) -> Result<InstanceId, BadInstance> {
        let too_many = BadInstance::Mesh(MeshError::TooMany);
        let WorldBuilder { instances: mut added, positions_m, triangles, parts, starts } = more;
        let first = u32::try_from(self.instances.len()).map_err(|_| too_many)?;
        u32::try_from(self.instances.len() + added.len()).map_err(|_| too_many)?;
        for (place, part) in parts.iter().enumerate() {
            let next = parts.get(place + 1).map_or(triangles.len(), |part| part.first as usize);
            let offset = starts[place];
            let end = starts.get(place + 1).map_or(positions_m.len(), |&start| start as usize);
            let corners: Vec<[u32; 3]> = triangles[part.first as usize..next]
                .iter()
                .map(|triangle| triangle.map(|corner| corner - offset))
                .collect();
            let mesh = TriangleMesh::new(&positions_m[offset as usize..end], &corners, threads)
                .map_err(BadInstance::Mesh)?;
            let instance = &mut added[part.instance as usize];
            instance.bounds_m = Some(mesh.bounds_m());
            instance.world_from_body = Frame::new(&Pose::IDENTITY);
            instance.body = Body::Mesh(Arc::new(mesh));
        }
        self.instances.append(&mut added);
        self.plant();
        Ok(InstanceId(first))
    }

    /// Takes instances away. Their ids are never given again.
    ///
    /// # Errors
    /// When one is not there, or named twice; then all stay.
    pub fn remove(&mut self, ids: &[InstanceId]) -> Result<(), BadChange> {
        let mut sorted = ids.to_vec();
        sorted.sort_unstable();
        for (place, &id) in sorted.iter().enumerate() {
            self.state(id)?;
            if sorted.get(place + 1) == Some(&id) {
                return Err(BadChange::NoSuchInstance(id));
            }
        }
        for id in ids {
            let instance = &mut self.instances[id.0 as usize];
            instance.state = State::Gone;
            instance.bounds_m = None;
            // Sets the memory of a mesh free, too.
            let body = std::mem::replace(&mut instance.body, Body::Fixed);
            if let Body::Fixed = body {
                let place = self.parts.partition_point(|part| part.instance < id.0);
                let first = self.parts[place].first;
                let after = self.parts.get(place + 1).map(|part| part.first);
                let count = u32::try_from(self.fixed.len()).unwrap_or(u32::MAX);
                self.fixed.erase(first..after.unwrap_or(count));
            }
        }
        self.survey_parts();
        self.plant();
        Ok(())
    }

    fn state(&self, id: InstanceId) -> Result<State, BadChange> {
        match self.instances.get(id.0 as usize) {
            Some(instance) if instance.state != State::Gone => Ok(instance.state),
            _ => Err(BadChange::NoSuchInstance(id)),
        }
    }

    /// Sorts instances into their trees.
    pub(super) fn plant(&mut self) {
        let Self { instances, resting, moving, endless, middle_m, .. } = self;
        let all = || (0_u32..).zip(instances.iter());
        let with_end = |moving: bool| {
            all()
                .filter(move |(_, each)| {
                    each.bounds_m.is_some() && (each.state == State::Moving) == moving
                })
                .map(|(number, _)| number)
        };
        resting.plant(with_end(false), instances, *middle_m);
        moving.plant(with_end(true), instances, *middle_m);
        endless.clear();
        let is_endless = |body: &Body| !matches!(body, Body::Fixed);
        endless.extend(
            all()
                .filter(|(_, each)| each.bounds_m.is_none() && is_endless(&each.body))
                .map(|(number, _)| number),
        );
    }

    /// Who sees the fixed triangles.
    pub(super) fn survey_parts(&mut self) {
        let instance = |part: &Part| &self.instances[part.instance as usize];
        let there =
            || self.parts.iter().map(instance).filter(|instance| instance.state != State::Gone);
        self.parts_mask = there().fold(u32::MAX, |mask, instance| mask & instance.tags.mask);
        self.parts_groups =
            there().map(|instance| instance.tags.group).filter(|&group| group != 0).collect();
        self.parts_groups.sort_unstable();
        self.parts_groups.dedup();
    }
}
