//! Inputs that are missing, late or lost, and a robot that is stuck.

use periplus_costmap::Nav2Release;
use periplus_graph::GoalState;
use periplus_msgs::nav2_msgs_main::{ComputePathToPoseResult, FollowPathResult, NavigateToPose};
use periplus_nav_nodes::nav2_actions::Nav2SentGoal;

use crate::robot::Faults;
use crate::world::{BRAKING_MS, FAR, NEAR, Setup, World};

/// Maximum time of all attempts and recoveries of the tree of Jazzy with a robot that does not move \[ms\]: seven times
/// 10 s until the controller gives up, twice, and recoveries of up to 15 s between them.
const MAX_ATTEMPTS_MS: i64 = 240_000;

/// World with a robot that drives to a goal.
fn driving(setup: Setup) -> (World, Nav2SentGoal<NavigateToPose>) {
    let mut world = setup.start();
    let sent = world.send(FAR);
    world.run_until("FollowPath");
    world.run_ms(1500);
    assert!(world.robot.command.vx_m_s > 0.3, "{:?}", world.robot.command);
    (world, sent)
}

#[test]
fn without_a_map_the_planner_times_out() {
    let mut world = Setup { has_map: false, ..Setup::default() }.start();
    let sent = world.send(NEAR);
    // `costmap_update_timeout` is 1 s.
    assert!(world.reason_after_ms("code 207") <= 1100);
    world.fails(&sent, 40_000, ComputePathToPoseResult::TIMEOUT, &["static_layer"]);
    world.publish_map();
    world.serves_the_next_goal();
}

#[test]
fn transforms_that_are_lost_stop_the_robot() {
    let (mut world, sent) = driving(Setup::default());
    world.robot.faults.has_no_tf = true;
    // `transform_tolerance` is 0.3 s.
    world.fails(&sent, 400, FollowPathResult::TF_ERROR, &["`base_link` to `odom`", "s old"]);
    world.serves_the_next_goal();
}

#[test]
fn a_goal_without_transforms_fails() {
    let mut world = World::new();
    world.robot.faults.has_no_tf = true;
    world.run_ms(2000);
    let sent = world.send(NEAR);
    let words = ["Unable to get start pose", "`base_link` to `map`"];
    world.fails(&sent, 1100, ComputePathToPoseResult::TF_ERROR, &words);
    world.serves_the_next_goal();
}

/// The costmaps have no `expected_update_rate`; the collision monitor stops the robot.
#[test]
fn a_silent_scan_stops_the_robot_by_the_collision_monitor() {
    let (mut world, sent) = driving(Setup::default());
    world.robot.faults.has_no_scan = true;
    // `source_timeout` is 1 s.
    world.stands_after(1200);
    let code = FollowPathResult::FAILED_TO_MAKE_PROGRESS;
    world.fails(&sent, MAX_ATTEMPTS_MS, code, &["0.00 m in 10"]);
    world.serves_the_next_goal();
}

#[test]
fn a_late_local_costmap_stops_the_robot() {
    let (mut world, sent) = driving(Setup::default().replace("LOCAL_RATE", "0.3"));
    world.robot.faults.has_no_scan = true;
    world.fails(&sent, 1500, FollowPathResult::CONTROLLER_TIMED_OUT, &["obstacle_layer"]);
    world.serves_the_next_goal();
}

#[test]
fn a_late_global_costmap_stops_the_robot() {
    let (mut world, sent) = driving(Setup::default().replace("GLOBAL_RATE", "0.3"));
    world.robot.faults.has_no_scan = true;
    // The next path is due within 1 s, and waits for the costmap for 1 s.
    assert!(world.reason_after_ms("code 207") <= 2500);
    world.fails(&sent, MAX_ATTEMPTS_MS, ComputePathToPoseResult::TIMEOUT, &["obstacle_layer"]);
    world.serves_the_next_goal();
}

#[test]
fn a_stuck_robot_gives_up() {
    let (mut world, sent) = driving(Setup::default());
    world.robot.faults = Faults { is_stuck: true, ..Faults::default() };
    // `movement_time_allowance` is 10 s.
    assert!(world.reason_after_ms("code 105") <= 11_000);
    let code = FollowPathResult::FAILED_TO_MAKE_PROGRESS;
    world.fails(&sent, MAX_ATTEMPTS_MS, code, &["0.00 m in 10"]);
    world.serves_the_next_goal();
}

/// Humble waits for the costmap without a limit; the robot stands meanwhile.
#[test]
fn humble_waits_for_a_late_costmap_while_the_robot_stands() {
    let setup = Setup { release: Nav2Release::Humble, ..Setup::default() };
    let (mut world, sent) = driving(setup.replace("LOCAL_RATE", "0.3"));
    world.robot.faults.has_no_scan = true;
    // 0.3 s until the costmap is late, 0.3 s until the controller stops the robot, 0.2 s to brake.
    world.stands_after(1000);
    assert_eq!(world.running(), ["FollowPath"]);
    let _answer = world.client.cancel(sent.id());
    assert_eq!(world.finish(&sent, 100).state, GoalState::Canceled);
    world.stands_after(BRAKING_MS);
    world.serves_the_next_goal();
}
