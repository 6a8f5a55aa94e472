//! A recording of the list.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use periplus_bags::BagTopic;
use periplus_bags::files::{IndexedBag, OpenProgress, RecordingFormat};
use periplus_msgs::Message as _;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_transport::lock;

use super::latched::{grid_of_updates, latched_depth};
use super::marker_index::{MarkerIndex, MarkerTopic};
use super::marks::MarkList;
use super::transform_index::TransformIndex;
use super::upload::TemporaryFolder;
use crate::foxglove::protocol::{OriginText, RecordingText, TimeNs, TopicText};

/// A recording of the list.
pub(super) struct Entry {
    pub(super) name: String,
    pub(super) path: PathBuf,
    pub(super) origin: Option<OriginText>,
    pub(super) state: EntryState,
    /// Folder that is removed with the recording.
    pub(super) _folder: Option<TemporaryFolder>,
}

/// State of a recording.
pub(super) enum EntryState {
    /// Being read, or made by a job.
    Opening(Arc<EntryProgress>),
    /// Open for replay.
    Ready(Arc<Recording>),
    /// Unreadable, with the reason.
    Failed(String),
}

/// Progress of a recording that is being opened or made.
#[derive(Debug, Default)]
pub(super) struct EntryProgress {
    /// Progress of the job, 0 to 1, as bits; a recording that is only opened has none.
    job: AtomicU32,
    pub(super) is_cancelled: AtomicBool,
    pub(super) opening: OpenProgress,
}

impl EntryProgress {
    pub(super) fn set_job(&self, fraction: f32) {
        self.job.store(fraction.clamp(0.0, 1.0).to_bits(), Ordering::Relaxed);
    }

    pub(super) fn fraction(&self) -> f64 {
        let job = f64::from(f32::from_bits(self.job.load(Ordering::Relaxed)));
        let fraction = if job > 0.0 { job } else { self.opening.fraction() };
        if fraction.is_finite() { fraction } else { 0.0 }
    }

    pub(super) fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
        self.opening.cancel();
    }
}

/// A recording that can be replayed.
pub(super) struct Recording {
    pub(super) bag: IndexedBag,
    /// For each topic, the number of messages that late subscribers get; none if it is not latched.
    pub(super) latched: Vec<Option<usize>>,
    /// True for topics of transforms.
    pub(super) is_transforms: Vec<bool>,
    /// For each topic of markers, the type of its messages.
    pub(super) marker_topics: Vec<Option<MarkerTopic>>,
    /// For each topic with updates of a grid, the topic of the grid.
    pub(super) grid_of_updates: Vec<Option<usize>>,
    pub(super) transforms: TransformIndex,
    pub(super) markers: MarkerIndex,
    pub(super) marks: MarkList,
    /// Ends the background pass.
    pub(super) is_closed: AtomicBool,
    /// Number of running fetches of messages, for which the background pass waits.
    pub(super) fetches: AtomicUsize,
    /// Problems of the background pass.
    notes: Mutex<Vec<String>>,
}

impl Recording {
    pub(super) fn new(bag: IndexedBag) -> Self {
        let topics = bag.topics();
        let is_transforms =
            |topic: &BagTopic| topic.type_name == TFMessage::TYPE_NAME && topic.encoding == "cdr";
        Self {
            latched: topics.iter().map(latched_depth).collect(),
            is_transforms: topics.iter().map(is_transforms).collect(),
            marker_topics: topics.iter().map(MarkerTopic::of).collect(),
            grid_of_updates: topics.iter().map(|topic| grid_of_updates(topic, topics)).collect(),
            transforms: TransformIndex::default(),
            markers: MarkerIndex::default(),
            marks: MarkList::default(),
            is_closed: AtomicBool::new(false),
            fetches: AtomicUsize::new(0),
            notes: Mutex::default(),
            bag,
        }
    }

    /// Notes a problem, which is one of the findings then.
    pub(super) fn note(&self, problem: String) {
        lock(&self.notes).push(problem);
    }

    /// Index of a topic by its id.
    pub(super) fn topic(&self, id: u32) -> Option<usize> {
        let index = usize::try_from(id.checked_sub(1)?).ok()?;
        (index < self.bag.topics().len()).then_some(index)
    }
}

/// Id of a topic.
pub(super) fn topic_id(index: usize) -> u32 {
    u32::try_from(index).map_or(u32::MAX, |index| index.saturating_add(1))
}

impl Entry {
    /// Description of the recording.
    pub(super) fn text(&self, id: u32) -> RecordingText {
        let mut text = RecordingText {
            id,
            name: self.name.clone(),
            kind: "",
            state: "opening",
            progress: 0.0,
            error: None,
            start_ns: TimeNs(0),
            end_ns: TimeNs(0),
            bytes: 0,
            message_count: 0,
            findings: Vec::new(),
            origin: self.origin.clone(),
            is_temporary: self._folder.is_some(),
            custom_data: BTreeMap::new(),
            topics: Vec::new(),
        };
        match &self.state {
            EntryState::Opening(progress) => text.progress = progress.fraction(),
            EntryState::Failed(why) => {
                text.state = "failed";
                text.error = Some(why.clone());
            }
            EntryState::Ready(recording) => describe(recording, &mut text),
        }
        text
    }
}

fn describe(recording: &Recording, text: &mut RecordingText) {
    let bag = &recording.bag;
    let (start_ns, end_ns) = bag.span_ns().unwrap_or((0, 0));
    text.state = "ready";
    text.progress = 1.0;
    text.kind = match bag.format() {
        RecordingFormat::Mcap => "mcap",
        RecordingFormat::Rosbag2 => "rosbag2",
        RecordingFormat::Ros1 => "ros1",
        RecordingFormat::Carmen => "carmen",
    };
    (text.start_ns, text.end_ns) = (TimeNs(start_ns), TimeNs(end_ns));
    (text.bytes, text.message_count) = (bag.bytes(), bag.message_count());
    text.custom_data.clone_from(bag.custom_data());
    let found = bag.findings().iter().map(|finding| finding.message.to_string());
    text.findings = found.chain(bag.faults()).chain(lock(&recording.notes).clone()).collect();
    let topics = bag.topics().iter().zip(bag.counts()).enumerate();
    text.topics = topics
        .map(|(index, (topic, count))| TopicText {
            id: topic_id(index),
            topic: topic.name.clone(),
            encoding: topic.encoding.clone(),
            schema_name: topic.type_name.clone(),
            schema_encoding: topic.schema_encoding.clone(),
            schema: String::from_utf8_lossy(&topic.schema).into_owned(),
            count: *count,
            is_latched: recording.latched.get(index).is_some_and(Option::is_some),
        })
        .collect();
}
