//! How a publisher offered its topic, as bags tell it.
//!
//! Fields, names and numbers are those of `rmw_qos_profile_t`, in the order in which rosbag2 writes
//! them (`rosbag2_storage/qos.cpp`): numbers up to version 8 of its metadata, names from version 9.

use std::fmt::Write as _;

use periplus_diagnostics::SourceMap;
use periplus_yaml::Node;

use crate::Style;

/// The quality of service that one publisher offered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QosProfile {
    /// Which messages are kept for those who are late.
    pub history: History,
    /// How many, with [`History::KeepLast`].
    pub depth: u64,
    /// Whether lost messages are sent again.
    pub reliability: Reliability,
    /// Whether who comes later gets what was sent before.
    pub durability: Durability,
    /// The longest time between messages \[ns\]; none is without end.
    pub deadline_ns: Option<u64>,
    /// How long a message is of use \[ns\]; none is without end.
    pub lifespan_ns: Option<u64>,
    /// How a publisher shows that it is alive.
    pub liveliness: Liveliness,
    /// How long it counts as alive \[ns\]; none is without end.
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

            /// From a name or a number.
            fn read(text: &str) -> Option<Self> {
                $(if text == $text || text == stringify!($number) { return Some(Self::$one); })*
                None
            }
        }
    };
}

policy! {
    /// Which messages are kept.
    History {
        /// As the middleware likes.
        SystemDefault = 0 "system_default"
        /// The last few.
        KeepLast = 1 "keep_last"
        /// All.
        KeepAll = 2 "keep_all"
        /// Nobody knows.
        Unknown = 3 "unknown"
    }
}

policy! {
    /// Whether lost messages are sent again.
    Reliability {
        /// As the middleware likes.
        SystemDefault = 0 "system_default"
        /// They are.
        Reliable = 1 "reliable"
        /// They are not.
        BestEffort = 2 "best_effort"
        /// Nobody knows.
        Unknown = 3 "unknown"
        /// Whatever the other side has.
        BestAvailable = 4 "best_available"
    }
}

policy! {
    /// Whether who comes later gets what was sent before.
    Durability {
        /// As the middleware likes.
        SystemDefault = 0 "system_default"
        /// From the publisher, as long as it lives.
        TransientLocal = 1 "transient_local"
        /// No.
        Volatile = 2 "volatile"
        /// Nobody knows.
        Unknown = 3 "unknown"
        /// Whatever the other side has.
        BestAvailable = 4 "best_available"
    }
}

policy! {
    /// How a publisher shows that it is alive.
    Liveliness {
        /// As the middleware likes.
        SystemDefault = 0 "system_default"
        /// The middleware does it.
        Automatic = 1 "automatic"
        /// The node says it.
        ManualByNode = 2 "manual_by_node"
        /// The publisher says it.
        ManualByTopic = 3 "manual_by_topic"
        /// Nobody knows.
        Unknown = 4 "unknown"
        /// Whatever the other side has.
        BestAvailable = 5 "best_available"
    }
}

impl QosProfile {
    /// Reliable, volatile, the last `depth`.
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

    /// The profile of sensor streams: best effort, the last five.
    #[must_use]
    pub fn sensor_data() -> Self {
        Self { reliability: Reliability::BestEffort, ..Self::reliable(5) }
    }

    /// The profile of maps and descriptions: reliable, and sent to who comes later.
    #[must_use]
    pub fn latched(depth: u64) -> Self {
        Self { durability: Durability::TransientLocal, ..Self::reliable(depth) }
    }
}

/// `RMW_DURATION_INFINITE`: 2^63 - 1 ns.
const ENDLESS_NS: u64 = i64::MAX as u64;

/// The profiles as YAML, each line with `indent` spaces in front.
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

/// The profiles of a list, by names or numbers. What is missing or strange is unknown.
pub(crate) fn from_yaml(list: &Node) -> Vec<QosProfile> {
    let profiles = list.list().unwrap_or_default().iter();
    profiles
        .map(|node| {
            let text = |name| node.get(name).and_then(Node::text).unwrap_or_default();
            let duration_ns = |name| {
                let part = |unit| node.get(name)?.get(unit)?.integer()?.try_into().ok();
                let all_ns = u64::saturating_mul(part("sec")?, 1_000_000_000);
                Some(all_ns.saturating_add(part("nsec")?)).filter(|&all_ns| all_ns < ENDLESS_NS)
            };
            let depth = node.get("depth").and_then(Node::integer).unwrap_or(0);
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

/// The profiles of a text inside of a bag.
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
