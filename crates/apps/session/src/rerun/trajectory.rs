//! Trajectory of an estimate as a path.

use periplus_geometry::Pose2;
use periplus_graph::{Graph, GraphError, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::std_msgs::Header;
use periplus_tf_ros::pose;

/// Topic of the trajectory.
const TOPIC: &str = "/trajectory";

/// Interval of publication \[ns\]. Each message has the whole trajectory.
const INTERVAL_NS: i64 = 5_000_000_000;

/// Publisher of the trajectory.
pub(super) struct TrajectoryPublisher {
    path: Publisher<Path>,
    frame: String,
    next_ns: i64,
    _node: Node,
}

impl TrajectoryPublisher {
    pub(super) fn new(graph: &Graph, frame: String) -> Result<Self, GraphError> {
        let node = graph.node(NodeSettings::new("rerun_trajectory").keep_names())?;
        let next_ns = graph.now_ns() + INTERVAL_NS;
        Ok(Self { path: node.publisher(TOPIC, Qos::latched(1))?, frame, next_ns, _node: node })
    }

    /// Publishes the trajectory if it is due, and always at the end. Times are stamps \[ns\].
    pub(super) fn publish(
        &mut self,
        now_ns: i64,
        is_end: bool,
        poses: impl FnOnce() -> Vec<(i64, Pose2)>,
    ) {
        if now_ns < self.next_ns && !is_end {
            return;
        }
        self.next_ns = now_ns + INTERVAL_NS;
        let poses: Vec<PoseStamped> = poses()
            .into_iter()
            .map(|(time_ns, map_from_base)| PoseStamped {
                header: Header::at(time_ns, &self.frame),
                pose: pose(map_from_base),
            })
            .collect();
        if !poses.is_empty() {
            self.path.publish(Path { header: Header::at(now_ns, &self.frame), poses });
        }
    }
}
