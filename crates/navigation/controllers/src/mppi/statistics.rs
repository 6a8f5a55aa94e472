//! Results for publication: samples, optimal trajectory, statistics of the critics.

use periplus_geometry::{Pose2, Twist2};

use super::critics::CriticKind;

/// Statistics of a critic in the last optimization, as in `nav2_msgs/CriticsStats`.
#[derive(Clone, Debug, PartialEq)]
pub struct CriticStatistics {
    /// Critic.
    pub critic: CriticKind,
    /// True if it added costs.
    pub has_changed: bool,
    /// Sum of the added costs over all samples.
    pub costs_sum: f32,
    /// Lowest added cost.
    pub lowest: f32,
    /// Highest added cost.
    pub highest: f32,
}

impl CriticStatistics {
    pub(crate) fn new(critic: CriticKind, added: &[f32]) -> Self {
        let costs_sum: f32 = added.iter().sum();
        let lowest = added.iter().copied().fold(f32::INFINITY, f32::min);
        let highest = added.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        Self { critic, has_changed: costs_sum != 0.0, costs_sum, lowest, highest }
    }
}

/// Trajectory of a sample.
#[derive(Clone, Debug, PartialEq)]
pub struct CandidateTrajectory {
    /// Index of the sample.
    pub sample: usize,
    /// Poses in the frame of the costmap.
    pub poses: Vec<Pose2>,
    /// Cost.
    pub cost: f32,
    /// Cost from 0 for the lowest to 1 for the highest of the samples without a collision; above 1 for others.
    pub relative_cost: f32,
    /// True if it touches an obstacle.
    pub collides: bool,
}

/// Point of the optimal trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MppiTrajectoryPoint {
    /// Time from the start \[s\].
    pub time_s: f64,
    /// Pose in the frame of the costmap.
    pub pose: Pose2,
    /// Velocity in the base frame.
    pub velocity: Twist2,
}
