//! Goals that cannot be reached, and goals that are not valid.

use periplus_msgs::nav2_msgs_main::{ComputePathToPoseResult, NavigateToPoseGoal};

use crate::common::pose_in;
use crate::world::{CLOSED, FAR, NEAR, OUTSIDE, Setup, World, goal};

/// Maximum time until a goal is refused for which recoveries are of no help \[ms\].
const MAX_REFUSAL_MS: i64 = 100;

#[test]
fn goals_are_reached_without_a_fault() {
    let mut world = World::new();
    world.reaches(NEAR);
    world.reaches(FAR);
}

/// The tree of Jazzy tries six recoveries: clear, spin, wait 5 s, back up, clear, spin.
#[test]
fn a_goal_without_a_path_has_its_reason_before_the_recoveries() {
    let mut world = World::new();
    let sent = world.send(CLOSED);
    assert!(world.reason_after_ms("code 208") <= MAX_REFUSAL_MS);
    let code = ComputePathToPoseResult::NO_VALID_PATH;
    world.fails(&sent, 15_000, code, &["nearest reachable position", "static_layer"]);
    world.serves_the_next_goal();
}

#[test]
fn a_goal_outside_of_the_map_is_refused_at_once() {
    let mut world = World::new();
    let sent = world.send(OUTSIDE);
    let words = ["9.00", "the map extends"];
    world.fails(&sent, MAX_REFUSAL_MS, ComputePathToPoseResult::GOAL_OUTSIDE_MAP, &words);
    world.serves_the_next_goal();
}

#[test]
fn a_goal_in_a_wall_is_refused_at_once() {
    let mut world = Setup::default().replace("tolerance: 0.5", "tolerance: 0.0").start();
    let sent = world.send([4.6, 3.4, 0.0]);
    let words = ["static_layer", "nearest reachable position"];
    world.fails(&sent, MAX_REFUSAL_MS, ComputePathToPoseResult::GOAL_OCCUPIED, &words);
    world.serves_the_next_goal();
}

#[test]
fn goals_that_are_not_numbers_are_refused_at_once() {
    let mut world = World::new();
    for pose in [[f64::NAN, 1.0, 0.0], [1.0, f64::INFINITY, 0.0], [2.0, 1.0, f64::NAN]] {
        let sent = world.send(pose);
        let code = ComputePathToPoseResult::GOAL_OUTSIDE_MAP;
        world.fails(&sent, MAX_REFUSAL_MS, code, &["finite numbers"]);
    }
    world.serves_the_next_goal();
}

#[test]
fn a_goal_in_an_unknown_frame_is_refused_at_once() {
    let mut world = World::new();
    let pose = pose_in("kitchen", 1.0, 1.0, 0.0);
    let sent = world.client.send(NavigateToPoseGoal { pose, ..goal(NEAR) });
    // Jazzy has no code for it.
    world.fails(&sent, MAX_REFUSAL_MS, 0, &["`kitchen` is not published"]);
    world.serves_the_next_goal();
}

#[test]
fn a_goal_in_the_frame_of_the_robot_is_reached() {
    let mut world = World::new();
    let pose = pose_in("base_link", 2.0, 0.0, 0.0);
    let sent = world.client.send(NavigateToPoseGoal { pose, ..goal(NEAR) });
    let ended = world.finish(&sent, 20_000);
    assert_eq!(ended.state, periplus_graph::GoalState::Succeeded, "{}", ended.result.error_msg);
    world.is_at([3.0, 1.0, 0.0]);
}
