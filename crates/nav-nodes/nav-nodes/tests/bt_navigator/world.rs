//! Navigator with scripted servers.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose;
use periplus_graph::{
    ActionSettings, Actor, Graph, LifecycleNode, Node, NodeSettings, Publisher, Qos,
};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::Path as PathMessage;
use periplus_msgs::nav2_msgs_main::{
    BackUp, BackUpGoal, BackUpResult, ClearEntireCostmap, ClearEntireCostmapResponse,
    ComputePathThroughPoses, ComputePathThroughPosesGoal, ComputePathThroughPosesResult,
    ComputePathToPose, ComputePathToPoseGoal, ComputePathToPoseResult, FollowPath, FollowPathGoal,
    FollowPathResult, IsPathValid, IsPathValidResponse, Spin, SpinGoal, SpinResult, Wait, WaitGoal,
    WaitResult,
};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::{Action, Nav2Action, Nav2Service};
use periplus_nav_nodes::bt_navigator::{BtNavigator, BtNavigatorParams};
use periplus_nav_nodes::nav2_actions::{Nav2GoalHandle, NewNav2Goal, serve_nav2_action};
use periplus_params::Given;
use periplus_resources::MemoryHost;

use crate::files::MemoryFiles;

pub(crate) const MS: i64 = 1_000_000;

/// Answer of a server to a goal.
#[derive(Clone, Debug)]
pub(crate) enum Answer {
    /// Success after a time \[ms\].
    Succeed(i64),
    /// Failure after a time \[ms\] with a code.
    Abort(i64, u16),
    /// Runs until it is canceled.
    Run,
    /// Accepts the goal after a time \[ms\], and runs until it is canceled.
    AcceptLate(i64),
    /// Refuses the goal.
    Reject,
}

/// Calls of servers with their time \[ms\].
#[derive(Clone, Default)]
pub(crate) struct Log(Arc<Mutex<Vec<(i64, String)>>>);

impl Log {
    fn push(&self, now_ns: i64, text: impl Into<String>) {
        self.0.lock().unwrap().push((now_ns / MS, text.into()));
    }

    /// Names in order, without times.
    pub(crate) fn names(&self) -> Vec<String> {
        self.0.lock().unwrap().iter().map(|(_, name)| name.clone()).collect()
    }

    /// Times of a call \[ms\].
    pub(crate) fn times(&self, name: &str) -> Vec<i64> {
        let calls = self.0.lock().unwrap();
        calls.iter().filter(|(_, call)| call == name).map(|(ms, _)| *ms).collect()
    }
}

/// Action of a scripted server.
pub(crate) trait FakeAction: Nav2Action {
    const NAME: &'static str;
    fn result(goal: &Self::Goal, code: u16, now_ns: i64) -> Self::Result;
}

/// Path of two poses to a goal; its stamp differs each time.
fn path_to(goal: &PoseStamped, now_ns: i64) -> PathMessage {
    let start = PoseStamped { header: goal.header.clone(), ..PoseStamped::default() };
    PathMessage { header: Header::at(now_ns, "map"), poses: vec![start, goal.clone()] }
}

macro_rules! fake {
    ($action:ident $name:literal $goal:ident $result:ident) => {
        impl FakeAction for $action {
            const NAME: &'static str = $name;

            fn result(_: &$goal, code: u16, _: i64) -> $result {
                $result {
                    error_code: code,
                    error_msg: format!("code {code}"),
                    ..$result::default()
                }
            }
        }
    };
}

fake!(FollowPath "follow_path" FollowPathGoal FollowPathResult);
fake!(Spin "spin" SpinGoal SpinResult);
fake!(BackUp "backup" BackUpGoal BackUpResult);
fake!(Wait "wait" WaitGoal WaitResult);

impl FakeAction for ComputePathToPose {
    const NAME: &'static str = "compute_path_to_pose";

    fn result(goal: &ComputePathToPoseGoal, code: u16, now_ns: i64) -> ComputePathToPoseResult {
        let path = if code == 0 { path_to(&goal.goal, now_ns) } else { PathMessage::default() };
        let error_msg = format!("code {code}");
        ComputePathToPoseResult { path, error_code: code, error_msg, ..Default::default() }
    }
}

impl FakeAction for ComputePathThroughPoses {
    const NAME: &'static str = "compute_path_through_poses";

    fn result(
        goal: &ComputePathThroughPosesGoal,
        code: u16,
        now_ns: i64,
    ) -> ComputePathThroughPosesResult {
        let path = path_to(&goal.goals.goals[goal.goals.goals.len() - 1], now_ns);
        ComputePathThroughPosesResult { path, error_code: code, ..Default::default() }
    }
}

/// State of a scripted server.
pub(crate) struct Fake<A: Action> {
    /// Answers to the next goals; the last one is repeated.
    pub(crate) answers: VecDeque<Answer>,
    pub(crate) goals: Vec<A::Goal>,
    running: Option<(Nav2GoalHandle<A>, i64, Answer)>,
    /// Goal to accept later, and the time of it \[ns\].
    held: Option<(NewNav2Goal<A>, i64)>,
    log: Log,
}

fn serve<A: FakeAction>(graph: &Graph, release: Nav2Release, log: &Log) -> Actor<Fake<A>> {
    let node = graph.node(NodeSettings::new(format!("{}_server", A::NAME))).unwrap();
    let mut actor = node.actor(Fake::<A> {
        answers: [Answer::Succeed(0)].into(),
        goals: Vec::new(),
        running: None,
        held: None,
        log: log.clone(),
    });
    let settings = ActionSettings::default();
    serve_nav2_action::<A, Fake<A>>(
        &mut actor,
        release,
        A::NAME,
        settings,
        |state, new, io| {
            let answer = match state.answers.len() {
                1 => state.answers[0].clone(),
                _ => state.answers.pop_front().unwrap(),
            };
            state.log.push(io.now_ns(), A::NAME);
            state.goals.push((**new.goal()).clone());
            if matches!(answer, Answer::Reject) {
                return new.reject();
            }
            if let Answer::AcceptLate(ms) = answer {
                state.held = Some((new, io.now_ns() + ms * MS));
                return;
            }
            let handle = new.accept().unwrap();
            handle.execute();
            if let Some((old, ..)) = state.running.take() {
                old.abort(A::Result::default());
            }
            state.running = Some((handle, io.now_ns(), answer));
        },
        |_, _, _| true,
    )
    .unwrap();
    let work = |state: &mut Fake<A>, now_ns: i64| {
        if let Some((new, _)) = state.held.take_if(|(_, due_ns)| now_ns >= *due_ns) {
            let handle = new.accept().unwrap();
            handle.execute();
            state.running = Some((handle, now_ns, Answer::Run));
        }
        let Some((handle, since_ns, answer)) = state.running.take() else { return };
        let elapsed_ms = (now_ns - since_ns) / MS;
        let result = |code| A::result(handle.goal(), code, now_ns);
        if handle.is_canceling() {
            state.log.push(now_ns, format!("{} canceled", A::NAME));
            handle.canceled(A::Result::default());
            return;
        }
        match answer {
            Answer::Succeed(ms) if elapsed_ms >= ms => drop(handle.succeed(result(0))),
            Answer::Abort(ms, code) if elapsed_ms >= ms => drop(handle.abort(result(code))),
            answer => state.running = Some((handle, since_ns, answer)),
        }
    };
    actor.timer(MS, move |state, io| work(state, io.now_ns())).unwrap();
    actor
}

/// A navigator with its servers, and a robot at the origin of the map.
pub(crate) struct World {
    pub(crate) graph: Graph,
    pub(crate) node: Node,
    pub(crate) navigator: LifecycleNode<BtNavigator>,
    pub(crate) log: Log,
    pub(crate) planner: Actor<Fake<ComputePathToPose>>,
    _through: Actor<Fake<ComputePathThroughPoses>>,
    pub(crate) controller: Actor<Fake<FollowPath>>,
    pub(crate) spin: Actor<Fake<Spin>>,
    pub(crate) wait: Actor<Fake<Wait>>,
    pub(crate) backup: Actor<Fake<BackUp>>,
    tf: Publisher<TFMessage>,
    _services: Actor<Log>,
    pub(crate) release: Nav2Release,
}

/// Serves a service in the form of a release.
fn serve_service<S: Nav2Service>(
    actor: &mut Actor<Log>,
    release: Nav2Release,
    name: &str,
    call: &'static str,
    response: fn() -> S::Response,
) {
    if release == Nav2Release::Main {
        let served = actor.serve::<S>(name, move |log, _, io| {
            log.push(io.now_ns(), call);
            response()
        });
        served.unwrap();
    } else {
        let served = actor.serve::<S::Jazzy>(name, move |log, _, io| {
            log.push(io.now_ns(), call);
            S::response_of_full(response())
        });
        served.unwrap();
    }
}

impl World {
    pub(crate) fn new(release: Nav2Release) -> Self {
        Self::with(release, MemoryHost::new(), &[])
    }

    pub(crate) fn with(release: Nav2Release, files: MemoryHost, params: &[(&str, &str)]) -> Self {
        let graph = Graph::new();
        let log = Log::default();
        let mut services = graph.node(NodeSettings::new("costmaps")).unwrap().actor(log.clone());
        for (name, call) in [
            ("local_costmap/clear_entirely_local_costmap", "clear local"),
            ("global_costmap/clear_entirely_global_costmap", "clear global"),
        ] {
            let response = || ClearEntireCostmapResponse { success: true };
            serve_service::<ClearEntireCostmap>(&mut services, release, name, call, response);
        }
        let valid = || IsPathValidResponse {
            success: true,
            is_valid: true,
            invalid_pose_indices: Vec::new(),
        };
        serve_service::<IsPathValid>(
            &mut services,
            release,
            "is_path_valid",
            "is_path_valid",
            valid,
        );
        let node = graph.node(NodeSettings::new("tester")).unwrap();
        let given = params.iter().map(|(name, value)| Given::new(name, *value));
        let mut findings = Diagnostics::new();
        let values = BtNavigatorParams::read(given, release, &mut findings);
        assert!(findings.is_empty(), "{findings:?}");
        let own = graph.node(NodeSettings::new("bt_navigator")).unwrap();
        let navigator =
            BtNavigator::new(&own, values, release, Arc::new(MemoryFiles(files))).unwrap();
        let world = Self {
            planner: serve(&graph, release, &log),
            _through: serve(&graph, release, &log),
            controller: serve(&graph, release, &log),
            spin: serve(&graph, release, &log),
            wait: serve(&graph, release, &log),
            backup: serve(&graph, release, &log),
            tf: node.publisher("/tf", Qos::reliable(100)).unwrap(),
            _services: services,
            graph,
            node,
            navigator,
            log,
            release,
        };
        world.navigator.start();
        world.move_to(0.0);
        world.run_ms(1);
        world
    }

    /// Places the robot on the x axis of the map.
    pub(crate) fn move_to(&self, x_m: f64) {
        let pose = Pose::from_xyz(x_m, 0.0, 0.0);
        let stamp_ns = self.graph.now_ns() + 1;
        self.tf.publish(periplus_tf_ros::transform("map", "base_link", pose, stamp_ns));
    }

    /// Advances the time of the graph.
    pub(crate) fn run_ms(&self, ms: i64) {
        self.graph.advance_to(self.graph.now_ns() + ms * MS);
    }
}

/// Pose on the x axis of the map.
pub(crate) fn goal(x_m: f64) -> PoseStamped {
    let mut pose = PoseStamped { header: Header::at(0, "map"), ..PoseStamped::default() };
    pose.pose.position.x = x_m;
    pose.pose.orientation.w = 1.0;
    pose
}
