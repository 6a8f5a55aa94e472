//! QoS conversion between graph and DDS.

use periplus_cyclonedds_sys as dds;
use periplus_graph::{Durability, History, Liveliness, Qos, Reliability};

/// Maximum blocking time of a writer without buffer space \[ns\]; the send is retried after the
/// other writers.
const BLOCKING_NS: i64 = 3_000_000;

/// Depth used for a `KEEP_ALL` history; DDS would keep samples until memory is exhausted.
pub(crate) const MOST_KEPT: usize = 10_000;

pub(crate) fn to_dds(qos: &Qos) -> dds::DdsQos {
    let depth = match qos.history {
        History::KeepLast => qos.depth.clamp(1, MOST_KEPT),
        History::KeepAll => MOST_KEPT,
    };
    dds::DdsQos {
        is_reliable: qos.reliability == Reliability::Reliable,
        durability: match qos.durability {
            Durability::Volatile => dds::DdsDurability::Volatile,
            Durability::TransientLocal => dds::DdsDurability::TransientLocal,
        },
        depth: Some(depth),
        deadline_ns: qos.deadline_ns,
        lifespan_ns: qos.lifespan_ns,
        liveliness: match qos.liveliness {
            Liveliness::Automatic => dds::DdsLiveliness::Automatic,
            Liveliness::ManualByTopic => dds::DdsLiveliness::ManualByTopic,
        },
        lease_ns: qos.lease_ns,
        blocking_ns: Some(BLOCKING_NS),
    }
}

/// Converts QoS from DDS. Policies that ROS does not have map to the next weaker one.
pub(crate) fn from_dds(qos: &dds::DdsQos) -> Qos {
    let reliability = if qos.is_reliable { Reliability::Reliable } else { Reliability::BestEffort };
    let (history, depth) = match qos.depth {
        Some(depth) => (History::KeepLast, depth),
        None => (History::KeepAll, 0),
    };
    Qos {
        reliability,
        durability: match qos.durability {
            dds::DdsDurability::Volatile => Durability::Volatile,
            _ => Durability::TransientLocal,
        },
        history,
        depth,
        deadline_ns: qos.deadline_ns,
        lifespan_ns: qos.lifespan_ns,
        liveliness: match qos.liveliness {
            dds::DdsLiveliness::ManualByTopic => Liveliness::ManualByTopic,
            _ => Liveliness::Automatic,
        },
        lease_ns: qos.lease_ns,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_policy_goes_there_and_back() {
        let full = Qos {
            deadline_ns: Some(100),
            lifespan_ns: Some(200),
            lease_ns: Some(300),
            liveliness: Liveliness::ManualByTopic,
            ..Qos::latched(3)
        };
        for qos in [full, Qos::sensor_data(), Qos::default(), Qos::latched(1), Qos::clock()] {
            assert_eq!(from_dds(&to_dds(&qos)), qos);
        }
        // A `KEEP_ALL` history gets a limit.
        assert_eq!(to_dds(&Qos::default().keep_all()).depth, Some(MOST_KEPT));
    }
}
