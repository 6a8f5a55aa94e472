//! Plugins of other authors in the servers of navigation.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/files.rs"]
mod files;
mod plugins;

use std::sync::Arc;

use common::{GLOBAL_COSTMAP, Stage, costmap, map, pose_in};
use files::MemoryFiles;
use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_graph::{GoalProgress, GoalState, LifecycleNode, NodeSettings, Qos, Transition};
use periplus_msgs::Nav2Action;
use periplus_msgs::geometry_msgs::TwistStamped;
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::nav2_msgs_main::*;
use periplus_msgs::rcl_interfaces::{
    Parameter, ParameterType, ParameterValue, SetParameters, SetParametersRequest,
};
use periplus_nav_nodes::behavior_server::{BehaviorServerConfig, BehaviorServerNode};
use periplus_nav_nodes::bt_navigator::{BtNavigator, BtNavigatorParams};
use periplus_nav_nodes::controller_server::ControllerServer;
use periplus_nav_nodes::nav2_actions::Nav2ActionClient;
use periplus_nav_nodes::planner_server::PlannerServer;
use periplus_params::Given;
use periplus_resources::MemoryHost;
use plugins::plugins;

const MAIN: Nav2Release = Nav2Release::Main;

/// Sends a goal and waits for its end.
fn finish<A: Nav2Action>(
    stage: &mut Stage,
    name: &str,
    goal: A::Goal,
    milliseconds: i64,
) -> (GoalState, Arc<A::Result>) {
    let client: Nav2ActionClient<A> = Nav2ActionClient::new(&stage.user, MAIN, name).unwrap();
    let sent = client.send(goal);
    for _ in 0..milliseconds / 20 {
        stage.advance(20);
        if let GoalProgress::Over(state, result) = sent.look() {
            return (state, result);
        }
    }
    panic!("{:?}", sent.look())
}

fn planner_server(
    given: &[(&str, &str)],
    found: &mut Diagnostics,
) -> (Stage, LifecycleNode<PlannerServer>) {
    let mut stage = Stage::new();
    let costmap = costmap(&stage.graph, "global_costmap", GLOBAL_COSTMAP, MAIN);
    let node = stage.graph.node(NodeSettings::new("planner_server")).unwrap();
    let given = given.iter().map(|(name, text)| Given::new(name, *text));
    let server =
        PlannerServer::with_plugins(&node, given, costmap, (&plugins(), &MemoryHost::new()), found)
            .unwrap();
    stage.map.publish(map(|_, _| false));
    server.start();
    stage.advance(300);
    (stage, server)
}

/// Plans from (1, 1) to (5, 1).
fn plan(stage: &mut Stage) -> (GoalState, Arc<ComputePathToPoseResult>) {
    let goal = ComputePathToPoseGoal { goal: pose_in("map", 5.0, 1.0, 0.0), ..Default::default() };
    finish::<ComputePathToPose>(stage, "compute_path_to_pose", goal, 2000)
}

#[test]
fn a_planner_of_others_plans_with_its_parameters() {
    let given = [("GridBased.plugin", "my_package/StraightLine"), ("GridBased.step", "2.0")];
    let mut found = Diagnostics::new();
    let (mut stage, server) = planner_server(&given, &mut found);
    assert!(found.is_empty(), "{:?}", found.iter().next());
    let (state, result) = plan(&mut stage);
    assert_eq!((state, &*result.error_msg), (GoalState::Succeeded, ""));
    let xs: Vec<f64> = result.path.poses.iter().map(|pose| pose.pose.position.x).collect();
    assert_eq!(xs, [1.0, 3.0, 5.0]);

    set_step(&stage, 1.0);
    assert_eq!(plan(&mut stage).1.path.poses.len(), 5);

    // The planner outlives a cleanup of its server, and then has the values of the meantime.
    assert!(server.lifecycle().change_now(Transition::Deactivate));
    assert!(server.lifecycle().change_now(Transition::Cleanup));
    set_step(&stage, 0.5);
    server.start();
    stage.advance(300);
    assert_eq!(plan(&mut stage).1.path.poses.len(), 9);
}

/// Sets the parameter `GridBased.step` of the planner server.
fn set_step(stage: &Stage, step_m: f64) {
    let value = ParameterValue {
        r#type: ParameterType::PARAMETER_DOUBLE,
        double_value: step_m,
        ..ParameterValue::default()
    };
    let parameters = vec![Parameter { name: "GridBased.step".into(), value }];
    let request = SetParametersRequest { parameters };
    let answer = stage.call::<SetParameters>("/planner_server/set_parameters", request);
    assert!(answer.results[0].successful, "{}", answer.results[0].reason);
}

#[test]
fn an_unknown_class_is_answered_with_the_registered_ones() {
    let mut found = Diagnostics::new();
    let (_stage, server) =
        planner_server(&[("GridBased.plugin", "my_package/StraigthLine")], &mut found);
    let error = found.iter().find(|finding| finding.code == "unknown-plugin").unwrap();
    let help = error.help.join(" ");
    assert!(help.contains("registered `my_package::Broken`, `my_package::StraightLine`"), "{help}");
    assert!(help.ends_with("did you mean `my_package::StraightLine`?"), "{help}");
    assert!(!server.lifecycle().is_active());
}

#[test]
fn a_class_that_creates_nothing_is_an_error() {
    let mut found = Diagnostics::new();
    let (_stage, server) =
        planner_server(&[("GridBased.plugin", "my_package::Broken")], &mut found);
    let error = found.iter().next().unwrap();
    assert_eq!(error.message, "`GridBased`: the class `my_package::Broken` has created no plugin");
    assert!(!server.lifecycle().is_active());
}

const LOCAL_COSTMAP: &str = "
local_costmap:
  local_costmap:
    ros__parameters:
      update_frequency: 20.0
      rolling_window: true
      width: 4
      height: 4
      resolution: 0.1
      robot_radius: 0.1
      plugins: [inflation_layer]
      inflation_layer: {plugin: 'nav2_costmap_2d::InflationLayer', inflation_radius: 0.2}
";

#[test]
fn a_controller_of_others_drives_and_its_error_ends_the_goal() {
    let mut stage = Stage::new();
    let costmap = costmap(&stage.graph, "local_costmap", LOCAL_COSTMAP, MAIN);
    let node = stage.graph.node(NodeSettings::new("controller_server")).unwrap();
    let given = [("FollowPath.plugin", "my_package::Forward"), ("FollowPath.speed", "0.25")];
    let given = given.map(|(name, text)| Given::new(name, text));
    let mut found = Diagnostics::new();
    let server =
        ControllerServer::with_plugins(&node, given, costmap, &plugins(), &mut found).unwrap();
    assert!(found.is_empty(), "{:?}", found.iter().next());
    let commands = stage.user.mailbox::<TwistStamped>("/cmd_vel", Qos::reliable(10)).unwrap();
    server.start();
    stage.advance(300);
    // The robot does not move, and `Forward` gives up after ten cycles.
    let poses = (0..40).map(|index| pose_in("odom", 1.0 + 0.1 * f64::from(index), 1.0, 0.0));
    let mut path = Path { poses: poses.collect(), ..Path::default() };
    path.header.frame_id = "odom".into();
    let goal = FollowPathGoal { path, ..Default::default() };
    let (state, result) = finish::<FollowPath>(&mut stage, "follow_path", goal, 3000);
    assert_eq!(state, GoalState::Aborted);
    assert_eq!(result.error_code, FollowPathResult::NO_VALID_CONTROL);
    assert_eq!(result.error_msg, "ten cycles are over");
    let speeds: Vec<f64> = commands.drain().iter().map(|it| it.twist.linear.x).collect();
    assert_eq!(speeds[..2], [0.25, 0.25]);
    assert_eq!(speeds.last(), Some(&0.0));
}

#[test]
fn a_behavior_of_others_serves_the_action_under_its_name() {
    let mut stage = Stage::new();
    let node = stage.graph.node(NodeSettings::new("behavior_server")).unwrap();
    let given = [
        ("behavior_plugins", "[turn, wait]"),
        ("turn.plugin", "my_package/Turn"),
        ("turn.speed", "0.5"),
    ];
    let given = given.map(|(name, text)| Given::new(name, text));
    let mut found = Diagnostics::new();
    let (config, own) = BehaviorServerConfig::read_with(given, Some(MAIN), &plugins(), &mut found);
    assert!(found.is_empty(), "{:?}", found.iter().next());
    assert_eq!((config.behaviors.len(), own.len()), (1, 1));
    let server = BehaviorServerNode::with_plugins(node, config, own).unwrap();
    let commands = stage.user.mailbox::<TwistStamped>("/cmd_vel", Qos::reliable(10)).unwrap();
    server.start();
    stage.advance(100);
    let goal = SpinGoal { target_yaw: 1.0, ..SpinGoal::default() };
    let (state, result) = finish::<Spin>(&mut stage, "turn", goal, 1000);
    assert_eq!((state, &*result.error_msg), (GoalState::Succeeded, ""));
    let rates: Vec<f64> = commands.drain().iter().map(|it| it.twist.angular.z).collect();
    assert_eq!(rates, [0.5, 0.5, 0.5, 0.0], "three cycles of 0.1 s, then a stop");

    let (state, result) = finish::<Spin>(&mut stage, "turn", SpinGoal::default(), 1000);
    assert_eq!(state, GoalState::Aborted);
    assert!(result.error_msg.starts_with("not to the left"), "{}", result.error_msg);
}

#[test]
fn a_tree_node_of_others_is_part_of_the_tree() {
    let tree = "<root BTCPP_format='4'><BehaviorTree ID='Main'><Sequence>
        <RetryUntilSuccessful num_attempts='5'><CountTo limit='3' count='{count}'/></RetryUntilSuccessful>
        <ScriptCondition code='count == 3'/>
    </Sequence></BehaviorTree></root>";
    let mut stage = Stage::new();
    let node = stage.graph.node(NodeSettings::new("bt_navigator")).unwrap();
    let given = [("default_nav_to_pose_bt_xml", "/own.xml"), ("navigators", "navigate_to_pose")];
    let given = given.map(|(name, text)| Given::new(name, text));
    let mut found = Diagnostics::new();
    let values = BtNavigatorParams::read(given, MAIN, &mut found);
    assert!(found.is_empty(), "{found:?}");
    let files = Arc::new(MemoryFiles(MemoryHost::new().with_file("/own.xml", tree)));
    let navigator = BtNavigator::with_plugins(&node, values, MAIN, files, &plugins()).unwrap();
    navigator.start();
    stage.advance(100);
    let goal = NavigateToPoseGoal { pose: pose_in("map", 3.0, 1.0, 0.0), ..Default::default() };
    let (state, result) = finish::<NavigateToPose>(&mut stage, "navigate_to_pose", goal, 2000);
    assert_eq!((state, &*result.error_msg), (GoalState::Succeeded, ""));
}
