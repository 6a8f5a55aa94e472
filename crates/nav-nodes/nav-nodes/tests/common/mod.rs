//! Stage for tests of navigation servers: a graph in lockstep with a map, a robot and a user.
#![allow(clippy::unwrap_used, dead_code, reason = "helpers of tests; each test uses some of them")]

use std::sync::Arc;

use periplus_costmap::{CostmapConfig, Nav2Release};
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_geometry::Pose2;
use periplus_graph::{Graph, LifecycleNode, Mailbox, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{
    Point, Pose, PoseStamped, Quaternion, Transform, TransformStamped, Vector3,
};
use periplus_msgs::nav_msgs::{MapMetaData, OccupancyGrid};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::{Message, Service};
use periplus_nav_nodes::costmap_2d::CostmapNode;

/// Costmap on a map, without a robot radius of more than one cell.
pub(crate) const GLOBAL_COSTMAP: &str = "
global_costmap:
  global_costmap:
    ros__parameters:
      update_frequency: 10.0
      publish_frequency: 10.0
      robot_radius: 0.1
      track_unknown_space: true
      plugins: [static_layer, inflation_layer]
      static_layer: {plugin: 'nav2_costmap_2d::StaticLayer'}
      inflation_layer: {plugin: 'nav2_costmap_2d::InflationLayer', inflation_radius: 0.2}
";

pub(crate) fn costmap(
    graph: &Graph,
    name: &str,
    text: &str,
    release: Nav2Release,
) -> LifecycleNode<CostmapNode> {
    let mut sources = SourceMap::new();
    let file = sources.add("params.yaml", text);
    let tree = periplus_yaml::parse(file, &sources).unwrap().unwrap();
    let mut diagnostics = Diagnostics::new();
    let config = CostmapConfig::read_yaml(&tree, name, Some(release), &mut diagnostics);
    assert!(diagnostics.is_empty(), "{:?}", diagnostics.iter().next());
    CostmapNode::new(graph, name, config).unwrap()
}

pub(crate) fn quaternion(yaw_rad: f64) -> Quaternion {
    let (z, w) = (libm::sin(yaw_rad / 2.0), libm::cos(yaw_rad / 2.0));
    Quaternion { x: 0.0, y: 0.0, z, w }
}

pub(crate) fn pose_in(frame: &str, x: f64, y: f64, yaw_rad: f64) -> PoseStamped {
    PoseStamped {
        header: Header { stamp: Time::default(), frame_id: frame.into() },
        pose: Pose { position: Point { x, y, z: 0.0 }, orientation: quaternion(yaw_rad) },
    }
}

/// Map of 6 x 4 m with cells of 0.1 m; `#` in rows of one metre is a wall, `?` unknown.
pub(crate) fn map(is_wall: impl Fn(f64, f64) -> bool) -> OccupancyGrid {
    let (width, height) = (60_u32, 40_u32);
    let cells = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
    let centre = |index: u32| (f64::from(index) + 0.5) / 10.0;
    OccupancyGrid {
        header: Header { stamp: Time::default(), frame_id: "map".into() },
        info: MapMetaData {
            resolution: 0.1,
            width,
            height,
            origin: pose_in("map", 0.0, 0.0, 0.0).pose,
            ..MapMetaData::default()
        },
        data: cells
            .map(|(column, row)| if is_wall(centre(column), centre(row)) { 100 } else { 0 })
            .collect(),
    }
}

/// Transforms from `map` to `odom` and from there to a robot at a pose.
pub(crate) fn transforms(time_ns: i64, robot: Pose2) -> TFMessage {
    let transform = |parent: &str, child: &str, pose: Pose2| TransformStamped {
        header: Header { stamp: Time::of_ns(time_ns), frame_id: parent.into() },
        child_frame_id: child.into(),
        transform: Transform {
            translation: Vector3 { x: pose.x_m, y: pose.y_m, z: 0.0 },
            rotation: quaternion(pose.yaw_rad),
        },
    };
    let transforms =
        vec![transform("map", "odom", Pose2::IDENTITY), transform("odom", "base_link", robot)];
    TFMessage { transforms }
}

pub(crate) struct Stage {
    pub(crate) graph: Graph,
    pub(crate) user: Node,
    pub(crate) tf: Publisher<TFMessage>,
    pub(crate) map: Publisher<OccupancyGrid>,
    pub(crate) robot: Option<Pose2>,
    pub(crate) now_ns: i64,
}

impl Stage {
    pub(crate) fn new() -> Self {
        let graph = Graph::new();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let tf = user.publisher("/tf", Qos::reliable(100)).unwrap();
        let map = user.publisher("/map", Qos::latched(1)).unwrap();
        Self { graph, user, tf, map, robot: Some(Pose2::new(1.0, 1.0, 0.0)), now_ns: 0 }
    }

    /// Publishes `map` to `odom` and `odom` to `base_link`.
    pub(crate) fn publish_robot(&self) {
        let Some(robot) = self.robot else { return };
        self.tf.publish(transforms(self.now_ns, robot));
    }

    /// Advances in steps of 10 ms, in each of which the pose of the robot is published.
    pub(crate) fn advance(&mut self, milliseconds: i64) {
        let end_ns = self.now_ns + milliseconds * 1_000_000;
        while self.now_ns < end_ns {
            self.now_ns = end_ns.min(self.now_ns + 10_000_000);
            self.publish_robot();
            self.graph.advance_to(self.now_ns);
        }
    }

    pub(crate) fn mailbox<T: Message>(&self, topic: &str) -> Mailbox<T> {
        self.user.mailbox(topic, Qos::reliable(100)).unwrap()
    }

    pub(crate) fn call<S: Service>(&self, name: &str, request: S::Request) -> Arc<S::Response> {
        let asked = self.user.client::<S>(name).unwrap().call(request);
        self.graph.settle();
        asked.take().unwrap().unwrap()
    }
}
