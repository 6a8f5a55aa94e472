//! All servers of navigation on a graph in lockstep, with a robot and a client.

use std::path::Path;
use std::sync::Arc;

use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::{
    GoalProgress, GoalState, Graph, Mailbox, Node, NodeSettings, Publisher, Qos, Transition,
};
use periplus_msgs::nav_msgs::OccupancyGrid;
use periplus_msgs::nav2_msgs_main::{NavigateToPose, NavigateToPoseGoal};
use periplus_msgs::{Nav2Action, std_msgs};
use periplus_nav_nodes::nav2_actions::{Nav2ActionClient, Nav2SentGoal};
use periplus_nav_nodes::navigation::{NavigationNode, NavigationServer, NavigationSetup};
use periplus_nav_nodes::navigation_plugins::NavigationPlugins;
use periplus_resources::MemoryHost;

use crate::common::{map, pose_in};
use crate::files::MemoryFiles;
use crate::params::YAML;
use crate::robot::{Robot, STEP_NS};

/// Walls around 6 x 4 m, and a closed room of 1 m in the upper right corner.
pub(crate) fn room(x: f64, y: f64) -> bool {
    let is_outside = !(0.1..5.9).contains(&x) || !(0.1..3.9).contains(&y);
    let is_room = (4.5..4.7).contains(&x) && y > 2.6 || x > 4.5 && (2.6..2.8).contains(&y);
    is_outside || is_room
}

/// Start of the robot.
pub(crate) const START: Pose2 = Pose2 { x_m: 1.0, y_m: 1.0, yaw_rad: 0.0 };
/// A goal that the robot reaches within 6 s.
pub(crate) const NEAR: [f64; 3] = [3.0, 1.0, 0.0];
/// A goal that it reaches within 15 s, with a rotation at the end.
pub(crate) const FAR: [f64; 3] = [5.0, 1.0, 3.0];
/// A goal in the closed room.
pub(crate) const CLOSED: [f64; 3] = [5.3, 3.35, 0.0];
/// A goal that is not on the map.
pub(crate) const OUTSIDE: [f64; 3] = [9.0, 1.0, 0.0];

/// Time until the robot stands \[ms\]: 1.8 rad/s are braked with 3.2 rad/s^2, 0.5 m/s with 2.5 m/s^2, after a period
/// of the smoother.
pub(crate) const BRAKING_MS: i64 = 700;

/// Changes of the usual world.
pub(crate) struct Setup {
    pub(crate) release: Nav2Release,
    /// Parameter file.
    pub(crate) yaml: String,
    /// Replacements in the parameter file.
    pub(crate) replace: Vec<(&'static str, &'static str)>,
    pub(crate) files: MemoryHost,
    pub(crate) has_map: bool,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            release: Nav2Release::Jazzy,
            yaml: YAML.to_owned(),
            replace: Vec::new(),
            files: MemoryHost::new(),
            has_map: true,
        }
    }
}

impl Setup {
    /// Replaces a text in the parameter file.
    pub(crate) fn replace(mut self, from: &'static str, to: &'static str) -> Self {
        self.replace.push((from, to));
        self
    }

    pub(crate) fn file(mut self, path: &str, text: &str) -> Self {
        self.files = self.files.with_file(path, text);
        self
    }

    /// Starts the servers and lets 1.5 s pass.
    pub(crate) fn start(self) -> World {
        let mut yaml = self.yaml;
        for (from, to) in &self.replace {
            assert!(yaml.contains(from), "{from}");
            yaml = yaml.replace(from, to);
        }
        let yaml = yaml.replace("LOCAL_RATE", "0.0").replace("GLOBAL_RATE", "0.0");
        let graph = Graph::new();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let mut sources = SourceMap::new();
        let file = sources.add("params.yaml", yaml);
        let tree = periplus_yaml::parse(file, &sources).unwrap();
        let setup = NavigationSetup {
            graph: &graph,
            file: tree.as_ref(),
            release: Some(self.release),
            stamped_velocities: Some(false),
            files: Arc::new(MemoryFiles(self.files)),
            save_photo: Arc::new(|_: &Path, _: &[u8]| Ok(())),
            plugins: NavigationPlugins::default(),
        };
        let mut diagnostics = Diagnostics::new();
        let mut create = |server: NavigationServer| {
            let mut settings = NodeSettings::new(server.node_name());
            if matches!(
                server,
                NavigationServer::Controller
                    | NavigationServer::Behaviors
                    | NavigationServer::VelocitySmoother
            ) {
                settings = settings.remap("cmd_vel", "cmd_vel_nav");
            }
            let node = graph.node(settings).unwrap();
            let created =
                setup.create(server, node, |settings| graph.node(settings), &mut diagnostics);
            created.unwrap()
        };
        let nodes: Vec<NavigationNode> =
            NavigationServer::STACK.into_iter().map(&mut create).collect();
        assert!(!diagnostics.has_errors(), "{diagnostics:?}");
        let map_publisher = user.publisher("/map", Qos::latched(1)).unwrap();
        let release = self.release;
        let mut world = World {
            robot: Robot::new(&user, START, room),
            client: Nav2ActionClient::new(&user, release, "navigate_to_pose").unwrap(),
            reasons: user.mailbox("/bt_navigator/status_reason", Qos::latched(100)).unwrap(),
            map: map_publisher,
            release,
            graph,
            user,
            nodes,
            now_ns: 0,
        };
        if self.has_map {
            world.publish_map();
        }
        world.run_ms(100);
        world.nodes.iter().for_each(NavigationNode::start);
        world.run_ms(1400);
        world
    }
}

pub(crate) struct World {
    pub(crate) graph: Graph,
    pub(crate) user: Node,
    pub(crate) nodes: Vec<NavigationNode>,
    pub(crate) robot: Robot,
    pub(crate) client: Nav2ActionClient<NavigateToPose>,
    pub(crate) reasons: Mailbox<std_msgs::String>,
    map: Publisher<OccupancyGrid>,
    pub(crate) release: Nav2Release,
    pub(crate) now_ns: i64,
}

/// End of an action.
#[derive(Debug)]
pub(crate) struct Ended<R> {
    pub(crate) state: GoalState,
    pub(crate) result: R,
}

impl World {
    pub(crate) fn new() -> Self {
        Setup::default().start()
    }

    pub(crate) fn publish_map(&self) {
        self.map.publish(map(room));
    }

    pub(crate) fn step(&mut self) {
        self.now_ns += STEP_NS;
        self.robot.step(self.now_ns);
        self.graph.advance_to(self.now_ns);
    }

    pub(crate) fn run_ms(&mut self, milliseconds: i64) {
        let end_ns = self.now_ns + milliseconds * 1_000_000;
        while self.now_ns < end_ns {
            self.step();
        }
    }

    pub(crate) fn node(&self, server: NavigationServer) -> &NavigationNode {
        self.nodes.iter().find(|node| node.server() == server).unwrap()
    }

    pub(crate) fn change(&self, server: NavigationServer, transition: Transition) {
        self.node(server).lifecycle().change(transition);
    }

    pub(crate) fn client_of<A: Nav2Action>(&self, name: &str) -> Nav2ActionClient<A> {
        Nav2ActionClient::new(&self.user, self.release, name).unwrap()
    }

    pub(crate) fn send(&self, pose: [f64; 3]) -> Nav2SentGoal<NavigateToPose> {
        self.client.send(goal(pose))
    }

    /// Names of the tree nodes that run.
    pub(crate) fn running(&self) -> Vec<String> {
        let NavigationNode::Navigator(node) = self.node(NavigationServer::Navigator) else {
            return Vec::new();
        };
        node.with(|navigator| navigator.status().running)
    }

    /// Lets time pass until a tree node runs.
    #[track_caller]
    pub(crate) fn run_until(&mut self, tree_node: &str) {
        for _ in 0..6000 {
            if self.running().iter().any(|name| name.contains(tree_node)) {
                return;
            }
            self.step();
        }
        panic!("`{tree_node}` does not run: {:?}", self.running());
    }

    /// Lets time pass until a goal is over, and at most for a time \[ms\].
    #[track_caller]
    pub(crate) fn finish<A: Nav2Action>(
        &mut self,
        sent: &Nav2SentGoal<A>,
        max_ms: i64,
    ) -> Ended<A::Result> {
        let start_ns = self.now_ns;
        loop {
            let after_ms = (self.now_ns - start_ns) / 1_000_000;
            match sent.look() {
                GoalProgress::Over(state, result) => {
                    return Ended { state, result: Arc::unwrap_or_clone(result) };
                }
                GoalProgress::Sent | GoalProgress::Accepted if after_ms < max_ms => self.step(),
                other => panic!("{other:?} after {after_ms} ms: {:?}", self.running()),
            }
        }
    }

    /// The robot stands within a time \[ms\] and for a second after it.
    #[track_caller]
    pub(crate) fn stands_after(&mut self, milliseconds: i64) {
        self.run_ms(milliseconds);
        for _ in 0..100 {
            self.step();
            assert_eq!(self.robot.command, Twist2::ZERO, "{:?}", self.running());
        }
        assert!(!self.robot.has_collided, "{:?}", self.robot.pose);
    }

    /// A goal is reached.
    #[track_caller]
    pub(crate) fn reaches(&mut self, pose: [f64; 3]) {
        let sent = self.send(pose);
        let ended = self.finish(&sent, 40_000);
        assert_eq!(ended.state, GoalState::Succeeded, "{}", ended.result.error_msg);
        self.is_at(pose);
        self.stands_after(BRAKING_MS);
    }

    #[track_caller]
    pub(crate) fn is_at(&self, [x, y, _]: [f64; 3]) {
        let robot = self.robot.pose;
        assert!(libm::hypot(robot.x_m - x, robot.y_m - y) < 0.35, "{robot:?}");
    }

    /// The servers serve the next goals: one that is reached without a fault.
    #[track_caller]
    pub(crate) fn serves_the_next_goal(&mut self) {
        self.robot.faults = crate::robot::Faults::default();
        self.run_ms(2000);
        let is_left = self.robot.pose.x_m < 3.0;
        self.reaches(if is_left { [4.0, 1.2, 0.0] } else { [2.0, 1.2, 0.0] });
    }

    /// The goal is aborted within a time \[ms\], with a code and words, and the robot stands.
    #[track_caller]
    pub(crate) fn fails(
        &mut self,
        sent: &Nav2SentGoal<NavigateToPose>,
        max_ms: i64,
        code: u16,
        words: &[&str],
    ) {
        let ended = self.finish(sent, max_ms);
        assert_eq!(ended.state, GoalState::Aborted);
        assert_eq!(ended.result.error_code, code, "{}", ended.result.error_msg);
        for word in words {
            assert!(ended.result.error_msg.contains(word), "{word}: {}", ended.result.error_msg);
        }
        self.stands_after(BRAKING_MS);
    }

    /// Time from now until a reason is published that has a word \[ms\].
    #[track_caller]
    pub(crate) fn reason_after_ms(&mut self, word: &str) -> i64 {
        for step in 0..2000 {
            if self.reasons.drain().iter().any(|reason| reason.data.contains(word)) {
                return step * 10;
            }
            self.step();
        }
        panic!("no reason has `{word}`");
    }
}

pub(crate) fn goal([x, y, yaw_rad]: [f64; 3]) -> NavigateToPoseGoal {
    NavigateToPoseGoal { pose: pose_in("map", x, y, yaw_rad), behavior_tree: String::new() }
}
