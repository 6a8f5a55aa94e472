//! Names for what is in a world, and what can be asked of it.

use periplus_geometry::{DVec3, Pose};

/// A model in a world. Numbers follow the order of adding and are never used twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ModelId(pub(crate) u32);

/// A link in a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LinkId(pub(crate) u32);

/// A joint in a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct JointId(pub(crate) u32);

/// Where a link is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkState {
    /// Its frame in the world.
    pub world_from_link: Pose,
    /// Velocity of the frame's origin, in world axes [m/s].
    pub linear_m_s: DVec3,
    /// Angular velocity, in world axes [rad/s].
    pub angular_rad_s: DVec3,
}

/// A step whose outcome is no longer a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Diverged {
    /// The model of this body.
    pub model: Option<ModelId>,
    /// The first body concerned, as `model::link`.
    pub link: String,
    /// Simulated time of the step [ns].
    pub time_ns: i64,
    /// Its speed [m/s]; none if it is not a number.
    pub speed_m_s: Option<f64>,
}

impl std::fmt::Display for Diverged {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { link, time_ns, speed_m_s, .. } = self;
        let time_s = *time_ns as f64 / 1e9;
        write!(out, "the simulation diverged at {time_s:.3} s: `{link}` ")?;
        match speed_m_s {
            Some(speed) => write!(out, "moves at {speed:.0} m/s")?,
            None => write!(out, "has no finite pose any more")?,
        }
        write!(out, "; a smaller step, or masses and inertias closer to each other, may help")
    }
}

impl std::error::Error for Diverged {}
