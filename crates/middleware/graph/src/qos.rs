//! Quality of service: what a publisher offers, what a subscription asks for, and when they fit.
//!
//! Source of names, defaults and rules: ROS 2, `rmw/qos_profiles.h` and the design article "ROS QoS -
//! Deadline, Liveliness, and Lifespan"; the table of fits is that of DDS 1.4, section 2.2.3
//! (requested versus offered).

use std::fmt;

/// Whether a message may get lost on the way. The order is that of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reliability {
    /// It may.
    BestEffort,
    /// It may not, as far as the history reaches.
    Reliable,
}

/// Whether who comes late gets what was sent before. The order is that of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Durability {
    /// No.
    Volatile,
    /// The last messages of every publisher that still lives, as many as its depth.
    TransientLocal,
}

/// How many messages wait.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum History {
    /// The newest, as many as the depth; older ones are dropped and counted.
    KeepLast,
    /// All, up to [`MOST_KEPT`].
    KeepAll,
}

/// Most messages that wait where all are kept, so that who never looks cannot take all memory: a
/// hundred seconds at a hundred per second.
pub const MOST_KEPT: usize = 10_000;

/// Who says that a publisher lives. The order is that of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Liveliness {
    /// Its node, all the time.
    Automatic,
    /// The publisher itself, by publishing.
    ManualByTopic,
}

/// Quality of service of a publisher (what it offers) or a subscription (what it asks for).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Qos {
    /// Whether messages may get lost.
    pub reliability: Reliability,
    /// Whether latecomers get the last messages.
    pub durability: Durability,
    /// How many messages wait.
    pub history: History,
    /// How many, with [`History::KeepLast`]; 0 counts as 1.
    pub depth: usize,
    /// Most time from message to message \[ns\]; none for any.
    pub deadline_ns: Option<i64>,
    /// Age at which a message is stale and no longer delivered \[ns\]; none for never.
    pub lifespan_ns: Option<i64>,
    /// Who says that a publisher lives.
    pub liveliness: Liveliness,
    /// How long it may be silent about that \[ns\]; none for any time.
    pub lease_ns: Option<i64>,
}

/// The defaults of ROS 2: reliable, volatile, the last ten.
impl Default for Qos {
    fn default() -> Self {
        Self::reliable(10)
    }
}

impl Qos {
    /// Reliable and volatile, the last `depth`.
    #[must_use]
    pub const fn reliable(depth: usize) -> Self {
        Self {
            reliability: Reliability::Reliable,
            durability: Durability::Volatile,
            history: History::KeepLast,
            depth,
            deadline_ns: None,
            lifespan_ns: None,
            liveliness: Liveliness::Automatic,
            lease_ns: None,
        }
    }

    /// Best effort and volatile, the last `depth`.
    #[must_use]
    pub const fn best_effort(depth: usize) -> Self {
        Self { reliability: Reliability::BestEffort, ..Self::reliable(depth) }
    }

    /// `SensorDataQoS`: best effort, the last five.
    #[must_use]
    pub const fn sensor_data() -> Self {
        Self::best_effort(5)
    }

    /// `ClockQoS`: best effort, the last one.
    #[must_use]
    pub const fn clock() -> Self {
        Self::best_effort(1)
    }

    /// Reliable and kept for latecomers, the last `depth`: maps, descriptions, static transforms.
    #[must_use]
    pub const fn latched(depth: usize) -> Self {
        Self { durability: Durability::TransientLocal, ..Self::reliable(depth) }
    }

    /// `ParametersQoS` and `ParameterEventsQoS`: reliable, the last thousand.
    #[must_use]
    pub const fn parameters() -> Self {
        Self::reliable(1000)
    }

    /// `RosoutQoS`: reliable, the last thousand kept for latecomers, for ten seconds.
    #[must_use]
    pub const fn rosout() -> Self {
        Self::latched(1000).with_lifespan_ns(10_000_000_000)
    }

    /// With another reliability.
    #[must_use]
    pub const fn with_reliability(self, reliability: Reliability) -> Self {
        Self { reliability, ..self }
    }

    /// With another durability.
    #[must_use]
    pub const fn with_durability(self, durability: Durability) -> Self {
        Self { durability, ..self }
    }

    /// With all messages kept until they are read.
    #[must_use]
    pub const fn keep_all(self) -> Self {
        Self { history: History::KeepAll, ..self }
    }

    /// With a deadline \[ns\].
    #[must_use]
    pub const fn with_deadline_ns(self, deadline_ns: i64) -> Self {
        Self { deadline_ns: Some(deadline_ns), ..self }
    }

    /// With a lifespan \[ns\].
    #[must_use]
    pub const fn with_lifespan_ns(self, lifespan_ns: i64) -> Self {
        Self { lifespan_ns: Some(lifespan_ns), ..self }
    }

    /// Most messages that wait.
    pub(crate) fn capacity(&self) -> usize {
        match self.history {
            History::KeepLast => self.depth.max(1),
            History::KeepAll => MOST_KEPT,
        }
    }

    /// The policies in which this offer is weaker than what is asked for; none when they fit.
    #[must_use]
    pub fn lacks(&self, asked: &Self) -> Vec<Policy> {
        let mut lacks = Vec::new();
        if self.reliability < asked.reliability {
            lacks.push(Policy::Reliability);
        }
        if self.durability < asked.durability {
            lacks.push(Policy::Durability);
        }
        if is_longer(self.deadline_ns, asked.deadline_ns) {
            lacks.push(Policy::Deadline);
        }
        if self.liveliness < asked.liveliness {
            lacks.push(Policy::Liveliness);
        }
        if is_longer(self.lease_ns, asked.lease_ns) {
            lacks.push(Policy::Lease);
        }
        lacks
    }

    /// With as much more on offer as it takes for who asks for this.
    #[must_use]
    pub fn offering(self, asked: &Self) -> Self {
        Self {
            reliability: self.reliability.max(asked.reliability),
            durability: self.durability.max(asked.durability),
            deadline_ns: shorter(self.deadline_ns, asked.deadline_ns),
            liveliness: self.liveliness.max(asked.liveliness),
            lease_ns: shorter(self.lease_ns, asked.lease_ns),
            ..self
        }
    }

    /// With as much less asked for as it takes to hear who offers this.
    #[must_use]
    pub fn asking(self, offered: &Self) -> Self {
        Self {
            reliability: self.reliability.min(offered.reliability),
            durability: self.durability.min(offered.durability),
            deadline_ns: longer(self.deadline_ns, offered.deadline_ns),
            liveliness: self.liveliness.min(offered.liveliness),
            lease_ns: longer(self.lease_ns, offered.lease_ns),
            ..self
        }
    }

    /// What is set for a policy, as ROS spells it.
    #[must_use]
    pub fn spelled(&self, policy: Policy) -> String {
        let span = |ns: Option<i64>| ns.map_or("infinite".to_owned(), |ns| format!("{ns} ns"));
        match policy {
            Policy::Reliability => self.reliability.to_string(),
            Policy::Durability => self.durability.to_string(),
            Policy::Liveliness => self.liveliness.to_string(),
            Policy::Deadline => span(self.deadline_ns),
            Policy::Lease => span(self.lease_ns),
        }
    }
}

/// The shorter of two times; none is infinite.
fn shorter(one: Option<i64>, other: Option<i64>) -> Option<i64> {
    one.into_iter().chain(other).min()
}

/// The longer of two times; none is infinite.
fn longer(one: Option<i64>, other: Option<i64>) -> Option<i64> {
    one.zip(other).map(|(one, other)| one.max(other))
}

/// Whether an offered time is longer than the one asked for; none is infinite.
fn is_longer(offered: Option<i64>, asked: Option<i64>) -> bool {
    match (offered, asked) {
        (_, None) => false,
        (None, Some(_)) => true,
        (Some(offered), Some(asked)) => asked < offered,
    }
}

/// A policy in which an offer and a request may not fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Policy {
    /// [`Qos::reliability`].
    Reliability,
    /// [`Qos::durability`].
    Durability,
    /// [`Qos::deadline_ns`].
    Deadline,
    /// [`Qos::liveliness`].
    Liveliness,
    /// [`Qos::lease_ns`].
    Lease,
}

impl fmt::Display for Policy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Reliability => "reliability",
            Self::Durability => "durability",
            Self::Deadline => "deadline",
            Self::Liveliness => "liveliness",
            Self::Lease => "liveliness lease duration",
        })
    }
}

impl fmt::Display for Reliability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::BestEffort => "best_effort",
            Self::Reliable => "reliable",
        })
    }
}

impl fmt::Display for Durability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Volatile => "volatile",
            Self::TransientLocal => "transient_local",
        })
    }
}

impl fmt::Display for Liveliness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Automatic => "automatic",
            Self::ManualByTopic => "manual_by_topic",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whoever_gives_way_both_fit() {
        let manual = Qos {
            liveliness: Liveliness::ManualByTopic,
            lease_ns: Some(5),
            ..Qos::latched(1).with_deadline_ns(10)
        };
        let kinds = [
            Qos::default(),
            Qos::sensor_data(),
            Qos::latched(3),
            manual,
            Qos::sensor_data().with_deadline_ns(20),
        ];
        for offered in kinds {
            for asked in kinds {
                assert_eq!(offered.offering(&asked).lacks(&asked), []);
                assert_eq!(offered.lacks(&asked.asking(&offered)), []);
                if offered.lacks(&asked).is_empty() {
                    assert_eq!(
                        (offered.offering(&asked), asked.asking(&offered)),
                        (offered, asked)
                    );
                }
            }
        }
    }
}
