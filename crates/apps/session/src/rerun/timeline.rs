//! Time of a rerun: that of the recording, or that of the stamps.
//!
//! A recording of a simulation may have been written with the time of the machine, while stamps are simulated time. Nodes
//! compare stamps with their clock, so that theirs then is that of the stamps; results are recorded at the time of the message
//! from which they come.

use periplus_bags::files::Bag;
use periplus_bags::{BagTopic, Selection, Target, Translation};
use periplus_diagnostics::Diagnostics;
use periplus_msgs::Message as _;
use periplus_msgs::tf2_msgs::TFMessage;

use super::error::RerunError;
use super::robot::RecordedRobot;
use crate::recorded::has_type;

/// Difference of stamp and time of recording above which they are different clocks \[ns\].
const MAX_DELAY_NS: i64 = 5_000_000_000;

/// Types whose messages begin with a header.
const STAMPED_TYPES: [&str; 5] = ["LaserScan", "PointCloud2", "Odometry", "Imu", "Range"];

/// Clock of a rerun.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RerunClock {
    /// The time of recording.
    Log,
    /// The stamps of the messages.
    Stamps,
}

/// Span of a recording and its clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Timeline {
    pub(super) clock: RerunClock,
    /// Time of recording of the first and last message \[ns\].
    pub(super) span_ns: (i64, i64),
    /// Time of the first scan or transform on the clock \[ns\].
    first_ns: i64,
}

impl Timeline {
    pub(super) fn of(bag: &Bag, robot: &RecordedRobot) -> Result<Self, RerunError> {
        let span_ns = bag
            .span_ns()
            .ok_or_else(|| RerunError::Missing("the recording has no messages".to_owned()))?;
        let Some((log_ns, stamp_ns)) = first_stamp(bag, robot)? else {
            return Ok(Self { clock: RerunClock::Log, span_ns, first_ns: span_ns.0 });
        };
        if log_ns.abs_diff(stamp_ns) <= MAX_DELAY_NS.unsigned_abs() {
            return Ok(Self { clock: RerunClock::Log, span_ns, first_ns: span_ns.0 });
        }
        Ok(Self { clock: RerunClock::Stamps, span_ns, first_ns: stamp_ns })
    }

    /// Returns the time at which the nodes start \[ns\].
    pub(super) fn start_ns(self) -> i64 {
        self.first_ns
    }

    /// Returns the part of the recording before a time of recording, 0 to 1.
    #[expect(clippy::cast_precision_loss, reason = "a part of a span needs few digits")]
    pub(super) fn part(self, log_ns: i64) -> f32 {
        let (from, to) = self.span_ns;
        let span = to.saturating_sub(from).max(1) as f32;
        (log_ns.saturating_sub(from) as f32 / span).clamp(0.0, 1.0)
    }
}

/// Returns time of recording and stamp of the first scan, or else of the first transform.
fn first_stamp(bag: &Bag, robot: &RecordedRobot) -> Result<Option<(i64, i64)>, RerunError> {
    let topics = bag.topics();
    let scan = topics.iter().find(|topic| topic.name == robot.scan_topic);
    let moving = topics.iter().find(|topic| {
        (has_type(topic, "TFMessage") || has_type(topic, "tfMessage"))
            && !topic.name.ends_with("tf_static")
    });
    let Some(topic) = scan.or(moving) else { return Ok(None) };
    let Some(mut translation) = Translation::new(topic, Target::Ros2, &mut Diagnostics::new())
    else {
        return Ok(None);
    };
    let mut messages = bag.messages(Selection::topics([topic.name.as_str()]));
    while let Some(message) = messages.next().map_err(RerunError::Recording)? {
        let Ok(data) = translation.translate(message.data) else { continue };
        if let Some(stamp_ns) = stamp_of(topic, data) {
            return Ok(Some((message.log_ns, stamp_ns)));
        }
    }
    Ok(None)
}

/// Returns the stamp of a message in CDR; of several transforms the newest.
pub(super) fn stamp_of(topic: &BagTopic, data: &[u8]) -> Option<i64> {
    if has_type(topic, "TFMessage") || has_type(topic, "tfMessage") {
        let message = TFMessage::decode_cdr(data).ok()?;
        return message.transforms.iter().map(|it| it.header.stamp.ns()).max();
    }
    if !STAMPED_TYPES.iter().any(|name| has_type(topic, name)) {
        return None;
    }
    // Encapsulation, seconds, nanoseconds.
    let word = |at: usize| -> Option<[u8; 4]> { data.get(at..at + 4)?.try_into().ok() };
    let is_little = data.get(1)? & 1 == 1;
    let (seconds, nanoseconds) = if is_little {
        (i32::from_le_bytes(word(4)?), u32::from_le_bytes(word(8)?))
    } else {
        (i32::from_be_bytes(word(4)?), u32::from_be_bytes(word(8)?))
    };
    Some(i64::from(seconds) * 1_000_000_000 + i64::from(nanoseconds))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use periplus_msgs::sensor_msgs::LaserScan;
    use periplus_msgs::std_msgs::Header;

    use super::*;

    #[test]
    fn the_stamp_is_read_from_the_first_bytes() {
        let header = Header::at(12_000_000_034, "laser");
        let scan = LaserScan { header, ..LaserScan::default() }.to_cdr().unwrap();
        let topic = BagTopic {
            name: "/scan".into(),
            type_name: LaserScan::TYPE_NAME.into(),
            encoding: "cdr".into(),
            schema_encoding: String::new(),
            schema: Vec::new(),
            metadata: BTreeMap::new(),
        };
        assert_eq!(stamp_of(&topic, &scan), Some(12_000_000_034));
        assert_eq!(stamp_of(&topic, &scan[..7]), None);
    }
}
