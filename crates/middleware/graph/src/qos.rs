//! Quality of service and the compatibility of offered and requested policies.
//!
//! Source of names, defaults and rules: ROS 2, `rmw/qos_profiles.h` and the design article on
//! deadline, liveliness and lifespan; the compatibility table is that of DDS 1.4, section 2.2.3
//! (requested versus offered).

use std::fmt;

/// Reliability policy, in ascending order of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reliability {
    /// Messages may be lost.
    BestEffort,
    /// Messages are delivered, within the history.
    Reliable,
}

/// Durability policy, in ascending order of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Durability {
    /// Late subscribers get no earlier messages.
    Volatile,
    /// Late subscribers get the last messages of each existing publisher, up to its depth.
    TransientLocal,
}

/// History policy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum History {
    /// Keeps the newest messages, up to the depth; older ones are dropped and counted.
    KeepLast,
    /// Keeps all messages, up to [`KEEP_ALL_MAX_MESSAGES`].
    KeepAll,
}

/// Maximum number of messages in a `KEEP_ALL` history, which bounds the memory of subscriptions
/// that are never read: 100 s at 100 messages per second.
pub const KEEP_ALL_MAX_MESSAGES: usize = 10_000;

/// Liveliness policy, in ascending order of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Liveliness {
    /// Asserted by the node.
    Automatic,
    /// Asserted by the publisher, by publishing.
    ManualByTopic,
}

/// Quality of service that a publisher offers or a subscription requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Qos {
    /// Reliability.
    pub reliability: Reliability,
    /// Durability.
    pub durability: Durability,
    /// History.
    pub history: History,
    /// Queue length with [`History::KeepLast`]; 0 counts as 1.
    pub depth: usize,
    /// Maximum time between two messages \[ns\]; none for no limit.
    pub deadline_ns: Option<i64>,
    /// Age at which a message is no longer delivered \[ns\]; none for no limit.
    pub lifespan_ns: Option<i64>,
    /// Liveliness.
    pub liveliness: Liveliness,
    /// Lease duration of the liveliness \[ns\]; none for no limit.
    pub lease_ns: Option<i64>,
}

/// The defaults of ROS 2: reliable, volatile, depth 10.
impl Default for Qos {
    fn default() -> Self {
        Self::reliable(10)
    }
}

impl Qos {
    /// Reliable and volatile, with a depth.
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

    /// Best effort and volatile, with a depth.
    #[must_use]
    pub const fn best_effort(depth: usize) -> Self {
        Self { reliability: Reliability::BestEffort, ..Self::reliable(depth) }
    }

    /// `SensorDataQoS`: best effort, depth 5.
    #[must_use]
    pub const fn sensor_data() -> Self {
        Self::best_effort(5)
    }

    /// `ClockQoS`: best effort, depth 1.
    #[must_use]
    pub const fn clock() -> Self {
        Self::best_effort(1)
    }

    /// Reliable and transient local, with a depth: maps, descriptions, static transforms.
    #[must_use]
    pub const fn latched(depth: usize) -> Self {
        Self { durability: Durability::TransientLocal, ..Self::reliable(depth) }
    }

    /// `ParametersQoS` and `ParameterEventsQoS`: reliable, depth 1000.
    #[must_use]
    pub const fn parameters() -> Self {
        Self::reliable(1000)
    }

    /// `RosoutQoS`: reliable, transient local, depth 1000, lifespan 10 s.
    #[must_use]
    pub const fn rosout() -> Self {
        Self::latched(1000).with_lifespan_ns(10_000_000_000)
    }

    /// Replaces the reliability.
    #[must_use]
    pub const fn with_reliability(self, reliability: Reliability) -> Self {
        Self { reliability, ..self }
    }

    /// Replaces the durability.
    #[must_use]
    pub const fn with_durability(self, durability: Durability) -> Self {
        Self { durability, ..self }
    }

    /// Replaces the history with `KEEP_ALL`.
    #[must_use]
    pub const fn keep_all(self) -> Self {
        Self { history: History::KeepAll, ..self }
    }

    /// Replaces the deadline \[ns\].
    #[must_use]
    pub const fn with_deadline_ns(self, deadline_ns: i64) -> Self {
        Self { deadline_ns: Some(deadline_ns), ..self }
    }

    /// Replaces the lifespan \[ns\].
    #[must_use]
    pub const fn with_lifespan_ns(self, lifespan_ns: i64) -> Self {
        Self { lifespan_ns: Some(lifespan_ns), ..self }
    }

    /// Maximum number of messages in the queue.
    pub(crate) fn capacity(&self) -> usize {
        match self.history {
            History::KeepLast => self.depth.max(1),
            History::KeepAll => KEEP_ALL_MAX_MESSAGES,
        }
    }

    /// Returns the policies in which this offer is weaker than the request; none if compatible.
    #[must_use]
    pub fn incompatible_policies(&self, asked: &Self) -> Vec<Policy> {
        let mut incompatible_policies = Vec::new();
        if self.reliability < asked.reliability {
            incompatible_policies.push(Policy::Reliability);
        }
        if self.durability < asked.durability {
            incompatible_policies.push(Policy::Durability);
        }
        if is_longer(self.deadline_ns, asked.deadline_ns) {
            incompatible_policies.push(Policy::Deadline);
        }
        if self.liveliness < asked.liveliness {
            incompatible_policies.push(Policy::Liveliness);
        }
        if is_longer(self.lease_ns, asked.lease_ns) {
            incompatible_policies.push(Policy::Lease);
        }
        incompatible_policies
    }

    /// Strengthens this offer as far as the request needs.
    #[must_use]
    pub fn strengthened_for(self, asked: &Self) -> Self {
        Self {
            reliability: self.reliability.max(asked.reliability),
            durability: self.durability.max(asked.durability),
            deadline_ns: shorter(self.deadline_ns, asked.deadline_ns),
            liveliness: self.liveliness.max(asked.liveliness),
            lease_ns: shorter(self.lease_ns, asked.lease_ns),
            ..self
        }
    }

    /// Weakens this request as far as the offer needs.
    #[must_use]
    pub fn weakened_for(self, offered: &Self) -> Self {
        Self {
            reliability: self.reliability.min(offered.reliability),
            durability: self.durability.min(offered.durability),
            deadline_ns: longer(self.deadline_ns, offered.deadline_ns),
            liveliness: self.liveliness.min(offered.liveliness),
            lease_ns: longer(self.lease_ns, offered.lease_ns),
            ..self
        }
    }

    /// The value of a policy in the spelling of ROS.
    #[must_use]
    pub fn policy_value(&self, policy: Policy) -> String {
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

/// The shorter of two durations; none is infinite.
fn shorter(one: Option<i64>, other: Option<i64>) -> Option<i64> {
    one.into_iter().chain(other).min()
}

/// The longer of two durations; none is infinite.
fn longer(one: Option<i64>, other: Option<i64>) -> Option<i64> {
    one.zip(other).map(|(one, other)| one.max(other))
}

/// True if the offered duration is longer than the requested one; none is infinite.
fn is_longer(offered: Option<i64>, asked: Option<i64>) -> bool {
    match (offered, asked) {
        (_, None) => false,
        (None, Some(_)) => true,
        (Some(offered), Some(asked)) => asked < offered,
    }
}

/// A policy that can be incompatible.
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
    fn weakening_or_strengthening_makes_policies_compatible() {
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
                assert_eq!(offered.strengthened_for(&asked).incompatible_policies(&asked), []);
                assert_eq!(offered.incompatible_policies(&asked.weakened_for(&offered)), []);
                if offered.incompatible_policies(&asked).is_empty() {
                    assert_eq!(
                        (offered.strengthened_for(&asked), asked.weakened_for(&offered)),
                        (offered, asked)
                    );
                }
            }
        }
    }
}
