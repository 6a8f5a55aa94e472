//! A waypoint follower with a navigator whose results are scripted.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::{Arc, Mutex};

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_graph::{
    ActionSettings, Actor, Alarm, GoalProgress, Graph, Io, LifecycleNode, Node, NodeSettings,
};
use periplus_msgs::Nav2Action;
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav2_msgs_main::{
    FollowWaypoints, FollowWaypointsGoal, NavigateToPose, NavigateToPoseResult,
};
use periplus_nav_nodes::nav2_actions::{
    Nav2ActionClient, Nav2GoalHandle, Nav2SentGoal, NewNav2Goal, serve_nav2_action,
};
use periplus_nav_nodes::waypoint_follower::{WaypointFollowerConfig, WaypointFollowerNode};
use periplus_params::Given;

/// Time that the navigator takes for a goal \[ns\].
const DRIVE_NS: i64 = 500_000_000;

/// End of a goal of the navigator.
#[derive(Clone, Copy)]
pub(crate) enum Arrival {
    Reached,
    Aborted(u16),
    Refused,
    /// The goal is accepted after [`DRIVE_NS`].
    AcceptedLate,
}

/// Navigator that drives nowhere.
#[derive(Default)]
pub(crate) struct Navigator {
    script: VecDeque<Arrival>,
    /// x of the poses that were sent.
    pub(crate) goals: Vec<f64>,
    running: Vec<Nav2GoalHandle<NavigateToPose>>,
    pub(crate) canceled: usize,
    late: Option<NewNav2Goal<NavigateToPose>>,
    alarm: Option<Alarm>,
}

impl Navigator {
    /// Ends the running goals.
    pub(crate) fn end(&mut self) {
        self.arrive(Arrival::Reached);
    }

    fn arrive(&mut self, arrival: Arrival) {
        if let Some(goal) = self.late.take().and_then(NewNav2Goal::accept) {
            goal.execute();
            self.running.push(goal);
            return;
        }
        for goal in self.running.drain(..) {
            if goal.is_canceling() {
                self.canceled += 1;
                goal.canceled(NavigateToPoseResult::default());
                continue;
            }
            let error_msg = String::new();
            match arrival {
                Arrival::Aborted(error_code) => {
                    goal.abort(NavigateToPoseResult { error_code, error_msg });
                }
                _ => {
                    goal.succeed(NavigateToPoseResult::default());
                }
            }
        }
    }
}

pub(crate) struct Stage {
    pub(crate) graph: Graph,
    pub(crate) user: Node,
    pub(crate) follower: LifecycleNode<WaypointFollowerNode>,
    pub(crate) navigator: Actor<Navigator>,
    pub(crate) client: Nav2ActionClient<FollowWaypoints>,
    /// Paths of the photos.
    pub(crate) photos: Arc<Mutex<Vec<String>>>,
    pub(crate) release: Nav2Release,
}

impl Stage {
    pub(crate) fn new(given: &[(&str, &str)], script: &[Arrival]) -> Self {
        Self::of(Nav2Release::Main, given, script)
    }

    pub(crate) fn of(release: Nav2Release, given: &[(&str, &str)], script: &[Arrival]) -> Self {
        let graph = Graph::new();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let script = script.iter().copied().collect();
        let state = Navigator { script, ..Navigator::default() };
        let mut navigator = graph.node(NodeSettings::new("bt_navigator")).unwrap().actor(state);
        serve_nav2_action::<NavigateToPose, Navigator>(
            &mut navigator,
            release,
            "navigate_to_pose",
            ActionSettings::default(),
            |state, new, io: &mut Io<'_, Navigator>| {
                let arrival = state.script.pop_front().unwrap_or(Arrival::Reached);
                state.goals.push(new.goal().pose.pose.position.x);
                if matches!(arrival, Arrival::Refused) {
                    return;
                }
                // A new goal preempts the one before.
                state.arrive(Arrival::Aborted(0));
                let end_ns = io.now_ns() + DRIVE_NS;
                if matches!(arrival, Arrival::AcceptedLate) {
                    state.late = Some(new);
                } else if let Some(goal) = new.accept() {
                    goal.execute();
                    state.running.push(goal);
                }
                state.alarm = Some(io.alarm(end_ns, move |state, _| state.arrive(arrival)));
            },
            |_, _, _| true,
        )
        .unwrap();
        let mut diagnostics = Diagnostics::new();
        let given = given.iter().map(|(name, text)| Given::new(name, *text));
        let config = WaypointFollowerConfig::read(given, Some(release), &mut diagnostics);
        assert!(diagnostics.is_empty(), "{diagnostics:?}");
        let photos = Arc::new(Mutex::new(Vec::new()));
        let saved = photos.clone();
        let save = Arc::new(move |path: &Path, content: &[u8]| {
            assert_eq!(content[1..4], *b"PNG");
            saved.lock().unwrap().push(path.display().to_string());
            Ok(())
        });
        let follower = WaypointFollowerNode::new(&graph, config, save).unwrap();
        follower.start();
        graph.settle();
        let client = Nav2ActionClient::new(&user, release, "follow_waypoints").unwrap();
        Self { graph, user, follower, navigator, client, photos, release }
    }

    pub(crate) fn run(&self, seconds: f64) {
        self.graph.advance_to(self.graph.now_ns() + (seconds * 1e9).round() as i64);
    }

    /// Sends waypoints by their x.
    pub(crate) fn send(&self, xs: &[f64]) -> Nav2SentGoal<FollowWaypoints> {
        self.send_goal(FollowWaypointsGoal { poses: poses(xs), ..FollowWaypointsGoal::default() })
    }

    pub(crate) fn send_goal(&self, goal: FollowWaypointsGoal) -> Nav2SentGoal<FollowWaypoints> {
        let sent = self.client.send(goal);
        self.graph.settle();
        sent
    }

    /// x of the poses that the navigator got.
    pub(crate) fn goals(&self) -> Vec<f64> {
        self.navigator.with(|state| state.goals.clone())
    }

    /// Lets time pass until a goal is over.
    pub(crate) fn finish<A: Nav2Action>(&self, sent: &Nav2SentGoal<A>) -> GoalProgress<A::Result> {
        for _ in 0..3000 {
            match sent.look() {
                GoalProgress::Sent | GoalProgress::Accepted => self.run(0.01),
                over => return over,
            }
        }
        panic!("the goal does not end");
    }
}

pub(crate) fn poses(xs: &[f64]) -> Vec<PoseStamped> {
    let pose = |x: &f64| {
        let mut pose = PoseStamped::default();
        pose.header.frame_id = "map".to_owned();
        pose.pose.position.x = *x;
        pose.pose.orientation.w = 1.0;
        pose
    };
    xs.iter().map(pose).collect()
}
