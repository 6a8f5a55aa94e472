//! QoS of command-line options, adapted to the publishers of a topic.

use periplus_graph::{Durability, History, Liveliness, Qos, Reliability};

use crate::{Failure, Outcome, SeenTopic};

/// QoS options; `None` selects a matching policy.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QosRequest {
    /// `--qos-profile`.
    pub profile: Option<String>,
    /// `--qos-depth`.
    pub depth: Option<usize>,
    /// `--qos-history`.
    pub history: Option<String>,
    /// `--qos-reliability`.
    pub reliability: Option<String>,
    /// `--qos-durability`.
    pub durability: Option<String>,
    /// `--qos-liveliness`.
    pub liveliness: Option<String>,
    /// `--qos-liveliness-lease-duration-seconds`.
    pub lease_s: Option<f64>,
}

/// Values of `--qos-profile` (`rmw/qos_profiles.h`).
const PROFILES: [(&str, Qos); 6] = [
    ("default", Qos::reliable(10)),
    ("sensor_data", Qos::sensor_data()),
    ("services_default", Qos::reliable(10)),
    ("parameters", Qos::parameters()),
    ("parameter_events", Qos::parameters()),
    ("system_default", Qos::reliable(1)),
];

/// Maximum number of latched messages from each publisher; robots have a few static publishers,
/// each of which may hold many transforms.
const LATCHED_DEPTH: usize = 100;

impl QosRequest {
    /// QoS offered by a publisher.
    ///
    /// # Errors
    /// When a value is unknown.
    pub fn offer(&self) -> Outcome<Qos> {
        self.over(Qos::reliable(10))
    }

    /// QoS requested by a subscription so that all publishers of a topic match, and a note if they
    /// differ. Explicit options take precedence.
    ///
    /// # Errors
    /// When a value is unknown.
    pub fn ask(&self, topic: Option<&SeenTopic>) -> Outcome<(Qos, Option<String>)> {
        let publishers = topic.map_or(&[][..], |topic| &topic.publishers);
        let is_bare =
            *self == Self { depth: self.depth, history: self.history.clone(), ..Self::default() };
        if publishers.is_empty() || !is_bare {
            return Ok((self.over(Qos::sensor_data())?, None));
        }
        let reliable = count(publishers, |qos| qos.reliability == Reliability::Reliable);
        let latched = count(publishers, |qos| qos.durability == Durability::TransientLocal);
        let all = publishers.len();
        // Strongest QoS that all publishers offer.
        let mut qos = Qos::reliable(64);
        if reliable < all {
            qos.reliability = Reliability::BestEffort;
        }
        if latched == all {
            qos.durability = Durability::TransientLocal;
            qos.depth = LATCHED_DEPTH;
        }
        let differ = |some: usize| 0 < some && some < all;
        let mut words = Vec::new();
        if differ(reliable) {
            words.push(format!(
                "{reliable} of {all} publishers are reliable and the others best effort; all are \
                 received as best effort"
            ));
        }
        if differ(latched) {
            words.push(format!(
                "{latched} of {all} publishers are transient local and the others are \
                 not; earlier messages are not requested"
            ));
        }
        Ok((self.over(qos)?, (!words.is_empty()).then(|| words.join("; "))))
    }

    fn over(&self, base: Qos) -> Outcome<Qos> {
        let mut qos = base;
        if let Some(name) = &self.profile {
            let found = PROFILES.iter().find(|(known, _)| known == name);
            let names = PROFILES.map(|(name, _)| name);
            qos = found.ok_or_else(|| unknown("--qos-profile", name, &names))?.1;
        }
        if let Some(word) = &self.history {
            qos.history = one_of(
                "--qos-history",
                word,
                &[("keep_last", History::KeepLast), ("keep_all", History::KeepAll)],
                qos.history,
            )?;
        }
        if let Some(depth) = self.depth {
            qos.depth = depth.max(1);
        }
        if let Some(word) = &self.reliability {
            let known =
                [("reliable", Reliability::Reliable), ("best_effort", Reliability::BestEffort)];
            qos.reliability = one_of("--qos-reliability", word, &known, qos.reliability)?;
        }
        if let Some(word) = &self.durability {
            let known = [
                ("volatile", Durability::Volatile),
                ("transient_local", Durability::TransientLocal),
            ];
            qos.durability = one_of("--qos-durability", word, &known, qos.durability)?;
        }
        if let Some(word) = &self.liveliness {
            let known = [
                ("automatic", Liveliness::Automatic),
                ("manual_by_topic", Liveliness::ManualByTopic),
            ];
            qos.liveliness = one_of("--qos-liveliness", word, &known, qos.liveliness)?;
        }
        if let Some(lease_s) = self.lease_s {
            qos.lease_ns = Some((lease_s * 1e9).round() as i64);
        }
        Ok(qos)
    }
}

fn count(ends: &[crate::TopicEndpoint], is_so: impl Fn(&Qos) -> bool) -> usize {
    ends.iter().filter(|end| is_so(&end.qos)).count()
}

fn one_of<T: Copy>(option: &str, word: &str, known: &[(&str, T)], by_itself: T) -> Outcome<T> {
    if matches!(word, "system_default" | "best_available") {
        return Ok(by_itself);
    }
    let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
    match known.iter().find(|(name, _)| *name == word) {
        Some((_, value)) => Ok(*value),
        None => Err(unknown(option, word, &names)),
    }
}

fn unknown(option: &str, word: &str, known: &[&str]) -> Failure {
    Failure::Usage(format!("{option} is `{word}`; expected one of {}", known.join(", ")))
}

/// QoS in the format of `ros2 topic info -v`, without the first line.
pub(crate) fn describe(qos: &Qos) -> String {
    let upper = |word: String| word.to_uppercase();
    let span = |ns: Option<i64>| match ns {
        None => "Infinite".to_owned(),
        Some(ns) => format!("{ns} nanoseconds"),
    };
    let history = match qos.history {
        History::KeepAll => "KEEP_ALL".to_owned(),
        // Fast DDS and older Cyclone DDS do not report it.
        History::KeepLast if qos.depth == 0 => "UNKNOWN".to_owned(),
        History::KeepLast => format!("KEEP_LAST ({})", qos.depth),
    };
    format!(
        "  Reliability: {}\n  History (Depth): {history}\n  Durability: {}\n  Lifespan: {}\n  \
         Deadline: {}\n  Liveliness: {}\n  Liveliness lease duration: {}\n",
        upper(qos.reliability.to_string()),
        upper(qos.durability.to_string()),
        span(qos.lifespan_ns),
        span(qos.deadline_ns),
        upper(qos.liveliness.to_string()),
        span(qos.lease_ns),
    )
}

/// QoS as JSON.
pub(crate) fn to_json(qos: &Qos) -> serde_json::Value {
    let history = match qos.history {
        History::KeepAll => "keep_all",
        History::KeepLast => "keep_last",
    };
    serde_json::json!({
        "reliability": qos.reliability.to_string(),
        "durability": qos.durability.to_string(),
        "history": history,
        "depth": qos.depth,
        "lifespan_ns": qos.lifespan_ns,
        "deadline_ns": qos.deadline_ns,
        "liveliness": qos.liveliness.to_string(),
        "lease_ns": qos.lease_ns,
    })
}
