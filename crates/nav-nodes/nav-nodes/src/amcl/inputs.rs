//! Subscriptions: scans, which wait for their transforms, and maps.

use std::collections::VecDeque;
use std::sync::Arc;

use periplus_diagnostics::Diagnostic;
use periplus_graph::{Client, GraphError, Mailbox, Node, Pending, Qos};
use periplus_msgs::nav_msgs::{GetMap, GetMapRequest, OccupancyGrid};
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_params::ParamValues;
use periplus_tf_ros::{Frames, Places, Robot, places};

/// Time after which a scan without transforms is dropped \[ns\].
const TRANSFORM_TIMEOUT_NS: i64 = 1_000_000_000;
/// Maximum number of waiting scans.
const MAX_WAITING_SCANS: usize = 50;
/// Time without scans after which a warning is logged \[ns\].
const SCAN_TIMEOUT_NS: i64 = 2_000_000_000;
/// Interval of calls of the map service \[ns\].
const MAP_CALL_INTERVAL_NS: i64 = 1_000_000_000;

/// Code of the report that no scans arrive.
pub(crate) const NO_SCANS: &str = "no-scans";

/// Subscriptions of the node.
pub(crate) struct Inputs {
    scans: Mailbox<LaserScan>,
    map: Mailbox<OccupancyGrid>,
    map_client: Option<MapClient>,
    /// Scans with their time of arrival \[ns\], oldest first.
    waiting: VecDeque<(i64, Arc<LaserScan>)>,
    last_scan_ns: i64,
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
    fn robot(&self) -> Robot<'_> {
        Robot {
            odom: &self.odom,
            base: &self.base,
            odom_parameter: "odom_frame_id",
            base_parameter: "base_frame_id",
        }
    }
}

/// Scan with the transforms at its time.
pub(crate) struct Placed {
    pub(crate) message: Arc<LaserScan>,
    pub(crate) places: Places,
}

impl Inputs {
    pub(crate) fn new(node: &Node, values: &ParamValues) -> Result<Self, GraphError> {
        let text = |name: &str| values.text(name).unwrap_or_default();
        let uses_topic = values.flag("use_map_topic").unwrap_or(true);
        let client = (!uses_topic).then(|| node.client::<GetMap>("static_map")).transpose()?;
        Ok(Self {
            scans: node.mailbox(&text("scan_topic"), Qos::best_effort(MAX_WAITING_SCANS))?,
            map: node.mailbox(&text("map_topic"), Qos::latched(1))?,
            map_client: client.map(|client| MapClient { client, called_ns: None, pending: None }),
            waiting: VecDeque::new(),
            last_scan_ns: node.now_ns(),
        })
    }

    /// Drops all waiting scans.
    pub(crate) fn clear(&mut self, now_ns: i64) {
        self.waiting.clear();
        self.last_scan_ns = now_ns;
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

    /// Moves new scans to the queue.
    pub(crate) fn receive(&mut self, now_ns: i64) {
        for message in self.scans.drain() {
            self.waiting.push_back((now_ns, message));
            self.last_scan_ns = now_ns;
        }
        while self.waiting.len() > MAX_WAITING_SCANS {
            self.waiting.pop_front();
        }
    }

    /// Returns the oldest scan whose transforms are available. Scans that waited too long are
    /// dropped and reported.
    pub(crate) fn next(
        &mut self,
        frames: &Frames,
        names: &FrameNames,
        now_ns: i64,
        reports: &mut Vec<Diagnostic>,
    ) -> Option<Placed> {
        loop {
            let (received_ns, message) = self.waiting.front()?;
            match places(message, frames, &names.robot()) {
                Ok(places) => {
                    let message = message.clone();
                    self.waiting.pop_front();
                    return Some(Placed { message, places });
                }
                Err(_) if now_ns - received_ns <= TRANSFORM_TIMEOUT_NS => return None,
                Err(lack) => {
                    reports.push(lack.told(&message.header.frame_id, frames, &names.robot()));
                    self.waiting.pop_front();
                }
            }
        }
    }

    /// Report that no scans arrive, with the likely cause.
    pub(crate) fn missing_scans(&self, node: &Node) -> Option<Diagnostic> {
        let elapsed_ns = node.now_ns() - self.last_scan_ns;
        if elapsed_ns < SCAN_TIMEOUT_NS {
            return None;
        }
        let topic = self.scans.topic();
        let info = node.graph().topics().into_iter().find(|it| it.name == topic);
        let own = node.full_name();
        let help = match info {
            Some(info) if info.publishers.is_empty() => {
                format!("`{topic}` has no publisher: start the scanner, or set `scan_topic`")
            }
            Some(info) if info.mismatches.iter().any(|it| it.subscription == own) => {
                format!("the QoS of the publisher of `{topic}` is incompatible")
            }
            _ => format!("the publisher of `{topic}` sends nothing"),
        };
        let elapsed_s = elapsed_ns as f64 * 1e-9;
        let message = format!("no scan received on `{topic}` for {elapsed_s:.0} s");
        Some(Diagnostic::error(NO_SCANS, message).help(help))
    }
}
