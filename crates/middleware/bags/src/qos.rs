//! QoS profiles of publishers, as stored in bags.
//!
//! Fields, names and numbers are those of `rmw_qos_profile_t`, in the order in which rosbag2 writes
//! them (`rosbag2_storage/qos.cpp`): numbers up to version 8 of its metadata, names from version 9.

use std::fmt::Write as _;

use periplus_diagnostics::SourceMap;
use periplus_yaml::YamlNode;

use crate::Style;

/// QoS offered by a publisher.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QosProfile {
    /// History policy.
    pub history: History,
    /// Depth, with [`History::KeepLast`].
    pub depth: u64,
    /// Reliability policy.
    pub reliability: Reliability,
    /// Durability policy.
    pub durability: Durability,
    /// Maximum time between messages \[ns\]; none is infinite.
    pub deadline_ns: Option<u64>,
    /// Lifespan of a message \[ns\]; none is infinite.
    pub lifespan_ns: Option<u64>,
    /// Liveliness policy.
    pub liveliness: Liveliness,
    /// Lease duration of the liveliness \[ns\]; none is infinite.
    pub lease_ns: Option<u64>,
}

/// A policy: its values, their numbers in `rmw/types.h`, and their names.
macro_rules! policy {
    ($(#[$doc:meta])* $name:ident { $($(#[$one_doc:meta])* $one:ident = $number:literal $text:literal)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name {
            $($(#[$one_doc])* $one,)*
        }

        impl $name {
            fn number(self) -> u8 {
                match self { $(Self::$one => $number,)* }
            }

            fn name(self) -> &'static str {
                match self { $(Self::$one => $text,)* }
            }

            /// Parses a name or a number.
            fn read(text: &str) -> Option<Self> {
                $(if text == $text || text == stringify!($number) { return Some(Self::$one); })*
                None
            }
        }
    };
}

policy! {
    /// History policy.
    History {
        /// Default of the middleware.
        SystemDefault = 0 "system_default"
        /// The newest messages, up to the depth.
        KeepLast = 1 "keep_last"
        /// All messages.
        KeepAll = 2 "keep_all"
        /// Unknown.
        Unknown = 3 "unknown"
    }
}

policy! {
    /// Reliability policy.
    Reliability {
        /// Default of the middleware.
        SystemDefault = 0 "system_default"
        /// Lost messages are sent again.
        Reliable = 1 "reliable"
        /// Messages may be lost.
        BestEffort = 2 "best_effort"
        /// Unknown.
        Unknown = 3 "unknown"
        /// The value of the other endpoint.
        BestAvailable = 4 "best_available"
    }
}

policy! {
    /// Durability policy.
    Durability {
        /// Default of the middleware.
        SystemDefault = 0 "system_default"
        /// Late subscribers get earlier messages while the publisher exists.
        TransientLocal = 1 "transient_local"
        /// Late subscribers get no earlier messages.
        Volatile = 2 "volatile"
        /// Unknown.
        Unknown = 3 "unknown"
        /// The value of the other endpoint.
        BestAvailable = 4 "best_available"
    }
}

policy! {
    /// Liveliness policy.
    Liveliness {
        /// Default of the middleware.
        SystemDefault = 0 "system_default"
        /// Asserted by the middleware.
        Automatic = 1 "automatic"
        /// Asserted by the node.
        ManualByNode = 2 "manual_by_node"
        /// Asserted by the publisher.
        ManualByTopic = 3 "manual_by_topic"
        /// Unknown.
        Unknown = 4 "unknown"
        /// The value of the other endpoint.
        BestAvailable = 5 "best_available"
    }
}

impl QosProfile {
    /// Reliable and volatile, with a depth.
    #[must_use]
    pub fn reliable(depth: u64) -> Self {
        Self {
            history: History::KeepLast,
            depth,
            reliability: Reliability::Reliable,
            durability: Durability::Volatile,
            deadline_ns: None,
            lifespan_ns: None,
            liveliness: Liveliness::Automatic,
            lease_ns: None,
        }
    }

    /// Sensor data profile: best effort, depth 5.
    #[must_use]
    pub fn sensor_data() -> Self {
        Self { reliability: Reliability::BestEffort, ..Self::reliable(5) }
    }

    /// Profile of maps and descriptions: reliable and transient local.
    #[must_use]
    pub fn latched(depth: u64) -> Self {
        Self { durability: Durability::TransientLocal, ..Self::reliable(depth) }
    }
}

/// `RMW_DURATION_INFINITE`: 2^63 - 1 ns.
const ENDLESS_NS: u64 = i64::MAX as u64;

/// Formats the profiles as YAML, each line with `indent` leading spaces.
pub(crate) fn to_yaml(profiles: &[QosProfile], style: Style, indent: usize) -> String {
    let mut yaml = String::new();
    let pad = " ".repeat(indent);
    for qos in profiles {
        let policies = match style {
            Style::Jazzy => [
                qos.history.name().to_owned(),
                qos.reliability.name().to_owned(),
                qos.durability.name().to_owned(),
                qos.liveliness.name().to_owned(),
            ],
            Style::Humble => [
                qos.history.number().to_string(),
                qos.reliability.number().to_string(),
                qos.durability.number().to_string(),
                qos.liveliness.number().to_string(),
            ],
        };
        let [history, reliability, durability, liveliness] = policies;
        let _ = writeln!(yaml, "{pad}- history: {history}");
        let _ = writeln!(yaml, "{pad}  depth: {}", qos.depth);
        let _ = writeln!(yaml, "{pad}  reliability: {reliability}");
        let _ = writeln!(yaml, "{pad}  durability: {durability}");
        put_duration(&mut yaml, &pad, "deadline", qos.deadline_ns);
        put_duration(&mut yaml, &pad, "lifespan", qos.lifespan_ns);
        let _ = writeln!(yaml, "{pad}  liveliness: {liveliness}");
        put_duration(&mut yaml, &pad, "liveliness_lease_duration", qos.lease_ns);
        let _ = writeln!(yaml, "{pad}  avoid_ros_namespace_conventions: false");
    }
    yaml
}

/// Reads the profiles of a list, by names or numbers. Missing or invalid values are unknown.
pub(crate) fn from_yaml(list: &YamlNode) -> Vec<QosProfile> {
    let profiles = list.list().unwrap_or_default().iter();
    profiles
        .map(|node| {
            let text = |name| node.get(name).and_then(YamlNode::text).unwrap_or_default();
            let duration_ns = |name| {
                let part = |unit| node.get(name)?.get(unit)?.integer()?.try_into().ok();
                let all_ns = u64::saturating_mul(part("sec")?, 1_000_000_000);
                Some(all_ns.saturating_add(part("nsec")?)).filter(|&all_ns| all_ns < ENDLESS_NS)
            };
            let depth = node.get("depth").and_then(YamlNode::integer).unwrap_or(0);
            QosProfile {
                history: History::read(text("history")).unwrap_or(History::Unknown),
                depth: u64::try_from(depth).unwrap_or(0),
                reliability: Reliability::read(text("reliability")).unwrap_or(Reliability::Unknown),
                durability: Durability::read(text("durability")).unwrap_or(Durability::Unknown),
                deadline_ns: duration_ns("deadline"),
                lifespan_ns: duration_ns("lifespan"),
                liveliness: Liveliness::read(text("liveliness")).unwrap_or(Liveliness::Unknown),
                lease_ns: duration_ns("liveliness_lease_duration"),
            }
        })
        .collect()
}

/// Reads the profiles of a text inside of a bag.
pub(crate) fn from_text(text: &str) -> Vec<QosProfile> {
    let mut sources = SourceMap::new();
    let file = sources.add("offered_qos_profiles", text);
    let node = periplus_yaml::parse(file, &sources).ok().flatten();
    node.map(|node| from_yaml(&node)).unwrap_or_default()
}

fn put_duration(yaml: &mut String, pad: &str, name: &str, duration_ns: Option<u64>) {
    let all_ns = duration_ns.unwrap_or(ENDLESS_NS);
    let (sec, nsec) = (all_ns / 1_000_000_000, all_ns % 1_000_000_000);
    let _ = writeln!(yaml, "{pad}  {name}:\n{pad}    sec: {sec}\n{pad}    nsec: {nsec}");
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::*;

    #[test]
    fn profiles_read_back() {
        let deadline = QosProfile { deadline_ns: Some(1_500_000_000), ..QosProfile::reliable(3) };
        let all = [QosProfile::sensor_data(), QosProfile::latched(1), deadline];
        for style in [Style::Humble, Style::Jazzy] {
            assert_eq!(from_text(&to_yaml(&all, style, 0)), all);
        }
        assert_eq!(from_text("[]"), []);
        assert_eq!(from_text("{"), []);
    }

    #[test]
    fn names_and_numbers() {
        expect![[r"
            - history: keep_last
              depth: 5
              reliability: best_effort
              durability: volatile
              deadline:
                sec: 9223372036
                nsec: 854775807
              lifespan:
                sec: 9223372036
                nsec: 854775807
              liveliness: automatic
              liveliness_lease_duration:
                sec: 9223372036
                nsec: 854775807
              avoid_ros_namespace_conventions: false
        "]]
        .assert_eq(&to_yaml(&[QosProfile::sensor_data()], Style::Jazzy, 0));
        let latched = QosProfile { deadline_ns: Some(1_500_000_000), ..QosProfile::latched(1) };
        expect![[r"
            - history: 1
              depth: 1
              reliability: 1
              durability: 1
              deadline:
                sec: 1
                nsec: 500000000
              lifespan:
                sec: 9223372036
                nsec: 854775807
              liveliness: 1
              liveliness_lease_duration:
                sec: 9223372036
                nsec: 854775807
              avoid_ros_namespace_conventions: false
        "]]
        .assert_eq(&to_yaml(&[latched], Style::Humble, 0));
        assert_eq!(to_yaml(&[], Style::Jazzy, 0), "");
    }
}
