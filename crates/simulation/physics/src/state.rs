//! Ids and states of a world's parts.

use periplus_geometry::{DVec3, Pose};

/// A model in a world. Ids count in the order of adding and are never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ModelId(pub(crate) u32);

/// A link in a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LinkId(pub(crate) u32);

/// A joint in a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct JointId(pub(crate) u32);

/// Pose and velocity of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkState {
    /// Pose of its frame in the world.
    pub world_from_link: Pose,
    /// Velocity of the frame's origin, in world axes [m/s].
    pub linear_m_s: DVec3,
    /// Angular velocity, in world axes [rad/s].
    pub angular_rad_s: DVec3,
}

impl LinkState {
    /// Returns the velocity of a point of the link, given in the world \[m\]: `v + ω × r` [m/s].
    #[must_use]
    pub fn velocity_at(&self, point_m: DVec3) -> DVec3 {
        self.linear_m_s + self.angular_rad_s.cross(point_m - self.world_from_link.translation)
    }
}

/// Error of a step with a diverged motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Diverged {
    /// Model of the body.
    pub model: Option<ModelId>,
    /// First diverged body, as `model::link`.
    pub link: String,
    /// Simulated time of the step [ns].
    pub time_ns: i64,
    /// Its speed [m/s]; `None` if it is not finite.
    pub speed_m_s: Option<f64>,
}

impl std::fmt::Display for Diverged {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { link, time_ns, speed_m_s, .. } = self;
        let time_s = *time_ns as f64 / 1e9;
        write!(out, "the simulation diverged at {time_s:.3} s: `{link}` ")?;
        match speed_m_s {
            Some(speed) => write!(out, "moves at {speed:.0} m/s")?,
            None => write!(out, "has no finite pose")?,
        }
        write!(out, "; a smaller step, or masses and inertias closer to each other, may help")
    }
}

impl std::error::Error for Diverged {}
