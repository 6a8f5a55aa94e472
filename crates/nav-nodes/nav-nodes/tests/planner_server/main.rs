//! Planner server on a graph, as clients see it.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/files.rs"]
mod files;
mod lattice_file;

use std::sync::Arc;

use common::{GLOBAL_COSTMAP, Stage, costmap, map, pose_in, transforms};
use files::MemoryFiles;
use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose2;
use periplus_graph::{
    GoalProgress, GoalState, Graph, LifecycleNode, LifecycleState, NodeSettings, Qos,
};
use periplus_msgs::nav_msgs::{Goals, Path};
use periplus_msgs::nav2_msgs_main::*;
use periplus_msgs::rcl_interfaces::{
    Parameter, ParameterType, ParameterValue, SetParameters, SetParametersRequest,
};
use periplus_msgs::{Nav2Action, nav2_msgs};
use periplus_nav_nodes::nav2_actions::{Nav2ActionClient, Nav2SentGoal};
use periplus_nav_nodes::navigation::{NavigationServer, NavigationSetup};
use periplus_nav_nodes::navigation_plugins::NavigationPlugins;
use periplus_nav_nodes::planner_server::PlannerServer;
use periplus_params::Given;
use periplus_resources::MemoryHost;

struct Planning {
    stage: Stage,
    server: LifecycleNode<PlannerServer>,
    release: Nav2Release,
}

impl Planning {
    fn new(release: Nav2Release, given: &[(&str, &str)]) -> Self {
        let stage = Stage::new();
        let costmap = costmap(&stage.graph, "global_costmap", GLOBAL_COSTMAP, release);
        let node = stage.graph.node(NodeSettings::new("planner_server")).unwrap();
        let given = given.iter().map(|(name, text)| Given::new(name, *text));
        let server = PlannerServer::new(&node, given, costmap, &mut Diagnostics::new()).unwrap();
        Self { stage, server, release }
    }

    /// With a map and a running server. The wall has a gap at the upper end.
    fn started(release: Nav2Release, given: &[(&str, &str)]) -> Self {
        let mut planning = Self::new(release, given);
        planning.stage.map.publish(map(|x, y| (2.9..3.1).contains(&x) && y < 3.0));
        planning.server.start();
        planning.stage.advance(300);
        planning
    }

    fn client<A: Nav2Action>(&self, name: &str) -> Nav2ActionClient<A> {
        Nav2ActionClient::new(&self.stage.user, self.release, name).unwrap()
    }

    fn finish<A: Nav2Action>(
        &mut self,
        sent: &Nav2SentGoal<A>,
        milliseconds: i64,
    ) -> GoalProgress<A::Result> {
        self.stage.advance(20);
        let _ = sent.look();
        self.stage.advance(milliseconds);
        sent.look()
    }

    fn plan_to(&mut self, goal: ComputePathToPoseGoal) -> (GoalState, ComputePathToPoseResult) {
        let client = self.client::<ComputePathToPose>("compute_path_to_pose");
        let sent = client.send(goal);
        let progress = match self.finish(&sent, 100) {
            GoalProgress::Accepted => self.finish(&sent, 1200),
            other => other,
        };
        match progress {
            GoalProgress::Over(state, result) => (state, Arc::unwrap_or_clone(result)),
            other => panic!("{other:?}"),
        }
    }

    fn fails(&mut self, goal: ComputePathToPoseGoal, code: u16, words: &[&str]) {
        let (state, result) = self.plan_to(goal);
        assert_eq!(state, GoalState::Aborted);
        assert_eq!(result.error_code, code, "{}", result.error_msg);
        for word in words {
            assert!(result.error_msg.contains(word), "{word}: {}", result.error_msg);
        }
    }
}

fn goal(x: f64, y: f64) -> ComputePathToPoseGoal {
    ComputePathToPoseGoal { goal: pose_in("map", x, y, 0.5), ..Default::default() }
}

fn length_m(path: &Path) -> f64 {
    let xy = |index: usize| {
        let point = &path.poses[index].pose.position;
        (point.x, point.y)
    };
    (1..path.poses.len())
        .map(|index| {
            let ((x, y), (to_x, to_y)) = (xy(index - 1), xy(index));
            libm::hypot(to_x - x, to_y - y)
        })
        .sum()
}

#[test]
fn a_path_leads_around_a_wall() {
    let mut planning = Planning::started(Nav2Release::Main, &[]);
    let plans = planning.stage.mailbox::<Path>("/plan");
    let (state, result) = planning.plan_to(goal(5.0, 1.0));
    assert_eq!((state, result.error_code), (GoalState::Succeeded, 0), "{}", result.error_msg);
    assert_eq!(result.path.header.frame_id, "map");
    // Over the end of the wall at (3, 3): twice the hypotenuse of 2 m and 2 m.
    let length_m = length_m(&result.path);
    assert!((5.6..6.6).contains(&length_m), "{length_m}");
    let highest = result.path.poses.iter().map(|pose| pose.pose.position.y).fold(0.0, f64::max);
    assert!(highest > 3.0, "{highest}");
    assert_eq!(*plans.latest().unwrap(), result.path);
}

#[test]
fn a_given_start_replaces_the_robot() {
    let mut planning = Planning::started(Nav2Release::Jazzy, &[]);
    let given = ComputePathToPoseGoal {
        start: pose_in("map", 4.0, 1.0, 0.0),
        use_start: true,
        ..goal(5.0, 1.0)
    };
    let (state, result) = planning.plan_to(given);
    assert_eq!(state, GoalState::Succeeded);
    assert!(length_m(&result.path) < 1.2);
}

#[test]
fn failures_have_codes_and_reasons() {
    let tolerance = [("GridBased.tolerance", "0.0")];
    let mut planning = Planning::started(Nav2Release::Main, &tolerance);
    let wall = ["layer `static_layer`", "the map has the value 100", "nearest reachable position"];
    planning.fails(goal(3.0, 1.0), ComputePathToPoseResult::GOAL_OCCUPIED, &wall);
    planning.fails(goal(9.0, 1.0), ComputePathToPoseResult::GOAL_OUTSIDE_MAP, &["9.00"]);
    let outside = ComputePathToPoseGoal {
        start: pose_in("map", -1.0, 1.0, 0.0),
        use_start: true,
        ..goal(1.0, 1.0)
    };
    planning.fails(outside, ComputePathToPoseResult::START_OUTSIDE_MAP, &["-1.00"]);
    let elsewhere =
        ComputePathToPoseGoal { goal: pose_in("kitchen", 1.0, 1.0, 0.0), ..Default::default() };
    planning.fails(elsewhere, ComputePathToPoseResult::TF_ERROR, &["`kitchen` to `map`"]);
    // The pose of the robot is no longer published.
    let robot = planning.stage.robot.take();
    planning.stage.advance(1000);
    planning.fails(
        goal(2.0, 1.0),
        ComputePathToPoseResult::TF_ERROR,
        &["Unable to get start pose"],
    );
    // It is published again while a goal waits.
    let client = planning.client::<ComputePathToPose>("compute_path_to_pose");
    let sent = client.send(goal(2.0, 1.0));
    assert!(matches!(planning.finish(&sent, 100), GoalProgress::Accepted));
    planning.stage.robot = robot;
    let progress = planning.finish(&sent, 800);
    assert!(matches!(progress, GoalProgress::Over(GoalState::Succeeded, _)), "{progress:?}");
}

#[test]
fn results_of_humble_have_no_codes() {
    let mut planning = Planning::started(Nav2Release::Humble, &[("GridBased.tolerance", "0.0")]);
    let (state, result) = planning.plan_to(goal(3.0, 1.0));
    assert_eq!((state, result.error_code, result.error_msg.as_str()), (GoalState::Aborted, 0, ""));
    assert!(
        planning
            .stage
            .user
            .action_client::<nav2_msgs::ComputePathToPose>("compute_path_to_pose")
            .is_err()
    );
}

#[test]
fn an_unknown_planner_is_rejected_by_main_and_fails_before() {
    let asked = ComputePathToPoseGoal { planner_id: "Grid".into(), ..goal(2.0, 1.0) };
    let mut planning = Planning::started(Nav2Release::Main, &[]);
    let client = planning.client::<ComputePathToPose>("compute_path_to_pose");
    let sent = client.send(asked.clone());
    assert_eq!(planning.finish(&sent, 10), GoalProgress::Rejected);
    let mut planning = Planning::started(Nav2Release::Jazzy, &[]);
    let words = ["no planner `Grid`", "`GridBased`"];
    planning.fails(asked, ComputePathToPoseResult::INVALID_PLANNER, &words);
}

#[test]
fn a_path_through_poses_has_each_pose_once() {
    let mut planning = Planning::started(Nav2Release::Main, &[]);
    let client = planning.client::<ComputePathThroughPoses>("compute_path_through_poses");
    let goals = |poses: &[(f64, f64)]| ComputePathThroughPosesGoal {
        goals: Goals {
            goals: poses.iter().map(|(x, y)| pose_in("map", *x, *y, 0.0)).collect(),
            ..Goals::default()
        },
        ..Default::default()
    };
    let sent = client.send(goals(&[(2.0, 1.0), (2.0, 3.0)]));
    let GoalProgress::Over(GoalState::Succeeded, result) = planning.finish(&sent, 50) else {
        panic!("{:?}", sent.look())
    };
    assert_eq!(result.last_reached_index, ComputePathThroughPosesResult::ALL_GOALS);
    for pair in result.path.poses.windows(2) {
        assert_ne!(pair[0].pose.position, pair[1].pose.position);
    }
    let sent = client.send(goals(&[]));
    let GoalProgress::Over(GoalState::Aborted, result) = planning.finish(&sent, 50) else {
        panic!("{:?}", sent.look())
    };
    assert_eq!(result.error_code, ComputePathThroughPosesResult::NO_VIAPOINTS_GIVEN);
}

#[test]
fn a_partial_path_ends_at_the_last_reachable_pose() {
    let partial = [("allow_partial_planning", "true"), ("GridBased.tolerance", "0.0")];
    let mut planning = Planning::started(Nav2Release::Main, &partial);
    let client = planning.client::<ComputePathThroughPoses>("compute_path_through_poses");
    let poses = [pose_in("map", 2.0, 1.0, 0.0), pose_in("map", 3.0, 1.0, 0.0)].to_vec();
    let goals = Goals { goals: poses, ..Goals::default() };
    let sent = client.send(ComputePathThroughPosesGoal { goals, ..Default::default() });
    let GoalProgress::Over(GoalState::Succeeded, result) = planning.finish(&sent, 50) else {
        panic!("{:?}", sent.look())
    };
    assert_eq!((result.last_reached_index, result.error_code), (0, 0));
    assert!((result.path.poses.last().unwrap().pose.position.x - 2.0).abs() < 0.1);
}

#[test]
fn a_goal_waits_for_the_costmap_until_its_time_is_over() {
    // No map: the static layer is not current.
    let mut planning = Planning::new(Nav2Release::Main, &[]);
    planning.server.start();
    planning.stage.advance(300);
    let client = planning.client::<ComputePathToPose>("compute_path_to_pose");
    let sent = client.send(goal(2.0, 1.0));
    assert_eq!(planning.finish(&sent, 500), GoalProgress::Accepted);
    planning.stage.advance(700);
    let GoalProgress::Over(GoalState::Aborted, result) = sent.look() else {
        panic!("{:?}", sent.look())
    };
    assert_eq!(result.error_code, ComputePathToPoseResult::TIMEOUT);
    assert!(result.error_msg.contains("static_layer"), "{}", result.error_msg);
    // A map that arrives in time ends the wait.
    let sent = client.send(goal(2.0, 1.0));
    assert_eq!(planning.finish(&sent, 300), GoalProgress::Accepted);
    planning.stage.map.publish(map(|_, _| false));
    planning.stage.advance(300);
    assert!(
        matches!(sent.look(), GoalProgress::Over(GoalState::Succeeded, _)),
        "{:?}",
        sent.look()
    );
}

#[test]
fn waiting_goals_are_preempted_and_canceled() {
    let mut planning = Planning::new(Nav2Release::Main, &[("costmap_update_timeout", "5.0")]);
    planning.server.start();
    planning.stage.advance(300);
    let client = planning.client::<ComputePathToPose>("compute_path_to_pose");
    let first = client.send(goal(2.0, 1.0));
    assert_eq!(planning.finish(&first, 20), GoalProgress::Accepted);
    let second = client.send(goal(2.0, 2.0));
    assert_eq!(planning.finish(&second, 20), GoalProgress::Accepted);
    let third = client.send(goal(2.0, 3.0));
    assert_eq!(planning.finish(&third, 20), GoalProgress::Accepted);
    let aborted = |sent: &Nav2SentGoal<ComputePathToPose>| {
        matches!(sent.look(), GoalProgress::Over(GoalState::Aborted, _))
    };
    assert!(aborted(&second), "a pending goal is overtaken by a newer one");
    planning.stage.map.publish(map(|_, _| false));
    planning.stage.advance(300);
    assert!(aborted(&first));
    let GoalProgress::Over(GoalState::Succeeded, result) = third.look() else {
        panic!("{:?}", third.look())
    };
    assert!((result.path.poses.last().unwrap().pose.position.y - 3.0).abs() < 0.1);
    // Cancel.
    let mut planning = Planning::new(Nav2Release::Main, &[("costmap_update_timeout", "5.0")]);
    planning.server.start();
    planning.stage.advance(300);
    let client = planning.client::<ComputePathToPose>("compute_path_to_pose");
    let sent = client.send(goal(2.0, 1.0));
    assert_eq!(planning.finish(&sent, 20), GoalProgress::Accepted);
    let _answer = client.cancel(sent.id());
    planning.stage.advance(50);
    assert!(matches!(sent.look(), GoalProgress::Over(GoalState::Canceled, _)), "{:?}", sent.look());
}

#[test]
fn every_planner_leads_around_the_wall() {
    for class in [
        "nav2_navfn_planner/NavfnPlanner",
        "nav2_theta_star_planner::ThetaStarPlanner",
        "nav2_smac_planner::SmacPlanner2D",
        "nav2_smac_planner::SmacPlannerHybrid",
    ] {
        let mut planning = Planning::started(Nav2Release::Main, &[("GridBased.plugin", class)]);
        let unsmoothed = planning.stage.mailbox::<Path>("/unsmoothed_plan");
        let (state, result) = planning.plan_to(goal(5.0, 1.0));
        assert_eq!(state, GoalState::Succeeded, "{class}: {}", result.error_msg);
        let length_m = length_m(&result.path);
        assert!((5.5..8.5).contains(&length_m), "{class}: {length_m}");
        let end = &result.path.poses.last().unwrap().pose.position;
        assert!(libm::hypot(end.x - 5.0, end.y - 1.0) < 0.2, "{class}: {end:?}");
        assert_eq!(unsmoothed.latest().is_some(), class.contains("Smac"), "{class}");
    }
}

/// The same server with a thread for each node.
#[test]
fn a_live_server_plans_beside_its_costmap() {
    let graph = Graph::live();
    let costmap = costmap(&graph, "global_costmap", GLOBAL_COSTMAP, Nav2Release::Jazzy);
    let node = graph.node(NodeSettings::new("planner_server")).unwrap();
    let server = PlannerServer::new(&node, [], costmap, &mut Diagnostics::new()).unwrap();
    let user = graph.node(NodeSettings::new("user")).unwrap();
    let maps = user.publisher("/map", Qos::latched(1)).unwrap();
    maps.publish(map(|_, _| false));
    server.start();
    let client = Nav2ActionClient::<ComputePathToPose>::new(
        &user,
        Nav2Release::Jazzy,
        "compute_path_to_pose",
    )
    .unwrap();
    let start = pose_in("map", 1.0, 1.0, 0.0);
    let (mut sent, mut succeeded) = (None, false);
    let tf = user.publisher("/tf", Qos::reliable(10)).unwrap();
    for step in 1..2000 {
        graph.advance_to(step * 10_000_000);
        tf.publish(transforms(graph.now_ns(), Pose2::new(1.0, 1.0, 0.0)));
        std::thread::sleep(std::time::Duration::from_millis(2));
        let asked = sent.get_or_insert_with(|| {
            client.send(ComputePathToPoseGoal {
                start: start.clone(),
                use_start: true,
                ..goal(5.0, 3.0)
            })
        });
        match asked.look() {
            GoalProgress::Over(GoalState::Succeeded, _) => {
                succeeded = true;
                break;
            }
            // The server or its costmap is not active yet.
            GoalProgress::Rejected | GoalProgress::Failed(_) | GoalProgress::Over(..) => {
                sent = None;
            }
            GoalProgress::Sent | GoalProgress::Accepted => {}
        }
    }
    assert!(succeeded);
}

#[test]
fn the_costmap_follows_the_lifecycle() {
    let planning = Planning::started(Nav2Release::Main, &[]);
    let state =
        |planning: &Planning| planning.server.with(|server| server.costmap().lifecycle().state());
    assert_eq!(state(&planning), LifecycleState::Active);
    let lifecycle = planning.server.lifecycle().clone();
    lifecycle.change(periplus_graph::Transition::Deactivate);
    planning.stage.graph.settle();
    assert_eq!(state(&planning), LifecycleState::Inactive);
    lifecycle.change(periplus_graph::Transition::Cleanup);
    planning.stage.graph.settle();
    assert_eq!(state(&planning), LifecycleState::Unconfigured);
    planning.server.start();
    planning.stage.graph.settle();
    assert_eq!(state(&planning), LifecycleState::Active);
}

#[test]
fn a_server_with_an_unknown_class_does_not_start() {
    let mut planning =
        Planning::new(Nav2Release::Main, &[("GridBased.plugin", "nav2_navfn_planner::Navfn")]);
    planning.server.start();
    planning.stage.advance(50);
    assert_eq!(planning.server.lifecycle().state(), LifecycleState::Unconfigured);
}

#[test]
fn paths_are_tested_for_collisions() {
    let planning = Planning::started(Nav2Release::Main, &[]);
    let path = |xs: &[f64]| Path {
        poses: xs.iter().map(|x| pose_in("map", *x, 1.0, 0.0)).collect(),
        ..Path::default()
    };
    let check = |path: Path, stop_at_first_collision: bool| {
        let request = IsPathValidRequest { path, stop_at_first_collision, ..Default::default() };
        planning.stage.call::<IsPathValid>("/is_path_valid", request)
    };
    let free = check(path(&[1.0, 1.5, 2.0]), true);
    assert!(free.success && free.is_valid);
    let blocked = check(path(&[1.0, 2.0, 3.05, 2.95, 4.0]), false);
    assert!(blocked.success && !blocked.is_valid);
    assert_eq!(blocked.invalid_pose_indices, [2, 3]);
    assert!(!check(Path::default(), true).success);
    // Poses that the robot has passed do not count.
    assert!(check(path(&[3.0, 1.0, 1.5]), true).is_valid);
}

#[test]
fn parameters_of_planners_change_while_the_server_runs() {
    let mut planning = Planning::started(Nav2Release::Main, &[]);
    let set = |planning: &Planning, name: &str, number: f64| {
        let value = ParameterValue {
            r#type: ParameterType::PARAMETER_DOUBLE,
            double_value: number,
            ..Default::default()
        };
        let parameters = vec![Parameter { name: name.into(), value }];
        let answer = planning.stage.call::<SetParameters>(
            "/planner_server/set_parameters",
            SetParametersRequest { parameters },
        );
        answer.results[0].clone()
    };
    assert_eq!(planning.plan_to(goal(3.0, 1.0)).0, GoalState::Succeeded, "0.5 m are tolerated");
    let changed = set(&planning, "GridBased.tolerance", 0.01);
    assert!(changed.successful, "{}", changed.reason);
    assert_eq!(planning.plan_to(goal(3.0, 1.0)).0, GoalState::Aborted);
    assert!(!set(&planning, "GridBased.tolerance", -1.0).successful);
    assert!(!set(&planning, "expected_planner_frequency", 0.0).successful);
}

/// Nav2's launch files remap `/tf` to `tf` for all nodes; the costmap subscribed to `/global_costmap/tf`.
#[test]
fn the_costmap_hears_the_transforms_of_its_server() {
    for (namespace, topic) in [("/", "/tf"), ("/robot1", "/robot1/tf")] {
        let graph = Graph::new();
        let remapped = |settings: NodeSettings| graph.node(settings.remap("/tf", "tf"));
        let setup = NavigationSetup {
            graph: &graph,
            file: None,
            release: None,
            stamped_velocities: None,
            files: Arc::new(MemoryFiles(MemoryHost::new())),
            save_photo: Arc::new(|_, _| Ok(())),
            plugins: NavigationPlugins::new(),
        };
        let node = remapped(NodeSettings::new("planner_server").namespace(namespace)).unwrap();
        let found = &mut Diagnostics::new();
        let server = setup.create(NavigationServer::Planner, node, remapped, found).unwrap();
        let names: Vec<String> = graph.topics().into_iter().map(|topic| topic.name).collect();
        assert!(names.iter().any(|name| name == topic), "{names:?}");
        assert!(!names.iter().any(|name| name.ends_with("costmap/tf")), "{names:?}");
        drop(server);
    }
}
