//! Subscriptions: scans, which wait for their transforms, and maps.

use std::sync::Arc;

use periplus_graph::{Client, GraphError, Mailbox, Node, Pending, Qos};
use periplus_localization::AmclParams;
use periplus_msgs::nav_msgs::{GetMap, GetMapRequest, OccupancyGrid};
use periplus_tf_ros::{
    FilterOrder, FilterSettings, RobotFrames, SCAN_TRANSFORM_TIMEOUT_NS, ScanQueue,
};

/// Maximum number of waiting scans.
const MAX_WAITING_SCANS: usize = 50;
/// Interval of calls of the map service \[ns\].
const MAP_CALL_INTERVAL_NS: i64 = 1_000_000_000;

/// Subscriptions of the node.
pub(crate) struct Inputs {
    pub(crate) scans: ScanQueue,
    map: Mailbox<OccupancyGrid>,
    map_client: Option<MapClient>,
}

/// Client of the map service, as in ROS 1.
struct MapClient {
    client: Client<GetMap>,
    called_ns: Option<i64>,
    pending: Option<Pending<GetMap>>,
}

/// Frames of the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct FrameNames {
    pub(crate) odom: String,
    pub(crate) base: String,
}

impl FrameNames {
    pub(crate) fn robot(&self) -> RobotFrames<'_> {
        RobotFrames {
            odom: &self.odom,
            base: &self.base,
            odom_parameter: "odom_frame_id",
            base_parameter: "base_frame_id",
        }
    }
}

impl Inputs {
    pub(crate) fn new(node: &Node, params: &AmclParams) -> Result<Self, GraphError> {
        let client =
            (!params.use_map_topic).then(|| node.client::<GetMap>("static_map")).transpose()?;
        let settings = FilterSettings {
            max_waiting: MAX_WAITING_SCANS,
            timeout_ns: SCAN_TRANSFORM_TIMEOUT_NS,
            order: FilterOrder::InOrder,
        };
        Ok(Self {
            scans: ScanQueue::new(node, &params.scan_topic, settings)?,
            map: node.mailbox(&params.map_topic, Qos::latched(1))?,
            map_client: client.map(|client| MapClient { client, called_ns: None, pending: None }),
        })
    }

    /// Returns a new map, if one arrived.
    pub(crate) fn take_map(&mut self, now_ns: i64) -> Option<Arc<OccupancyGrid>> {
        if let Some(map) = self.map.latest() {
            return Some(map);
        }
        let map_client = self.map_client.as_mut()?;
        if let Some(answer) = map_client.pending.as_ref().and_then(Pending::take) {
            map_client.pending = None;
            if let Ok(answer) = answer
                && !answer.map.data.is_empty()
            {
                self.map_client = None;
                return Some(Arc::new(answer.map.clone()));
            }
        }
        let is_due =
            map_client.called_ns.is_none_or(|called_ns| now_ns - called_ns >= MAP_CALL_INTERVAL_NS);
        if map_client.pending.is_none() && is_due && map_client.client.is_ready() {
            map_client.called_ns = Some(now_ns);
            map_client.pending = Some(map_client.client.call(GetMapRequest::default()));
        }
        None
    }

    /// Description of the source of the map.
    pub(crate) fn map_source(&self) -> String {
        match &self.map_client {
            Some(map_client) => format!("from the service `{}`", map_client.client.name()),
            None => format!("on `{}`", self.map.topic()),
        }
    }
}
