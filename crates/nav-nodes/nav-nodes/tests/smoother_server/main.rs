//! Smoother server on a graph, as clients see it.
#![allow(clippy::unwrap_used, reason = "a test says what must be there")]

#[path = "../common/mod.rs"]
mod common;

use std::sync::Arc;

use common::{GLOBAL_COSTMAP, Stage, costmap, map, pose_in};
use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_graph::{GoalProgress, GoalState, LifecycleNode, NodeSettings};
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::nav2_msgs_main::{SmoothPath, SmoothPathGoal, SmoothPathResult};
use periplus_nav_nodes::costmap_2d::CostmapNode;
use periplus_nav_nodes::nav2_actions::Nav2ActionClient;
use periplus_nav_nodes::smoother_server::SmootherServer;
use periplus_params::Given;

struct Smoothing {
    stage: Stage,
    _costmap: LifecycleNode<CostmapNode>,
    _server: LifecycleNode<SmootherServer>,
    release: Nav2Release,
}

impl Smoothing {
    fn new(release: Nav2Release, given: &[(&str, &str)]) -> Self {
        let mut stage = Stage::new();
        let costmap = costmap(&stage.graph, "global_costmap", GLOBAL_COSTMAP, release);
        costmap.start();
        let node = stage.graph.node(NodeSettings::new("smoother_server")).unwrap();
        let given = given.iter().map(|(name, text)| Given::new(name, *text));
        let releases = (release, release);
        let server = SmootherServer::new(&node, given, releases, &mut Diagnostics::new()).unwrap();
        server.start();
        stage.map.publish(map(|x, y| (2.9..3.1).contains(&x) && y < 3.0));
        stage.advance(300);
        Self { stage, _costmap: costmap, _server: server, release }
    }

    fn smooth(&mut self, goal: SmoothPathGoal) -> GoalProgress<SmoothPathResult> {
        let client =
            Nav2ActionClient::<SmoothPath>::new(&self.stage.user, self.release, "smooth_path");
        let sent = client.unwrap().send(goal);
        self.stage.advance(20);
        let _ = sent.look();
        self.stage.advance(20);
        sent.look()
    }

    fn fails(&mut self, goal: SmoothPathGoal, code: u16, word: &str) {
        let GoalProgress::Over(GoalState::Aborted, result) = self.smooth(goal) else { panic!() };
        assert_eq!(result.error_code, code, "{}", result.error_msg);
        assert!(result.error_msg.contains(word), "{}", result.error_msg);
    }
}

/// A path of one corner: east, then north.
fn corner(x: f64) -> Path {
    let along = |index: u32| f64::from(index) * 0.1;
    let east = (0..10).map(|index| pose_in("map", x - 1.0 + along(index), 1.0, 0.0));
    let north = (0..10).map(|index| pose_in("map", x, 1.0 + along(index), 1.57));
    let mut path = Path { poses: east.chain(north).collect(), ..Path::default() };
    path.header.frame_id = "map".into();
    path
}

fn goal(path: Path) -> SmoothPathGoal {
    let mut goal = SmoothPathGoal { path, check_for_collisions: true, ..Default::default() };
    goal.max_smoothing_duration.sec = 1;
    goal
}

fn done(progress: GoalProgress<SmoothPathResult>) -> Arc<SmoothPathResult> {
    let GoalProgress::Over(GoalState::Succeeded, result) = progress else { panic!("{progress:?}") };
    result
}

#[test]
fn a_corner_gets_round() {
    let mut smoothing = Smoothing::new(Nav2Release::Main, &[]);
    let published = smoothing.stage.mailbox::<Path>("/plan_smoothed");
    let path = corner(2.0);
    let result = done(smoothing.smooth(goal(path.clone())));
    assert!(result.was_completed);
    assert_eq!(result.path.poses.len(), path.poses.len());
    let (ends, old) = (&result.path.poses, &path.poses);
    assert_eq!(ends[0].pose.position, old[0].pose.position);
    assert_eq!(ends[19].pose.position, old[19].pose.position);
    // The corner at (2, 1) is cut.
    assert!(ends[10].pose.position.x < 1.99 && ends[10].pose.position.y > 1.01);
    assert_eq!(*published.latest().unwrap(), result.path);
}

#[test]
fn a_path_through_a_wall_collides() {
    let mut smoothing = Smoothing::new(Nav2Release::Main, &[]);
    smoothing.fails(
        goal(corner(3.0)),
        SmoothPathResult::SMOOTHED_PATH_IN_COLLISION,
        "254 along the footprint",
    );
    let unchecked = SmoothPathGoal { check_for_collisions: false, ..goal(corner(3.0)) };
    assert!(matches!(smoothing.smooth(unchecked), GoalProgress::Over(GoalState::Succeeded, _)));
}

#[test]
fn wrong_goals_are_rejected_by_main_and_fail_before() {
    let unknown = SmoothPathGoal { smoother_id: "smooth".into(), ..goal(corner(2.0)) };
    let mut smoothing = Smoothing::new(Nav2Release::Main, &[]);
    assert_eq!(smoothing.smooth(unknown.clone()), GoalProgress::Rejected);
    assert_eq!(smoothing.smooth(goal(Path::default())), GoalProgress::Rejected);
    let mut smoothing = Smoothing::new(Nav2Release::Jazzy, &[]);
    smoothing.fails(unknown, SmoothPathResult::INVALID_SMOOTHER, "`simple_smoother`");
    smoothing.fails(goal(Path::default()), SmoothPathResult::INVALID_PATH, "empty");
}

#[test]
fn smoothers_are_chosen_by_id() {
    let given = [
        ("smoother_plugins", "simple sg"),
        ("simple.plugin", "nav2_smoother/SimpleSmoother"),
        ("sg.plugin", "nav2_smoother::SavitzkyGolaySmoother"),
    ];
    let mut smoothing = Smoothing::new(Nav2Release::Jazzy, &given);
    let path = |smoothing: &mut Smoothing, id: &str| {
        let asked = SmoothPathGoal { smoother_id: id.into(), ..goal(corner(2.0)) };
        done(smoothing.smooth(asked)).path.clone()
    };
    assert_ne!(path(&mut smoothing, "simple"), path(&mut smoothing, "sg"));
    smoothing.fails(goal(corner(2.0)), SmoothPathResult::INVALID_SMOOTHER, "several");
}
