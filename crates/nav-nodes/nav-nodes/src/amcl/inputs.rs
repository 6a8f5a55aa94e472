//! What is heard: scans, which wait for their transforms, and maps.

use std::collections::VecDeque;
use std::sync::Arc;

use periplus_diagnostics::Diagnostic;
use periplus_graph::{Client, GraphError, Mailbox, Node, Pending, Qos};
use periplus_msgs::nav_msgs::{GetMap, GetMapRequest, OccupancyGrid};
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_params::ParamValues;
use periplus_tf_ros::{Frames, Places, Robot, places};

/// A scan whose transforms do not come is dropped after so long \[ns\].
const PATIENCE_NS: i64 = 1_000_000_000;
/// Most scans that wait.
const MOST_WAITING: usize = 50;
/// No scan for so long is told \[ns\].
const SILENCE_NS: i64 = 2_000_000_000;
/// How often a map is asked for by service \[ns\].
const ASK_NS: i64 = 1_000_000_000;

/// What is said when no scans come.
pub(crate) const NO_SCANS: &str = "no-scans";

/// Topics that are heard.
pub(crate) struct Inputs {
    scans: Mailbox<LaserScan>,
    map: Mailbox<OccupancyGrid>,
    asks: Option<Asks>,
    /// When they came \[ns\], oldest first.
    waiting: VecDeque<(i64, Arc<LaserScan>)>,
    last_scan_ns: i64,
}

/// The map by service, as in ROS 1.
struct Asks {
    client: Client<GetMap>,
    asked_ns: Option<i64>,
    pending: Option<Pending<GetMap>>,
}

/// Frames of the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Names {
    pub(crate) odom: String,
    pub(crate) base: String,
}

impl Names {
    fn robot(&self) -> Robot<'_> {
        Robot {
            odom: &self.odom,
            base: &self.base,
            odom_parameter: "odom_frame_id",
            base_parameter: "base_frame_id",
        }
    }
}

/// A scan with where everything was at its time.
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
            scans: node.mailbox(&text("scan_topic"), Qos::best_effort(MOST_WAITING))?,
            map: node.mailbox(&text("map_topic"), Qos::latched(1))?,
            asks: client.map(|client| Asks { client, asked_ns: None, pending: None }),
            waiting: VecDeque::new(),
            last_scan_ns: node.now_ns(),
        })
    }

    /// What waits counts no longer.
    pub(crate) fn forget(&mut self, now_ns: i64) {
        self.waiting.clear();
        self.last_scan_ns = now_ns;
    }

    /// A map that has come.
    pub(crate) fn map(&mut self, now_ns: i64) -> Option<Arc<OccupancyGrid>> {
        if let Some(map) = self.map.latest() {
            return Some(map);
        }
        let asks = self.asks.as_mut()?;
        if let Some(answer) = asks.pending.as_ref().and_then(Pending::take) {
            asks.pending = None;
            if let Ok(answer) = answer
                && !answer.map.data.is_empty()
            {
                self.asks = None;
                return Some(Arc::new(answer.map.clone()));
            }
        }
        let is_due = asks.asked_ns.is_none_or(|asked_ns| now_ns - asked_ns >= ASK_NS);
        if asks.pending.is_none() && is_due && asks.client.is_ready() {
            asks.asked_ns = Some(now_ns);
            asks.pending = Some(asks.client.call(GetMapRequest::default()));
        }
        None
    }

    /// Where a map is waited for, in words.
    pub(crate) fn map_source(&self) -> String {
        match &self.asks {
            Some(asks) => format!("from the service `{}`", asks.client.name()),
            None => format!("on `{}`", self.map.topic()),
        }
    }

    /// Takes in scans that have come.
    pub(crate) fn listen(&mut self, now_ns: i64) {
        for message in self.scans.drain() {
            self.waiting.push_back((now_ns, message));
            self.last_scan_ns = now_ns;
        }
        while self.waiting.len() > MOST_WAITING {
            self.waiting.pop_front();
        }
    }

    /// The oldest scan whose transforms are there. Those that waited too long are dropped; why is
    /// told.
    pub(crate) fn next(
        &mut self,
        frames: &Frames,
        names: &Names,
        now_ns: i64,
        complaints: &mut Vec<Diagnostic>,
    ) -> Option<Placed> {
        loop {
            let (came_ns, message) = self.waiting.front()?;
            match places(message, frames, &names.robot()) {
                Ok(places) => {
                    let message = message.clone();
                    self.waiting.pop_front();
                    return Some(Placed { message, places });
                }
                Err(_) if now_ns - came_ns <= PATIENCE_NS => return None,
                Err(lack) => {
                    complaints.push(lack.told(&message.header.frame_id, frames, &names.robot()));
                    self.waiting.pop_front();
                }
            }
        }
    }

    /// What to say when no scans come.
    pub(crate) fn silence(&self, node: &Node) -> Option<Diagnostic> {
        let silent_ns = node.now_ns() - self.last_scan_ns;
        if silent_ns < SILENCE_NS {
            return None;
        }
        let topic = self.scans.topic();
        let info = node.graph().topics().into_iter().find(|it| it.name == topic);
        let own = node.full_name();
        let help = match info {
            Some(info) if info.publishers.is_empty() => {
                format!("nobody publishes `{topic}`: start the scanner, or set `scan_topic`")
            }
            Some(info) if info.mismatches.iter().any(|it| it.subscription == own) => {
                format!("the QoS of who publishes `{topic}` does not fit")
            }
            _ => format!("who publishes `{topic}` is silent"),
        };
        let silent_s = silent_ns as f64 * 1e-9;
        let words = format!("no scan has come on `{topic}` for {silent_s:.0} s");
        Some(Diagnostic::error(NO_SCANS, words).help(help))
    }
}
