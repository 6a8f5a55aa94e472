//! The two actions: poses in a frame, and poses on the globe.

use periplus_msgs::Action;
use periplus_msgs::Nav2Action;
use periplus_msgs::geographic_msgs::GeoPose;
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav2_msgs::WaypointStatus;
use periplus_msgs::nav2_msgs_main::{
    FollowGPSWaypoints, FollowGPSWaypointsFeedback, FollowGPSWaypointsGoal,
    FollowGPSWaypointsResult, FollowWaypoints, FollowWaypointsFeedback, FollowWaypointsGoal,
    FollowWaypointsResult,
};

use super::follow::Follower;
use super::node::WaypointFollowerNode;

/// Poses of a goal.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Waypoints {
    /// In a frame.
    Poses(Vec<PoseStamped>),
    /// On the globe; they have to be converted.
    Gps(Vec<GeoPose>),
}

impl Waypoints {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Poses(poses) => poses.len(),
            Self::Gps(poses) => poses.len(),
        }
    }
}

/// A goal of either action.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FollowRequest {
    pub(super) waypoints: Waypoints,
    /// Number of repetitions.
    pub(super) loops: u32,
    /// Index of the first pose.
    pub(super) first: usize,
}

impl FollowRequest {
    /// # Errors
    /// The reason why the goal is rejected.
    pub(super) fn check(&self) -> Result<(), String> {
        let count = self.waypoints.len();
        if count == 0 {
            return Err("it has no waypoints".to_owned());
        }
        if self.first >= count {
            let first = self.first;
            return Err(format!("`goal_index` is {first}, and it has {count} waypoints"));
        }
        Ok(())
    }
}

/// Result of a goal.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct FollowOutcome {
    pub(super) missed: Vec<WaypointStatus>,
    pub(super) code: u16,
    pub(super) text: String,
}

/// An action that follows waypoints.
pub(super) trait FollowAction: Nav2Action + 'static {
    fn follower(state: &mut WaypointFollowerNode) -> &mut Follower<Self>;
    fn request(goal: &<Self as Action>::Goal) -> FollowRequest;
    fn feedback(index: usize) -> <Self as Action>::Feedback;
    fn result(outcome: FollowOutcome) -> <Self as Action>::Result;
}

fn index_of(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

impl FollowAction for FollowWaypoints {
    fn follower(state: &mut WaypointFollowerNode) -> &mut Follower<Self> {
        &mut state.poses
    }

    fn request(goal: &FollowWaypointsGoal) -> FollowRequest {
        FollowRequest {
            waypoints: Waypoints::Poses(goal.poses.clone()),
            loops: goal.number_of_loops,
            first: goal.goal_index as usize,
        }
    }

    fn feedback(index: usize) -> FollowWaypointsFeedback {
        FollowWaypointsFeedback { current_waypoint: index_of(index) }
    }

    fn result(FollowOutcome { missed, code, text }: FollowOutcome) -> FollowWaypointsResult {
        FollowWaypointsResult { missed_waypoints: missed, error_code: code, error_msg: text }
    }
}

impl FollowAction for FollowGPSWaypoints {
    fn follower(state: &mut WaypointFollowerNode) -> &mut Follower<Self> {
        &mut state.gps
    }

    fn request(goal: &FollowGPSWaypointsGoal) -> FollowRequest {
        FollowRequest {
            waypoints: Waypoints::Gps(goal.gps_poses.clone()),
            loops: goal.number_of_loops,
            first: goal.goal_index as usize,
        }
    }

    fn feedback(index: usize) -> FollowGPSWaypointsFeedback {
        FollowGPSWaypointsFeedback { current_waypoint: index_of(index) }
    }

    fn result(FollowOutcome { missed, code, text }: FollowOutcome) -> FollowGPSWaypointsResult {
        let error_code = i16::try_from(code).unwrap_or(i16::MAX);
        FollowGPSWaypointsResult { missed_waypoints: missed, error_code, error_msg: text }
    }
}
