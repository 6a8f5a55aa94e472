//! A robot that moves exactly as commanded, on a costmap with obstacles.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{Pose2, Twist2};
use periplus_graph::{
    GoalProgress, Graph, LifecycleNode, Mailbox, Node, NodeSettings, Publisher, Qos,
};
use periplus_msgs::Nav2Action;
use periplus_msgs::geometry_msgs::{Point32, PolygonStamped, Twist, TwistStamped};
use periplus_msgs::nav2_msgs::Costmap;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_nav_nodes::behavior_server::{BehaviorServerConfig, BehaviorServerNode};
use periplus_nav_nodes::nav2_actions::{Nav2ActionClient, Nav2SentGoal};
use periplus_params::Given;
use periplus_tf_ros::transform;

/// Step of the simulated robot \[ns\].
pub(crate) const STEP_NS: i64 = 10_000_000;

/// Half of the side of the robot \[m\].
const HALF_M: f32 = 0.1;

/// Cells per side and size of a cell of the costmap, which is centred at the origin.
const CELLS: usize = 80;
const CELL_M: f64 = 0.05;

enum Commands {
    Plain(Mailbox<Twist>),
    Stamped(Mailbox<TwistStamped>),
}

pub(crate) struct Stage {
    pub(crate) graph: Graph,
    pub(crate) user: Node,
    pub(crate) server: LifecycleNode<BehaviorServerNode>,
    commands: Commands,
    tf: Publisher<TFMessage>,
    costmaps: Publisher<Costmap>,
    footprints: Publisher<PolygonStamped>,
    release: Nav2Release,
    pub(crate) pose: Pose2,
    pub(crate) velocity: Twist2,
    /// All commands so far.
    pub(crate) log: Vec<Twist2>,
    /// Robots without transforms stand still and are not seen.
    pub(crate) has_tf: bool,
}

impl Stage {
    pub(crate) fn new(release: Nav2Release, given: &[(&str, &str)]) -> Self {
        let graph = Graph::new();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let plugins = [
            ("behavior_plugins", "[spin, backup, drive_on_heading, assisted_teleop, wait]"),
            ("transform_tolerance", "0.1"),
        ];
        let given = plugins.iter().chain(given).map(|(name, text)| Given::new(name, *text));
        let mut diagnostics = Diagnostics::new();
        let config = BehaviorServerConfig::read(given, Some(release), &mut diagnostics);
        assert!(diagnostics.is_empty(), "{diagnostics:?}");
        let server = BehaviorServerNode::new(&graph, config).unwrap();
        let commands = if release >= Nav2Release::Kilted {
            Commands::Stamped(user.mailbox("cmd_vel", Qos::reliable(100)).unwrap())
        } else {
            Commands::Plain(user.mailbox("cmd_vel", Qos::reliable(100)).unwrap())
        };
        let mut stage = Self {
            tf: user.publisher("/tf", Qos::reliable(100)).unwrap(),
            costmaps: user.publisher("local_costmap/costmap_raw", Qos::latched(1)).unwrap(),
            footprints: user
                .publisher("local_costmap/published_footprint", Qos::reliable(10))
                .unwrap(),
            graph,
            user,
            server,
            commands,
            release,
            pose: Pose2::IDENTITY,
            velocity: Twist2::ZERO,
            log: Vec::new(),
            has_tf: true,
        };
        stage.server.start();
        stage.run(0.1);
        stage
    }

    /// Publishes a costmap whose cells at these points are lethal.
    pub(crate) fn see(&self, obstacles: &[(f64, f64)]) {
        let mut costmap = Costmap { header: self.header(), ..Costmap::default() };
        let origin = -(CELLS as f64) / 2.0 * CELL_M;
        costmap.metadata.resolution = CELL_M as f32;
        costmap.metadata.size_x = CELLS as u32;
        costmap.metadata.size_y = CELLS as u32;
        (costmap.metadata.origin.position.x, costmap.metadata.origin.position.y) = (origin, origin);
        costmap.metadata.origin.orientation.w = 1.0;
        costmap.data = vec![0; CELLS * CELLS];
        let index = |at: f64| ((at - origin) / CELL_M).floor() as usize;
        for (x, y) in obstacles {
            costmap.data[index(*y) * CELLS + index(*x)] = 254;
        }
        self.costmaps.publish(costmap);
        let corner = |x: f32, y: f32| {
            let (x, y) = self.pose.transform_point((x * HALF_M).into(), (y * HALF_M).into());
            Point32 { x: x as f32, y: y as f32, z: 0.0 }
        };
        let mut footprint = PolygonStamped { header: self.header(), ..PolygonStamped::default() };
        footprint.polygon.points =
            vec![corner(1.0, 1.0), corner(-1.0, 1.0), corner(-1.0, -1.0), corner(1.0, -1.0)];
        self.footprints.publish(footprint);
    }

    fn header(&self) -> Header {
        Header::at(self.graph.now_ns(), "odom")
    }

    fn receive(&mut self) {
        let twists: Vec<Twist> = match &self.commands {
            Commands::Plain(mailbox) => mailbox.drain().iter().map(|it| (**it).clone()).collect(),
            Commands::Stamped(mailbox) => mailbox
                .drain()
                .iter()
                .map(|stamped| {
                    assert_eq!(stamped.header.frame_id, "base_link");
                    stamped.twist.clone()
                })
                .collect(),
        };
        for twist in twists {
            self.velocity = Twist2::new(twist.linear.x, twist.linear.y, twist.angular.z);
            self.log.push(self.velocity);
        }
    }

    /// Moves the robot for a time.
    pub(crate) fn run(&mut self, seconds: f64) {
        let end_ns = self.graph.now_ns() + (seconds * 1e9).round() as i64;
        while self.graph.now_ns() < end_ns {
            self.graph.advance_to(self.graph.now_ns() + STEP_NS);
            let step_s = STEP_NS as f64 * 1e-9;
            let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = self.velocity;
            let moved = Pose2::new(vx_m_s * step_s, vy_m_s * step_s, wz_rad_s * step_s);
            self.pose = self.pose * moved;
            if self.has_tf {
                let message = transform("odom", "base_link", self.pose, self.graph.now_ns());
                self.tf.publish(message);
                self.graph.settle();
            }
            self.receive();
        }
    }

    pub(crate) fn client<A: Nav2Action>(&self, name: &str) -> Nav2ActionClient<A> {
        Nav2ActionClient::new(&self.user, self.release, name).unwrap()
    }

    /// Sends a goal and moves the robot until the goal is over.
    pub(crate) fn finish<A: Nav2Action>(
        &mut self,
        sent: &Nav2SentGoal<A>,
    ) -> GoalProgress<A::Result> {
        for _ in 0..3000 {
            match sent.look() {
                GoalProgress::Sent | GoalProgress::Accepted => self.run(0.01),
                over => return over,
            }
        }
        panic!("the goal does not end");
    }
}
