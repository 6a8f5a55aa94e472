//! Clients that use the servers without the navigator.

use periplus_geometry::Twist2;
use periplus_graph::GoalState;
use periplus_msgs::Nav2Action;
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::geometry_msgs::{Point, Twist};
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::nav2_msgs_main::*;
use periplus_nav_nodes::nav2_actions::Nav2SentGoal;

use crate::common::pose_in;
use crate::robot::Faults;
use crate::world::{BRAKING_MS, START, World};

/// Path to the right from the start of the robot to a position x \[m\].
fn path(to_x_m: f64) -> Path {
    let count = ((to_x_m - START.x_m) / 0.05) as u32;
    let x_m = |index: u32| START.x_m + 0.05 * f64::from(index);
    let poses = (0..=count).map(|index| pose_in("map", x_m(index), START.y_m, 0.0)).collect();
    let mut path = Path { poses, ..Path::default() };
    path.header.frame_id = "map".to_owned();
    path
}

fn ahead(x: f64) -> Point {
    Point { x, y: 0.0, z: 0.0 }
}

fn follow(path: Path) -> FollowPathGoal {
    FollowPathGoal { path, ..FollowPathGoal::default() }
}

fn spin(target_yaw: f32) -> SpinGoal {
    SpinGoal { target_yaw, ..SpinGoal::default() }
}

fn back_up(distance_m: f64, speed: f32) -> BackUpGoal {
    BackUpGoal { target: ahead(-distance_m), speed, ..BackUpGoal::default() }
}

fn drive(distance_m: f64, speed: f32) -> DriveOnHeadingGoal {
    DriveOnHeadingGoal { target: ahead(distance_m), speed, ..DriveOnHeadingGoal::default() }
}

/// Sends a goal to a world, and lets the servers work on it for 0.8 s.
fn started<A: Nav2Action>(world: &mut World, name: &str, goal: &A::Goal) -> Nav2SentGoal<A> {
    let sent = world.client_of::<A>(name).send(goal.clone());
    world.run_ms(800);
    sent
}

/// A goal is canceled while it runs; a goal is preempted by an equal one, which then is canceled.
fn is_interrupted<A: Nav2Action>(name: &str, goal: &A::Goal, is_moving: bool) {
    let mut world = World::new();
    let sent = started::<A>(&mut world, name, goal);
    assert_eq!(world.robot.command != Twist2::ZERO, is_moving, "{name}: {:?}", world.robot.command);
    let client = world.client_of::<A>(name);
    let _answer = client.cancel(sent.id());
    assert_eq!(world.finish(&sent, 110).state, GoalState::Canceled, "{name}");
    world.stands_after(BRAKING_MS);

    let first = started::<A>(&mut world, name, goal);
    let second = client.send(goal.clone());
    assert_eq!(world.finish(&first, 200).state, GoalState::Aborted, "{name}");
    world.run_ms(300);
    let _answer = client.cancel(second.id());
    assert_eq!(world.finish(&second, 110).state, GoalState::Canceled, "{name}");
    world.stands_after(BRAKING_MS);
    world.serves_the_next_goal();
}

#[test]
fn goals_of_all_servers_are_canceled_and_preempted() {
    is_interrupted::<FollowPath>("follow_path", &follow(path(5.0)), true);
    is_interrupted::<Spin>("spin", &spin(20.0), true);
    is_interrupted::<BackUp>("backup", &back_up(0.6, 0.05), true);
    is_interrupted::<DriveOnHeading>("drive_on_heading", &drive(2.0, 0.1), true);
    let time = Duration { sec: 20, nanosec: 0 };
    is_interrupted::<Wait>("wait", &WaitGoal { time }, false);
    is_interrupted::<AssistedTeleop>("assisted_teleop", &AssistedTeleopGoal::default(), false);
}

#[test]
fn assisted_teleoperation_stops_the_robot_when_it_is_canceled() {
    let mut world = World::new();
    let teleop = world.user.publisher("/cmd_vel_teleop", periplus_graph::Qos::reliable(1)).unwrap();
    let sent =
        started::<AssistedTeleop>(&mut world, "assisted_teleop", &AssistedTeleopGoal::default());
    let mut command = Twist::default();
    command.linear.x = 0.2;
    teleop.publish(command);
    world.run_ms(500);
    assert!(world.robot.command.vx_m_s > 0.1, "{:?}", world.robot.command);
    let _answer = world.client_of::<AssistedTeleop>("assisted_teleop").cancel(sent.id());
    assert_eq!(world.finish(&sent, 110).state, GoalState::Canceled);
    world.stands_after(BRAKING_MS);
    world.serves_the_next_goal();
}

/// A goal that is not valid is aborted at once, with a code and a word; the robot does not move.
#[track_caller]
fn is_refused<A: Nav2Action>(
    world: &mut World,
    name: &str,
    goal: A::Goal,
    error: impl Fn(&A::Result) -> (u16, String),
    code: u16,
    word: &str,
) {
    let sent = world.client_of::<A>(name).send(goal);
    let ended = world.finish(&sent, 500);
    let (found, text) = error(&ended.result);
    assert_eq!((ended.state, found), (GoalState::Aborted, code), "{name}: {text}");
    assert!(text.contains(word), "{name}: {text}");
    let before = world.robot.pose;
    world.stands_after(0);
    assert_eq!(world.robot.pose, before, "{name}");
}

#[test]
fn goals_that_are_not_valid_are_refused_with_the_reason() {
    let mut world = World::new();
    let w = &mut world;
    let of = |result: &FollowPathResult| (result.error_code, result.error_msg.clone());
    let invalid = FollowPathResult::INVALID_PATH;
    is_refused::<FollowPath>(w, "follow_path", follow(Path::default()), of, invalid, "empty");
    let mut wrong = path(3.0);
    wrong.poses[10].pose.position.x = f64::NAN;
    is_refused::<FollowPath>(w, "follow_path", follow(wrong.clone()), of, invalid, "pose 10");
    let mut elsewhere = path(3.0);
    elsewhere.header.frame_id = "kitchen".to_owned();
    let transform = FollowPathResult::TF_ERROR;
    is_refused::<FollowPath>(w, "follow_path", follow(elsewhere.clone()), of, transform, "kitchen");

    let of = |result: &SmoothPathResult| (result.error_code, result.error_msg.clone());
    let smooth = |path| SmoothPathGoal {
        path,
        max_smoothing_duration: Duration { sec: 1, nanosec: 0 },
        ..SmoothPathGoal::default()
    };
    let invalid = SmoothPathResult::INVALID_PATH;
    is_refused::<SmoothPath>(w, "smooth_path", smooth(Path::default()), of, invalid, "empty");
    is_refused::<SmoothPath>(w, "smooth_path", smooth(wrong), of, invalid, "pose 10");
    let unknown = SmoothPathResult::UNKNOWN;
    is_refused::<SmoothPath>(w, "smooth_path", smooth(elsewhere), of, unknown, "kitchen");

    let of = |result: &ComputePathToPoseResult| (result.error_code, result.error_msg.clone());
    let plan =
        |x, y, yaw| ComputePathToPoseGoal { goal: pose_in("map", x, y, yaw), ..Default::default() };
    let outside = ComputePathToPoseResult::GOAL_OUTSIDE_MAP;
    let name = "compute_path_to_pose";
    is_refused::<ComputePathToPose>(w, name, plan(f64::NAN, 1.0, 0.0), of, outside, "finite");
    is_refused::<ComputePathToPose>(w, name, plan(2.0, 1.0, f64::NAN), of, outside, "finite");
    is_refused::<ComputePathToPose>(w, name, plan(2.0, f64::INFINITY, 0.0), of, outside, "finite");

    let of = |result: &SpinResult| (result.error_code, result.error_msg.clone());
    for yaw in [f32::NAN, f32::INFINITY] {
        is_refused::<Spin>(w, "spin", spin(yaw), of, SpinResult::UNKNOWN, "target_yaw");
    }
    let of = |result: &BackUpResult| (result.error_code, result.error_msg.clone());
    let invalid = BackUpResult::INVALID_INPUT;
    for goal in [back_up(f64::NAN, 0.1), back_up(0.3, f32::NAN), back_up(f64::INFINITY, 0.1)] {
        is_refused::<BackUp>(w, "backup", goal, of, invalid, "finite");
    }
    let of = |result: &DriveOnHeadingResult| (result.error_code, result.error_msg.clone());
    let invalid = DriveOnHeadingResult::INVALID_INPUT;
    for goal in [drive(f64::NAN, 0.1), drive(0.3, f32::NAN), drive(f64::INFINITY, 0.1)] {
        is_refused::<DriveOnHeading>(w, "drive_on_heading", goal, of, invalid, "finite");
    }
    world.serves_the_next_goal();
}

/// A behavior that moves ends when the transforms are lost, without a time allowance.
fn ends_without_transforms<A: Nav2Action>(
    name: &str,
    goal: &A::Goal,
    error: impl Fn(&A::Result) -> (u16, String),
    code: u16,
) {
    let mut world = World::new();
    let sent = started::<A>(&mut world, name, goal);
    assert_ne!(world.robot.command, Twist2::ZERO, "{name}");
    world.robot.faults = Faults { has_no_tf: true, ..Faults::default() };
    let ended = world.finish(&sent, 1000);
    let (found, text) = error(&ended.result);
    assert_eq!((ended.state, found), (GoalState::Aborted, code), "{name}: {text}");
    assert!(text.contains("old"), "{text}");
    world.stands_after(BRAKING_MS);
    world.serves_the_next_goal();
}

#[test]
fn behaviors_end_when_the_transforms_are_lost() {
    let of = |result: &SpinResult| (result.error_code, result.error_msg.clone());
    ends_without_transforms::<Spin>("spin", &spin(20.0), of, SpinResult::TF_ERROR);
    let of = |result: &BackUpResult| (result.error_code, result.error_msg.clone());
    let goal = back_up(0.6, 0.05);
    ends_without_transforms::<BackUp>("backup", &goal, of, BackUpResult::TF_ERROR);
    let of = |result: &DriveOnHeadingResult| (result.error_code, result.error_msg.clone());
    let code = DriveOnHeadingResult::TF_ERROR;
    ends_without_transforms::<DriveOnHeading>("drive_on_heading", &drive(2.0, 0.1), of, code);
}

#[test]
fn a_stuck_robot_ends_a_behavior_after_its_time() {
    let mut world = World::new();
    world.robot.faults = Faults { is_stuck: true, ..Faults::default() };
    let time_allowance = Duration { sec: 3, nanosec: 0 };
    let sent = world.client_of::<Spin>("spin").send(SpinGoal { time_allowance, ..spin(1.0) });
    let ended = world.finish(&sent, 3200);
    assert_eq!((ended.state, ended.result.error_code), (GoalState::Aborted, SpinResult::TIMEOUT));
    assert!(ended.result.error_msg.contains("3 s"), "{}", ended.result.error_msg);
    world.stands_after(BRAKING_MS);
    world.serves_the_next_goal();
}

#[test]
fn a_wall_ahead_ends_a_drive() {
    let mut world = World::new();
    let sent = world.client_of::<DriveOnHeading>("drive_on_heading").send(drive(8.0, 0.3));
    let ended = world.finish(&sent, 30_000);
    let code = DriveOnHeadingResult::COLLISION_AHEAD;
    assert_eq!((ended.state, ended.result.error_code), (GoalState::Aborted, code));
    world.stands_after(BRAKING_MS);
    world.serves_the_next_goal();
}
