//! What was seen and heard.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use periplus_tf::Survey;

use super::network::Surroundings;
use crate::Seen;

/// All that the rules look at.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// Who is there.
    pub seen: Seen,
    /// How long was listened.
    pub time: Duration,
    /// Frames.
    pub survey: Survey,
    /// Messages with a header, by topic.
    pub heard: BTreeMap<String, Heard>,
    /// Times on `/clock` \[ns\], the first and the last.
    pub clock: Option<(i64, i64)>,
    /// How often the time on `/clock` went back.
    pub clock_jumps: usize,
    /// What each node says of `use_sim_time`.
    pub simulated: BTreeMap<String, bool>,
    /// True for a robot alone on a plane: its sensors see nothing, and that is no fault.
    pub is_alone: bool,
    /// The machine, where it matters.
    pub surroundings: Option<Surroundings>,
}

/// What came on a topic.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heard {
    /// Its type.
    pub type_name: String,
    /// How many messages.
    pub count: usize,
    /// When the first and the last came \[ns\].
    pub arrived_ns: (i64, i64),
    /// The newest stamp \[ns\].
    pub stamp_ns: i64,
    /// The frames they name.
    pub frames: BTreeSet<String>,
    /// What is in scans.
    pub scans: Option<ScanFacts>,
    /// How often it should come, where that is known \[Hz\].
    pub wanted_hz: Option<f64>,
}

impl Heard {
    /// How often it came \[Hz\].
    #[must_use]
    pub fn rate_hz(&self) -> Option<f64> {
        let span_ns = self.arrived_ns.1 - self.arrived_ns.0;
        (self.count > 1 && span_ns > 0).then(|| (self.count - 1) as f64 * 1e9 / span_ns as f64)
    }
}

/// Readings of all scans, counted by what they say (REP 117).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScanFacts {
    /// All.
    pub readings: usize,
    /// Between both limits.
    pub good: usize,
    /// Not a number.
    pub nan: usize,
    /// Exactly zero.
    pub zero: usize,
    /// Farther than the sensor can see.
    pub far: usize,
    /// At the lower limit or nearer.
    pub near: usize,
}
