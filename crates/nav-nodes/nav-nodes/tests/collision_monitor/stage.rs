//! A robot at the origin of `odom` with a scanner, and a collision monitor.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose2;
use periplus_graph::{Graph, LifecycleNode, Mailbox, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::geometry_msgs::{Twist, TwistStamped};
use periplus_msgs::nav2_msgs::CollisionMonitorState;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_nav_nodes::collision_monitor::{CollisionMonitorNode, MonitorConfig};
use periplus_params::Given;
use periplus_tf_ros::transform;

enum Velocities {
    Plain(Publisher<Twist>, Mailbox<Twist>),
    Stamped(Publisher<TwistStamped>, Mailbox<TwistStamped>),
}

pub(crate) struct Stage {
    pub(crate) graph: Graph,
    pub(crate) user: Node,
    pub(crate) monitor: LifecycleNode<CollisionMonitorNode>,
    pub(crate) states: Mailbox<CollisionMonitorState>,
    velocities: Velocities,
    tf: Publisher<TFMessage>,
    scans: Publisher<LaserScan>,
}

/// Parameters of every test.
const COMMON: [(&str, &str); 2] =
    [("base_frame_id", "base_link"), ("state_topic", "monitor_state")];

/// A zone of one metre around the robot that one point triggers.
pub(crate) const STOP: [(&str, &str); 5] = [
    ("polygons", "[Stop]"),
    ("Stop.type", "polygon"),
    ("Stop.action_type", "stop"),
    ("Stop.points", "[[0.5, 0.5], [0.5, -0.5], [-0.5, -0.5], [-0.5, 0.5]]"),
    ("Stop.min_points", "1"),
];

pub(crate) const SCAN: [(&str, &str); 1] = [("observation_sources", "[scan]")];

pub(crate) fn config(release: Nav2Release, given: &[&[(&str, &str)]]) -> MonitorConfig {
    let all: Vec<(&str, &str)> =
        COMMON.iter().chain(given.iter().copied().flatten()).copied().collect();
    let mut diagnostics = Diagnostics::new();
    let given = all.iter().map(|(name, text)| Given::new(name, *text));
    let config = MonitorConfig::read_monitor(given, Some(release), &mut diagnostics);
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    config
}

impl Stage {
    pub(crate) fn new(given: &[&[(&str, &str)]]) -> Self {
        Self::of(Nav2Release::Main, given)
    }

    pub(crate) fn of(release: Nav2Release, given: &[&[(&str, &str)]]) -> Self {
        let graph = Graph::new();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let monitor = CollisionMonitorNode::new(&graph, config(release, given)).unwrap();
        let qos = Qos::reliable(100);
        let input = if release == Nav2Release::Humble { "cmd_vel_raw" } else { "cmd_vel_smoothed" };
        let velocities = if release >= Nav2Release::Kilted {
            let output = user.mailbox("cmd_vel", qos).unwrap();
            Velocities::Stamped(user.publisher(input, qos).unwrap(), output)
        } else {
            let output = user.mailbox("cmd_vel", qos).unwrap();
            Velocities::Plain(user.publisher(input, qos).unwrap(), output)
        };
        let stage = Self {
            states: user.mailbox("monitor_state", qos).unwrap(),
            tf: user.publisher("/tf", qos).unwrap(),
            scans: user.publisher("scan", Qos::sensor_data()).unwrap(),
            graph,
            user,
            monitor,
            velocities,
        };
        stage.monitor.start();
        stage.graph.advance_to(1_000_000_000);
        stage.stand_at(0.0);
        stage
    }

    pub(crate) fn now(&self, frame: &str) -> Header {
        Header::at(self.graph.now_ns(), frame)
    }

    /// Publishes the pose of the robot.
    pub(crate) fn stand_at(&self, x_m: f64) {
        let pose = Pose2::new(x_m, 0.0, 0.0);
        self.tf.publish(transform("odom", "base_link", pose, self.graph.now_ns()));
        self.graph.settle();
    }

    /// Publishes a scan with one point ahead; none for an infinite range.
    pub(crate) fn scan(&self, range: f32) {
        self.scans.publish(LaserScan {
            header: self.now("base_link"),
            angle_increment: 0.1,
            range_max: 10.0,
            ranges: vec![range],
            ..LaserScan::default()
        });
        self.graph.settle();
    }

    /// Lets time pass.
    pub(crate) fn wait(&self, seconds: f64) {
        self.graph.advance_to(self.graph.now_ns() + (seconds * 1e9).round() as i64);
    }

    /// Sends a command and returns the velocity that the monitor publishes: x, y, theta.
    pub(crate) fn command(&self, [vx, vy, wz]: [f64; 3]) -> Option<[f64; 3]> {
        let mut twist = Twist::default();
        (twist.linear.x, twist.linear.y, twist.angular.z) = (vx, vy, wz);
        let output = match &self.velocities {
            Velocities::Plain(input, output) => {
                input.publish(twist);
                self.graph.settle();
                output.latest().map(|twist| (*twist).clone())
            }
            Velocities::Stamped(input, output) => {
                input.publish(TwistStamped { header: self.now("base_link"), twist });
                self.graph.settle();
                output.latest().map(|stamped| stamped.twist.clone())
            }
        };
        output.map(|twist| [twist.linear.x, twist.linear.y, twist.angular.z])
    }

    /// Speed that the monitor allows for 1 m/s ahead.
    pub(crate) fn speed(&self) -> f64 {
        self.command([1.0, 0.0, 0.0]).unwrap()[0]
    }
}
