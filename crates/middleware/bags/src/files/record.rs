//! Recording of a graph.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::{BagInfo, BagTopic, Stamp, Style, Target, Translation};
use periplus_diagnostics::Diagnostics;
use periplus_graph::{Durability, Graph, Qos, Sample, Sink, TapId, TopicInfo};
use periplus_msgs::TypeRegistry;

use crate::files::profile::profile;
use crate::files::{BagError, BagWriter, Storage, WriteSettings};

/// Filter of topics to record.
pub type RecordFilter = Box<dyn Fn(&TopicInfo) -> bool + Send + Sync>;

/// Settings of a recorder.
pub struct RecordSettings {
    /// Settings of the bag.
    pub write: WriteSettings,
    /// Topics to record.
    pub wanted: RecordFilter,
    /// Queue depth in live mode, while the disk is busy.
    pub depth: usize,
    /// Clock for the time of recording \[ns\]; none for the time of the graph.
    pub clock: Option<Now>,
    /// QoS of the publishers of a topic by its full name; none to use those of the graph. A
    /// recorder of remote topics knows them from discovery; the publishers that represent them in
    /// the graph have the depth that the recorder requested.
    pub offered: Option<Offered>,
}

/// Returns the time \[ns\].
pub type Now = Box<dyn Fn() -> i64 + Send + Sync>;

/// Returns the QoS of the publishers of a topic. A depth of 0 is unknown.
pub type Offered = Box<dyn Fn(&str) -> Vec<Qos> + Send + Sync>;

impl RecordSettings {
    /// Records all topics.
    #[must_use]
    pub fn all(write: WriteSettings) -> Self {
        Self { write, wanted: Box::new(|_| true), depth: 10_000, clock: None, offered: None }
    }
}

/// Records the topics of a graph, with the times of the graph.
pub struct Recorder {
    graph: Graph,
    tap: TapId,
    shared: Arc<Shared>,
}

/// Result of a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recording {
    /// Content of the bag.
    pub info: BagInfo,
    /// Number of messages lost because the disk was too slow.
    pub dropped: u64,
}

struct Shared {
    settings: RecordSettings,
    /// Time at which the recording began, by the clock of the graph \[ns\].
    start_ns: i64,
    state: Mutex<State>,
}

struct State {
    /// None after the end or a failure.
    writer: Option<BagWriter>,
    /// None for topics that cannot be recorded.
    topics: BTreeMap<String, Option<Way>>,
    failure: Option<BagError>,
    messages: u64,
    /// True once the clock of the graph was behind the start: a simulation was reset.
    is_reset: bool,
}

/// A recorded topic.
struct Way {
    id: usize,
    /// True while only retained messages were received, which were published before the start.
    is_retained: bool,
    /// Conversion, for ROS 1 bags.
    translation: Translation,
}

struct BagSink(Arc<Shared>);

impl Recorder {
    /// Starts a recording; see [`BagWriter::create`].
    ///
    /// # Errors
    /// When it cannot be created.
    pub fn start(
        graph: &Graph,
        path: impl AsRef<Path>,
        settings: RecordSettings,
    ) -> Result<Self, BagError> {
        let write = WriteSettings { is_live: true, ..settings.write.clone() };
        let state = State {
            writer: Some(BagWriter::create(path, write)?),
            topics: BTreeMap::new(),
            failure: None,
            messages: 0,
            is_reset: false,
        };
        let start_ns = graph.now_ns();
        let shared = Arc::new(Shared { settings, start_ns, state: Mutex::new(state) });
        let tap = graph.tap(Box::new(BagSink(shared.clone())));
        Ok(Self { graph: graph.clone(), tap, shared })
    }

    /// Writes messages older than a second to disk, by the clock of the graph. Call it
    /// periodically, for topics that have stopped.
    ///
    /// # Errors
    /// When a message could not be written; the recording has stopped then.
    pub fn keep(&self) -> Result<(), BagError> {
        let settings = &self.shared.settings;
        let now_ns = settings.clock.as_ref().map_or_else(|| self.graph.now_ns(), |now| now());
        let mut state = self.shared.lock();
        if let Some(Err(error)) = state.writer.as_mut().map(|writer| writer.advance_to(now_ns)) {
            state.fail(error);
        }
        state.failure.take().map_or(Ok(()), Err)
    }

    /// Number of messages recorded.
    #[must_use]
    pub fn messages(&self) -> u64 {
        self.shared.lock().messages
    }

    /// Ends the recording.
    ///
    /// # Errors
    /// When a message could not be written, or the file cannot be completed.
    pub fn finish(self) -> Result<Recording, BagError> {
        let dropped = self.graph.tap_dropped(self.tap);
        self.graph.untap(self.tap);
        let mut state = self.shared.lock();
        if let Some(failure) = state.failure.take() {
            return Err(failure);
        }
        let info = match state.writer.take() {
            Some(writer) => writer.finish()?,
            None => BagInfo::default(),
        };
        Ok(Recording { info, dropped })
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Sink for BagSink {
    fn wants(&self, topic: &TopicInfo) -> bool {
        (self.0.settings.wanted)(topic)
    }

    fn depth(&self) -> usize {
        self.0.settings.depth
    }

    fn take(&self, topic: &TopicInfo, sample: &Sample) {
        let mut state = self.0.lock();
        let settings = &self.0.settings;
        let stamp = match &settings.clock {
            Some(now) => Stamp::at(now()),
            None => Stamp {
                log_ns: state.reception_ns(topic, sample, self.0.start_ns),
                ..Stamp::at(sample.time_ns)
            },
        };
        if let Err(error) = state.take(settings, topic, sample, stamp) {
            state.fail(error);
        }
    }
}

impl State {
    /// Stops recording after a failure, which [`Recorder::finish`] returns.
    fn fail(&mut self, error: BagError) {
        self.failure.get_or_insert(error);
        self.writer = None;
    }

    /// Time at which the recorder received a message. As in rosbag2, a latched message that was
    /// published before the recording began is received at the beginning.
    fn reception_ns(&mut self, topic: &TopicInfo, sample: &Sample, start_ns: i64) -> i64 {
        let time_ns = sample.time_ns;
        let is_first = match self.topics.get_mut(&topic.name) {
            Some(Some(way)) => {
                way.is_retained &= time_ns < start_ns;
                way.is_retained
            }
            Some(None) => false,
            None => true,
        };
        let is_latched =
            topic.publishers.iter().any(|it| it.qos.durability == Durability::TransientLocal);
        if time_ns >= start_ns {
            return time_ns;
        }
        self.is_reset |= !is_latched;
        if is_first && !self.is_reset { start_ns } else { time_ns }
    }

    fn take(
        &mut self,
        settings: &RecordSettings,
        topic: &TopicInfo,
        sample: &Sample,
        stamp: Stamp,
    ) -> Result<(), BagError> {
        let Some(writer) = &mut self.writer else { return Ok(()) };
        if !self.topics.contains_key(&topic.name) {
            let mut way = way(writer, settings, topic)?;
            if let Some(way) = &mut way {
                way.is_retained = stamp.publish_ns < stamp.log_ns;
            }
            self.topics.insert(topic.name.clone(), way);
        }
        let Some(Some(way)) = self.topics.get_mut(&topic.name) else { return Ok(()) };
        // A message that cannot be encoded is not recorded.
        let Ok(bytes) = sample.cdr() else { return Ok(()) };
        let Ok(data) = way.translation.translate(bytes) else { return Ok(()) };
        writer.write(way.id, stamp, data)?;
        self.messages += 1;
        Ok(())
    }
}

fn way(
    writer: &mut BagWriter,
    settings: &RecordSettings,
    topic: &TopicInfo,
) -> Result<Option<Way>, BagError> {
    let offered = match &settings.offered {
        Some(offered) => offered(&topic.name),
        None => topic.publishers.iter().map(|publisher| publisher.qos).collect(),
    };
    let target = if settings.write.storage == Storage::Ros1 { Target::Ros1 } else { Target::Ros2 };
    let mut unused = Diagnostics::new();
    let Some(translation) = Translation::new(&describe(topic, &offered), target, &mut unused)
    else {
        return Ok(None);
    };
    let id = writer.topic(translation.topic())?;
    Ok(Some(Way { id, is_retained: false, translation }))
}

/// A topic of a graph in the form of a bag.
fn describe(topic: &TopicInfo, offered: &[Qos]) -> BagTopic {
    let types = TypeRegistry::builtin();
    let text = types.schema_text(&topic.type_name).unwrap_or_default();
    let hash = topic.type_hash.clone().or_else(|| types.hash(&topic.type_name));
    let profiles = offered.iter().map(profile).collect();
    let info = crate::TopicInformation {
        name: topic.name.clone(),
        type_name: topic.type_name.clone(),
        type_hash: hash.clone().unwrap_or_default(),
        encoding: "cdr".into(),
        qos: profiles,
        messages: 0,
    };
    let metadata = [
        ("offered_qos_profiles".to_owned(), info.qos_text(Style::default())),
        ("topic_type_hash".to_owned(), hash.unwrap_or_default()),
    ];
    BagTopic {
        name: info.name,
        type_name: info.type_name,
        encoding: info.encoding,
        schema_encoding: if text.is_empty() { String::new() } else { "ros2msg".into() },
        schema: text.into(),
        metadata: metadata.into(),
    }
}
