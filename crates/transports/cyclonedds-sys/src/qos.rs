//! Quality of service, as DDS has it.

use crate::ffi;

/// Whether a latecomer gets what was written before. The order is that of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Durability {
    /// No.
    Volatile,
    /// As long as the writer lives.
    TransientLocal,
    /// As long as a service outside keeps it.
    Transient,
    /// For ever.
    Persistent,
}

/// Who says that a writer lives. The order is that of strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Liveliness {
    /// Its program, all the time.
    Automatic,
    /// Any writer of its participant.
    ManualByParticipant,
    /// It itself.
    ManualByTopic,
}

/// What a writer offers or a reader asks for. Times are in ns, none is infinite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Qos {
    /// Whether what is lost is sent again.
    pub is_reliable: bool,
    /// Whether latecomers get the last samples.
    pub durability: Durability,
    /// How many samples are kept: none for all. Of others it is known only if they tell; 0 if not.
    pub depth: Option<usize>,
    /// Most time from sample to sample.
    pub deadline_ns: Option<i64>,
    /// Age at which a sample is too old.
    pub lifespan_ns: Option<i64>,
    /// Who says that a writer lives.
    pub liveliness: Liveliness,
    /// How long it may be silent about that.
    pub lease_ns: Option<i64>,
    /// How long a reliable writer waits for room before it gives up.
    pub blocking_ns: Option<i64>,
}

/// Reliable and volatile, the last ten; a writer waits 100 ms.
impl Default for Qos {
    fn default() -> Self {
        Self {
            is_reliable: true,
            durability: Durability::Volatile,
            depth: Some(10),
            deadline_ns: None,
            lifespan_ns: None,
            liveliness: Liveliness::Automatic,
            lease_ns: None,
            blocking_ns: Some(100_000_000),
        }
    }
}

impl Qos {
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
                0 => Durability::Volatile,
                1 => Durability::TransientLocal,
                2 => Durability::Transient,
                _ => Durability::Persistent,
            },
            depth: match from.history {
                0 => Some(usize::try_from(from.depth).unwrap_or(0)),
                1 => None,
                _ => Some(0),
            },
            deadline_ns: span(from.deadline_ns),
            lifespan_ns: span(from.lifespan_ns),
            liveliness: match from.liveliness {
                0 => Liveliness::Automatic,
                1 => Liveliness::ManualByParticipant,
                _ => Liveliness::ManualByTopic,
            },
            lease_ns: span(from.lease_ns),
            blocking_ns: span(from.blocking_ns),
        }
    }
}
