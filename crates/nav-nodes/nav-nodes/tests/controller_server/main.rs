//! Controller server on a graph, with a robot that moves as it is commanded.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

#[path = "../common/mod.rs"]
mod common;

use common::{Stage, costmap, map, pose_in};
use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::{
    GoalProgress, GoalState, LifecycleNode, LifecycleState, Mailbox, NodeSettings, Publisher, Qos,
};
use periplus_msgs::geometry_msgs::{PointStamped, Twist, TwistStamped};
use periplus_msgs::nav_msgs::{Odometry, Path};
use periplus_msgs::nav2_msgs::{SpeedLimit, TrackingFeedback};
use periplus_msgs::nav2_msgs_main::{FollowPath, FollowPathGoal, FollowPathResult};
use periplus_msgs::rcl_interfaces::{
    Parameter, ParameterType, ParameterValue, SetParameters, SetParametersRequest,
};
use periplus_nav_nodes::controller_server::ControllerServer;
use periplus_nav_nodes::nav2_actions::{Nav2ActionClient, Nav2SentGoal};
use periplus_params::Given;

const LOCAL_COSTMAP: &str = "
local_costmap:
  local_costmap:
    ros__parameters:
      global_frame: odom
      rolling_window: true
      width: 3
      height: 3
      resolution: 0.05
      update_frequency: 10.0
      publish_frequency: 0.0
      robot_radius: 0.1
      plugins: [static_layer, inflation_layer]
      static_layer: {plugin: 'nav2_costmap_2d::StaticLayer'}
      inflation_layer: {plugin: 'nav2_costmap_2d::InflationLayer', inflation_radius: 0.3}
";

const PURE_PURSUIT: (&str, &str) =
    ("FollowPath.plugin", "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController");

enum Commands {
    Plain(Mailbox<Twist>),
    Stamped(Mailbox<TwistStamped>),
}

struct Driving {
    stage: Stage,
    server: LifecycleNode<ControllerServer>,
    release: Nav2Release,
    commands: Commands,
    odometry: Publisher<Odometry>,
    /// Last command.
    command: Twist2,
    /// Fastest command so far.
    fastest_m_s: f64,
    /// A robot that is stuck does not move.
    is_stuck: bool,
}

impl Driving {
    fn new(release: Nav2Release, given: &[(&str, &str)]) -> Self {
        Self::with(release, &[&[PURE_PURSUIT], given].concat())
    }

    /// With another controller.
    fn with(release: Nav2Release, given: &[(&str, &str)]) -> Self {
        let stage = Stage::new();
        let costmap = costmap(&stage.graph, "local_costmap", LOCAL_COSTMAP, release);
        let node = stage.graph.node(NodeSettings::new("controller_server")).unwrap();
        let given = given.iter().map(|(name, text)| Given::new(name, *text));
        let mut found = Diagnostics::new();
        let server = ControllerServer::new(&node, given, costmap, &mut found).unwrap();
        assert!(found.is_empty(), "{:?}", found.iter().next());
        let qos = Qos::reliable(10);
        let commands = if release >= Nav2Release::Kilted {
            Commands::Stamped(stage.user.mailbox("/cmd_vel", qos).unwrap())
        } else {
            Commands::Plain(stage.user.mailbox("/cmd_vel", qos).unwrap())
        };
        let odometry = stage.user.publisher("/odom", qos).unwrap();
        server.start();
        stage.graph.settle();
        Self {
            stage,
            server,
            release,
            commands,
            odometry,
            command: Twist2::ZERO,
            fastest_m_s: 0.0,
            is_stuck: false,
        }
    }

    /// On a map with walls.
    fn on(
        release: Nav2Release,
        given: &[(&str, &str)],
        is_wall: impl Fn(f64, f64) -> bool,
    ) -> Self {
        let mut driving = Self::new(release, given);
        driving.stage.map.publish(map(is_wall));
        driving.advance(300);
        driving
    }

    fn free(release: Nav2Release, given: &[(&str, &str)]) -> Self {
        Self::on(release, given, |_, _| false)
    }

    /// Moves the robot as commanded, in steps of 10 ms.
    fn advance(&mut self, milliseconds: i64) {
        const STEP_S: f64 = 0.01;
        for _ in 0..milliseconds / 10 {
            let twist = match &self.commands {
                Commands::Plain(commands) => commands.latest().map(|twist| (*twist).clone()),
                Commands::Stamped(commands) => commands.latest().map(|twist| twist.twist.clone()),
            };
            if let Some(twist) = twist {
                self.command = Twist2::new(twist.linear.x, twist.linear.y, twist.angular.z);
                self.fastest_m_s = self.fastest_m_s.max(self.command.speed_m_s());
            }
            let velocity = if self.is_stuck { Twist2::ZERO } else { self.command };
            if let Some(robot) = &mut self.stage.robot {
                let step = Pose2::new(
                    velocity.vx_m_s * STEP_S,
                    velocity.vy_m_s * STEP_S,
                    velocity.wz_rad_s * STEP_S,
                );
                *robot = *robot * step;
            }
            let mut odometry = Odometry::default();
            odometry.twist.twist.linear.x = velocity.vx_m_s;
            odometry.twist.twist.angular.z = velocity.wz_rad_s;
            self.odometry.publish(odometry);
            self.stage.advance(10);
        }
    }

    fn client(&self) -> Nav2ActionClient<FollowPath> {
        Nav2ActionClient::new(&self.stage.user, self.release, "follow_path").unwrap()
    }

    fn send(&mut self, goal: FollowPathGoal) -> Nav2SentGoal<FollowPath> {
        let sent = self.client().send(goal);
        self.advance(20);
        let _ = sent.look();
        sent
    }

    /// Runs until a goal is over, for at most some seconds. Returns the state and the result.
    fn finish(
        &mut self,
        sent: &Nav2SentGoal<FollowPath>,
        max_s: i64,
    ) -> (GoalState, FollowPathResult) {
        for _ in 0..max_s * 10 {
            if let GoalProgress::Over(state, result) = sent.look() {
                return (state, (*result).clone());
            }
            self.advance(100);
        }
        panic!("{:?}", sent.look())
    }

    fn fails(&mut self, goal: FollowPathGoal, code: u16, words: &[&str]) {
        let sent = self.send(goal);
        let (state, result) = self.finish(&sent, 30);
        assert_eq!(state, GoalState::Aborted);
        assert_eq!(result.error_code, code, "{}", result.error_msg);
        for word in words {
            assert!(result.error_msg.contains(word), "{word}: {}", result.error_msg);
        }
        self.advance(50);
        assert_eq!(self.command, Twist2::ZERO);
    }

    fn robot(&self) -> Pose2 {
        self.stage.robot.unwrap()
    }
}

/// Straight path at a height of 1 m.
fn path(from_x: f64, to_x: f64) -> Path {
    let count = ((to_x - from_x) / 0.05).round() as u32;
    let x = |index: u32| from_x + 0.05 * f64::from(index);
    let mut path = Path {
        poses: (0..=count).map(|index| pose_in("map", x(index), 1.0, 0.0)).collect(),
        ..Path::default()
    };
    path.header.frame_id = "map".into();
    path
}

fn goal(path: Path) -> FollowPathGoal {
    FollowPathGoal { path, ..Default::default() }
}

#[test]
fn the_robot_reaches_the_goal_and_stops() {
    let mut driving = Driving::free(Nav2Release::Main, &[]);
    let tracking = driving.stage.mailbox::<TrackingFeedback>("/tracking_feedback");
    let plans = driving.stage.mailbox::<Path>("/transformed_global_plan");
    let lookahead = driving.stage.mailbox::<PointStamped>("/lookahead_point");
    let client = driving.client();
    let sent = driving.send(goal(path(1.0, 4.0)));
    driving.advance(1000);
    let feedback = &client.feedback().pop().unwrap().1.tracking_feedback;
    assert!((1.5..3.0).contains(&feedback.distance_to_goal), "{feedback:?}");
    assert!(feedback.position_tracking_error.abs() < 0.05 && feedback.speed > 0.1);
    assert!(feedback.current_path_index > 0);
    let (state, result) = driving.finish(&sent, 20);
    assert_eq!((state, result.error_code), (GoalState::Succeeded, 0));
    assert!((3.75..4.25).contains(&driving.robot().x_m), "{:?}", driving.robot());
    driving.advance(50);
    assert_eq!(driving.command, Twist2::ZERO);
    assert!((0.45..0.51).contains(&driving.fastest_m_s), "{}", driving.fastest_m_s);
    assert!(tracking.latest().is_some() && lookahead.latest().is_some());
    assert_eq!(plans.latest().unwrap().header.frame_id, "odom");
    // And again, which needs a fresh state of the checkers.
    let sent = driving.send(goal(path(3.8, 5.0)));
    assert_eq!(driving.finish(&sent, 20).0, GoalState::Succeeded);
    assert!(driving.robot().x_m > 4.7);
}

#[test]
fn older_releases_have_plain_velocities_and_their_own_feedback() {
    for release in [Nav2Release::Humble, Nav2Release::Jazzy] {
        let mut driving = Driving::free(release, &[]);
        let received = driving.stage.mailbox::<Path>("/received_global_plan");
        let client = driving.client();
        let sent = driving.send(goal(path(1.0, 3.0)));
        driving.advance(1000);
        let feedback = &client.feedback().pop().unwrap().1.tracking_feedback;
        assert!((1.0..2.0).contains(&feedback.distance_to_goal), "{release} {feedback:?}");
        assert_eq!(driving.finish(&sent, 20).0, GoalState::Succeeded, "{release}");
        assert_eq!(received.latest().unwrap().poses.len(), 41);
        assert!((2.75..3.25).contains(&driving.robot().x_m), "{release} {:?}", driving.robot());
    }
}

#[test]
fn a_stuck_robot_makes_no_progress() {
    let allowance = [("progress_checker.movement_time_allowance", "2.0")];
    let mut driving = Driving::free(Nav2Release::Main, &allowance);
    driving.is_stuck = true;
    let words = ["Failed to make progress", "movement_time_allowance"];
    let code = FollowPathResult::FAILED_TO_MAKE_PROGRESS;
    driving.fails(goal(path(1.0, 4.0)), code, &words);
    assert!(driving.fastest_m_s > 0.1, "it tried");
}

#[test]
fn a_preempting_path_does_not_reset_the_progress_checker() {
    let allowance = [("progress_checker.movement_time_allowance", "2.0")];
    let mut driving = Driving::free(Nav2Release::Main, &allowance);
    driving.is_stuck = true;
    let first = driving.send(goal(path(1.0, 4.0)));
    driving.advance(1500);
    let second = driving.send(goal(path(1.0, 3.0)));
    driving.advance(100);
    assert!(matches!(first.look(), GoalProgress::Over(GoalState::Aborted, _)));
    driving.advance(600);
    let GoalProgress::Over(GoalState::Aborted, result) = second.look() else {
        panic!("{:?}", second.look())
    };
    assert_eq!(result.error_code, FollowPathResult::FAILED_TO_MAKE_PROGRESS);
}

#[test]
fn a_preempting_path_is_followed() {
    let mut driving = Driving::free(Nav2Release::Main, &[]);
    let first = driving.send(goal(path(1.0, 5.0)));
    driving.advance(1000);
    let second = driving.send(goal(path(1.0, 3.0)));
    assert_eq!(driving.finish(&second, 20).0, GoalState::Succeeded);
    assert!(matches!(first.look(), GoalProgress::Over(GoalState::Aborted, _)));
    assert!((2.75..3.25).contains(&driving.robot().x_m));
}

#[test]
fn an_obstacle_is_an_error_at_once_or_after_the_tolerance() {
    let wall = |x: f64, _: f64| (2.0..2.2).contains(&x);
    let mut driving = Driving::on(Nav2Release::Main, &[], wall);
    let words = ["collision", "layer `static_layer`"];
    driving.fails(goal(path(1.0, 4.0)), FollowPathResult::NO_VALID_CONTROL, &words);
    assert!(driving.robot().x_m < 2.0);
    let tolerance = [("failure_tolerance", "0.5")];
    let mut driving = Driving::on(Nav2Release::Main, &tolerance, wall);
    let words = ["patience exceeded", "layer `static_layer`"];
    driving.fails(goal(path(1.0, 4.0)), FollowPathResult::PATIENCE_EXCEEDED, &words);
    assert!(driving.robot().x_m < 2.0);
    // Without a limit it waits until the obstacle is gone.
    let mut driving = Driving::on(Nav2Release::Main, &[("failure_tolerance", "-1.0")], wall);
    let sent = driving.send(goal(path(1.0, 4.0)));
    driving.advance(5000);
    assert_eq!(sent.look(), GoalProgress::Accepted);
    assert_eq!(driving.command, Twist2::ZERO);
    driving.stage.map.publish(map(|_, _| false));
    assert_eq!(driving.finish(&sent, 20).0, GoalState::Succeeded);
}

#[test]
fn a_canceled_goal_stops_the_robot() {
    let mut driving = Driving::free(Nav2Release::Main, &[]);
    let client = driving.client();
    let sent = driving.send(goal(path(1.0, 5.0)));
    driving.advance(1000);
    assert!(driving.command.speed_m_s() > 0.1);
    let _answer = client.cancel(sent.id());
    driving.advance(200);
    assert!(matches!(sent.look(), GoalProgress::Over(GoalState::Canceled, _)), "{:?}", sent.look());
    assert_eq!(driving.command, Twist2::ZERO);
}

#[test]
fn wrong_goals_are_rejected_by_main_and_fail_before() {
    let unknown = FollowPathGoal { controller_id: "Follow".into(), ..goal(path(1.0, 2.0)) };
    let checker = FollowPathGoal { goal_checker_id: "checker".into(), ..goal(path(1.0, 2.0)) };
    let mut driving = Driving::free(Nav2Release::Main, &[]);
    for wrong in [unknown.clone(), checker.clone(), goal(Path::default())] {
        let sent = driving.send(wrong);
        assert_eq!(sent.look(), GoalProgress::Rejected);
    }
    let mut driving = Driving::free(Nav2Release::Jazzy, &[]);
    driving.fails(unknown, FollowPathResult::INVALID_CONTROLLER, &["`FollowPath`"]);
    driving.fails(checker, FollowPathResult::UNKNOWN, &["goal checker `checker`"]);
    driving.fails(goal(Path::default()), FollowPathResult::INVALID_PATH, &["empty"]);
}

#[test]
fn missing_transforms_and_paths_out_of_reach_are_errors() {
    let mut driving = Driving::free(Nav2Release::Main, &[]);
    let mut elsewhere = path(1.0, 2.0);
    elsewhere.header.frame_id = "kitchen".into();
    driving.fails(goal(elsewhere), FollowPathResult::TF_ERROR, &["`kitchen` to `odom`"]);
    driving.fails(goal(path(4.0, 5.0)), FollowPathResult::INVALID_PATH, &["0 poses"]);
    let sent = driving.send(goal(path(1.0, 4.0)));
    driving.advance(300);
    driving.stage.robot = None;
    let (state, result) = driving.finish(&sent, 5);
    assert_eq!((state, result.error_code), (GoalState::Aborted, FollowPathResult::TF_ERROR));
    assert!(result.error_msg.contains("Failed to obtain robot pose"), "{}", result.error_msg);
}

#[test]
fn a_costmap_that_is_not_current_ends_the_goal() {
    // No map: the static layer is not current.
    let mut driving = Driving::new(Nav2Release::Main, &[]);
    driving.advance(300);
    let words = ["timed out", "static_layer"];
    driving.fails(goal(path(1.0, 4.0)), FollowPathResult::CONTROLLER_TIMED_OUT, &words);
}

#[test]
fn speed_limits_apply_to_the_controllers() {
    let mut driving = Driving::free(Nav2Release::Main, &[]);
    let limits = driving.stage.user.publisher("/speed_limit", Qos::reliable(1)).unwrap();
    limits.publish(SpeedLimit { percentage: true, speed_limit: 40.0, ..SpeedLimit::default() });
    let sent = driving.send(goal(path(1.0, 2.5)));
    assert_eq!(driving.finish(&sent, 30).0, GoalState::Succeeded);
    assert!((0.15..0.21).contains(&driving.fastest_m_s), "{}", driving.fastest_m_s);
}

#[test]
fn parameters_of_plugins_change_while_the_server_runs() {
    let mut driving = Driving::free(Nav2Release::Main, &[]);
    let set = |driving: &Driving, name: &str, number: f64| {
        let value = ParameterValue {
            r#type: ParameterType::PARAMETER_DOUBLE,
            double_value: number,
            ..Default::default()
        };
        let parameters = vec![Parameter { name: name.into(), value }];
        let request = SetParametersRequest { parameters };
        let service = "/controller_server/set_parameters";
        driving.stage.call::<SetParameters>(service, request).results[0].clone()
    };
    let changed = set(&driving, "FollowPath.max_linear_vel", 0.3);
    assert!(changed.successful, "{}", changed.reason);
    assert!(set(&driving, "goal_checker.xy_goal_tolerance", 0.5).successful);
    assert!(!set(&driving, "goal_checker.xy_goal_tolerance", -0.5).successful);
    assert!(!set(&driving, "failure_tolerance", -0.5).successful);
    let sent = driving.send(goal(path(1.0, 3.0)));
    assert_eq!(driving.finish(&sent, 30).0, GoalState::Succeeded);
    assert!(driving.fastest_m_s < 0.31, "{}", driving.fastest_m_s);
    assert!((2.45..2.65).contains(&driving.robot().x_m), "{:?}", driving.robot());
}

#[test]
fn deactivation_stops_the_robot_and_the_costmap() {
    let mut driving = Driving::free(Nav2Release::Main, &[]);
    let sent = driving.send(goal(path(1.0, 5.0)));
    driving.advance(500);
    driving.server.lifecycle().change(periplus_graph::Transition::Deactivate);
    driving.advance(100);
    assert!(matches!(sent.look(), GoalProgress::Over(GoalState::Aborted, _)), "{:?}", sent.look());
    assert_eq!(driving.command, Twist2::ZERO);
    let state = driving.server.with(|server| server.costmap().lifecycle().state());
    assert_eq!(state, LifecycleState::Inactive);
    let sent = driving.send(goal(path(1.0, 5.0)));
    assert_eq!(sent.look(), GoalProgress::Rejected);
}

/// Parameters of controllers that drive a robot without further tuning.
const MPPI: &[(&str, &str)] = &[
    ("FollowPath.plugin", "nav2_mppi_controller::MPPIController"),
    ("FollowPath.batch_size", "300"),
    (
        "FollowPath.critics",
        "ConstraintCritic CostCritic GoalCritic GoalAngleCritic PathAlignCritic PathFollowCritic PathAngleCritic PreferForwardCritic",
    ),
    ("FollowPath.visualize", "true"),
];
const DWB: &[(&str, &str)] = &[
    ("FollowPath.plugin", "dwb_core::DWBLocalPlanner"),
    (
        "FollowPath.critics",
        "RotateToGoal Oscillation BaseObstacle GoalAlign PathAlign PathDist GoalDist",
    ),
    ("FollowPath.max_vel_x", "0.4"),
    ("FollowPath.max_speed_xy", "0.4"),
    ("FollowPath.max_vel_theta", "1.0"),
    ("FollowPath.min_speed_theta", "0.0"),
    ("FollowPath.acc_lim_x", "2.5"),
    ("FollowPath.acc_lim_theta", "3.2"),
    ("FollowPath.decel_lim_x", "-2.5"),
    ("FollowPath.decel_lim_theta", "-3.2"),
    ("FollowPath.PathAlign.scale", "32.0"),
    ("FollowPath.PathDist.scale", "32.0"),
    ("FollowPath.GoalAlign.scale", "24.0"),
    ("FollowPath.GoalDist.scale", "24.0"),
    ("FollowPath.BaseObstacle.scale", "0.02"),
    ("FollowPath.RotateToGoal.scale", "32.0"),
];
const SHIM: &[(&str, &str)] = &[
    ("FollowPath.plugin", "nav2_rotation_shim_controller::RotationShimController"),
    (
        "FollowPath.primary_controller",
        "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController",
    ),
];
const SHIM_OF_MAIN: &[(&str, &str)] = &[
    ("FollowPath.plugin", "nav2_rotation_shim_controller::RotationShimController"),
    (
        "FollowPath.primary_controller.plugin",
        "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController",
    ),
];
const GRACEFUL: &[(&str, &str)] =
    &[("FollowPath.plugin", "nav2_graceful_controller::GracefulController")];

#[test]
fn every_controller_reaches_the_goal_in_every_release() {
    for (name, given) in [("MPPI", MPPI), ("DWB", DWB), ("Graceful", GRACEFUL)] {
        for release in [Nav2Release::Humble, Nav2Release::Jazzy, Nav2Release::Main] {
            if name == "Graceful" && release == Nav2Release::Humble {
                // Humble does not have it.
                continue;
            }
            let mut driving = Driving::with(release, given);
            driving.stage.map.publish(map(|_, _| false));
            driving.advance(300);
            let shown = match (name, release) {
                ("MPPI", Nav2Release::Main) => "/controller_server/optimal_path",
                ("MPPI", _) => "/optimal_trajectory",
                _ => "/local_plan",
            };
            let shown = driving.stage.mailbox::<Path>(shown);
            let sent = driving.send(goal(path(1.0, 3.5)));
            let (state, result) = driving.finish(&sent, 40);
            assert_eq!(state, GoalState::Succeeded, "{name} {release}: {}", result.error_msg);
            let robot = driving.robot();
            assert!((robot.x_m - 3.5).abs() < 0.3, "{name} {release}: {robot:?}");
            assert!(shown.latest().is_some_and(|path| path.poses.len() > 1), "{name} {release}");
            driving.advance(50);
            assert_eq!(driving.command, Twist2::ZERO);
        }
    }
}

#[test]
fn a_rotation_shim_turns_to_the_path_first() {
    for (release, given) in
        [(Nav2Release::Humble, SHIM), (Nav2Release::Jazzy, SHIM), (Nav2Release::Main, SHIM_OF_MAIN)]
    {
        let mut driving = Driving::with(release, given);
        driving.stage.map.publish(map(|_, _| false));
        driving.stage.robot = Some(Pose2::new(1.0, 1.0, 2.0));
        driving.advance(300);
        let sent = driving.send(goal(path(1.0, 3.0)));
        driving.advance(300);
        assert!(driving.command.wz_rad_s < -0.1, "{release} {:?}", driving.command);
        assert!(driving.fastest_m_s < 0.05, "{release} {}", driving.fastest_m_s);
        let (state, result) = driving.finish(&sent, 30);
        assert_eq!(state, GoalState::Succeeded, "{release} {}", result.error_msg);
        assert!((2.7..3.3).contains(&driving.robot().x_m), "{release} {:?}", driving.robot());
    }
}

#[test]
fn runs_are_equal_to_the_last_bit() {
    let run = || {
        let mut driving = Driving::free(Nav2Release::Main, &[]);
        let sent = driving.send(goal(path(1.0, 3.0)));
        driving.finish(&sent, 20);
        (driving.robot(), driving.stage.now_ns)
    };
    assert_eq!(run(), run());
}
