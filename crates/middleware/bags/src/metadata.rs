//! `metadata.yaml`: description of a bag, as written by rosbag2.

mod read;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::QosProfile;
use crate::qos;

pub(crate) use read::embedded_custom_data;
pub use read::{Metadata, read_metadata};

/// Version of the metadata. The messages are the same in all versions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Version 5: policies as numbers, for ROS 2 Humble and later.
    Humble,
    /// Version 9: policies as names, for ROS 2 Jazzy and later.
    #[default]
    Jazzy,
}

impl Style {
    /// Version number in `metadata.yaml`.
    #[must_use]
    pub fn version(self) -> u32 {
        match self {
            Self::Humble => 5,
            Self::Jazzy => 9,
        }
    }
}

/// Storage of the files of a bag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stored {
    /// `mcap` or `sqlite3`.
    pub storage: String,
    /// Compression format on top of the storage, such as `zstd`; usually empty.
    pub compression: String,
    /// Compression mode: `FILE`, `MESSAGE`; usually empty.
    pub compression_mode: String,
}

impl Default for Stored {
    /// MCAP without additional compression.
    fn default() -> Self {
        Self { storage: "mcap".into(), compression: String::new(), compression_mode: String::new() }
    }
}

/// Content of a bag.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BagInfo {
    /// Topics in the order of their first appearance.
    pub topics: Vec<TopicInformation>,
    /// Files in the order of their messages.
    pub files: Vec<FileInfo>,
    /// Name of the ROS distribution of the message definitions, such as `jazzy`; may be empty.
    pub ros_distro: String,
    /// Facts of the recorder by name, such as the world of a simulation; `custom_data` in ROS 2 Jazzy.
    pub custom_data: BTreeMap<String, String>,
}

/// A topic of a bag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TopicInformation {
    /// Full name, such as `/scan`.
    pub name: String,
    /// Full type name, such as `sensor_msgs/msg/LaserScan`.
    pub type_name: String,
    /// Type hash, such as `RIHS01_64c1...`; empty if unknown.
    pub type_hash: String,
    /// Encoding of the messages: `cdr`.
    pub encoding: String,
    /// QoS offered by each of its publishers.
    pub qos: Vec<QosProfile>,
    /// Number of messages.
    pub messages: u64,
}

/// A file of a bag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileInfo {
    /// File name relative to `metadata.yaml`.
    pub path: String,
    /// Times of the first and last message \[ns\]; none without messages.
    pub span_ns: Option<(i64, i64)>,
    /// Number of messages.
    pub messages: u64,
}

impl BagInfo {
    /// Number of messages.
    #[must_use]
    pub fn messages(&self) -> u64 {
        self.topics.iter().map(|topic| topic.messages).sum()
    }

    /// Times of the first and last message \[ns\]; none without messages.
    #[must_use]
    pub fn span_ns(&self) -> Option<(i64, i64)> {
        let spans = self.files.iter().filter_map(|file| file.span_ns);
        spans.reduce(|(start, end), (from, to)| (start.min(from), end.max(to)))
    }

    /// Formats `metadata.yaml` for MCAP files.
    #[must_use]
    pub fn to_yaml(&self, style: Style) -> String {
        self.to_yaml_for(style, &Stored::default())
    }

    /// Formats `metadata.yaml`.
    #[must_use]
    pub fn to_yaml_for(&self, style: Style, stored: &Stored) -> String {
        format!("rosbag2_bagfile_information:\n{}", self.body(style, 2, stored))
    }

    /// Formats the content without its top-level key, as embedded in files, with each line indented
    /// by `indent`.
    pub(crate) fn body(&self, style: Style, indent: usize, stored: &Stored) -> String {
        let pad = " ".repeat(indent);
        let mut yaml = String::new();
        let mut line = |text: &str| {
            let _ = writeln!(yaml, "{pad}{text}");
        };
        line(&format!("version: {}", style.version()));
        line(&format!("storage_identifier: {}", stored.storage));
        span(&mut line, "", self.span_ns());
        line(&format!("message_count: {}", self.messages()));
        list(&mut line, "topics_with_message_count", self.topics.is_empty());
        for topic in &self.topics {
            topic.put(&mut line, style);
        }
        line(&format!("compression_format: {}", quoted(&stored.compression)));
        line(&format!("compression_mode: {}", quoted(&stored.compression_mode)));
        list(&mut line, "relative_file_paths", self.files.is_empty());
        for file in &self.files {
            line(&format!("  - {}", quoted(&file.path)));
        }
        list(&mut line, "files", self.files.is_empty());
        for file in &self.files {
            line(&format!("  - path: {}", quoted(&file.path)));
            span(&mut line, "    ", file.span_ns);
            line(&format!("    message_count: {}", file.messages));
        }
        if style == Style::Jazzy {
            let is_empty = self.custom_data.is_empty();
            line(&format!("custom_data:{}", if is_empty { " ~" } else { "" }));
            for (name, value) in &self.custom_data {
                line(&format!("  {}: {}", quoted(name), quoted(value)));
            }
            line(&format!("ros_distro: {}", quoted(&self.ros_distro)));
        }
        yaml
    }
}

impl TopicInformation {
    /// Formats the QoS profiles as one text, as in a channel or database row.
    #[must_use]
    pub fn qos_text(&self, style: Style) -> String {
        match style {
            Style::Jazzy if self.qos.is_empty() => "[]".into(),
            _ => qos::to_yaml(&self.qos, style, 0),
        }
    }

    fn put(&self, line: &mut dyn FnMut(&str), style: Style) {
        line("  - topic_metadata:");
        line(&format!("      name: {}", quoted(&self.name)));
        line(&format!("      type: {}", quoted(&self.type_name)));
        line(&format!("      serialization_format: {}", quoted(&self.encoding)));
        match style {
            // Until version 8 the profiles are a string with YAML inside.
            Style::Humble => {
                let text = self.qos_text(style);
                line(&format!("      offered_qos_profiles: {}", quoted(&text)));
            }
            Style::Jazzy if self.qos.is_empty() => line("      offered_qos_profiles: []"),
            Style::Jazzy => {
                line("      offered_qos_profiles:");
                qos::to_yaml(&self.qos, style, 8).lines().for_each(&mut *line);
            }
        }
        if style == Style::Jazzy {
            line(&format!("      type_description_hash: {}", quoted(&self.type_hash)));
        }
        line(&format!("    message_count: {}", self.messages));
    }
}

fn list(line: &mut dyn FnMut(&str), name: &str, is_empty: bool) {
    line(&format!("{name}:{}", if is_empty { " []" } else { "" }));
}

/// Formats start and duration. Without messages both are zero, as in rosbag2.
fn span(line: &mut dyn FnMut(&str), pad: &str, span_ns: Option<(i64, i64)>) {
    let (start_ns, end_ns) = span_ns.unwrap_or_default();
    let order: [(&str, &str, i64); 2] = [
        ("duration", "nanoseconds", end_ns.saturating_sub(start_ns)),
        ("starting_time", "nanoseconds_since_epoch", start_ns),
    ];
    // rosbag2 uses this order for the bag and the reverse for each file.
    let order = if pad.is_empty() { order } else { [order[1], order[0]] };
    for (name, unit, value) in order {
        line(&format!("{pad}{name}:"));
        line(&format!("{pad}  {unit}: {value}"));
    }
}

/// Formats a YAML string: plain where every parser reads it as a string, otherwise quoted.
fn quoted(text: &str) -> String {
    let is_word = |c: char| c.is_ascii_alphanumeric() || "/_.-".contains(c);
    let starts = text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '/');
    let is_special = ["true", "false", "yes", "no", "on", "off", "null", "y", "n"]
        .contains(&text.to_ascii_lowercase().as_str());
    if starts && !is_special && text.chars().all(is_word) {
        return text.into();
    }
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            '\t' => quoted.push_str("\\t"),
            c if c.is_control() || matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}') => {
                let _ = write!(quoted, "\\U{:08X}", c as u32);
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
