//! Inputs of a steering model: an agent, and its surroundings relative to it.

use glam::DVec2;

/// Another agent or an obstacle that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Neighbour {
    /// Vector from the agent's centre to the nearest point of the other's axis \[m\].
    pub(crate) offset: DVec2,
    /// Velocity \[m/s\].
    pub(crate) velocity: DVec2,
    /// Unit vector in which it wants to walk; zero where that is not known.
    pub(crate) heading: DVec2,
    /// Radius around the axis \[m\].
    pub(crate) radius_m: f64,
    /// Part of the avoidance that the agent does: one half among people, 1 where the other does not avoid.
    pub(crate) share_ratio: f64,
}

/// Centre of the other members of an agent's group, and its size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GroupView {
    /// Vector from the agent to the centre of all members \[m\].
    pub(crate) to_centre: DVec2,
    /// Vector from the agent to the centre of the other members \[m\].
    pub(crate) to_others: DVec2,
    /// Number of members.
    pub(crate) members: usize,
}

/// Agent and surroundings.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Perception<'a> {
    /// Velocity \[m/s\].
    pub(crate) velocity: DVec2,
    /// Radius of the body \[m\].
    pub(crate) radius_m: f64,
    /// Velocity without others \[m/s\].
    pub(crate) preferred: DVec2,
    /// Limit of the speed \[m/s\].
    pub(crate) max_speed_m_per_s: f64,
    /// Other agents and moving obstacles, the nearest first.
    pub(crate) neighbours: &'a [Neighbour],
    /// Vectors to the nearest point of each wall \[m\].
    pub(crate) walls: &'a [DVec2],
    /// Group, where the agent has one.
    pub(crate) group: Option<GroupView>,
    /// Duration of the step \[s\].
    pub(crate) step_s: f64,
}
