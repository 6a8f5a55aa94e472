//! Navigator with scripted servers, in lockstep.
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    clippy::disallowed_methods,
    reason = "helpers of tests, which read shared files"
)]

mod equal_trees;
#[path = "../common/files.rs"]
mod files;
mod world;

use periplus_costmap::Nav2Release;
use periplus_graph::{GoalProgress, GoalState, Qos};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::Goals;
use periplus_msgs::nav2_msgs::BehaviorTreeLog;
use periplus_msgs::nav2_msgs_main::{
    NavigateThroughPoses, NavigateThroughPosesGoal, NavigateToPose, NavigateToPoseGoal,
    NavigateToPoseResult, WaypointStatus,
};
use periplus_msgs::std_msgs;
use periplus_nav_nodes::bt_navigator::{NAVIGATE_CAR_TO_POSE_FILE, built_in_tree};
use periplus_nav_nodes::nav2_actions::{Nav2ActionClient, Nav2SentGoal};
use periplus_resources::MemoryHost;
use world::{Answer, World, goal};

struct Client(Nav2ActionClient<NavigateToPose>);

impl Client {
    fn new(world: &World) -> Self {
        Self(Nav2ActionClient::new(&world.node, world.release, "navigate_to_pose").unwrap())
    }

    fn send(&self, x_m: f64) -> Nav2SentGoal<NavigateToPose> {
        self.send_with_tree(x_m, "")
    }

    fn send_with_tree(&self, x_m: f64, tree: &str) -> Nav2SentGoal<NavigateToPose> {
        self.0.send(NavigateToPoseGoal { pose: goal(x_m), behavior_tree: tree.to_owned() })
    }
}

/// Final state and result.
fn end(world: &World, sent: &Nav2SentGoal<NavigateToPose>) -> (GoalState, NavigateToPoseResult) {
    // The first look requests the result of an accepted goal.
    let _ = sent.look();
    world.run_ms(1);
    match sent.look() {
        GoalProgress::Over(state, result) => (state, (*result).clone()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn paths_are_planned_each_second_and_followed() {
    let world = World::new(Nav2Release::Main);
    world.controller.with(|controller| controller.answers = [Answer::Run].into());
    let client = Client::new(&world);
    let sent = client.send(10.0);
    world.run_ms(4_500);
    assert_eq!(sent.look(), GoalProgress::Accepted);
    let planned = world.log.times("compute_path_to_pose");
    assert_eq!(planned.len(), 5, "{planned:?}");
    let gaps: Vec<i64> = planned.windows(2).map(|pair| pair[1] - pair[0]).collect();
    // One period after the last plan arrived, plus one tick.
    assert!(gaps.iter().all(|gap| (1_000..=1_020).contains(gap)), "{gaps:?}");
    // Each new path is sent to the controller, which never stops in between.
    assert_eq!(world.log.times("follow_path").len(), 5);
    assert!(world.log.times("follow_path canceled").is_empty());
    let goals = world.controller.with(|controller| controller.goals.clone());
    assert_eq!(goals[0].controller_id, "FollowPath");
    assert!(goals.windows(2).all(|pair| pair[0].path != pair[1].path));
    let feedback = client.0.feedback();
    let last = &feedback[feedback.len() - 1].1;
    assert_eq!(last.distance_remaining, 10.0);
    assert_eq!((last.number_of_recoveries, last.navigation_time.sec), (0, 4));
    world.controller.with(|controller| controller.answers = [Answer::Succeed(0)].into());
    world.run_ms(2_000);
    assert_eq!(end(&world, &sent).0, GoalState::Succeeded);
}

#[test]
fn near_the_goal_a_valid_path_is_kept() {
    let world = World::new(Nav2Release::Main);
    world.controller.with(|controller| controller.answers = [Answer::Run].into());
    let client = Client::new(&world);
    let _sent = client.send(3.0);
    world.run_ms(4_500);
    assert_eq!(world.log.times("compute_path_to_pose").len(), 1);
    assert!(world.log.times("is_path_valid").len() >= 3);
    assert_eq!(world.log.times("follow_path").len(), 1);
}

/// Attempts to plan and follow, each with the clearing of the local costmap, and what follows each.
fn attempts(recoveries: &[&[&str]]) -> Vec<String> {
    let attempt = ["compute_path_to_pose", "follow_path", "clear local", "follow_path"];
    let all = recoveries.iter().flat_map(|after| attempt.iter().chain(after.iter()));
    all.map(|name| (*name).to_owned()).collect()
}

#[test]
fn recoveries_are_tried_in_turn() {
    let clear: &[&str] = &["clear local", "clear global"];
    let check = |release, recoveries: &[&[&str]], count: i16| {
        let world = World::new(release);
        let code = 105;
        world.controller.with(|controller| controller.answers = [Answer::Abort(0, code)].into());
        let client = Client::new(&world);
        let sent = client.send(10.0);
        world.run_ms(9_000);
        assert_eq!(world.log.names(), attempts(recoveries), "{release}");
        let (state, result) = end(&world, &sent);
        assert_eq!(state, GoalState::Aborted, "{release}");
        assert_eq!(result.error_code, if release == Nav2Release::Humble { 0 } else { code });
        let feedback = client.0.feedback();
        assert_eq!(feedback[feedback.len() - 1].1.number_of_recoveries, count, "{release}");
    };
    // In main the round ends after its last child; before, six retries go round.
    check(Nav2Release::Main, &[clear, &["spin"], &["wait"], &["backup"]], 9);
    let six: [&[&str]; 7] = [clear, &["spin"], &["wait"], &["backup"], clear, &["spin"], &[]];
    check(Nav2Release::Jazzy, &six, 15);
    check(Nav2Release::Humble, &six, 15);
}

#[test]
fn a_recovery_that_helps_resets_the_retries() {
    let world = World::new(Nav2Release::Main);
    let answers = [Answer::Abort(0, 105), Answer::Abort(0, 105), Answer::Succeed(100)];
    world.controller.with(|controller| controller.answers = answers.into());
    let sent = Client::new(&world).send(10.0);
    world.run_ms(1_000);
    assert_eq!(end(&world, &sent).0, GoalState::Succeeded);
    assert_eq!(end(&world, &sent).1.error_code, 0);
    assert!(world.log.times("spin").is_empty());
}

#[test]
fn an_occupied_goal_ends_at_once_with_the_reason() {
    for release in [Nav2Release::Main, Nav2Release::Jazzy] {
        let world = World::new(release);
        world.planner.with(|planner| planner.answers = [Answer::Abort(0, 206)].into());
        let reasons =
            world.node.mailbox::<std_msgs::String>("/bt_navigator/status_reason", Qos::latched(1));
        let sent = Client::new(&world).send(10.0);
        world.run_ms(100);
        let (state, result) = end(&world, &sent);
        assert_eq!((state, result.error_code), (GoalState::Aborted, 206), "{release}");
        assert_eq!(world.log.names(), ["compute_path_to_pose"]);
        let status = world.navigator.with(|navigator| navigator.status());
        let error = status.last_error.clone().unwrap();
        assert_eq!((error.server.as_str(), error.code), ("compute_path_to_pose", 206));
        let reason = reasons.unwrap().latest().unwrap().data.clone();
        assert!(reason.contains("compute_path_to_pose failed with code 206"), "{reason}");
        assert!(reason.contains("Goal failed error_code:206"), "{reason}");
    }
}

/// Cancels a goal while a server is running; it is canceled, and the navigation as well.
fn check_cancel(prepare: impl FnOnce(&World), ms: i64, running: &str) {
    let world = World::new(Nav2Release::Main);
    prepare(&world);
    let client = Client::new(&world);
    let sent = client.send(10.0);
    world.run_ms(ms);
    assert_eq!(world.log.names().last().unwrap(), running);
    let status = world.navigator.with(|navigator| navigator.status());
    assert_eq!(status.running.len(), 1, "{status}");
    let _answer = client.0.cancel(sent.id());
    world.run_ms(100);
    assert_eq!(end(&world, &sent).0, GoalState::Canceled, "{running}");
    assert_eq!(*world.log.names().last().unwrap(), format!("{running} canceled"));
    let status = world.navigator.with(|navigator| navigator.status());
    assert_eq!((status.action, status.last_outcome.as_str()), (None, "Goal canceled"));
    // Nothing goes on afterwards.
    let count = world.log.names().len();
    world.run_ms(3_000);
    assert_eq!(world.log.names().len(), count);
}

#[test]
fn cancellation_stops_the_running_server() {
    let fail = || [Answer::Abort(0, 105)].into();
    let run = || [Answer::Run].into();
    check_cancel(|world| world.planner.with(|it| it.answers = run()), 200, "compute_path_to_pose");
    check_cancel(|world| world.controller.with(|it| it.answers = run()), 200, "follow_path");
    let spin = |world: &World| {
        world.controller.with(|it| it.answers = fail());
        world.spin.with(|it| it.answers = run());
    };
    check_cancel(spin, 800, "spin");
    let wait = |world: &World| {
        world.controller.with(|it| it.answers = fail());
        world.wait.with(|it| it.answers = run());
    };
    check_cancel(wait, 1_200, "wait");
    let back_up = |world: &World| {
        world.controller.with(|it| it.answers = fail());
        world.backup.with(|it| it.answers = run());
    };
    check_cancel(back_up, 1_500, "backup");
    // Before the server has acknowledged.
    check_cancel(|world| world.planner.with(|it| it.answers = run()), 1, "compute_path_to_pose");
}

#[test]
fn a_new_goal_for_the_same_tree_replaces_the_first() {
    let world = World::new(Nav2Release::Main);
    world.controller.with(|controller| controller.answers = [Answer::Run].into());
    let client = Client::new(&world);
    let first = client.send(10.0);
    world.run_ms(500);
    let second = client.send(20.0);
    world.run_ms(1_000);
    assert_eq!(end(&world, &first).0, GoalState::Aborted);
    assert_eq!(second.look(), GoalProgress::Accepted);
    let planned = world.planner.with(|planner| planner.goals.clone());
    let xs: Vec<f64> = planned.iter().map(|plan| plan.goal.pose.position.x).collect();
    assert_eq!(xs, [10.0, 20.0]);
    assert!(world.log.times("follow_path canceled").is_empty());
    // A recovery stops for a new goal.
    world.controller.with(|controller| controller.answers = [Answer::Abort(0, 105)].into());
    world.spin.with(|spin| spin.answers = [Answer::Run].into());
    world.run_ms(2_500);
    assert_eq!(world.log.names().last().unwrap(), "spin");
    world.controller.with(|controller| controller.answers = [Answer::Succeed(0)].into());
    let third = client.send(30.0);
    world.run_ms(500);
    assert_eq!(world.log.times("spin canceled").len(), 1);
    assert_eq!(end(&world, &second).0, GoalState::Aborted);
    assert_eq!(end(&world, &third).0, GoalState::Succeeded);
}

/// Tree that only follows a path.
const OTHER_TREE: &str = r#"<root BTCPP_format="4"><BehaviorTree ID="Other">
  <Wait wait_duration="1.0"/>
</BehaviorTree></root>"#;

#[test]
fn a_new_goal_for_another_tree_is_refused() {
    let files = MemoryHost::new().with_file("/t/other.xml", OTHER_TREE);
    let world = World::with(Nav2Release::Main, files, &[]);
    world.controller.with(|controller| controller.answers = [Answer::Succeed(2_000)].into());
    let client = Client::new(&world);
    let first = client.send(3.0);
    world.run_ms(500);
    let second = client.send_with_tree(3.0, "/t/other.xml");
    world.run_ms(100);
    assert_eq!(end(&world, &second).0, GoalState::Aborted);
    assert_eq!(first.look(), GoalProgress::Accepted);
    world.run_ms(2_500);
    assert_eq!(end(&world, &first).0, GoalState::Succeeded);
    assert!(world.log.times("wait").is_empty());
    let third = client.send_with_tree(3.0, "/t/other.xml");
    world.run_ms(100);
    assert_eq!(end(&world, &third).0, GoalState::Succeeded);
    assert_eq!(world.log.times("wait").len(), 1);
}

#[test]
fn a_broken_tree_names_its_line() {
    let broken =
        "<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"B\">\n  <Spinn/>\n</BehaviorTree></root>";
    let files = || MemoryHost::new().with_file("/t/broken.xml", broken);
    let world = World::with(Nav2Release::Main, files(), &[]);
    let client = Client::new(&world);
    let sent = client.send_with_tree(3.0, "/t/broken.xml");
    world.run_ms(100);
    let (state, result) = end(&world, &sent);
    assert_eq!((state, result.error_code), (GoalState::Aborted, 9001));
    let expected = "/t/broken.xml:3:4: unknown node `Spinn`; did you mean `Spin`?";
    assert!(result.error_msg.contains(expected), "{}", result.error_msg);
    let missing = client.send_with_tree(3.0, "/t/missing.xml");
    world.run_ms(100);
    assert_eq!(end(&world, &missing).1.error_code, 9001);
    // The default tree is loaded at activation.
    let params = [("default_nav_to_pose_bt_xml", "/t/broken.xml")];
    let world = World::with(Nav2Release::Main, files(), &params);
    assert!(!world.navigator.lifecycle().is_active());
    // A name of Nav2's own file means the built-in tree where the file does not exist.
    let stock = "/opt/ros/jazzy/share/nav2_bt_navigator/behavior_trees/navigate_to_pose_w_replanning_and_recovery.xml";
    let params = [("default_nav_to_pose_bt_xml", stock)];
    let world = World::with(Nav2Release::Jazzy, files(), &params);
    assert!(world.navigator.lifecycle().is_active());
}

#[test]
fn the_tree_for_cars_keeps_its_path_and_never_spins() {
    for release in [Nav2Release::Jazzy, Nav2Release::Main] {
        let params = [("default_nav_to_pose_bt_xml", NAVIGATE_CAR_TO_POSE_FILE)];
        let world = World::with(release, MemoryHost::new(), &params);
        world.controller.with(|controller| controller.answers = [Answer::Succeed(5_000)].into());
        let sent = Client::new(&world).send(3.0);
        world.run_ms(8_000);
        assert_eq!(end(&world, &sent).0, GoalState::Succeeded, "{release}");
        assert_eq!(world.log.times("compute_path_to_pose").len(), 1, "{release}");
        assert!(world.log.times("is_path_valid").len() >= 3, "{release}");
    }
    let tree = built_in_tree(Nav2Release::Main, NAVIGATE_CAR_TO_POSE_FILE).unwrap();
    assert!(!tree.contains("<Spin"));
}

#[test]
fn a_finished_action_is_not_repeated_until_its_parent_resets_it() {
    let tree = r#"<root BTCPP_format="4"><BehaviorTree ID="T"><PipelineSequence>
      <ComputePathToPose goal="{goal}" path="{path}"/><FollowPath path="{path}"/>
    </PipelineSequence></BehaviorTree></root>"#;
    let files = MemoryHost::new().with_file("/t/tree.xml", tree);
    let world = World::with(Nav2Release::Main, files, &[]);
    world.controller.with(|controller| controller.answers = [Answer::Succeed(500)].into());
    let sent = Client::new(&world).send_with_tree(10.0, "/t/tree.xml");
    world.run_ms(1_000);
    assert_eq!(end(&world, &sent).0, GoalState::Succeeded);
    assert_eq!(world.log.names(), ["compute_path_to_pose", "follow_path"]);
}

#[test]
fn trees_are_found_by_id_in_folders() {
    let uses = r#"<root BTCPP_format="4"><BehaviorTree ID="Uses"><SubTree ID="Other"/></BehaviorTree></root>"#;
    let files =
        MemoryHost::new().with_file("/t/other.xml", OTHER_TREE).with_file("/u/uses.xml", uses);
    let world = World::with(Nav2Release::Main, files, &[("bt_search_directories", "/t")]);
    let client = Client::new(&world);
    for tree in ["Other", "/u/uses.xml"] {
        let sent = client.send_with_tree(3.0, tree);
        world.run_ms(100);
        assert_eq!(
            end(&world, &sent),
            (GoalState::Succeeded, NavigateToPoseResult::default()),
            "{tree}"
        );
    }
    let sent = client.send_with_tree(3.0, "Unknown");
    world.run_ms(100);
    assert!(
        end(&world, &sent).1.error_msg.contains("there is no tree `Unknown`"),
        "{:?}",
        end(&world, &sent).1
    );
}

#[test]
fn a_server_that_does_not_exist_or_refuses_fails_the_node() {
    let tree = r#"<root BTCPP_format="4"><BehaviorTree ID="T">
      <Spin server_name="none" error_code_id="{spin_error_code}" error_msg="{spin_error_msg}"/>
    </BehaviorTree></root>"#;
    let files = MemoryHost::new().with_file("/t/tree.xml", tree);
    let world = World::with(Nav2Release::Main, files, &[]);
    let client = Client::new(&world);
    let sent = client.send_with_tree(3.0, "/t/tree.xml");
    world.run_ms(900);
    assert_eq!(sent.look(), GoalProgress::Accepted);
    world.run_ms(200);
    let (_, result) = end(&world, &sent);
    assert_eq!(result.error_code, 2);
    assert_eq!(result.error_msg, "the action server `none` is not available");
    world.planner.with(|planner| planner.answers = [Answer::Reject].into());
    let sent = client.send(10.0);
    world.run_ms(200);
    assert_eq!(end(&world, &sent).1.error_msg, "Goal was rejected by the action server.");
}

#[test]
fn a_robot_without_a_pose_refuses_goals() {
    let world = World::with(Nav2Release::Main, MemoryHost::new(), &[("robot_base_frame", "base")]);
    let sent = Client::new(&world).send(10.0);
    world.run_ms(100);
    assert_eq!(sent.look(), GoalProgress::Rejected);
    let world = World::with(Nav2Release::Jazzy, MemoryHost::new(), &[("robot_base_frame", "base")]);
    let sent = Client::new(&world).send(10.0);
    world.run_ms(100);
    let (state, result) = end(&world, &sent);
    assert_eq!((state, result.error_code), (GoalState::Aborted, 0));
}

#[test]
fn poses_are_passed_one_after_the_other() {
    for release in [Nav2Release::Main, Nav2Release::Humble] {
        let world = World::new(release);
        world.controller.with(|controller| controller.answers = [Answer::Run].into());
        let client = Nav2ActionClient::<NavigateThroughPoses>::new(
            &world.node,
            release,
            "navigate_through_poses",
        );
        let client = client.unwrap();
        let poses = Goals { goals: vec![goal(5.0), goal(10.0), goal(20.0)], ..Goals::default() };
        let sent = client.send(NavigateThroughPosesGoal { poses, ..Default::default() });
        world.run_ms(100);
        let to_pose = Client::new(&world).send(1.0);
        world.move_to(5.5);
        world.run_ms(3_200);
        assert_eq!(to_pose.look(), GoalProgress::Rejected, "only one navigator runs");
        let last = client.feedback().pop().unwrap().1;
        assert_eq!(last.number_of_poses_remaining, 2, "{release}");
        world.controller.with(|controller| controller.answers = [Answer::Succeed(0)].into());
        world.run_ms(3_500);
        let _ = sent.look();
        world.run_ms(1);
        let GoalProgress::Over(state, result) = sent.look() else { panic!("{:?}", sent.look()) };
        assert_eq!(state, GoalState::Succeeded);
        if release == Nav2Release::Main {
            let statuses = result.waypoint_statuses.iter().map(|status| status.waypoint_status);
            assert_eq!(statuses.collect::<Vec<_>>(), [WaypointStatus::COMPLETED; 3]);
        }
    }
}

#[test]
fn a_pose_on_the_topic_is_a_goal_and_changes_are_logged() {
    let world = World::new(Nav2Release::Jazzy);
    let log =
        world.node.mailbox::<BehaviorTreeLog>("behavior_tree_log", Qos::reliable(100)).unwrap();
    let topic = world.node.publisher::<PoseStamped>("goal_pose", Qos::reliable(10)).unwrap();
    topic.publish(goal(3.0));
    world.run_ms(200);
    assert_eq!(world.log.names(), ["compute_path_to_pose", "follow_path"]);
    let messages = log.drain();
    let events = messages.iter().flat_map(|message| &message.event_log);
    let of_planner: Vec<(&str, &str)> = events
        .filter(|event| event.node_name == "ComputePathToPose")
        .map(|event| (event.previous_status.as_str(), event.current_status.as_str()))
        .collect();
    assert_eq!(of_planner[..3], [("IDLE", "RUNNING"), ("RUNNING", "SUCCESS"), ("SUCCESS", "IDLE")]);
}

#[test]
fn runs_are_equal() {
    let run = || {
        let world = World::new(Nav2Release::Main);
        let answers = [Answer::Abort(30, 105), Answer::Abort(7, 106), Answer::Succeed(400)];
        world.controller.with(|controller| controller.answers = answers.into());
        let client = Client::new(&world);
        let sent = client.send(10.0);
        world.run_ms(5_000);
        (end(&world, &sent), format!("{:?}", client.0.feedback()), world.log.names())
    };
    assert_eq!(run(), run());
}

#[test]
fn a_goal_that_is_accepted_too_late_is_canceled() {
    for release in [Nav2Release::Jazzy, Nav2Release::Main] {
        let world = World::new(release);
        world.controller.with(|controller| controller.answers = [Answer::AcceptLate(500)].into());
        let sent = Client::new(&world).send(10.0);
        world.run_ms(200);
        let (state, result) = end(&world, &sent);
        assert_eq!(state, GoalState::Aborted, "{release}");
        assert!(result.error_msg.contains("acknowledge"), "{release} {}", result.error_msg);
        // The controller would drive for a client that is gone.
        world.run_ms(400);
        assert_eq!(world.log.times("follow_path canceled").len(), 1, "{release}");
    }
}
