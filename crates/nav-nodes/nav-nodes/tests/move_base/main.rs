//! `move_base` on a graph, with a robot that moves as it is commanded.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]
#![allow(clippy::disallowed_methods, reason = "one of them compares with the documentation")]

#[path = "../common/mod.rs"]
mod common;
mod parameters;
mod stage;

use std::f64::consts::{FRAC_PI_2, TAU};

use common::pose_in;
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::Qos;
use periplus_msgs::actionlib_msgs::{GoalStatus, GoalStatusArray};
use periplus_msgs::geometry_msgs::{PolygonStamped, PoseStamped};
use periplus_msgs::move_base_msgs::MoveBaseActionFeedback;
use periplus_msgs::nav_msgs::{GetPlan, GetPlanRequest, Path};
use periplus_msgs::std_srvs::{Empty, EmptyRequest};
use stage::Driving;

/// No walls.
fn free(_: f64, _: f64) -> bool {
    false
}

/// A wall across the map at x = 3 m, with a door at its upper end.
fn door(x: f64, y: f64) -> bool {
    (2.9..3.1).contains(&x) && y < 2.8
}

fn distance_m(robot: Pose2, x_m: f64, y_m: f64) -> f64 {
    libm::hypot(robot.x_m - x_m, robot.y_m - y_m)
}

#[test]
fn the_robot_reaches_its_goal_with_each_local_planner() {
    for planner in ["dwa_local_planner/DWAPlannerROS", "base_local_planner/TrajectoryPlannerROS"] {
        let mut driving = Driving::new(&format!("base_local_planner: {planner}"), door);
        driving.send("a", (5.0, 1.0, FRAC_PI_2));
        let status = driving.finish(60);
        assert_eq!((status.status, status.text.as_str()), (GoalStatus::SUCCEEDED, "Goal reached."));
        assert_eq!(status.goal_id.id, "a");
        let robot = driving.robot();
        assert!(distance_m(robot, 5.0, 1.0) < 0.15, "{planner} {robot:?}");
        assert!((robot.yaw_rad - FRAC_PI_2).abs() < 0.15, "{planner} {robot:?}");
        driving.advance(100);
        assert_eq!(driving.command, Twist2::ZERO);
    }
}

#[test]
fn another_controller_drives_in_place_of_teb() {
    let more = "base_local_planner: teb_local_planner/TebLocalPlannerROS";
    let mut driving = Driving::new(more, free);
    driving.send("a", (3.0, 2.0, 0.0));
    assert_eq!(driving.finish(60).status, GoalStatus::SUCCEEDED);
    assert!(distance_m(driving.robot(), 3.0, 2.0) < 0.25);
}

#[test]
fn global_planner_plans_too() {
    for more in ["", "use_grid_path: true, use_dijkstra: false"] {
        let more = format!(
            "base_global_planner: global_planner/GlobalPlanner\nGlobalPlanner: {{orientation_mode: 1, {more}}}"
        );
        let mut driving = Driving::new(&more, door);
        let plans = driving.stage.mailbox::<Path>("/move_base/GlobalPlanner/plan");
        driving.send("a", (5.0, 1.0, 0.0));
        let plan = plans.latest().unwrap();
        // Through the door.
        assert!(plan.poses.iter().any(|it| it.pose.position.y > 2.8), "{more}");
        let heading = plan.poses[plan.poses.len() / 4].pose.orientation.z;
        assert!((0.1..0.8).contains(&heading), "{more}: it leads up: {heading}");
        assert_eq!(driving.finish(60).status, GoalStatus::SUCCEEDED, "{more}");
    }
}

#[test]
fn topics_of_a_run() {
    let mut driving = Driving::new("global_costmap/publish_frequency: 5.0", free);
    let user = &driving.stage.user;
    let qos = Qos::reliable(100);
    let current = user.mailbox::<PoseStamped>("/move_base/current_goal", qos).unwrap();
    let plan = user.mailbox::<Path>("/move_base/NavfnROS/plan", qos).unwrap();
    let global = user.mailbox::<Path>("/move_base/DWAPlannerROS/global_plan", qos).unwrap();
    let local = user.mailbox::<Path>("/move_base/DWAPlannerROS/local_plan", qos).unwrap();
    let status = user.mailbox::<GoalStatusArray>("/move_base/status", qos).unwrap();
    let feedback = user.mailbox::<MoveBaseActionFeedback>("/move_base/feedback", qos).unwrap();
    let outline =
        user.mailbox::<PolygonStamped>("/move_base/global_costmap/footprint", qos).unwrap();
    let goals = user.publisher::<PoseStamped>("/move_base_simple/goal", qos).unwrap();
    let costs = driving.grid("/move_base/global_costmap/costmap");
    goals.publish(pose_in("map", 3.0, 1.0, 0.0));
    driving.advance(1000);
    assert_eq!(current.latest().unwrap().pose.position.x, 3.0);
    let plan = plan.latest().unwrap();
    assert_eq!(plan.header.frame_id, "map");
    assert!((plan.poses[0].pose.position.x - 1.0).abs() < 1e-6);
    assert_eq!(plan.poses.last().unwrap().pose.position.x, 3.0);
    assert_eq!(global.latest().unwrap().header.frame_id, "odom");
    assert!(local.latest().unwrap().poses.len() > 2);
    let status = status.latest().unwrap();
    assert_eq!(status.status_list[0].status, GoalStatus::ACTIVE);
    assert!(status.status_list[0].goal_id.id.starts_with("/move_base-1-"));
    let feedback = feedback.latest().unwrap();
    assert_eq!(feedback.status.goal_id.id, status.status_list[0].goal_id.id);
    assert!(feedback.feedback.base_position.pose.position.x > 1.1);
    assert_eq!(costs.latest().unwrap().info.width, 60);
    assert!(outline.latest().unwrap().polygon.points.len() >= 3);
}

#[test]
fn a_goal_in_a_wall_is_aborted_after_the_recoveries() {
    let mut driving = Driving::new("", door);
    driving.send("wall", (3.0, 1.0, 0.0));
    let status = driving.finish(60);
    assert_eq!(status.status, GoalStatus::ABORTED);
    let wanted = "Failed to find a valid plan. Even after executing recovery behaviors.";
    assert!(status.text.starts_with(wanted), "{}", status.text);
    assert!(status.text.contains("layer `static_layer`"), "{}", status.text);
    let names = ["conservative_reset", "rotate_recovery", "aggressive_reset", "rotate_recovery"];
    assert_eq!(driving.recoveries(), names);
    let turns = driving.turned_rad / TAU;
    assert!((1.9..2.05).contains(&turns), "{turns} turns");
    driving.advance(100);
    assert_eq!(driving.command, Twist2::ZERO);
    // The next goal starts with fresh recoveries.
    driving.send("free", (1.5, 1.0, 0.0));
    assert_eq!(driving.finish(30).status, GoalStatus::SUCCEEDED);
}

#[test]
fn retries_and_recoveries_as_configured() {
    let more = "max_planning_retries: 2\n\
                recovery_behaviors: [{name: reset, type: 'clear_costmap_recovery/ClearCostmapRecovery'}]";
    let mut driving = Driving::new(more, door);
    driving.send("wall", (3.0, 1.0, 0.0));
    let before_ns = driving.stage.now_ns;
    assert_eq!(driving.finish(10).status, GoalStatus::ABORTED);
    assert_eq!(driving.recoveries(), ["reset"]);
    let took_ns = driving.stage.now_ns - before_ns;
    assert!(took_ns < 1_000_000_000, "three attempts, a recovery, three attempts: {took_ns} ns");
    let mut driving = Driving::new("recovery_behavior_enabled: false", door);
    driving.send("wall", (3.0, 1.0, 0.0));
    assert_eq!(driving.finish(10).status, GoalStatus::ABORTED);
    assert!(driving.recoveries().is_empty());
}

#[test]
fn a_cancelled_goal_stops_the_robot() {
    for id in ["a", ""] {
        let mut driving = Driving::new("", free);
        driving.send("a", (5.0, 1.0, 0.0));
        driving.advance(1000);
        assert!(driving.command.vx_m_s > 0.1);
        driving.cancel(id);
        assert_eq!(driving.ended[0].status, GoalStatus::PREEMPTED);
        assert_eq!(driving.command, Twist2::ZERO);
        let robot = driving.robot();
        driving.advance(1000);
        assert_eq!(driving.robot(), robot);
        assert_eq!(driving.ended.len(), 1);
    }
}

#[test]
fn a_goal_that_arrives_after_its_cancel_request_does_not_start() {
    let mut driving = Driving::new("", free);
    driving.cancel("late");
    driving.send("late", (5.0, 1.0, 0.0));
    driving.advance(500);
    assert_eq!(driving.ended[0].status, GoalStatus::RECALLED);
    assert_eq!(driving.command, Twist2::ZERO);
}

#[test]
fn a_goal_is_cancelled_while_the_robot_recovers() {
    let mut driving = Driving::new("", door);
    driving.send("wall", (3.0, 1.0, 0.0));
    driving.advance(3500);
    assert!(driving.command.wz_rad_s > 0.3, "it turns");
    driving.cancel("wall");
    assert_eq!(driving.ended[0].status, GoalStatus::PREEMPTED);
    assert_eq!(driving.command, Twist2::ZERO);
}

#[test]
fn a_new_goal_preempts() {
    let mut driving = Driving::new("", free);
    driving.send("a", (5.0, 1.0, 0.0));
    driving.advance(1000);
    driving.send("b", (1.0, 3.0, 0.0));
    driving.advance(60);
    assert_eq!(driving.ended.len(), 1);
    assert_eq!(
        (driving.ended[0].status, &*driving.ended[0].goal_id.id),
        (GoalStatus::PREEMPTED, "a")
    );
    let status = driving.finish(60);
    assert_eq!((status.status, &*status.goal_id.id), (GoalStatus::SUCCEEDED, "b"));
    assert!(distance_m(driving.robot(), 1.0, 3.0) < 0.15);
}

#[test]
fn two_goals_at_once_leave_the_second() {
    let mut driving = Driving::new("", free);
    driving.send("a", (5.0, 1.0, 0.0));
    driving.advance(500);
    driving.send("b", (5.0, 3.0, 0.0));
    driving.send("c", (2.0, 1.0, 0.0));
    while driving.ended.len() < 3 {
        driving.finish(30);
    }
    let ids: Vec<(&str, u8)> =
        driving.ended.iter().map(|it| (&*it.goal_id.id, it.status)).collect();
    assert_eq!(ids.last(), Some(&("c", GoalStatus::SUCCEEDED)));
}

#[test]
fn a_stuck_robot_oscillates() {
    let mut driving = Driving::new("oscillation_timeout: 2.0", free);
    driving.is_stuck = true;
    driving.send("a", (5.0, 1.0, 0.0));
    driving.advance(2500);
    assert_eq!(driving.recoveries(), ["conservative_reset"]);
    driving.is_stuck = false;
    assert_eq!(driving.finish(60).status, GoalStatus::SUCCEEDED);
}

#[test]
fn a_recovery_limits_the_speed_until_the_robot_has_moved() {
    let more = "oscillation_timeout: 2.0\noscillation_distance: 0.1\n\
                recovery_behaviors: [{name: slow, type: move_slow_and_clear/MoveSlowAndClear}]\n\
                slow: {limited_trans_speed: 0.2, limited_distance: 0.3}";
    let mut driving = Driving::new(more, free);
    driving.is_stuck = true;
    driving.send("a", (5.0, 1.0, 0.0));
    driving.advance(2500);
    assert_eq!(driving.recoveries(), ["slow"]);
    driving.is_stuck = false;
    driving.advance(1000);
    assert!((0.1..0.21).contains(&driving.command.vx_m_s), "{:?}", driving.command);
    driving.advance(2000);
    assert!(driving.command.vx_m_s > 0.4, "{:?}", driving.command);
}

#[test]
fn a_lost_transform_aborts_the_goal() {
    let mut driving = Driving::new("", free);
    driving.send("a", (5.0, 1.0, 0.0));
    driving.advance(1000);
    let robot = driving.stage.robot.take();
    driving.advance(1000);
    assert_eq!(driving.command, Twist2::ZERO, "stopped while the pose is unknown");
    driving.stage.robot = robot;
    assert_eq!(driving.finish(60).status, GoalStatus::SUCCEEDED);
    driving.stage.robot = None;
    driving.advance(1000);
    driving.send("b", (1.0, 1.0, 0.0));
    let status = driving.finish(60);
    assert_eq!(status.status, GoalStatus::ABORTED);
    assert!(status.text.contains("`base_link`"), "{}", status.text);
}

#[test]
fn without_a_map_a_goal_is_aborted_with_the_reason() {
    let mut driving = Driving::without_map("");
    driving.advance(500);
    driving.send("a", (2.0, 1.0, 0.0));
    let status = driving.finish(60);
    assert_eq!(status.status, GoalStatus::ABORTED);
    assert!(status.text.contains("costmap is not ready"), "{}", status.text);
}

#[test]
fn a_goal_without_a_heading_is_aborted_at_once() {
    let mut driving = Driving::new("", free);
    let mut goal = pose_in("map", 2.0, 1.0, 0.0);
    goal.pose.orientation.w = 0.0;
    let goals = driving.stage.user.publisher("/move_base_simple/goal", Qos::reliable(1)).unwrap();
    goals.publish(goal);
    driving.advance(50);
    assert_eq!(driving.ended[0].status, GoalStatus::ABORTED);
    assert!(driving.ended[0].text.contains("invalid quaternion"), "{}", driving.ended[0].text);
}

#[test]
fn plans_for_users_while_the_robot_rests() {
    let mut driving = Driving::new("", door);
    let request = |x, tolerance| GetPlanRequest {
        start: PoseStamped::default(),
        goal: pose_in("map", x, 1.0, 0.0),
        tolerance,
    };
    // First and last position in decimetres.
    let call = |driving: &Driving, request| {
        let response = driving.stage.call::<GetPlan>("/move_base/make_plan", request);
        let x_dm = |it: &PoseStamped| (it.pose.position.x * 10.0).round() as i64;
        let poses = &response.plan.poses;
        poses.first().map(x_dm).zip(poses.last().map(x_dm))
    };
    assert_eq!(call(&driving, request(5.0, 0.0)), Some((10, 50)));
    assert_eq!(call(&driving, request(3.0, 0.0)), None, "in the wall");
    // A plan to a position near it, and the goal itself.
    assert_eq!(call(&driving, request(3.0, 1.0)), Some((10, 30)));
    driving.send("a", (5.0, 1.0, 0.0));
    assert_eq!(call(&driving, request(5.0, 0.0)), None, "a goal is running");
    driving.stage.call::<Empty>("/move_base/clear_costmaps", EmptyRequest::default());
    assert_eq!(driving.finish(60).status, GoalStatus::SUCCEEDED);
}

#[test]
fn costmaps_rest_between_goals() {
    let mut driving = Driving::new("shutdown_costmaps: true", free);
    for (x, id) in [(2.0, "a"), (3.0, "b")] {
        driving.send(id, (x, 1.0, 0.0));
        let status = driving.finish(60);
        assert_eq!(status.status, GoalStatus::SUCCEEDED, "{}", status.text);
        let is_active = driving.node.with(|node| node.local_costmap().lifecycle().is_active());
        assert!(!is_active);
    }
}
