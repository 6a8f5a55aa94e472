//! Collection of messages with a header, transforms, and the clock.

use std::collections::BTreeMap;
use std::time::Duration;

use periplus_graph::{Mailbox, Node, Qos, RawMailbox, Sample};
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_tf::{TransformKind, TransformMonitor};

use super::observation::{ScanFacts, SystemObservation, TopicStatistics};
use crate::tf::stamped;
use crate::{Outcome, Seen};

/// Sensor message types that begin with a header.
const SENSOR_TYPES: [&str; 8] = [
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/PointCloud2",
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/Imu",
    "sensor_msgs/msg/Range",
    "sensor_msgs/msg/NavSatFix",
    "sensor_msgs/msg/MagneticField",
    "nav_msgs/msg/Odometry",
];

const SCAN_TYPE: &str = SENSOR_TYPES[0];

/// The broadcaster of a transform is unknown.
const AUTHORITY: &str = "";

/// Subscriptions to all relevant topics.
pub struct SystemObserver {
    moving: Mailbox<TFMessage>,
    fixed: Mailbox<TFMessage>,
    clock: Mailbox<Clock>,
    sensors: Vec<(String, RawMailbox)>,
    survey: TransformMonitor,
    heard: BTreeMap<String, TopicStatistics>,
    times_ns: Option<(i64, i64)>,
    clock_jumps: usize,
}

impl SystemObserver {
    /// Subscribes to the topics of a snapshot.
    ///
    /// # Errors
    /// When the graph refuses.
    pub fn open(node: &Node, seen: &Seen) -> Outcome<Self> {
        let mut sensors = Vec::new();
        let mut heard = BTreeMap::new();
        for topic in seen.topics.iter().filter(|topic| !topic.publishers.is_empty()) {
            let Some(type_name) =
                topic.types.iter().find(|name| SENSOR_TYPES.contains(&name.as_str()))
            else {
                continue;
            };
            let hash = topic.publishers.iter().find_map(|end| end.type_hash.as_deref());
            let mailbox = node.raw_mailbox(&topic.name, type_name, hash, Qos::sensor_data())?;
            sensors.push((topic.name.clone(), mailbox));
            let empty =
                TopicStatistics { type_name: type_name.clone(), ..TopicStatistics::default() };
            heard.insert(topic.name.clone(), empty);
        }
        Ok(Self {
            moving: node.mailbox("/tf", Qos::reliable(100))?,
            fixed: node.mailbox("/tf_static", Qos::latched(100))?,
            clock: node.mailbox("/clock", Qos::sensor_data())?,
            sensors,
            survey: TransformMonitor::default(),
            heard,
            times_ns: None,
            clock_jumps: 0,
        })
    }

    /// Processes messages received since the last call.
    pub fn hear(&mut self) {
        let fixed = self.fixed.drain().into_iter().map(|message| (message, TransformKind::Fixed));
        let moving =
            self.moving.drain().into_iter().map(|message| (message, TransformKind::Moving));
        for (message, kind) in fixed.chain(moving) {
            for transform in &message.transforms {
                // Refused transforms are counted by the survey.
                let _ = self.survey.insert(&stamped(transform), AUTHORITY, kind);
            }
        }
        for message in self.clock.drain() {
            let now_ns = message.clock.ns();
            let (first_ns, last_ns) = self.times_ns.unwrap_or((now_ns, now_ns));
            self.clock_jumps += usize::from(now_ns < last_ns);
            self.times_ns = Some((first_ns, now_ns));
        }
        for (topic, mailbox) in &self.sensors {
            let heard = self.heard.entry(topic.clone()).or_default();
            for sample in mailbox.drain() {
                take(heard, &sample);
            }
        }
    }

    /// Returns all collected data, with a snapshot of the graph.
    #[must_use]
    pub fn observation(
        self,
        seen: Seen,
        simulated: BTreeMap<String, bool>,
        time: Duration,
    ) -> SystemObservation {
        SystemObservation {
            seen,
            time,
            survey: self.survey,
            heard: self.heard,
            clock: self.times_ns,
            clock_jumps: self.clock_jumps,
            simulated,
            is_alone: false,
            network_settings: None,
        }
    }
}

fn take(heard: &mut TopicStatistics, sample: &Sample) {
    if heard.count == 0 {
        heard.arrived_ns.0 = sample.time_ns;
    }
    heard.arrived_ns.1 = sample.time_ns;
    heard.count += 1;
    if let Some((stamp_ns, frame)) = sample.cdr().ok().and_then(header) {
        heard.stamp_ns = heard.stamp_ns.max(stamp_ns);
        heard.frames.insert(frame);
    }
    if heard.type_name == SCAN_TYPE
        && let Ok(scan) = sample.message::<LaserScan>()
    {
        count(heard.scans.get_or_insert_default(), &scan);
        let period_s = f64::from(scan.scan_time);
        heard.wanted_hz = (period_s > 0.0).then(|| 1.0 / period_s);
    }
}

fn count(facts: &mut ScanFacts, scan: &LaserScan) {
    for &range in &scan.ranges {
        facts.readings += 1;
        let counter = if range.is_nan() {
            &mut facts.nan
        } else if range == 0.0 {
            &mut facts.zero
        } else if range >= scan.range_max {
            &mut facts.far
        } else if range <= scan.range_min {
            &mut facts.near
        } else {
            &mut facts.good
        };
        *counter += 1;
    }
}

/// Stamp \[ns\] and frame of a message that begins with a `std_msgs/msg/Header`: four bytes of
/// encapsulation, seconds, nanoseconds, length and text with a terminating zero.
fn header(cdr: &[u8]) -> Option<(i64, String)> {
    let is_little = cdr.get(1)? & 1 == 1;
    let word = |at: usize| -> Option<u32> {
        let bytes: [u8; 4] = cdr.get(at..at + 4)?.try_into().ok()?;
        Some(if is_little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) })
    };
    let (seconds, rest_ns, length) = (word(4)?.cast_signed(), word(8)?, word(12)? as usize);
    let text = cdr.get(16..16_usize.checked_add(length)?)?;
    let text = text.strip_suffix(&[0]).unwrap_or(text);
    let stamp_ns = i64::from(seconds) * 1_000_000_000 + i64::from(rest_ns);
    Some((stamp_ns, String::from_utf8_lossy(text).into_owned()))
}

#[test]
fn a_header_is_found_in_bytes() {
    let bytes = [0, 1, 0, 0, 7, 0, 0, 0, 5, 0, 0, 0, 4, 0, 0, 0, b'o', b'd', b'm', 0, 9];
    assert_eq!(header(&bytes), Some((7_000_000_005, "odm".to_owned())));
    assert_eq!(header(&bytes[..18]), None);
}
