//! Subscription to scans that wait for their transforms.

use std::sync::Arc;

use periplus_diagnostics::Diagnostic;
use periplus_graph::{GraphError, Mailbox, Node, Qos, TopicInfo};
use periplus_msgs::Message as _;
use periplus_msgs::sensor_msgs::LaserScan;

use crate::Frames;
use crate::message_filter::{FilterSettings, MessageFilter};
use crate::scans::{RobotFrames, ScanTransforms, scan_transforms};

/// Time after arrival at which a scan without transforms is dropped \[ns\].
pub const SCAN_TRANSFORM_TIMEOUT_NS: i64 = 1_000_000_000;

/// Time without scans after which their absence is reported \[ns\].
const SILENCE_TIMEOUT_NS: i64 = 2_000_000_000;

/// Code of the report that no scans arrive.
pub const NO_SCANS: &str = "no-scans";

/// Scan with the transforms of its stamp.
pub struct TransformedScan {
    /// The scan.
    pub message: Arc<LaserScan>,
    /// Transforms of its stamp.
    pub transforms: ScanTransforms,
}

/// Subscription to a topic of scans, and the queue in which they wait for their transforms.
pub struct ScanQueue {
    scans: Mailbox<LaserScan>,
    filter: MessageFilter<LaserScan>,
    last_scan_ns: i64,
}

impl ScanQueue {
    /// Subscribes to a topic.
    ///
    /// # Errors
    /// When the name is not valid or the topic has another type.
    pub fn new(node: &Node, topic: &str, settings: FilterSettings) -> Result<Self, GraphError> {
        Ok(Self {
            scans: node.mailbox(topic, Qos::best_effort(settings.max_waiting))?,
            filter: MessageFilter::new(settings),
            last_scan_ns: node.now_ns(),
        })
    }

    /// Drops all scans that have arrived.
    pub fn clear(&mut self, now_ns: i64) {
        let _ = self.scans.drain();
        self.filter.clear();
        self.last_scan_ns = now_ns;
    }

    /// Adds the scans that have arrived since the last call.
    pub fn receive(&mut self, now_ns: i64) {
        for message in self.scans.drain() {
            self.last_scan_ns = now_ns;
            let _superseded = self.filter.push(now_ns, message);
        }
    }

    /// Returns the next scan whose transforms are available. A scan that waited too long is dropped,
    /// with its reason in `findings`.
    pub fn next(
        &mut self,
        frames: &Frames,
        robot: &RobotFrames<'_>,
        now_ns: i64,
        findings: &mut Vec<Diagnostic>,
    ) -> Option<TransformedScan> {
        let found = self.filter.next(
            now_ns,
            |message| scan_transforms(message, frames, robot),
            |message, missing| {
                findings.push(missing.finding(&message.header.frame_id, frames, robot));
            },
        );
        found.map(|(message, transforms)| TransformedScan { message, transforms })
    }

    /// Number of scans that were dropped for newer ones.
    #[must_use]
    pub fn superseded(&self) -> u64 {
        self.filter.superseded()
    }

    /// Number of scans that were dropped because a transform was missing.
    #[must_use]
    pub fn without_transforms(&self) -> u64 {
        self.filter.without_transforms()
    }

    /// Report that no scans have arrived for a time, with the likely cause.
    #[must_use]
    pub fn silence(&self, node: &Node) -> Option<Diagnostic> {
        let silent_ns = node.now_ns() - self.last_scan_ns;
        if silent_ns < SILENCE_TIMEOUT_NS {
            return None;
        }
        let topic = self.scans.topic();
        let others = other_scan_topics(node, topic);
        let info = node.graph().topics().into_iter().find(|it| it.name == topic);
        let own = node.full_name();
        let help = match info {
            Some(info) if info.publishers.is_empty() && !others.is_empty() => {
                let topics = others.join("`, `");
                format!("there are scans on `{topics}`: set `scan_topic` to one of these")
            }
            Some(info) if info.publishers.is_empty() => {
                format!("`{topic}` has no publisher: start the scanner, or set `scan_topic`")
            }
            Some(info) if info.mismatches.iter().any(|it| it.subscription == own) => {
                format!("the QoS of the publisher of `{topic}` is incompatible")
            }
            _ => format!("the publisher of `{topic}` sends nothing"),
        };
        let silent_s = silent_ns as f64 * 1e-9;
        let message = format!("no scan received on `{topic}` for {silent_s:.0} s");
        Some(Diagnostic::error(NO_SCANS, message).help(help))
    }
}

/// Topics with scans of other nodes, except one.
fn other_scan_topics(node: &Node, except: &str) -> Vec<String> {
    let has_scans = |it: &TopicInfo| {
        it.type_name == LaserScan::TYPE_NAME
            && it.publishers.iter().any(|publisher| publisher.node != node.full_name())
            && it.name != except
    };
    node.graph().topics().into_iter().filter(has_scans).map(|it| it.name).collect()
}

#[cfg(test)]
mod tests {
    use periplus_graph::{Graph, NodeSettings, Publisher};
    use periplus_msgs::builtin_interfaces::Time;
    use periplus_msgs::std_msgs::Header;
    use periplus_tf::TransformKind;

    use super::*;
    use crate::message_filter::FilterOrder;
    use crate::transform;

    const SECOND_NS: i64 = 1_000_000_000;
    const ROBOT: RobotFrames<'static> = RobotFrames {
        odom: "odom",
        base: "base",
        odom_parameter: "odom_frame",
        base_parameter: "base_frame",
    };

    struct Stage {
        node: Node,
        scans: Publisher<LaserScan>,
        queue: ScanQueue,
        frames: Frames,
        findings: Vec<Diagnostic>,
    }

    /// A scanner with its mounting, and odometry until a second.
    fn stage(order: FilterOrder, odometry_until_s: i64) -> Result<Stage, GraphError> {
        let node = Graph::new().node(NodeSettings::new("slam"))?;
        let timeout_ns = SCAN_TRANSFORM_TIMEOUT_NS;
        let settings = FilterSettings { max_waiting: 10, timeout_ns, order };
        let queue = ScanQueue::new(&node, "scan", settings)?;
        let scans = node.publisher::<LaserScan>("scan", Qos::sensor_data())?;
        let mut frames = Frames::default();
        let identity = periplus_geometry::Pose2::IDENTITY;
        frames.take(&transform("base", "laser", identity, SECOND_NS), TransformKind::Fixed);
        for time_s in 1..=odometry_until_s {
            let odometry = transform("odom", "base", identity, time_s * SECOND_NS);
            frames.take(&odometry, TransformKind::Moving);
        }
        Ok(Stage { node, scans, queue, frames, findings: Vec::new() })
    }

    impl Stage {
        fn publish(&self, times_s: std::ops::RangeInclusive<i32>) {
            for sec in times_s {
                let header = Header { stamp: Time { sec, nanosec: 0 }, frame_id: "laser".into() };
                self.scans.publish(LaserScan { header, ..LaserScan::default() });
            }
        }

        /// Seconds of the scans that are passed on.
        fn passed(&mut self, now_ns: i64) -> Vec<i32> {
            self.queue.receive(now_ns);
            let mut passed = Vec::new();
            while let Some(scan) = self.queue.next(&self.frames, &ROBOT, now_ns, &mut self.findings)
            {
                passed.push(scan.message.header.stamp.sec);
            }
            passed
        }
    }

    #[test]
    fn the_newest_usable_scan_counts_when_live() -> Result<(), GraphError> {
        for (order, passed, superseded) in
            [(FilterOrder::OldestReady, vec![1, 2, 3], 0), (FilterOrder::NewestReady, vec![3], 2)]
        {
            let mut stage = stage(order, 3)?;
            stage.publish(1..=4);
            assert_eq!(stage.passed(0), passed);
            assert_eq!(stage.queue.superseded(), superseded);
        }
        Ok(())
    }

    #[test]
    fn the_reason_of_a_dropped_scan_is_reported() -> Result<(), GraphError> {
        let mut stage = stage(FilterOrder::InOrder, 2)?;
        stage.publish(2..=3);
        assert_eq!(stage.passed(0), [2]);
        assert_eq!(stage.findings, [], "its odometry may still arrive");
        assert!(stage.passed(SCAN_TRANSFORM_TIMEOUT_NS + 1).is_empty());
        assert_eq!(stage.queue.without_transforms(), 1);
        let finding = &stage.findings[0];
        assert_eq!(finding.code, "no-odometry");
        assert!(finding.message.contains("no transform from `base` to `odom`"), "{finding:?}");
        assert!(finding.help[0].contains("`odom_frame` and `base_frame`"), "{finding:?}");
        Ok(())
    }

    #[test]
    fn a_cleared_queue_forgets_scans_that_were_not_yet_received() -> Result<(), GraphError> {
        let mut stage = stage(FilterOrder::InOrder, 3)?;
        stage.publish(1..=1);
        stage.queue.receive(0);
        stage.publish(2..=2);
        stage.queue.clear(0);
        stage.publish(3..=3);
        assert_eq!(stage.passed(0), [3]);
        Ok(())
    }

    #[test]
    fn silence_is_reported_with_the_topics_that_have_scans() -> Result<(), GraphError> {
        let Stage { node, queue, scans, .. } = stage(FilterOrder::InOrder, 0)?;
        let graph = node.graph();
        assert_eq!(queue.silence(&node), None);
        graph.advance_to(SILENCE_TIMEOUT_NS);
        let help = |queue: &ScanQueue| queue.silence(&node).map(|it| it.help[0].clone());
        assert_eq!(help(&queue).as_deref(), Some("the publisher of `/scan` sends nothing"));
        drop(scans);
        let start = "`/scan` has no publisher: start the scanner, or set `scan_topic`";
        assert_eq!(help(&queue).as_deref(), Some(start));
        let other = graph.node(NodeSettings::new("lidar"))?;
        let _front = other.publisher::<LaserScan>("front_scan", Qos::sensor_data())?;
        let set = "there are scans on `/front_scan`: set `scan_topic` to one of these";
        assert_eq!(help(&queue).as_deref(), Some(set));
        Ok(())
    }
}
