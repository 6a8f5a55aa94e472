//! Scans, which wait for their transforms.

use std::collections::VecDeque;
use std::sync::Arc;

use periplus_diagnostics::Diagnostic;
use periplus_graph::{GraphError, Mailbox, Node, Qos, TopicInfo};
use periplus_msgs::Message as _;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_params::ParamValues;
use periplus_tf_ros::{Frames, Places, Robot, places};

use crate::slam_toolbox::values::integer;

/// Maximum wait for the transforms of a scan \[ns\].
const PATIENCE_NS: i64 = 1_000_000_000;
/// Scans that wait for their turn.
const QUEUE: usize = 200;
/// Scans that wait for transforms where the newest one counts: transforms come a little later than the
/// scans they are for, and a queue of one would be full for ever.
const FEW: usize = 10;
/// Time without scans before a warning \[ns\].
const SILENCE_NS: i64 = 2_000_000_000;

/// The topic of scans, and those that wait.
pub(crate) struct Inputs {
    scans: Mailbox<LaserScan>,
    /// When they came \[ns\], oldest first.
    waiting: VecDeque<(i64, Arc<LaserScan>)>,
    most: usize,
    /// True if the newest usable scan counts and older ones are skipped.
    is_newest_first: bool,
    last_scan_ns: i64,
    /// Scans that were left out for a newer one, and that never got their transforms.
    pub(crate) left_out: u64,
    pub(crate) dropped: u64,
}

/// Frames of the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Names {
    pub(crate) map: String,
    pub(crate) odom: String,
    pub(crate) base: String,
}

impl Names {
    fn robot(&self) -> Robot<'_> {
        Robot {
            odom: &self.odom,
            base: &self.base,
            odom_parameter: "odom_frame",
            base_parameter: "base_frame",
        }
    }
}

/// A scan with where everything was at its time.
pub(crate) struct Placed {
    pub(crate) message: Arc<LaserScan>,
    pub(crate) places: Places,
}

impl Inputs {
    pub(crate) fn new(
        node: &Node,
        topic: &str,
        values: &ParamValues,
        is_newest_first: bool,
    ) -> Result<Self, GraphError> {
        let asked = integer(values, "scan_queue_size").and_then(|size| usize::try_from(size).ok());
        let most = asked.unwrap_or(1).max(if is_newest_first { FEW } else { QUEUE });
        Ok(Self {
            scans: node.mailbox(topic, Qos::best_effort(most))?,
            waiting: VecDeque::new(),
            most,
            is_newest_first,
            last_scan_ns: node.now_ns(),
            left_out: 0,
            dropped: 0,
        })
    }

    /// Drops the queued scans.
    pub(crate) fn forget(&mut self, now_ns: i64) {
        let _ = self.scans.drain();
        self.waiting.clear();
        self.last_scan_ns = now_ns;
    }

    /// Takes in scans that have come.
    pub(crate) fn listen(&mut self, now_ns: i64) {
        for message in self.scans.drain() {
            self.waiting.push_back((now_ns, message));
            self.last_scan_ns = now_ns;
        }
        while self.waiting.len() > self.most {
            self.waiting.pop_front();
            self.left_out += 1;
        }
    }

    /// Returns the next scan with available transforms. Drops those that waited too long, with the reason.
    pub(crate) fn next(
        &mut self,
        frames: &Frames,
        names: &Names,
        now_ns: i64,
        complaints: &mut Vec<Diagnostic>,
    ) -> Option<Placed> {
        let ready = |(at, (_, message)): (usize, &(i64, Arc<LaserScan>))| {
            let places = places(message, frames, &names.robot()).ok()?;
            Some((at, Placed { message: message.clone(), places }))
        };
        let mut waiting = self.waiting.iter().enumerate();
        let found = if self.is_newest_first {
            waiting.rev().find_map(ready)
        } else {
            waiting.find_map(ready)
        };
        if let Some((at, placed)) = found {
            // Transforms arrive in order: a skipped scan never gets its own.
            *(if self.is_newest_first { &mut self.left_out } else { &mut self.dropped }) +=
                at as u64;
            self.waiting.drain(..=at);
            return Some(placed);
        }
        while let Some((came_ns, message)) = self.waiting.front()
            && now_ns - came_ns > PATIENCE_NS
        {
            if let Err(lack) = places(message, frames, &names.robot()) {
                complaints.push(lack.told(&message.header.frame_id, frames, &names.robot()));
            }
            self.waiting.pop_front();
            self.dropped += 1;
        }
        None
    }

    /// Returns the diagnostic for missing scans.
    pub(crate) fn silence(&self, node: &Node) -> Option<Diagnostic> {
        let silent_ns = node.now_ns() - self.last_scan_ns;
        if silent_ns < SILENCE_NS {
            return None;
        }
        let topic = self.scans.topic();
        let others = scan_topics(node, topic);
        let info = node.graph().topics().into_iter().find(|it| it.name == topic);
        let own = node.full_name();
        let help = match info {
            Some(info) if info.publishers.is_empty() && !others.is_empty() => {
                let topics = others.join("`, `");
                format!("there are scans on `{topics}`: set `scan_topic` to one of these")
            }
            Some(info) if info.publishers.is_empty() => {
                format!("no node publishes `{topic}`: start the scanner, or set `scan_topic`")
            }
            Some(info) if info.mismatches.iter().any(|it| it.subscription == own) => {
                format!("the QoS of the publishers of `{topic}` is incompatible")
            }
            _ => format!("the publishers of `{topic}` send nothing"),
        };
        let silent_s = silent_ns as f64 * 1e-9;
        let words = format!("no scan has come on `{topic}` for {silent_s:.0} s");
        Some(Diagnostic::error("no-scans", words).help(help))
    }
}

/// Topics on which others publish scans, but one.
fn scan_topics(node: &Node, but: &str) -> Vec<String> {
    let of_scans = |it: &TopicInfo| {
        it.type_name == LaserScan::TYPE_NAME
            && it.publishers.iter().any(|publisher| publisher.node != node.full_name())
            && it.name != but
    };
    node.graph().topics().into_iter().filter(of_scans).map(|it| it.name).collect()
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::Diagnostics;
    use periplus_graph::{Graph, NodeSettings};
    use periplus_msgs::builtin_interfaces::Time;
    use periplus_msgs::geometry_msgs::{Quaternion, TransformStamped};
    use periplus_msgs::std_msgs::Header;
    use periplus_msgs::tf2_msgs::TFMessage;
    use periplus_slam::tables::SLAM_TOOLBOX;
    use periplus_tf::TransformKind;

    use super::*;

    fn transform(parent: &str, child: &str, sec: i32) -> TFMessage {
        let mut one = TransformStamped {
            header: Header { stamp: Time { sec, nanosec: 0 }, frame_id: parent.into() },
            child_frame_id: child.into(),
            ..TransformStamped::default()
        };
        one.transform.rotation = Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 };
        TFMessage { transforms: vec![one] }
    }

    /// Scans of seconds 1 to 4; transforms up to second 3. Gives the seconds of those that are used.
    fn used(is_newest_first: bool) -> Result<(Vec<i32>, u64), GraphError> {
        let graph = Graph::new();
        let node = graph.node(NodeSettings::new("slam"))?;
        let values = SLAM_TOOLBOX.check([], None, &mut Diagnostics::new());
        let mut inputs = Inputs::new(&node, "scan", &values, is_newest_first)?;
        let scans = node.publisher::<LaserScan>("scan", Qos::sensor_data())?;
        for sec in 1..=4 {
            let header = Header { stamp: Time { sec, nanosec: 0 }, frame_id: "laser".into() };
            scans.publish(LaserScan { header, ..LaserScan::default() });
        }
        let mut frames = Frames::default();
        frames.take(&transform("base", "laser", 1), TransformKind::Fixed);
        for sec in 1..=3 {
            frames.take(&transform("odom", "base", sec), TransformKind::Moving);
        }
        let names = Names { map: "map".into(), odom: "odom".into(), base: "base".into() };
        inputs.listen(0);
        let mut used = Vec::new();
        while let Some(placed) = inputs.next(&frames, &names, 0, &mut Vec::new()) {
            used.push(placed.message.header.stamp.sec);
        }
        Ok((used, inputs.left_out))
    }

    #[test]
    fn in_live_the_newest_scan_that_can_be_used_counts() -> Result<(), GraphError> {
        assert_eq!(used(false)?, (vec![1, 2, 3], 0));
        assert_eq!(used(true)?, (vec![3], 2));
        Ok(())
    }
}
