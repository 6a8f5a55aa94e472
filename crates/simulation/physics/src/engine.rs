//! Engines that move the records: physics, or exact motion.

use periplus_geometry::{DVec3, Pose};

use crate::exact::Exact;
use crate::records::{Mark, Records};
use crate::rigid::Rigid;

/// Pose and velocity of a body.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BodyMotion {
    pub(crate) world_from_body: Pose,
    /// Velocity of the body's origin [m/s].
    pub(crate) linear_m_s: DVec3,
    pub(crate) angular_rad_s: DVec3,
}

impl BodyMotion {
    pub(crate) fn resting(world_from_body: Pose) -> Self {
        Self { world_from_body, ..Self::default() }
    }

    /// Returns the velocity of the body's point that is at a position in the world [m/s].
    pub(crate) fn velocity_at(&self, point_m: DVec3) -> DVec3 {
        let arm_m = point_m - self.world_from_body.translation;
        self.linear_m_s + self.angular_rad_s.cross(arm_m)
    }
}

#[derive(Clone)]
pub(crate) enum Engine {
    Rigid(Box<Rigid>),
    Exact(Exact),
}

impl Engine {
    /// Adds the records after a mark.
    pub(crate) fn insert(&mut self, records: &Records, after: Mark) {
        match self {
            Self::Rigid(rigid) => rigid.insert(records, after),
            Self::Exact(exact) => exact.insert(records),
        }
    }

    pub(crate) fn remove(&mut self, records: &Records, model: u32) {
        match self {
            Self::Rigid(rigid) => rigid.remove(records.bodies_of(model)),
            Self::Exact(exact) => exact.forget(model),
        }
    }

    /// Returns `None` for a removed body.
    pub(crate) fn body(&self, records: &Records, body: usize) -> Option<BodyMotion> {
        match self {
            Self::Rigid(rigid) => rigid.body(body),
            Self::Exact(exact) => exact.body(records, body),
        }
    }

    /// Sets the poses of some bodies of a model, at rest.
    pub(crate) fn place(&mut self, records: &Records, model: u32, places: &[(usize, Pose)]) {
        match self {
            Self::Rigid(rigid) => rigid.place(places),
            Self::Exact(exact) => exact.place(records, model, places),
        }
    }
}
