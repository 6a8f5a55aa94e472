//! Subscription to scans, which wait for their transforms.

use periplus_graph::{GraphError, Node};
use periplus_tf_ros::{
    FilterOrder, FilterSettings, RobotFrames, SCAN_TRANSFORM_TIMEOUT_NS, ScanQueue,
};

use crate::slam_toolbox::parameters::NodeParams;

/// Maximum number of waiting scans where every scan counts.
const MAX_WAITING_SCANS: usize = 200;
/// Maximum number of waiting scans where the newest one counts. Transforms arrive a little later than
/// their scans, and a queue of one would always be full.
const MAX_WAITING_SCANS_NEWEST_FIRST: usize = 10;

/// Frames of the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Names {
    pub(crate) map: String,
    pub(crate) odom: String,
    pub(crate) base: String,
}

impl Names {
    pub(crate) fn robot(&self) -> RobotFrames<'_> {
        RobotFrames {
            odom: &self.odom,
            base: &self.base,
            odom_parameter: "odom_frame",
            base_parameter: "base_frame",
        }
    }
}

/// Subscribes to scans. `is_newest_first` skips older scans for the newest usable one.
pub(crate) fn scan_queue(
    node: &Node,
    params: &NodeParams,
    is_newest_first: bool,
) -> Result<ScanQueue, GraphError> {
    let (order, min_waiting) = match is_newest_first {
        true => (FilterOrder::NewestReady, MAX_WAITING_SCANS_NEWEST_FIRST),
        false => (FilterOrder::OldestReady, MAX_WAITING_SCANS),
    };
    let max_waiting = params.scan_queue_size.max(min_waiting);
    let timeout_ns = SCAN_TRANSFORM_TIMEOUT_NS;
    ScanQueue::new(node, &params.scan_topic, FilterSettings { max_waiting, timeout_ns, order })
}
