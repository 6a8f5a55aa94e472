//! Goals with several poses: waypoints one after the other, and navigation through poses.

use periplus_graph::{GoalProgress, GoalState};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::Goals;
use periplus_msgs::nav2_msgs_main::{
    FollowWaypoints, FollowWaypointsGoal, NavigateThroughPoses, NavigateThroughPosesGoal,
};

use crate::common::pose_in;
use crate::world::{BRAKING_MS, CLOSED, FAR, NEAR, OUTSIDE, World};

const SIDE: [f64; 3] = [2.0, 2.5, 1.5];

fn poses(of: &[[f64; 3]]) -> Vec<PoseStamped> {
    of.iter().map(|[x, y, yaw]| pose_in("map", *x, *y, *yaw)).collect()
}

fn waypoints(of: &[[f64; 3]]) -> FollowWaypointsGoal {
    FollowWaypointsGoal { poses: poses(of), ..FollowWaypointsGoal::default() }
}

fn through(of: &[[f64; 3]]) -> NavigateThroughPosesGoal {
    let poses = Goals { goals: poses(of), ..Goals::default() };
    NavigateThroughPosesGoal { poses, ..NavigateThroughPosesGoal::default() }
}

#[test]
fn waypoints_are_canceled_at_every_stage() {
    // On the way to the first, at the first, on the way to the second.
    for stage in 0..3 {
        let mut world = World::new();
        let client = world.client_of::<FollowWaypoints>("follow_waypoints");
        let sent = client.send(waypoints(&[SIDE, FAR]));
        world.run_until("FollowPath");
        world.run_ms(1000);
        if stage > 0 {
            for _ in 0..3000 {
                if world.running().is_empty() {
                    break;
                }
                world.step();
            }
            world.is_at(SIDE);
            world.run_ms(50);
        }
        if stage > 1 {
            world.run_until("FollowPath");
            world.run_ms(1000);
        }
        assert_eq!(world.running().is_empty(), stage == 1);
        let _answer = client.cancel(sent.id());
        assert_eq!(world.finish(&sent, 100).state, GoalState::Canceled, "{stage}");
        world.stands_after(BRAKING_MS);
        assert!(world.running().is_empty());
        world.serves_the_next_goal();
    }
}

#[test]
fn waypoints_are_preempted() {
    let mut world = World::new();
    let client = world.client_of::<FollowWaypoints>("follow_waypoints");
    let first = client.send(waypoints(&[SIDE, FAR]));
    world.run_until("FollowPath");
    world.run_ms(1000);
    let second = client.send(waypoints(&[NEAR]));
    let ended = world.finish(&second, 20_000);
    assert_eq!((ended.state, ended.result.missed_waypoints.len()), (GoalState::Succeeded, 0));
    assert_eq!(world.finish(&first, 20).state, GoalState::Aborted);
    world.is_at(NEAR);
    world.stands_after(BRAKING_MS);
}

#[test]
fn waypoints_that_are_missed_have_their_code() {
    let mut world = World::new();
    let client = world.client_of::<FollowWaypoints>("follow_waypoints");
    let sent = client.send(waypoints(&[OUTSIDE, NEAR]));
    let ended = world.finish(&sent, 30_000);
    assert_eq!(ended.state, GoalState::Succeeded);
    let missed = &ended.result.missed_waypoints;
    assert_eq!(missed.len(), 1);
    assert_eq!((missed[0].waypoint_index, missed[0].error_code), (0, 204));
    world.is_at(NEAR);
    let empty = client.send(FollowWaypointsGoal::default());
    world.run_ms(50);
    assert_eq!(empty.look(), GoalProgress::Rejected);
}

#[test]
fn navigation_through_poses_is_canceled_and_preempted() {
    let mut world = World::new();
    let client = world.client_of::<NavigateThroughPoses>("navigate_through_poses");
    let sent = client.send(through(&[SIDE, FAR]));
    world.run_until("FollowPath");
    world.run_ms(1000);
    // Only one navigator works at a time.
    let other = world.send(NEAR);
    world.run_ms(50);
    assert_eq!(other.look(), GoalProgress::Rejected);
    let _answer = client.cancel(sent.id());
    assert_eq!(world.finish(&sent, 100).state, GoalState::Canceled);
    world.stands_after(BRAKING_MS);

    let first = client.send(through(&[SIDE, FAR]));
    world.run_until("FollowPath");
    world.run_ms(2000);
    let second = client.send(through(&[NEAR]));
    let ended = world.finish(&second, 30_000);
    assert_eq!(ended.state, GoalState::Succeeded, "{}", ended.result.error_msg);
    assert_eq!(world.finish(&first, 20).state, GoalState::Aborted);
    world.is_at(NEAR);
    world.stands_after(BRAKING_MS);
    world.serves_the_next_goal();
}

#[test]
fn navigation_through_poses_that_cannot_be_reached_fails() {
    for (list, code, max_ms) in
        [(&[SIDE, OUTSIDE][..], 304, 500), (&[SIDE, CLOSED], 308, 60_000), (&[], 309, 500)]
    {
        let mut world = World::new();
        let client = world.client_of::<NavigateThroughPoses>("navigate_through_poses");
        let sent = client.send(through(list));
        let ended = world.finish(&sent, max_ms);
        assert_eq!((ended.state, ended.result.error_code), (GoalState::Aborted, code));
        world.stands_after(BRAKING_MS);
        world.serves_the_next_goal();
    }
}
