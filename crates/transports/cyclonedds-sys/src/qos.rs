//! Quality of service of DDS.

use crate::ffi;

/// Durability policy, in ascending order of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DdsDurability {
    /// Late readers get no earlier samples.
    Volatile,
    /// Late readers get earlier samples while the writer exists.
    TransientLocal,
    /// Earlier samples are kept by an external service.
    Transient,
    /// Earlier samples are kept permanently.
    Persistent,
}

/// Liveliness policy, in ascending order of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DdsLiveliness {
    /// Asserted by the participant automatically.
    Automatic,
    /// Asserted by any writer of the participant.
    ManualByParticipant,
    /// Asserted by the writer itself.
    ManualByTopic,
}

/// QoS that a writer offers or a reader requests. Times are in ns, none is infinite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DdsQos {
    /// Reliability: lost samples are sent again.
    pub is_reliable: bool,
    /// Durability.
    pub durability: DdsDurability,
    /// History depth; none for `KEEP_ALL`, 0 if a remote endpoint does not announce it.
    pub depth: Option<usize>,
    /// Maximum time between samples.
    pub deadline_ns: Option<i64>,
    /// Lifespan of a sample.
    pub lifespan_ns: Option<i64>,
    /// Liveliness.
    pub liveliness: DdsLiveliness,
    /// Lease duration of the liveliness.
    pub lease_ns: Option<i64>,
    /// Maximum time that a reliable writer blocks for buffer space.
    pub blocking_ns: Option<i64>,
}

/// Reliable and volatile, depth 10; a writer blocks for at most 100 ms.
impl Default for DdsQos {
    fn default() -> Self {
        Self {
            is_reliable: true,
            durability: DdsDurability::Volatile,
            depth: Some(10),
            deadline_ns: None,
            lifespan_ns: None,
            liveliness: DdsLiveliness::Automatic,
            lease_ns: None,
            blocking_ns: Some(100_000_000),
        }
    }
}

impl DdsQos {
    pub(crate) fn to_ffi(self) -> ffi::Qos {
        let span = |ns: Option<i64>| ns.map_or(i64::MAX, |ns| ns.max(0));
        let depth = self.depth.map_or(1, |depth| depth.clamp(1, i32::MAX as usize));
        ffi::Qos {
            deadline_ns: span(self.deadline_ns),
            lifespan_ns: span(self.lifespan_ns),
            lease_ns: span(self.lease_ns),
            blocking_ns: span(self.blocking_ns),
            reliability: self.is_reliable.into(),
            durability: self.durability as i32,
            history: self.depth.is_none().into(),
            depth: i32::try_from(depth).unwrap_or(i32::MAX),
            liveliness: self.liveliness as i32,
            unused: 0,
        }
    }

    pub(crate) fn from_ffi(from: &ffi::Qos) -> Self {
        let span = |ns: i64| (ns != i64::MAX).then_some(ns);
        Self {
            is_reliable: from.reliability != 0,
            durability: match from.durability {
                0 => DdsDurability::Volatile,
                1 => DdsDurability::TransientLocal,
                2 => DdsDurability::Transient,
                _ => DdsDurability::Persistent,
            },
            depth: match from.history {
                0 => Some(usize::try_from(from.depth).unwrap_or(0)),
                1 => None,
                _ => Some(0),
            },
            deadline_ns: span(from.deadline_ns),
            lifespan_ns: span(from.lifespan_ns),
            liveliness: match from.liveliness {
                0 => DdsLiveliness::Automatic,
                1 => DdsLiveliness::ManualByParticipant,
                _ => DdsLiveliness::ManualByTopic,
            },
            lease_ns: span(from.lease_ns),
            blocking_ns: span(from.blocking_ns),
        }
    }
}
