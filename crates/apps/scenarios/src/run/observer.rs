//! Observation of messages: counts, times, stamps, the log and the digest.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use periplus_faults::{has_header, header_stamp_ns};
use periplus_graph::{Graph, Level, Sample, Sink, TapId, TopicInfo};
use periplus_msgs::rcl_interfaces::Log;

/// Topic of logs.
const LOG_TOPIC: &str = "/rosout";

/// Types of messages that are too large to record, and whose sensors are slow to simulate.
const HEAVY_TYPES: [&str; 5] = [
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/CompressedImage",
    "sensor_msgs/msg/CameraInfo",
    "sensor_msgs/msg/PointCloud2",
    "sensor_msgs/msg/PointCloud",
];

/// Maximum number of messages of a topic whose times are kept: ten hours at 100 Hz.
const MAX_RECORD_COUNT: usize = 3_600_000;

/// Maximum number of lines of the log.
const MAX_LOG_LINES: usize = 100_000;

/// Returns true if messages of this type are recorded and part of the digest.
pub(crate) fn is_light(type_name: &str) -> bool {
    !HEAVY_TYPES.contains(&type_name)
}

/// Messages of a watched topic.
#[derive(Clone, Debug, Default)]
pub(crate) struct TopicRecord {
    /// Times of publication \[ns\].
    pub(crate) times_ns: Vec<i64>,
    /// Stamps of the headers \[ns\], for types that have one.
    pub(crate) stamps_ns: Vec<i64>,
}

/// Observer of a graph.
pub(crate) struct Observer {
    shared: Arc<Shared>,
    tap: TapId,
}

struct Shared {
    watched: BTreeSet<String>,
    has_digest: bool,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    records: BTreeMap<String, TopicRecord>,
    log: Vec<String>,
    digest: Option<u64>,
    has_headers: BTreeMap<String, bool>,
}

impl Observer {
    /// Starts to watch topics. With `has_digest` all messages that are not heavy are hashed.
    pub(crate) fn start(graph: &Graph, watched: BTreeSet<String>, has_digest: bool) -> Self {
        let state = State { digest: has_digest.then_some(FNV_OFFSET), ..State::default() };
        let shared = Arc::new(Shared { watched, has_digest, state: Mutex::new(state) });
        let tap = graph.tap(Box::new(ObserverSink(shared.clone())));
        Self { shared, tap }
    }

    /// Number of messages of a watched topic so far.
    pub(crate) fn count(&self, topic: &str) -> usize {
        self.shared.lock().records.get(topic).map_or(0, |record| record.times_ns.len())
    }

    /// Ends the observation: records of the watched topics, lines of the log, and the digest.
    pub(crate) fn finish(
        self,
        graph: &Graph,
    ) -> (BTreeMap<String, TopicRecord>, Vec<String>, Option<u64>) {
        graph.untap(self.tap);
        let mut state = self.shared.lock();
        let (records, log) = (std::mem::take(&mut state.records), std::mem::take(&mut state.log));
        (records, log, state.digest)
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

struct ObserverSink(Arc<Shared>);

impl Sink for ObserverSink {
    fn wants(&self, topic: &TopicInfo) -> bool {
        let is_watched = topic.name == LOG_TOPIC || self.0.watched.contains(&topic.name);
        is_watched || self.0.has_digest && is_light(&topic.type_name)
    }

    fn take(&self, topic: &TopicInfo, sample: &Sample) {
        let mut state = self.0.lock();
        if self.0.watched.contains(&topic.name) {
            state.record(topic, sample);
        }
        if topic.name == LOG_TOPIC {
            state.log(sample);
        }
        if let Some(digest) = state.digest {
            let mut hash = fnv(digest, topic.name.as_bytes());
            hash = fnv(hash, &sample.time_ns.to_le_bytes());
            hash = sample.cdr().map_or(hash, |bytes| fnv(hash, bytes));
            state.digest = Some(hash);
        }
    }
}

impl State {
    fn record(&mut self, topic: &TopicInfo, sample: &Sample) {
        let is_stamped = match self.has_headers.get(&topic.type_name) {
            Some(has_header) => *has_header,
            None => {
                let is_stamped = has_header(&topic.type_name);
                self.has_headers.insert(topic.type_name.clone(), is_stamped);
                is_stamped
            }
        };
        let record = self.records.entry(topic.name.clone()).or_default();
        if record.times_ns.len() >= MAX_RECORD_COUNT {
            return;
        }
        record.times_ns.push(sample.time_ns);
        if is_stamped && let Some(stamp_ns) = sample.cdr().ok().and_then(header_stamp_ns) {
            record.stamps_ns.push(stamp_ns);
        }
    }

    fn log(&mut self, sample: &Sample) {
        let Ok(log) = sample.message::<Log>() else { return };
        if self.log.len() < MAX_LOG_LINES {
            let time_s = sample.time_ns as f64 * 1e-9;
            let level = format!("{:?}", Level::of_number(log.level)).to_uppercase();
            let (name, text) = (&log.name, &log.msg);
            self.log.push(format!("[{time_s:.3}] [{level}] [{name}]: {text}"));
        }
    }
}

const FNV_OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0100_0000_01b3;

/// FNV-1a on words of eight bytes, and on the bytes that are left: a digest for the comparison of equal runs, without
/// cryptographic strength. Source of the constants: G. Fowler, L. C. Noll, K.-P. Vo, "The FNV non-cryptographic hash
/// algorithm".
fn fnv(mut hash: u64, bytes: &[u8]) -> u64 {
    let mut words = bytes.chunks_exact(8);
    for word in words.by_ref() {
        let mut number = [0; 8];
        number.copy_from_slice(word);
        hash = (hash ^ u64::from_le_bytes(number)).wrapping_mul(FNV_PRIME);
        hash ^= hash >> 32;
    }
    for byte in words.remainder() {
        hash = (hash ^ u64::from(*byte)).wrapping_mul(FNV_PRIME);
    }
    (hash ^ bytes.len() as u64).wrapping_mul(FNV_PRIME)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digest_changes_with_every_byte_and_length() {
        let digest = |bytes: &[u8]| fnv(FNV_OFFSET, bytes);
        let bytes = [7_u8; 20];
        for index in 0..bytes.len() {
            for bit in 0..8 {
                let mut other = bytes;
                other[index] ^= 1 << bit;
                assert_ne!(digest(&bytes), digest(&other), "byte {index}, bit {bit}");
            }
        }
        assert_ne!(digest(&[0; 8]), digest(&[0; 16]));
    }
}
