//! Errors and warnings of the log.

use std::collections::BTreeMap;
use std::sync::Arc;

use periplus_bags::BagTopic;
use periplus_msgs::{DynamicMessage, Format, Layout, Number, Value};

use super::{Mark, MarkKind};

/// Types of log messages, with the levels of warnings and errors.
const TYPES: [(&str, f64, f64); 3] = [
    ("rcl_interfaces/msg/Log", 30.0, 40.0),
    // ROS 1: levels are bits.
    ("rosgraph_msgs/msg/Log", 4.0, 8.0),
    ("rosgraph_msgs/Log", 4.0, 8.0),
];

/// Time in which similar lines are one mark \[ns\].
const MERGE_NS: i64 = 1_000_000_000;

/// Maximum number of lines that are compared with new ones.
const MAX_RECENT: usize = 256;

/// Phrases of rclcpp, rclpy and this program for endpoints with incompatible QoS.
const QOS_PHRASES: [&str; 2] = ["incompatible QoS", "incompatible qos"];

/// Log lines of a topic.
pub(in super::super) struct LogMarks {
    layout: Arc<Layout>,
    warning: f64,
    error: f64,
    /// Time of the last mark of each logger and text.
    recent: BTreeMap<(String, String), i64>,
}

impl LogMarks {
    pub(super) fn new(topic: &BagTopic) -> Option<Self> {
        let (_, warning, error) = TYPES.into_iter().find(|(name, ..)| *name == topic.type_name)?;
        Some(Self { layout: topic.layout()?, warning, error, recent: BTreeMap::new() })
    }

    pub(super) fn detect(&mut self, time_ns: i64, data: &[u8]) -> Vec<Mark> {
        let Ok(line) = DynamicMessage::decode(&self.layout, Format::CDR, data) else {
            return Vec::new();
        };
        let level = match line.get("level") {
            Some(Value::Number(Number::U8(level))) => f64::from(level),
            Some(Value::Number(Number::I8(level))) => f64::from(level),
            _ => return Vec::new(),
        };
        let text = |path: &str| match line.get(path) {
            Some(Value::Text(text)) => text,
            _ => String::new(),
        };
        if level < self.warning {
            return Vec::new();
        }
        let (name, message) = (text("name"), text("msg"));
        let kind = if QOS_PHRASES.iter().any(|phrase| message.contains(phrase)) {
            MarkKind::QosMismatch
        } else if level >= self.error {
            MarkKind::Error
        } else {
            MarkKind::Warning
        };
        // Numbers differ from line to line of the same message.
        let same: String = message.chars().filter(|c| !c.is_ascii_digit()).collect();
        let key = (name.clone(), same);
        let last_ns = self.recent.insert(key, time_ns);
        if self.recent.len() > MAX_RECENT {
            self.recent.retain(|_, last_ns| time_ns.saturating_sub(*last_ns) < MERGE_NS);
        }
        if self.recent.len() > MAX_RECENT {
            self.recent.clear();
        }
        if last_ns.is_some_and(|last_ns| time_ns.saturating_sub(last_ns) < MERGE_NS) {
            return Vec::new();
        }
        vec![Mark::new(time_ns, kind, format!("{name}: {message}"))]
    }
}

#[cfg(test)]
mod tests {
    use periplus_msgs::Message as _;
    use periplus_msgs::rcl_interfaces::Log;

    use super::*;

    fn detector() -> LogMarks {
        let topic = BagTopic {
            name: "/rosout".into(),
            type_name: Log::TYPE_NAME.into(),
            encoding: "cdr".into(),
            schema_encoding: "ros2msg".into(),
            schema: Log::schema_text().into(),
            metadata: BTreeMap::new(),
        };
        LogMarks::new(&topic).expect("a log")
    }

    fn line(level: u8, msg: &str) -> Vec<u8> {
        Log { level, name: "amcl".into(), msg: msg.into(), ..Log::default() }.to_cdr().unwrap()
    }

    #[test]
    fn warnings_errors_and_mismatches_are_marks() {
        let mut log = detector();
        assert_eq!(log.detect(1, &line(20, "fine")), []);
        let marks = log.detect(2, &line(30, "slow"));
        assert_eq!(marks, [Mark::new(2, MarkKind::Warning, "amcl: slow")]);
        assert_eq!(log.detect(3, &line(40, "no map"))[0].kind, MarkKind::Error);
        let qos = "offering incompatible QoS. Last incompatible policy: RELIABILITY";
        assert_eq!(log.detect(4, &line(30, qos))[0].kind, MarkKind::QosMismatch);
        assert_eq!(log.detect(5, &[0]), []);
    }

    #[test]
    fn similar_lines_of_a_second_are_one_mark() {
        let mut log = detector();
        assert_eq!(log.detect(0, &line(30, "late by 12 ms")).len(), 1);
        assert_eq!(log.detect(MERGE_NS / 2, &line(30, "late by 7 ms")).len(), 0);
        assert_eq!(log.detect(MERGE_NS, &line(30, "late by 7 ms")).len(), 0);
        assert_eq!(log.detect(2 * MERGE_NS, &line(30, "late by 7 ms")).len(), 1);
    }
}
