//! Navigators to a pose and through poses.
//!
//! Source: `nav2_bt_navigator/src/navigators/*.cpp`.

use periplus_behavior_tree::{Blackboard, TreeValue};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::Goals;
use periplus_msgs::nav2_msgs_main::{
    NavigateThroughPoses, NavigateThroughPosesFeedback, NavigateThroughPosesGoal,
    NavigateThroughPosesResult, NavigateToPose, NavigateToPoseFeedback, NavigateToPoseGoal,
    NavigateToPoseResult, WaypointStatus,
};

use super::default_trees::{NAVIGATE_THROUGH_POSES_FILE, NAVIGATE_TO_POSE_FILE};
use super::navigator::{CommonFeedback, GoalError, NavigatorKind, OwnCodes};
use super::parameters::BtNavigatorParams;

/// Navigator to one pose.
pub(super) struct ToPose;

impl NavigatorKind for ToPose {
    type Action = NavigateToPose;
    const NAME: &'static str = "navigate_to_pose";
    const DEFAULT_FILE: &'static str = NAVIGATE_TO_POSE_FILE;
    const CODES: OwnCodes = OwnCodes {
        unknown: NavigateToPoseResult::UNKNOWN,
        failed_to_load: NavigateToPoseResult::FAILED_TO_LOAD_BEHAVIOR_TREE,
        tf_error: NavigateToPoseResult::TF_ERROR,
    };

    fn default_tree(params: &BtNavigatorParams) -> &str {
        &params.default_nav_to_pose_bt_xml
    }

    fn entries(params: &BtNavigatorParams) -> (&str, &str, f64) {
        let tracking = &params.to_pose_tracking_feedback_blackboard_id;
        (&params.to_pose_path_blackboard_id, tracking, params.to_pose_search_window_m)
    }

    fn tree_name(goal: &NavigateToPoseGoal) -> &str {
        &goal.behavior_tree
    }

    fn poses(goal: &NavigateToPoseGoal) -> &[PoseStamped] {
        std::slice::from_ref(&goal.pose)
    }

    fn entries_of_goal(
        params: &BtNavigatorParams,
        _: &NavigateToPoseGoal,
        poses: Vec<PoseStamped>,
    ) -> Vec<(String, TreeValue)> {
        let pose = poses.into_iter().next().unwrap_or_default();
        vec![(params.goal_blackboard_id.clone(), TreeValue::object(pose))]
    }

    fn feedback(
        _: &BtNavigatorParams,
        common: CommonFeedback,
        _: &Blackboard,
    ) -> NavigateToPoseFeedback {
        NavigateToPoseFeedback {
            current_pose: common.current_pose,
            navigation_time: common.navigation_time,
            estimated_time_remaining: common.estimated_time_remaining,
            number_of_recoveries: common.number_of_recoveries,
            distance_remaining: common.distance_remaining,
            position_tracking_error: common.position_tracking_error,
            heading_tracking_error: common.heading_tracking_error,
        }
    }

    fn result(
        _: &BtNavigatorParams,
        (error_code, error_msg): GoalError,
        _: Option<&Blackboard>,
        _: bool,
    ) -> NavigateToPoseResult {
        NavigateToPoseResult { error_code, error_msg }
    }
}

/// Navigator through several poses.
pub(super) struct ThroughPoses;

fn waypoints(params: &BtNavigatorParams, blackboard: &Blackboard) -> Vec<WaypointStatus> {
    let entry = blackboard.get(&params.waypoint_statuses_blackboard_id);
    entry.and_then(|value| value.get::<Vec<WaypointStatus>>()).cloned().unwrap_or_default()
}

impl NavigatorKind for ThroughPoses {
    type Action = NavigateThroughPoses;
    const NAME: &'static str = "navigate_through_poses";
    const DEFAULT_FILE: &'static str = NAVIGATE_THROUGH_POSES_FILE;
    const CODES: OwnCodes = OwnCodes {
        unknown: NavigateThroughPosesResult::UNKNOWN,
        failed_to_load: NavigateThroughPosesResult::FAILED_TO_LOAD_BEHAVIOR_TREE,
        tf_error: NavigateThroughPosesResult::TF_ERROR,
    };

    fn default_tree(params: &BtNavigatorParams) -> &str {
        &params.default_nav_through_poses_bt_xml
    }

    fn entries(params: &BtNavigatorParams) -> (&str, &str, f64) {
        let tracking = &params.through_poses_tracking_feedback_blackboard_id;
        (&params.through_poses_path_blackboard_id, tracking, params.through_poses_search_window_m)
    }

    fn tree_name(goal: &NavigateThroughPosesGoal) -> &str {
        &goal.behavior_tree
    }

    fn poses(goal: &NavigateThroughPosesGoal) -> &[PoseStamped] {
        &goal.poses.goals
    }

    fn entries_of_goal(
        params: &BtNavigatorParams,
        goal: &NavigateThroughPosesGoal,
        poses: Vec<PoseStamped>,
    ) -> Vec<(String, TreeValue)> {
        let status = |(index, pose): (usize, &PoseStamped)| WaypointStatus {
            waypoint_index: u32::try_from(index).unwrap_or(u32::MAX),
            waypoint_pose: pose.clone(),
            ..WaypointStatus::default()
        };
        let statuses: Vec<WaypointStatus> = poses.iter().enumerate().map(status).collect();
        let goals = Goals { header: goal.poses.header.clone(), goals: poses };
        vec![
            (params.goals_blackboard_id.clone(), TreeValue::object(goals)),
            (params.waypoint_statuses_blackboard_id.clone(), TreeValue::object(statuses)),
        ]
    }

    fn feedback(
        params: &BtNavigatorParams,
        common: CommonFeedback,
        blackboard: &Blackboard,
    ) -> NavigateThroughPosesFeedback {
        let goals = blackboard.get(&params.goals_blackboard_id);
        let remaining = goals.and_then(|value| value.get::<Goals>()).map_or(0, |it| it.goals.len());
        NavigateThroughPosesFeedback {
            current_pose: common.current_pose,
            navigation_time: common.navigation_time,
            estimated_time_remaining: common.estimated_time_remaining,
            number_of_recoveries: common.number_of_recoveries,
            distance_remaining: common.distance_remaining,
            position_tracking_error: common.position_tracking_error,
            heading_tracking_error: common.heading_tracking_error,
            number_of_poses_remaining: i16::try_from(remaining).unwrap_or(i16::MAX),
            waypoint_statuses: waypoints(params, blackboard),
        }
    }

    fn result(
        params: &BtNavigatorParams,
        (error_code, error_msg): GoalError,
        blackboard: Option<&Blackboard>,
        is_success: bool,
    ) -> NavigateThroughPosesResult {
        let mut waypoint_statuses =
            blackboard.map(|blackboard| waypoints(params, blackboard)).unwrap_or_default();
        let end = if is_success { WaypointStatus::COMPLETED } else { WaypointStatus::FAILED };
        for status in &mut waypoint_statuses {
            if status.waypoint_status == WaypointStatus::PENDING {
                status.waypoint_status = end;
            }
        }
        NavigateThroughPosesResult { error_code, error_msg, waypoint_statuses }
    }
}
