//! The waypoint follower as its clients see it.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

mod stage;

use periplus_costmap::Nav2Release;
use periplus_graph::{GoalProgress, GoalState, Qos, Transition};
use periplus_msgs::geographic_msgs::GeoPose;
use periplus_msgs::geometry_msgs::Point;
use periplus_msgs::nav2_msgs_main::{
    FollowGPSWaypoints, FollowGPSWaypointsGoal, FollowGPSWaypointsResult, FollowWaypointsGoal,
    FollowWaypointsResult,
};
use periplus_msgs::robot_localization::{FromLL, FromLLResponse};
use periplus_msgs::sensor_msgs::Image;
use periplus_msgs::std_msgs::Empty;
use periplus_nav_nodes::nav2_actions::Nav2ActionClient;

use stage::{Arrival, Stage, poses};

/// State, error code and missed waypoints of a goal.
#[track_caller]
fn over(progress: &GoalProgress<FollowWaypointsResult>) -> (GoalState, u16, Vec<(u32, u16)>) {
    let GoalProgress::Over(state, result) = progress else { panic!("{progress:?}") };
    let missed = result.missed_waypoints.iter();
    (*state, result.error_code, missed.map(|it| (it.waypoint_index, it.error_code)).collect())
}

#[test]
fn poses_are_reached_one_after_the_other() {
    for release in Nav2Release::ALL {
        let stage = Stage::of(release, &[], &[]);
        let sent = stage.send(&[1.0, 2.0, 3.0]);
        stage.run(0.2);
        assert_eq!(stage.goals(), [1.0], "{release}");
        let progress = stage.finish(&sent);
        assert_eq!(over(&progress), (GoalState::Succeeded, 0, vec![]), "{release}");
        assert_eq!(stage.goals(), [1.0, 2.0, 3.0]);
        let feedback = stage.client.feedback();
        assert_eq!(feedback.last().unwrap().1.current_waypoint, 2);
    }
}

#[test]
fn missed_poses_are_reported() {
    let script = [Arrival::Reached, Arrival::Aborted(208), Arrival::Refused, Arrival::Reached];
    let check = |stop: &str, expected: (GoalState, u16, Vec<(u32, u16)>), goals: &[f64]| {
        let stage = Stage::new(&[("stop_on_failure", stop)], &script);
        let progress = stage.finish(&stage.send(&[1.0, 2.0, 3.0, 4.0]));
        assert_eq!(over(&progress), expected, "{stop}");
        assert_eq!(stage.goals(), goals);
    };
    let unknown = FollowWaypointsResult::UNKNOWN;
    let all = (GoalState::Succeeded, 0, vec![(1, 208), (2, unknown)]);
    check("false", all, &[1.0, 2.0, 3.0, 4.0]);
    let code = FollowWaypointsResult::STOP_ON_MISSED_WAYPOINT;
    check("true", (GoalState::Aborted, code, vec![(1, 208)]), &[1.0, 2.0]);
    // Jazzy has no code for it.
    let stage = Stage::of(Nav2Release::Jazzy, &[], &[Arrival::Aborted(208)]);
    let progress = stage.finish(&stage.send(&[1.0]));
    assert_eq!(over(&progress), (GoalState::Aborted, 0, vec![(0, 208)]));
}

#[test]
fn waypoints_are_repeated_and_may_start_in_the_middle() {
    let stage = Stage::new(&[], &[]);
    let goal = FollowWaypointsGoal { number_of_loops: 1, goal_index: 1, poses: poses(&[1.0, 2.0]) };
    let progress = stage.finish(&stage.send_goal(goal));
    assert_eq!(over(&progress).0, GoalState::Succeeded);
    assert_eq!(stage.goals(), [2.0, 1.0, 2.0]);
    for (goal_index, xs) in [(0, &[][..]), (2, &[1.0, 2.0])] {
        let goal = FollowWaypointsGoal { number_of_loops: 0, goal_index, poses: poses(xs) };
        let sent = stage.send_goal(goal);
        stage.run(0.1);
        assert_eq!(sent.look(), GoalProgress::Rejected);
    }
}

#[test]
fn cancellation_in_the_middle_cancels_the_navigator() {
    let stage = Stage::new(&[], &[]);
    let sent = stage.send(&[1.0, 2.0, 3.0]);
    stage.run(0.8);
    assert_eq!(stage.goals(), [1.0, 2.0]);
    let _ = sent.look();
    let _ = stage.client.cancel(sent.id());
    stage.run(0.15);
    let _ = sent.look();
    stage.run(0.01);
    assert_eq!(over(&sent.look()), (GoalState::Canceled, 0, vec![]));
    stage.run(2.0);
    assert_eq!(stage.goals(), [1.0, 2.0]);
    assert_eq!(stage.navigator.with(|navigator| navigator.canceled), 1);
}

#[test]
fn a_new_goal_replaces_the_waypoints() {
    let stage = Stage::new(&[], &[]);
    let first = stage.send(&[1.0, 2.0, 3.0]);
    stage.run(0.2);
    let _ = first.look();
    let second = stage.send(&[7.0, 8.0]);
    let progress = stage.finish(&second);
    assert_eq!(over(&progress), (GoalState::Succeeded, 0, vec![]));
    assert_eq!(over(&first.look()).0, GoalState::Aborted);
    assert_eq!(stage.goals(), [1.0, 7.0, 8.0]);
}

#[test]
fn the_robot_waits_at_each_pose() {
    let duration = |pause: &str| {
        let stage = Stage::new(&[("wait_at_waypoint.waypoint_pause_duration", pause)], &[]);
        let progress = stage.finish(&stage.send(&[1.0, 2.0]));
        assert_eq!(over(&progress).0, GoalState::Succeeded);
        stage.graph.now_ns()
    };
    let more_s = (duration("2000") - duration("0")) as f64 * 1e-9;
    assert!((more_s - 4.0).abs() < 0.11, "{more_s}");
}

#[test]
fn a_photo_is_taken_at_each_pose() {
    let given = [
        ("waypoint_task_executor_plugin", "photo"),
        ("photo.plugin", "nav2_waypoint_follower::PhotoAtWaypoint"),
        ("photo.save_dir", "/photos"),
        ("photo.image_topic", "image"),
        ("stop_on_failure", "false"),
    ];
    let stage = Stage::new(&given, &[]);
    let progress = stage.finish(&stage.send(&[1.0]));
    let failed = FollowWaypointsResult::TASK_EXECUTOR_FAILED;
    assert_eq!(over(&progress), (GoalState::Succeeded, 0, vec![(0, failed)]), "no image yet");

    let images = stage.user.publisher::<Image>("image", Qos::reliable(1)).unwrap();
    let (encoding, data) = ("rgb8".to_owned(), vec![1, 2, 3]);
    images.publish(Image { width: 1, height: 1, step: 3, encoding, data, ..Image::default() });
    stage.graph.advance_to(5_500_000_000);
    let start_s = stage.graph.now_ns() / 1_000_000_000;
    let progress = stage.finish(&stage.send(&[1.0, 2.0]));
    assert_eq!(over(&progress), (GoalState::Succeeded, 0, vec![]));
    // The files are named by the seconds at which the poses were sent, half a second apart.
    let photos = stage.photos.lock().unwrap().clone();
    let expected = [(0, start_s), (1, start_s + 1)].map(|(i, s)| format!("/photos/{i}_{s}.png"));
    assert_eq!(photos, expected);
}

#[test]
fn the_robot_waits_for_input() {
    let given = [
        ("waypoint_task_executor_plugin", "button"),
        ("button.plugin", "nav2_waypoint_follower::InputAtWaypoint"),
        ("button.timeout", "3.0"),
    ];
    let stage = Stage::new(&given, &[]);
    let inputs =
        stage.user.publisher::<Empty>("input_at_waypoint/input", Qos::reliable(1)).unwrap();
    // An input before the arrival does not count.
    inputs.publish(Empty::default());
    let sent = stage.send(&[1.0, 2.0]);
    stage.run(2.0);
    assert_eq!(stage.goals(), [1.0]);
    inputs.publish(Empty::default());
    stage.run(0.2);
    assert_eq!(stage.goals(), [1.0, 2.0]);
    let progress = stage.finish(&sent);
    let failed = FollowWaypointsResult::TASK_EXECUTOR_FAILED;
    assert_eq!(over(&progress), (GoalState::Aborted, failed, vec![(1, failed)]));
}

/// Sends two GPS waypoints.
fn follow_gps(stage: &Stage) -> GoalProgress<FollowGPSWaypointsResult> {
    let client = Nav2ActionClient::<FollowGPSWaypoints>::new(
        &stage.user,
        stage.release,
        "follow_gps_waypoints",
    )
    .unwrap();
    let waypoint = |longitude: f64| {
        let mut pose = GeoPose::default();
        pose.position.longitude = longitude;
        pose
    };
    let gps_poses = vec![waypoint(0.1), waypoint(0.2)];
    let sent = client.send(FollowGPSWaypointsGoal { gps_poses, ..Default::default() });
    stage.finish(&sent)
}

#[test]
fn gps_waypoints_are_converted_or_refused() {
    let stage = Stage::new(&[], &[]);
    let progress = follow_gps(&stage);
    let GoalProgress::Over(GoalState::Aborted, result) = progress else { panic!() };
    assert_eq!(result.error_code, 602);
    assert!(result.error_msg.contains("/fromLL"), "{}", result.error_msg);
    assert!(stage.goals().is_empty());

    let stage = Stage::new(&[], &[]);
    let mut navsat =
        stage.graph.node(periplus_graph::NodeSettings::new("navsat_transform")).unwrap().actor(());
    navsat
        .serve::<FromLL>("/fromLL", |(), request, _| FromLLResponse {
            map_point: Point { x: request.ll_point.longitude * 100.0, ..Point::default() },
        })
        .unwrap();
    let progress = follow_gps(&stage);
    assert!(matches!(progress, GoalProgress::Over(GoalState::Succeeded, _)), "{progress:?}");
    assert_eq!(stage.goals(), [10.0, 20.0]);
}

#[test]
fn deactivation_aborts_the_goal_and_cancels_the_navigator() {
    let stage = Stage::new(&[], &[]);
    let sent = stage.send(&[1.0, 2.0]);
    stage.run(0.2);
    let _ = sent.look();
    stage.follower.lifecycle().change(Transition::Deactivate);
    stage.run(1.0);
    assert_eq!(over(&sent.look()).0, GoalState::Aborted);
    assert_eq!(stage.navigator.with(|navigator| navigator.canceled), 1);
    assert_eq!(stage.goals(), [1.0]);
    let rejected = stage.send(&[1.0]);
    stage.run(0.1);
    assert_eq!(rejected.look(), GoalProgress::Rejected);
}

#[test]
fn a_goal_is_canceled_once_the_navigator_has_accepted_it() {
    let stage = Stage::new(&[], &[Arrival::AcceptedLate]);
    let sent = stage.send(&[1.0, 2.0]);
    stage.run(0.1);
    let _ = sent.look();
    let _ = stage.client.cancel(sent.id());
    stage.run(0.2);
    assert_eq!(sent.look(), GoalProgress::Accepted);
    stage.run(0.4);
    let progress = stage.finish(&sent);
    assert_eq!(over(&progress), (GoalState::Canceled, 0, vec![]));
    // The navigator ends it with its next goal.
    stage.navigator.with(|navigator| navigator.end());
    assert_eq!(stage.navigator.with(|navigator| navigator.canceled), 1);
}
