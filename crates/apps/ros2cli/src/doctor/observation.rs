//! Data of a diagnosis.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use periplus_tf::TransformMonitor;

use super::network::NetworkSettings;
use crate::Seen;

/// Input of all rules.
#[derive(Clone, Debug, Default)]
pub struct SystemObservation {
    /// Nodes, topics and services.
    pub seen: Seen,
    /// Duration of the observation.
    pub time: Duration,
    /// Transforms.
    pub survey: TransformMonitor,
    /// Messages with a header, by topic.
    pub heard: BTreeMap<String, TopicStatistics>,
    /// Times on `/clock` \[ns\], the first and the last.
    pub clock: Option<(i64, i64)>,
    /// Number of backward jumps of `/clock`.
    pub clock_jumps: usize,
    /// `use_sim_time` of each node.
    pub simulated: BTreeMap<String, bool>,
    /// True for a robot alone on a plane: its sensors detect nothing, which is not a problem.
    pub is_alone: bool,
    /// Network of this machine, if relevant.
    pub network_settings: Option<NetworkSettings>,
}

/// Statistics of a topic.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TopicStatistics {
    /// Message type.
    pub type_name: String,
    /// Number of messages.
    pub count: usize,
    /// Arrival of the first and the last \[ns\].
    pub arrived_ns: (i64, i64),
    /// Newest stamp \[ns\].
    pub stamp_ns: i64,
    /// Frames of the messages.
    pub frames: BTreeSet<String>,
    /// Statistics of scans.
    pub scans: Option<ScanFacts>,
    /// Expected rate, if known \[Hz\].
    pub wanted_hz: Option<f64>,
}

impl TopicStatistics {
    /// Measured rate \[Hz\].
    #[must_use]
    pub fn rate_hz(&self) -> Option<f64> {
        let span_ns = self.arrived_ns.1 - self.arrived_ns.0;
        (self.count > 1 && span_ns > 0).then(|| (self.count - 1) as f64 * 1e9 / span_ns as f64)
    }
}

/// Counts of the readings of all scans (REP 117).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScanFacts {
    /// All readings.
    pub readings: usize,
    /// Within `range_min` and `range_max`.
    pub good: usize,
    /// NaN.
    pub nan: usize,
    /// Exactly zero.
    pub zero: usize,
    /// Beyond `range_max`.
    pub far: usize,
    /// At `range_min` or nearer.
    pub near: usize,
}
