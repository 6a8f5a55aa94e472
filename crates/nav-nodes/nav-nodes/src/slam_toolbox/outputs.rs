//! Publishers of the map and the pose.

use std::sync::Arc;

use periplus_geometry::Pose2;
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_grid::OccupancyGrid;
use periplus_maps::to_message;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus_msgs::nav_msgs::{self, MapMetaData};
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::std_msgs::Float64;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_msgs::visualization_msgs::{InteractiveMarker, InteractiveMarkerUpdate, MarkerArray};
use periplus_scan_matching::Symmetric3;
use periplus_tf_ros::{pose_with_covariance, transform};

use crate::slam_toolbox::Program;
use crate::slam_toolbox::messages::{covariance_rows, published};
use crate::slam_toolbox::parameters::NodeParams;

/// Topics that are published.
pub(crate) struct Outputs {
    map: Publisher<nav_msgs::OccupancyGrid>,
    metadata: Publisher<MapMetaData>,
    tf: Publisher<TFMessage>,
    toolbox: Option<Toolbox>,
    /// Entropy of the particle weights, published by `slam_gmapping` only.
    entropy: Option<Publisher<Float64>>,
}

/// Publishers of `slam_toolbox` only.
struct Toolbox {
    pose: Publisher<PoseWithCovarianceStamped>,
    graph: Publisher<MarkerArray>,
    contradictions: Publisher<MarkerArray>,
    scan: Publisher<LaserScan>,
    handles: Publisher<InteractiveMarkerUpdate>,
}

impl Outputs {
    pub(crate) fn new(
        node: &Node,
        program: Program,
        params: &NodeParams,
    ) -> Result<Self, GraphError> {
        let map = &params.map_topic;
        let toolbox = || -> Result<Toolbox, GraphError> {
            Ok(Toolbox {
                pose: node.publisher("pose", Qos::reliable(10))?,
                graph: node.publisher("slam_toolbox/graph_visualization", Qos::reliable(10))?,
                contradictions: node.publisher("slam_toolbox/contradictions", Qos::latched(1))?,
                scan: node.publisher("slam_toolbox/scan_visualization", Qos::reliable(10))?,
                handles: node.publisher("slam_toolbox/update", Qos::reliable(100))?,
            })
        };
        Ok(Self {
            map: node.publisher(map, Qos::latched(1))?,
            metadata: node.publisher(&format!("{map}_metadata"), Qos::latched(1))?,
            tf: node.publisher("/tf", Qos::reliable(100))?,
            toolbox: program.is_toolbox().then(toolbox).transpose()?,
            entropy: (!program.is_toolbox())
                .then(|| node.publisher("~/entropy", Qos::reliable(1)))
                .transpose()?,
        })
    }

    pub(crate) fn publish_map(&self, map: &OccupancyGrid, time_ns: i64, frame: &str) {
        let message = to_message(&published(map), frame, Time::of_ns(time_ns));
        self.metadata.publish(message.info.clone());
        self.map.publish(message);
    }

    pub(crate) fn publish_transform(
        &self,
        map_frame: &str,
        odom_frame: &str,
        map_from_odom: Pose2,
        time_ns: i64,
    ) {
        self.tf.publish(transform(map_frame, odom_frame, map_from_odom, time_ns));
    }

    pub(crate) fn publish_pose(
        &self,
        map_from_base: Pose2,
        covariance: &Symmetric3,
        time_ns: i64,
        frame: &str,
    ) {
        if let Some(toolbox) = &self.toolbox {
            let pose =
                pose_with_covariance(map_from_base, covariance_rows(covariance), time_ns, frame);
            toolbox.pose.publish(pose);
        }
    }

    pub(crate) fn publish_entropy(&self, data: f64) {
        if let Some(entropy) = &self.entropy {
            entropy.publish(Float64 { data });
        }
    }

    /// Publishes the graph if it has subscribers.
    pub(crate) fn publish_graph(&self, draw: impl FnOnce() -> MarkerArray) {
        if let Some(toolbox) = self.toolbox.as_ref().filter(|it| it.graph.is_heard()) {
            toolbox.graph.publish(draw());
        }
    }

    /// Contradictions of the map: kept for nodes that subscribe later.
    pub(crate) fn publish_contradictions(&self, draw: impl FnOnce() -> MarkerArray) {
        if let Some(toolbox) = &self.toolbox {
            toolbox.contradictions.publish(draw());
        }
    }

    /// Publishes the handles if they have subscribers, with the sequence number of their server.
    pub(crate) fn publish_handles(
        &self,
        number: u64,
        draw: impl FnOnce() -> Vec<InteractiveMarker>,
    ) {
        if let Some(toolbox) = self.toolbox.as_ref().filter(|it| it.handles.is_heard()) {
            toolbox.handles.publish(InteractiveMarkerUpdate {
                server_id: "slam_toolbox".to_owned(),
                seq_num: number,
                r#type: InteractiveMarkerUpdate::UPDATE,
                markers: draw(),
                ..InteractiveMarkerUpdate::default()
            });
        }
    }

    /// A scan that became part of the map.
    pub(crate) fn publish_scan(&self, scan: &Arc<LaserScan>) {
        if let Some(toolbox) = self.toolbox.as_ref().filter(|it| it.scan.is_heard()) {
            toolbox.scan.publish(LaserScan::clone(scan));
        }
    }
}
