//! Goals that are canceled or preempted at every stage.

use periplus_graph::GoalState;
use periplus_msgs::nav2_msgs_main::NavigateToPose;
use periplus_msgs::nav2_msgs_main::NavigateToPoseGoal;
use periplus_nav_nodes::nav2_actions::Nav2SentGoal;

use crate::world::{BRAKING_MS, CLOSED, FAR, NEAR, START, Setup, World, goal};

/// Maximum time from a cancellation to the end of the action \[ms\].
const MAX_CANCEL_MS: i64 = 100;

/// Tree that smooths the path.
const SMOOTHING: &str = r#"
<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <Sequence>
      <ComputePathToPose goal="{goal}" planner_id="GridBased" path="{path}"/>
      <SmoothPath unsmoothed_path="{path}" smoothed_path="{path}" smoother_id="simple_smoother"/>
      <FollowPath path="{path}" controller_id="FollowPath"/>
    </Sequence>
  </BehaviorTree>
</root>"#;

/// Stage at which a goal is interrupted.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// In the same instant.
    Sent,
    /// No map has arrived, so that the planner waits.
    WaitingForMap,
    /// No transform has arrived for a while, so that the planner waits.
    WaitingForPose,
    /// While a tree node runs on the way to a goal that can be reached.
    Driving(&'static str),
    /// At the goal, with another heading.
    Turning,
    /// While a tree node runs because of a goal that cannot be reached.
    Recovering(&'static str),
    /// While a tree node of the tree with a smoother runs.
    Smoothing,
}

const STAGES: [Stage; 10] = [
    Stage::Sent,
    Stage::WaitingForMap,
    Stage::WaitingForPose,
    Stage::Driving("ComputePathToPose"),
    Stage::Driving("FollowPath"),
    Stage::Turning,
    Stage::Recovering("ClearEntireCostmap"),
    Stage::Recovering("Spin"),
    Stage::Recovering("Wait"),
    Stage::Recovering("BackUp"),
];

impl Stage {
    /// A world with a goal that is at this stage.
    fn enter(self) -> (World, Nav2SentGoal<NavigateToPose>) {
        let mut setup = Setup::default().file("/trees/smoothing.xml", SMOOTHING);
        setup.has_map = !matches!(self, Self::WaitingForMap);
        let mut world = setup.start();
        match self {
            Self::Sent => {
                let sent = world.send(FAR);
                world.graph.settle();
                (world, sent)
            }
            Self::WaitingForMap => {
                let sent = world.send(FAR);
                world.run_ms(500);
                assert!(world.running()[0].contains("ComputePath"), "{:?}", world.running());
                (world, sent)
            }
            Self::WaitingForPose => {
                world.robot.faults.has_no_tf = true;
                world.run_ms(1000);
                let sent = world.send(FAR);
                world.run_ms(500);
                assert!(world.running()[0].contains("ComputePath"), "{:?}", world.running());
                (world, sent)
            }
            Self::Driving(tree_node) => {
                let sent = world.send(FAR);
                world.run_until(tree_node);
                if tree_node == "FollowPath" {
                    world.run_ms(1500);
                    assert!(world.robot.command.vx_m_s > 0.3, "{:?}", world.robot.command);
                }
                (world, sent)
            }
            Self::Turning => {
                let sent = world.send([START.x_m, START.y_m, 3.0]);
                world.run_ms(700);
                let command = world.robot.command;
                assert!(command.wz_rad_s.abs() > 0.3 && command.vx_m_s == 0.0, "{command:?}");
                (world, sent)
            }
            Self::Recovering(tree_node) => {
                let sent = world.send(CLOSED);
                world.run_until(tree_node);
                if !tree_node.starts_with("Clear") {
                    world.run_ms(600);
                    let is_moving =
                        world.robot.command.vx_m_s != 0.0 || world.robot.command.wz_rad_s != 0.0;
                    assert_eq!(is_moving, tree_node != "Wait", "{:?}", world.robot.command);
                }
                (world, sent)
            }
            Self::Smoothing => {
                let behavior_tree = "/trees/smoothing.xml".to_owned();
                let sent = world.client.send(NavigateToPoseGoal { behavior_tree, ..goal(FAR) });
                world.run_until("SmoothPath");
                (world, sent)
            }
        }
    }
}

#[test]
fn a_goal_is_canceled_at_every_stage() {
    for stage in STAGES.into_iter().chain([Stage::Smoothing]) {
        let (mut world, sent) = stage.enter();
        let before = world.robot.pose;
        let answer = world.client.cancel(sent.id());
        let ended = world.finish(&sent, MAX_CANCEL_MS);
        assert_eq!(ended.state, GoalState::Canceled, "{stage:?}");
        // As in Nav2, a goal that is canceled during recoveries has the code of the error before.
        let code = if matches!(stage, Stage::Recovering(_)) { 208 } else { 0 };
        assert_eq!(ended.result.error_code, code, "{stage:?}: {}", ended.result.error_msg);
        assert_eq!(answer.take().unwrap().unwrap().goals_canceling.len(), 1, "{stage:?}");
        world.stands_after(BRAKING_MS);
        let travelled_m =
            libm::hypot(world.robot.pose.x_m - before.x_m, world.robot.pose.y_m - before.y_m);
        assert!(travelled_m < 0.15, "{stage:?}: {travelled_m}");
        if matches!(stage, Stage::WaitingForMap) {
            world.publish_map();
        }
        world.serves_the_next_goal();
    }
}

#[test]
fn a_goal_is_preempted_at_every_stage() {
    for stage in STAGES {
        let (mut world, first) = stage.enter();
        let second = world.send(NEAR);
        world.run_ms(50);
        world.robot.faults = crate::robot::Faults::default();
        world.publish_map();
        let ended = world.finish(&second, 40_000);
        assert_eq!(ended.state, GoalState::Succeeded, "{stage:?} {}", ended.result.error_msg);
        assert_eq!(world.finish(&first, 20).state, GoalState::Aborted, "{stage:?}");
        world.is_at(NEAR);
        world.stands_after(BRAKING_MS);
        world.serves_the_next_goal();
    }
}

#[test]
fn a_goal_with_another_tree_is_refused_while_one_runs() {
    let (mut world, first) = Stage::Driving("FollowPath").enter();
    let behavior_tree = "/trees/smoothing.xml".to_owned();
    let second = world
        .client
        .send(NavigateToPoseGoal { behavior_tree: behavior_tree.clone(), ..goal(NEAR) });
    let ended = world.finish(&second, 100);
    assert_eq!(ended.state, GoalState::Aborted);
    let ended = world.finish(&first, 40_000);
    assert_eq!(ended.state, GoalState::Succeeded);
    world.is_at(FAR);
    // Afterwards it is served.
    let third = world.client.send(NavigateToPoseGoal { behavior_tree, ..goal(NEAR) });
    assert_eq!(world.finish(&third, 40_000).state, GoalState::Succeeded);
    world.is_at(NEAR);
}

#[test]
fn of_goals_in_one_instant_the_last_one_is_reached() {
    let mut world = World::new();
    let [first, second, third] = [FAR, CLOSED, NEAR].map(|pose| world.send(pose));
    let ended = world.finish(&third, 20_000);
    assert_eq!(ended.state, GoalState::Succeeded, "{}", ended.result.error_msg);
    world.is_at(NEAR);
    for overtaken in [first, second] {
        assert_eq!(world.finish(&overtaken, 20).state, GoalState::Aborted);
    }
    world.stands_after(BRAKING_MS);
    world.serves_the_next_goal();
}

#[test]
fn a_pending_goal_is_canceled_together_with_the_current_one() {
    let (mut world, first) = Stage::Driving("FollowPath").enter();
    let second = world.send(NEAR);
    world.graph.settle();
    let _answer = world.client.cancel(second.id());
    assert_eq!(world.finish(&second, MAX_CANCEL_MS).state, GoalState::Canceled);
    assert_eq!(world.finish(&first, MAX_CANCEL_MS).state, GoalState::Aborted);
    world.stands_after(BRAKING_MS);
    world.serves_the_next_goal();
}

#[test]
fn a_goal_after_a_cancellation_in_the_same_instant_is_reached() {
    let (mut world, first) = Stage::Driving("FollowPath").enter();
    let _answer = world.client.cancel(first.id());
    let second = world.send(NEAR);
    let ended = world.finish(&second, 20_000);
    assert_eq!(ended.state, GoalState::Succeeded, "{}", ended.result.error_msg);
    assert_eq!(world.finish(&first, 20).state, GoalState::Aborted);
    world.is_at(NEAR);
    world.stands_after(BRAKING_MS);
}
