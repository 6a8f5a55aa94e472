//! The behaviors as their clients see them, with a robot that moves exactly as commanded.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

mod stage;

use periplus_costmap::Nav2Release;
use periplus_geometry::Twist2;
use periplus_graph::{GoalProgress, GoalState, Qos, Transition};
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::geometry_msgs::{Point, TwistStamped};
use periplus_msgs::nav2_msgs_main::{
    AssistedTeleop, AssistedTeleopGoal, BackUp, BackUpGoal, BackUpResult, DriveOnHeading,
    DriveOnHeadingGoal, DriveOnHeadingResult, Spin, SpinGoal, SpinResult, Wait, WaitGoal,
};
use periplus_msgs::std_msgs::Empty;

use stage::Stage;

fn seconds(sec: i32) -> Duration {
    Duration { sec, ..Duration::default() }
}

fn spin(target_yaw: f32) -> SpinGoal {
    SpinGoal { target_yaw, time_allowance: seconds(20), ..SpinGoal::default() }
}

fn back_up(distance: f64, speed: f32) -> BackUpGoal {
    let target = Point { x: distance, ..Point::default() };
    BackUpGoal { target, speed, time_allowance: seconds(20), ..BackUpGoal::default() }
}

/// State, error code and result of a goal.
#[track_caller]
fn over<R: Clone>(progress: &GoalProgress<R>, code: impl Fn(&R) -> u16) -> (GoalState, u16) {
    match progress {
        GoalProgress::Over(state, result) => (*state, code(result)),
        GoalProgress::Rejected => (GoalState::Unknown, 0),
        _ => panic!("the goal is not over"),
    }
}

#[test]
fn a_spin_turns_by_the_angle() {
    let check = |release: Nav2Release, target: f32, from: f64, to: f64| {
        let mut stage = Stage::new(release, &[]);
        stage.see(&[]);
        let client = stage.client::<Spin>("spin");
        let sent = client.send(spin(target));
        let progress = stage.finish(&sent);
        assert_eq!(over(&progress, |it: &SpinResult| it.error_code), (GoalState::Succeeded, 0));
        let yaw = stage.pose.yaw_rad;
        assert!((from..to).contains(&yaw), "{release} {target}: {yaw}");
        assert_eq!(stage.log.last(), Some(&Twist2::ZERO));
        let GoalProgress::Over(_, result) = progress else { panic!() };
        let elapsed_s = result.total_elapsed_time.ns() as f64 * 1e-9;
        // At most 1 rad/s, at least the braking distance at 0.4 rad/s.
        assert!((f64::from(target.abs())..10.0).contains(&elapsed_s), "{elapsed_s}");
        let feedback = client.feedback();
        let turned = feedback.last().unwrap().1.angular_distance_traveled;
        assert!((f64::from(turned) - yaw).abs() < 0.05, "{turned} {yaw}");
    };
    // It ends within a cycle of 0.1 s at 0.4 rad/s or less.
    for release in [Nav2Release::Humble, Nav2Release::Jazzy, Nav2Release::Main] {
        check(release, 1.57, 1.57, 1.64);
    }
    check(Nav2Release::Main, -1.0, -1.07, -1.0);
    check(Nav2Release::Main, 7.0, 7.0, 7.07);
}

#[test]
fn a_robot_backs_up_and_stops_before_obstacles() {
    let check = |obstacles: &[(f64, f64)], expected: (GoalState, u16), from: f64, to: f64| {
        let mut stage = Stage::new(Nav2Release::Main, &[]);
        stage.see(obstacles);
        let sent = stage.client::<BackUp>("backup").send(back_up(0.6, 0.1));
        let progress = stage.finish(&sent);
        assert_eq!(over(&progress, |it: &BackUpResult| it.error_code), expected);
        let x = stage.pose.x_m;
        assert!((from..to).contains(&x), "{x}");
        assert_eq!(stage.log.last(), Some(&Twist2::ZERO));
    };
    check(&[], (GoalState::Succeeded, 0), -0.615, -0.6);
    let collision = (GoalState::Aborted, BackUpResult::COLLISION_AHEAD);
    // The robot's rear would touch the cell from -0.45 to -0.4 within two seconds.
    check(&[(-0.42, 0.0)], collision, -0.14, -0.09);
    check(&[(-0.12, 0.0)], collision, -0.001, 0.001);
    // An obstacle ahead does not matter, and one beyond the target neither.
    check(&[(0.32, 0.0), (-0.82, 0.0)], (GoalState::Succeeded, 0), -0.615, -0.6);
}

#[test]
fn goals_fail_for_a_reason() {
    let mut stage = Stage::new(Nav2Release::Main, &[]);
    // Without a costmap no pose is free, unless checks are disabled.
    let code = |it: &SpinResult| it.error_code;
    let sent = stage.client::<Spin>("spin").send(spin(1.0));
    let aborted = |code| (GoalState::Aborted, code);
    assert_eq!(over(&stage.finish(&sent), code), aborted(SpinResult::COLLISION_AHEAD));
    let blind = SpinGoal { disable_collision_checks: true, ..spin(1.0) };
    let sent = stage.client::<Spin>("spin").send(blind);
    assert_eq!(over(&stage.finish(&sent), code), (GoalState::Succeeded, 0));

    stage.see(&[]);
    let slow = SpinGoal { time_allowance: seconds(1), ..spin(3.0) };
    let sent = stage.client::<Spin>("spin").send(slow);
    let progress = stage.finish(&sent);
    assert_eq!(over(&progress, code), aborted(SpinResult::TIMEOUT));
    let GoalProgress::Over(_, result) = progress else { panic!() };
    assert!(result.error_msg.contains("within 1 s"), "{}", result.error_msg);
    assert_eq!(stage.velocity, Twist2::ZERO);

    let target = Point { x: 0.3, ..Point::default() };
    let wrong = DriveOnHeadingGoal { target, speed: -0.1, ..DriveOnHeadingGoal::default() };
    let sent = stage.client::<DriveOnHeading>("drive_on_heading").send(wrong);
    let progress = stage.finish(&sent);
    let code = |it: &DriveOnHeadingResult| it.error_code;
    assert_eq!(over(&progress, code), aborted(DriveOnHeadingResult::INVALID_INPUT));
}

#[test]
fn a_robot_without_transforms_does_not_move() {
    let mut stage = Stage::new(Nav2Release::Main, &[("local_frame", "nowhere")]);
    stage.see(&[]);
    let sent = stage.client::<Spin>("spin").send(spin(1.0));
    let progress = stage.finish(&sent);
    let expected = (GoalState::Aborted, SpinResult::TF_ERROR);
    assert_eq!(over(&progress, |it: &SpinResult| it.error_code), expected);
    assert_eq!(stage.log, []);
}

#[test]
fn cancellation_stops_the_robot_at_once() {
    let mut stage = Stage::new(Nav2Release::Main, &[]);
    stage.see(&[]);
    let client = stage.client::<Spin>("spin");
    let sent = client.send(spin(3.0));
    stage.run(0.5);
    assert_eq!(stage.velocity, Twist2::new(0.0, 0.0, 1.0));
    let _ = sent.look();
    let _ = client.cancel(sent.id());
    // The next cycle.
    stage.run(0.11);
    assert_eq!(stage.velocity, Twist2::ZERO);
    let state = over(&sent.look(), |it: &SpinResult| it.error_code);
    assert_eq!(state, (GoalState::Canceled, 0));
    let count = stage.log.len();
    stage.run(0.5);
    assert_eq!(stage.log.len(), count, "nothing is published after the end");
}

#[test]
fn a_new_goal_preempts_the_running_one() {
    let mut stage = Stage::new(Nav2Release::Main, &[]);
    stage.see(&[]);
    let client = stage.client::<Spin>("spin");
    let first = client.send(spin(3.0));
    stage.run(0.5);
    let _ = first.look();
    let second = client.send(spin(-0.5));
    let progress = stage.finish(&second);
    let code = |it: &SpinResult| it.error_code;
    assert_eq!(over(&progress, code), (GoalState::Succeeded, 0));
    assert_eq!(over(&first.look(), code), (GoalState::Aborted, 0));
    // About half a radian to the left, then half a radian to the right.
    assert!((-0.1..0.15).contains(&stage.pose.yaw_rad), "{}", stage.pose.yaw_rad);
}

#[test]
fn waiting_takes_the_time_and_moves_nothing() {
    let mut stage = Stage::new(Nav2Release::Jazzy, &[]);
    let client = stage.client::<Wait>("wait");
    let sent = client.send(WaitGoal { time: seconds(2) });
    let progress = stage.finish(&sent);
    let GoalProgress::Over(state, result) = progress else { panic!() };
    assert_eq!(state, GoalState::Succeeded);
    assert_eq!(result.total_elapsed_time, seconds(2));
    let feedback = client.feedback();
    assert_eq!(feedback.last().unwrap().1.time_left, seconds(0));
    assert_eq!(feedback[feedback.len() - 6].1.time_left.nanosec, 500_000_000);
    assert_eq!(stage.log, []);
}

#[test]
fn teleoperation_slows_down_before_obstacles_until_it_is_preempted() {
    let mut stage = Stage::new(Nav2Release::Main, &[]);
    stage.see(&[(0.42, 0.0)]);
    let sent =
        stage.client::<AssistedTeleop>("assisted_teleop").send(AssistedTeleopGoal::default());
    let teleop = stage.user.publisher::<TwistStamped>("cmd_vel_teleop", Qos::reliable(1)).unwrap();
    stage.run(0.1);
    let mut command = TwistStamped::default();
    command.twist.linear.x = 0.5;
    teleop.publish(command);
    stage.run(0.15);
    // The front reaches 0.4 after more than 0.6 s, in the seventh step: 0.7 of the speed.
    assert!((stage.velocity.vx_m_s - 0.35).abs() < 0.051, "{}", stage.velocity.vx_m_s);
    stage.run(5.0);
    assert_eq!(stage.velocity, Twist2::ZERO, "it stands before the obstacle");
    assert!((0.2..0.31).contains(&stage.pose.x_m), "{}", stage.pose.x_m);
    let preempt = stage.user.publisher::<Empty>("preempt_teleop", Qos::reliable(1)).unwrap();
    preempt.publish(Empty::default());
    let progress = stage.finish(&sent);
    assert!(matches!(progress, GoalProgress::Over(GoalState::Succeeded, _)));
}

#[test]
fn deactivation_ends_the_goal_and_stops_the_robot() {
    let mut stage = Stage::new(Nav2Release::Main, &[]);
    stage.see(&[]);
    let client = stage.client::<Spin>("spin");
    let sent = client.send(spin(3.0));
    stage.run(0.5);
    let _ = sent.look();
    stage.server.lifecycle().change(Transition::Deactivate);
    stage.run(0.05);
    assert_eq!(stage.velocity, Twist2::ZERO);
    let code = |it: &SpinResult| it.error_code;
    assert_eq!(over(&sent.look(), code), (GoalState::Aborted, 0));
    let rejected = client.send(spin(1.0));
    stage.run(0.05);
    assert_eq!(over(&rejected.look(), code), (GoalState::Unknown, 0));
}
