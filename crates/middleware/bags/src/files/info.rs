//! Summary of a bag, as printed by `ros2 bag info` and as JSON.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::files::{Bag, Storage};

/// Summary of a bag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Info {
    /// Files, as given.
    pub files: Vec<String>,
    /// Size \[bytes\].
    pub bytes: u64,
    /// Storage format.
    pub storage: Storage,
    /// ROS distribution that recorded it; may be empty.
    pub ros_distro: String,
    /// Facts that the recorder wrote by name.
    pub custom_data: BTreeMap<String, String>,
    /// Times of the first and last message \[ns\].
    pub span_ns: Option<(i64, i64)>,
    /// Number of messages.
    pub messages: u64,
    /// Topics, by name.
    pub topics: Vec<TopicSum>,
    /// Compression format and mode; usually empty.
    pub packing: (String, String),
    /// True if all files were closed properly.
    pub is_whole: bool,
}

/// Summary of a topic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TopicSum {
    /// Name.
    pub name: String,
    /// Type.
    pub type_name: String,
    /// Number of messages.
    pub messages: u64,
    /// Encoding of the messages.
    pub encoding: String,
}

impl Info {
    /// Creates the summary of a bag.
    #[must_use]
    pub fn of(bag: &Bag) -> Self {
        let file = |path: &std::path::Path| {
            let name = if periplus_os::fs::is_dir(bag.path()) {
                path.file_name()
            } else {
                Some(path.as_os_str())
            };
            name.unwrap_or_default().to_string_lossy().into_owned()
        };
        let topic = |(topic, count): (&crate::BagTopic, &u64)| TopicSum {
            name: topic.name.clone(),
            type_name: topic.type_name.clone(),
            messages: *count,
            encoding: topic.encoding.clone(),
        };
        let mut topics: Vec<TopicSum> = bag.topics().iter().zip(bag.counts()).map(topic).collect();
        topics.sort_by(|a, b| (&a.name, &a.type_name).cmp(&(&b.name, &b.type_name)));
        let metadata = bag.metadata();
        let packing = metadata.map(|one| (one.compression.clone(), one.compression_mode.clone()));
        Self {
            files: bag.files().map(file).collect(),
            bytes: bag.bytes(),
            storage: bag.storage(),
            ros_distro: bag.ros_distro().to_owned(),
            custom_data: bag.custom_data().clone(),
            span_ns: bag.span_ns(),
            messages: bag.message_count(),
            topics,
            packing: packing.unwrap_or_default(),
            is_whole: bag.is_whole(),
        }
    }

    /// Formats the summary as `ros2 bag info` does.
    #[must_use]
    pub fn to_text(&self) -> String {
        let mut text = String::from("\n");
        let mut line = |name: &str, value: &str| {
            let _ = writeln!(text, "{name:<19}{value}");
        };
        line("Files:", &self.files.join(&format!("\n{:19}", "")));
        line("Bag size:", &size(self.bytes));
        line("Storage id:", self.storage.identifier());
        let distro = if self.ros_distro.is_empty() { "unknown" } else { &self.ros_distro };
        line("ROS Distro:", distro);
        if !self.packing.0.is_empty() {
            line(
                "Compression:",
                &format!("{} ({})", self.packing.0, self.packing.1.to_lowercase()),
            );
        }
        let (start_ns, end_ns) = self.span_ns.unwrap_or_default();
        line("Duration:", &format!("{}s", seconds(end_ns.saturating_sub(start_ns))));
        line("Start:", &moment(start_ns));
        line("End:", &moment(end_ns));
        line("Messages:", &self.messages.to_string());
        for (name, value) in &self.custom_data {
            line("Custom data:", &format!("{name}: {value}"));
        }
        let topics: Vec<String> = self
            .topics
            .iter()
            .map(|topic| {
                format!(
                    "Topic: {} | Type: {} | Count: {} | Serialization Format: {}",
                    topic.name, topic.type_name, topic.messages, topic.encoding
                )
            })
            .collect();
        line("Topic information:", &topics.join(&format!("\n{:19}", "")));
        text
    }
}

/// Formats a size, such as `1.5 GiB`.
fn size(bytes: u64) -> String {
    let units = ["B", "KiB", "MiB", "GiB", "TiB"];
    let mut value = bytes as f64;
    let mut unit = 0;
    while value >= 1024.0 && unit + 1 < units.len() {
        value /= 1024.0;
        unit += 1;
    }
    if unit == 0 { format!("{bytes} B") } else { format!("{value:.1} {}", units[unit]) }
}

/// Formats seconds, such as `12.345678901`.
fn seconds(time_ns: i64) -> String {
    let sign = if time_ns < 0 { "-" } else { "" };
    let all = time_ns.unsigned_abs();
    format!("{sign}{}.{:09}", all / 1_000_000_000, all % 1_000_000_000)
}

/// Formats a time in UTC, such as `Nov 21 2026 15:04:05.123456789 (1795273445.123456789)`.
fn moment(time_ns: i64) -> String {
    let all = time_ns.max(0).unsigned_abs();
    let (day, rest) = (all / 86_400_000_000_000, all % 86_400_000_000_000);
    let (year, month, day) = date(day);
    let months =
        ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"];
    let second = rest / 1_000_000_000;
    format!(
        "{} {day:>2} {year} {:02}:{:02}:{:02}.{:09} ({})",
        months.get(month as usize - 1).unwrap_or(&"???"),
        second / 3600,
        second / 60 % 60,
        second % 60,
        rest % 1_000_000_000,
        seconds(time_ns),
    )
}

/// Formats a time in UTC as in the folder names of `ros2 bag record`: `2026_11_21-15_04_05`.
#[must_use]
pub fn stamp_name(time_ns: i64) -> String {
    let all = time_ns.max(0).unsigned_abs();
    let (year, month, day) = date(all / 86_400_000_000_000);
    let second = all / 1_000_000_000;
    let (hour, minute) = (second / 3600 % 24, second / 60 % 60);
    format!("{year}_{month:02}_{day:02}-{hour:02}_{minute:02}_{:02}", second % 60)
}

/// Year, month and day of a number of days since 1970-01-01 (Howard Hinnant, "chrono-Compatible
/// Low-Level Date Algorithms", `civil_from_days`, for days not before 1970).
fn date(days: u64) -> (u64, u64, u64) {
    let days = days + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1_460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * shifted + 2) / 5 + 1;
    let month = if shifted < 10 { shifted + 3 } else { shifted - 9 };
    let year = year_of_era + era * 400 + u64::from(month <= 2);
    (year, month, day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_have_dates() {
        assert_eq!(moment(0), "Jan  1 1970 00:00:00.000000000 (0.000000000)");
        assert_eq!(
            moment(951_782_400_000_000_001),
            "Feb 29 2000 00:00:00.000000001 (951782400.000000001)"
        );
        assert_eq!(
            moment(1_795_273_445_123_456_789),
            "Nov 21 2026 15:04:05.123456789 (1795273445.123456789)"
        );
    }

    #[test]
    fn folders_are_named_by_time() {
        assert_eq!(stamp_name(1_795_273_445_123_456_789), "2026_11_21-15_04_05");
    }

    #[test]
    fn sizes_have_units() {
        assert_eq!(size(1023), "1023 B");
        assert_eq!(size(1536), "1.5 KiB");
        assert_eq!(size(3 << 30), "3.0 GiB");
    }
}
