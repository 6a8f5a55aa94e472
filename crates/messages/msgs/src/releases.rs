//! Forms of the actions and services of Nav2 in its releases.
//!
//! Nav2 changed the fields of many actions without changing their names. `nav2_msgs` has the form of
//! Jazzy, `nav2_msgs_humble` that of Humble and `nav2_msgs_main` that of the main branch; types without a
//! difference are the same type in all three. The form of main has the fields of all others, so that
//! nodes work with it alone and convert at the edge:
//!
//! ```
//! use periplus_msgs::nav2_msgs_main::{ComputePathToPose, ComputePathToPoseResult};
//! use periplus_msgs::{Nav2Action, ReleaseForm, nav2_msgs_humble};
//!
//! let mut result = ComputePathToPoseResult::default();
//! result.error_code = ComputePathToPoseResult::NO_VALID_PATH;
//! result.path.poses.resize_with(2, Default::default);
//! type Humble = <ComputePathToPose as Nav2Action>::Humble;
//! let result: nav2_msgs_humble::ComputePathToPoseResult =
//!     <Humble as ReleaseForm<ComputePathToPose>>::result_of_full(result);
//! assert_eq!(result.path.poses.len(), 2);
//! ```

use crate::geometry_msgs::PoseStamped;
use crate::nav_msgs::Goals;
use crate::nav2_msgs::{MissedWaypoint, WaypointStatus};
use crate::{
    Action, Service, nav2_msgs as jazzy, nav2_msgs_humble as humble, nav2_msgs_main as main,
};

/// Action of Nav2, in the form of main, with the forms of other releases.
pub trait Nav2Action: Action + Sized {
    /// Form of Humble.
    type Humble: ReleaseForm<Self>;
    /// Form of Jazzy and Kilted.
    type Jazzy: ReleaseForm<Self>;
}

/// Form of an action in a release. Conversions keep the fields that both forms have; others have their
/// default values.
pub trait ReleaseForm<Full: Action>: Action {
    /// Converts a goal to the full form.
    fn full_goal(goal: Self::Goal) -> Full::Goal;
    /// Converts a goal of the full form.
    fn goal_of_full(full: Full::Goal) -> Self::Goal;
    /// Converts a result to the full form.
    fn full_result(result: Self::Result) -> Full::Result;
    /// Converts a result of the full form.
    fn result_of_full(full: Full::Result) -> Self::Result;
    /// Converts feedback to the full form.
    fn full_feedback(feedback: Self::Feedback) -> Full::Feedback;
    /// Converts feedback of the full form.
    fn feedback_of_full(full: Full::Feedback) -> Self::Feedback;
}

impl<A: Action> ReleaseForm<A> for A {
    fn full_goal(goal: A::Goal) -> A::Goal {
        goal
    }

    fn goal_of_full(full: A::Goal) -> A::Goal {
        full
    }

    fn full_result(result: A::Result) -> A::Result {
        result
    }

    fn result_of_full(full: A::Result) -> A::Result {
        full
    }

    fn full_feedback(feedback: A::Feedback) -> A::Feedback {
        feedback
    }

    fn feedback_of_full(full: A::Feedback) -> A::Feedback {
        full
    }
}

/// Service of Nav2, in the form of main, with the form of the releases up to Kilted.
pub trait Nav2Service: Service + Sized {
    /// Form of Humble, Jazzy and Kilted.
    type Jazzy: Service;
    /// Converts a request to the full form.
    fn full_request(request: <Self::Jazzy as Service>::Request) -> Self::Request;
    /// Converts a request of the full form.
    fn request_of_full(full: Self::Request) -> <Self::Jazzy as Service>::Request;
    /// Converts a response to the full form. A response without `success` is one of success.
    fn full_response(response: <Self::Jazzy as Service>::Response) -> Self::Response;
    /// Converts a response of the full form.
    fn response_of_full(full: Self::Response) -> <Self::Jazzy as Service>::Response;
}

/// Conversion of a field.
trait Recast<T> {
    fn recast(self) -> T;
}

impl<T> Recast<T> for T {
    fn recast(self) -> T {
        self
    }
}

impl Recast<Goals> for Vec<PoseStamped> {
    fn recast(self) -> Goals {
        let header = self.first().map(|pose| pose.header.clone()).unwrap_or_default();
        Goals { header, goals: self }
    }
}

impl Recast<Vec<PoseStamped>> for Goals {
    fn recast(self) -> Vec<PoseStamped> {
        self.goals
    }
}

impl Recast<Vec<WaypointStatus>> for Vec<MissedWaypoint> {
    fn recast(self) -> Vec<WaypointStatus> {
        let status = |missed: MissedWaypoint| WaypointStatus {
            waypoint_status: WaypointStatus::FAILED,
            waypoint_index: missed.index,
            waypoint_pose: missed.goal,
            error_code: missed.error_code,
            ..Default::default()
        };
        self.into_iter().map(status).collect()
    }
}

impl Recast<Vec<MissedWaypoint>> for Vec<WaypointStatus> {
    fn recast(self) -> Vec<MissedWaypoint> {
        let missed = |status: WaypointStatus| MissedWaypoint {
            index: status.waypoint_index,
            goal: status.waypoint_pose,
            error_code: status.error_code,
        };
        self.into_iter().map(missed).collect()
    }
}

impl Recast<Vec<WaypointStatus>> for Vec<i32> {
    fn recast(self) -> Vec<WaypointStatus> {
        let status = |index: i32| WaypointStatus {
            waypoint_status: WaypointStatus::FAILED,
            waypoint_index: u32::try_from(index).unwrap_or_default(),
            ..Default::default()
        };
        self.into_iter().map(status).collect()
    }
}

impl Recast<Vec<i32>> for Vec<WaypointStatus> {
    fn recast(self) -> Vec<i32> {
        self.iter().map(|status| i32::try_from(status.waypoint_index).unwrap_or(i32::MAX)).collect()
    }
}

/// Actions with their forms: `humble jazzy Spin` has its own form in both.
macro_rules! actions {
    ($($name:ident: $humble:ident $jazzy:ident;)*) => {$(
        impl Nav2Action for main::$name {
            type Humble = $humble::$name;
            type Jazzy = $jazzy::$name;
        }
    )*};
}

/// Fields that a form shares with the full one, with their path in the latter if it differs.
macro_rules! forms {
    ($(
        $release:ident $name:ident {
            goal: $($goal:ident),*;
            result: $($result:ident),*;
            feedback: $($feedback:ident $(as $($path:ident).+)?),*;
        }
    )*) => {$(
        impl ReleaseForm<main::$name> for $release::$name {
            forms!(full_goal goal_of_full Goal main::$name: $($goal),*);
            forms!(full_result result_of_full Result main::$name: $($result),*);
            forms!(full_feedback feedback_of_full Feedback main::$name:
                $($feedback $(as $($path).+)?),*);
        }
    )*};
    ($to:ident $from:ident $part:ident $full:ty: $($field:ident $(as $($path:ident).+)?),*) => {
        #[allow(unused_mut, unused_variables, reason = "a part may have no fields")]
        fn $to(form: Self::$part) -> <$full as Action>::$part {
            let mut full = <$full as Action>::$part::default();
            $(forms!(@path full $field $(as $($path).+)?) = form.$field.recast();)*
            full
        }

        #[allow(unused_mut, unused_variables, reason = "a part may have no fields")]
        fn $from(full: <$full as Action>::$part) -> Self::$part {
            let mut form = Self::$part::default();
            $(form.$field = forms!(@path full $field $(as $($path).+)?).recast();)*
            form
        }
    };
    (@path $full:ident $field:ident) => { $full.$field };
    (@path $full:ident $field:ident as $($path:ident).+) => { $full.$($path).+ };
}

/// Services with the fields that both forms share.
macro_rules! services {
    ($($name:ident { request: $($request:ident),*; response: $($response:ident),*; })*) => {$(
        impl Nav2Service for main::$name {
            type Jazzy = jazzy::$name;

            #[allow(unused_mut, unused_variables, reason = "a part may have no fields")]
            fn full_request(form: <jazzy::$name as Service>::Request) -> Self::Request {
                let mut full = Self::Request::default();
                $(full.$request = form.$request;)*
                full
            }

            #[allow(unused_mut, unused_variables, reason = "a part may have no fields")]
            fn request_of_full(full: Self::Request) -> <jazzy::$name as Service>::Request {
                let mut form = <jazzy::$name as Service>::Request::default();
                $(form.$request = full.$request;)*
                form
            }

            #[allow(unused_variables, reason = "a part may have no fields")]
            fn full_response(form: <jazzy::$name as Service>::Response) -> Self::Response {
                let mut full = Self::Response::default();
                full.success = true;
                $(full.$response = form.$response;)*
                full
            }

            #[allow(unused_mut, unused_variables, reason = "a part may have no fields")]
            fn response_of_full(full: Self::Response) -> <jazzy::$name as Service>::Response {
                let mut form = <jazzy::$name as Service>::Response::default();
                $(form.$response = full.$response;)*
                form
            }
        }
    )*};
}

actions! {
    AssistedTeleop: humble jazzy;
    BackUp: humble jazzy;
    ComputeAndTrackRoute: jazzy jazzy;
    ComputePathThroughPoses: humble jazzy;
    ComputePathToPose: humble jazzy;
    ComputeRoute: jazzy jazzy;
    DockRobot: jazzy jazzy;
    DriveOnHeading: humble jazzy;
    FollowGPSWaypoints: jazzy jazzy;
    FollowObject: jazzy jazzy;
    FollowPath: humble jazzy;
    FollowWaypoints: humble jazzy;
    NavigateThroughPoses: humble jazzy;
    NavigateToPose: humble jazzy;
    SmoothPath: humble jazzy;
    Spin: humble jazzy;
    UndockRobot: jazzy jazzy;
    Wait: humble jazzy;
}

forms! {
    humble AssistedTeleop {
        goal: time_allowance;
        result: total_elapsed_time;
        feedback: current_teleop_duration;
    }
    humble BackUp {
        goal: target, speed, time_allowance;
        result: total_elapsed_time;
        feedback: distance_traveled;
    }
    jazzy BackUp {
        goal: target, speed, time_allowance;
        result: total_elapsed_time, error_code, error_msg;
        feedback: distance_traveled;
    }
    jazzy ComputeAndTrackRoute {
        goal: start_id, start, goal_id, goal, use_start, use_poses;
        result: execution_duration, error_code;
        feedback: last_node_id, next_node_id, current_edge_id, route, path, operations_triggered,
            rerouted;
    }
    humble ComputePathThroughPoses {
        goal: goals, start, planner_id, use_start;
        result: path, planning_time;
        feedback: ;
    }
    jazzy ComputePathThroughPoses {
        goal: goals, start, planner_id, use_start;
        result: path, planning_time, error_code, error_msg;
        feedback: ;
    }
    humble ComputePathToPose {
        goal: goal, start, planner_id, use_start;
        result: path, planning_time;
        feedback: ;
    }
    jazzy ComputePathToPose {
        goal: goal, start, planner_id, use_start;
        result: path, planning_time, error_code, error_msg;
        feedback: ;
    }
    jazzy ComputeRoute {
        goal: start_id, start, goal_id, goal, use_start, use_poses;
        result: planning_time, path, route, error_code;
        feedback: ;
    }
    humble DriveOnHeading {
        goal: target, speed, time_allowance;
        result: total_elapsed_time;
        feedback: distance_traveled;
    }
    jazzy DriveOnHeading {
        goal: target, speed, time_allowance;
        result: total_elapsed_time, error_code, error_msg;
        feedback: distance_traveled;
    }
    jazzy FollowGPSWaypoints {
        goal: number_of_loops, goal_index, gps_poses;
        result: missed_waypoints, error_code, error_msg;
        feedback: current_waypoint;
    }
    humble FollowPath {
        goal: path, controller_id, goal_checker_id;
        result: result;
        feedback: distance_to_goal as tracking_feedback.distance_to_goal,
            speed as tracking_feedback.speed;
    }
    jazzy FollowPath {
        goal: path, controller_id, goal_checker_id, progress_checker_id;
        result: result, error_code, error_msg;
        feedback: distance_to_goal as tracking_feedback.distance_to_goal,
            speed as tracking_feedback.speed;
    }
    humble FollowWaypoints {
        goal: poses;
        result: missed_waypoints;
        feedback: current_waypoint;
    }
    jazzy FollowWaypoints {
        goal: number_of_loops, goal_index, poses;
        result: missed_waypoints, error_code, error_msg;
        feedback: current_waypoint;
    }
    humble NavigateThroughPoses {
        goal: poses, behavior_tree;
        result: ;
        feedback: current_pose, navigation_time, estimated_time_remaining, number_of_recoveries,
            distance_remaining, number_of_poses_remaining;
    }
    jazzy NavigateThroughPoses {
        goal: poses, behavior_tree;
        result: error_code, error_msg;
        feedback: current_pose, navigation_time, estimated_time_remaining, number_of_recoveries,
            distance_remaining, number_of_poses_remaining;
    }
    humble NavigateToPose {
        goal: pose, behavior_tree;
        result: ;
        feedback: current_pose, navigation_time, estimated_time_remaining, number_of_recoveries,
            distance_remaining;
    }
    jazzy NavigateToPose {
        goal: pose, behavior_tree;
        result: error_code, error_msg;
        feedback: current_pose, navigation_time, estimated_time_remaining, number_of_recoveries,
            distance_remaining;
    }
    humble SmoothPath {
        goal: path, smoother_id, max_smoothing_duration, check_for_collisions;
        result: path, smoothing_duration, was_completed;
        feedback: ;
    }
    humble Spin {
        goal: target_yaw, time_allowance;
        result: total_elapsed_time;
        feedback: angular_distance_traveled;
    }
    jazzy Spin {
        goal: target_yaw, time_allowance;
        result: total_elapsed_time, error_code, error_msg;
        feedback: angular_distance_traveled;
    }
    humble Wait {
        goal: time;
        result: total_elapsed_time;
        feedback: time_left;
    }
}

services! {
    ClearCostmapAroundPose { request: pose, reset_distance; response: ; }
    ClearCostmapAroundRobot { request: reset_distance; response: ; }
    ClearCostmapExceptRegion { request: reset_distance; response: ; }
    ClearEntireCostmap { request: ; response: ; }
    IsPathValid { request: path; response: is_valid, invalid_pose_indices; }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Codec, Message, from_json, to_json};

    /// Fields of a form that survive the conversion to the full form and back.
    fn keeps<T: Message, U>(form: T, full: impl Fn(T) -> U, back: impl Fn(U) -> T) {
        assert_eq!(back(full(form.clone())), form, "{}", T::TYPE_NAME);
    }

    /// Message whose fields are all different from their default values.
    fn filled<T: Message + Codec>() -> T {
        fn fill(value: &mut serde_json::Value) {
            use serde_json::Value;
            match value {
                Value::Bool(value) => *value = !*value,
                Value::Number(number) => *number = 7.into(),
                Value::String(text) => text.push('x'),
                Value::Array(items) => items.iter_mut().for_each(fill),
                Value::Object(fields) => fields.values_mut().for_each(fill),
                Value::Null => {}
            }
        }
        let mut json = to_json(&T::default());
        fill(&mut json);
        from_json(&json).unwrap()
    }

    fn check<Full: Action, Form: ReleaseForm<Full>>() {
        assert_eq!(Full::TYPE_NAME, Form::TYPE_NAME);
        keeps(filled(), Form::full_goal, Form::goal_of_full);
        keeps(filled(), Form::full_result, Form::result_of_full);
        keeps(filled(), Form::full_feedback, Form::feedback_of_full);
    }

    #[test]
    fn no_field_of_an_older_form_is_lost() {
        fn both<A: Nav2Action>() {
            check::<A, A::Humble>();
            check::<A, A::Jazzy>();
            check::<A, A>();
        }
        both::<main::AssistedTeleop>();
        both::<main::BackUp>();
        both::<main::ComputeAndTrackRoute>();
        both::<main::ComputePathThroughPoses>();
        both::<main::ComputePathToPose>();
        both::<main::ComputeRoute>();
        both::<main::DockRobot>();
        both::<main::DriveOnHeading>();
        both::<main::FollowGPSWaypoints>();
        both::<main::FollowObject>();
        both::<main::FollowPath>();
        both::<main::FollowWaypoints>();
        both::<main::NavigateThroughPoses>();
        both::<main::NavigateToPose>();
        both::<main::SmoothPath>();
        both::<main::Spin>();
        both::<main::UndockRobot>();
        both::<main::Wait>();
    }

    #[test]
    fn lists_of_poses_and_waypoints_are_converted() {
        let pose = |x| {
            let mut pose = PoseStamped::default();
            pose.header.frame_id = "map".into();
            pose.pose.position.x = x;
            pose
        };
        let goal = jazzy::NavigateThroughPosesGoal {
            poses: vec![pose(1.0), pose(2.0)],
            ..Default::default()
        };
        let full =
            <jazzy::NavigateThroughPoses as ReleaseForm<main::NavigateThroughPoses>>::full_goal(
                goal,
            );
        assert_eq!(full.poses.header.frame_id, "map");
        assert_eq!(full.poses.goals, [pose(1.0), pose(2.0)]);
        let missed = WaypointStatus {
            waypoint_index: 3,
            waypoint_status: WaypointStatus::FAILED,
            error_code: 105,
            ..Default::default()
        };
        let result =
            main::FollowWaypointsResult { missed_waypoints: vec![missed], ..Default::default() };
        type Humble = <main::FollowWaypoints as Nav2Action>::Humble;
        let result = <Humble as ReleaseForm<main::FollowWaypoints>>::result_of_full(result);
        assert_eq!(result.missed_waypoints, [3]);
    }

    #[test]
    fn responses_without_success_mean_success() {
        assert!(main::ClearEntireCostmap::full_response(Default::default()).success);
        let response = jazzy::IsPathValidResponse { is_valid: true, ..Default::default() };
        let full = main::IsPathValid::full_response(response.clone());
        assert!(full.success && full.is_valid);
        assert_eq!(main::IsPathValid::response_of_full(full), response);
    }
}
