//! A graph recorded.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::{BagInfo, BagTopic, Stamp, Style, Target, Translation};
use periplus_diagnostics::Diagnostics;
use periplus_graph::{Graph, Qos, Sample, Sink, TapId, TopicInfo};
use periplus_msgs::TypeRegistry;

use crate::files::profile::profile;
use crate::files::{BagError, BagWriter, Storage, WriteSettings};

/// Which topics are recorded.
pub type Wanted = Box<dyn Fn(&TopicInfo) -> bool + Send + Sync>;

/// What is recorded, and how.
pub struct RecordSettings {
    /// How it is written.
    pub write: WriteSettings,
    /// Which topics.
    pub wanted: Wanted,
    /// How many messages may wait in live while the disk is busy.
    pub depth: usize,
    /// Tells the time at which a message is recorded \[ns\]; none for that of the graph.
    pub clock: Option<Now>,
    /// QoS of the publishers of a topic by its full name; none for those that the graph has. A
    /// recorder of other programs knows these from discovery: what stands for them in the graph keeps
    /// as many messages as the recorder asked for.
    pub offered: Option<Offered>,
}

/// Tells the time \[ns\].
pub type Now = Box<dyn Fn() -> i64 + Send + Sync>;

/// QoS of the publishers of a topic. A depth of 0 is one that they do not announce.
pub type Offered = Box<dyn Fn(&str) -> Vec<Qos> + Send + Sync>;

impl RecordSettings {
    /// All topics.
    #[must_use]
    pub fn all(write: WriteSettings) -> Self {
        Self { write, wanted: Box::new(|_| true), depth: 10_000, clock: None, offered: None }
    }
}

/// Writes what is published on a graph to a recording, at the times of the graph.
pub struct Recorder {
    graph: Graph,
    tap: TapId,
    shared: Arc<Shared>,
}

/// What was recorded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recording {
    /// What is in it.
    pub info: BagInfo,
    /// How many messages came too fast for the disk.
    pub dropped: u64,
}

struct Shared {
    settings: RecordSettings,
    state: Mutex<State>,
}

struct State {
    /// None once it has ended or failed.
    writer: Option<BagWriter>,
    /// None for those that cannot be recorded.
    topics: BTreeMap<String, Option<Way>>,
    failure: Option<BagError>,
    messages: u64,
}

/// How the messages of a topic are written.
struct Way {
    id: usize,
    /// For bags of ROS 1.
    translation: Translation,
}

struct BagSink(Arc<Shared>);

impl Recorder {
    /// Begins a recording; see [`BagWriter::create`].
    ///
    /// # Errors
    /// When it cannot be made.
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
        };
        let shared = Arc::new(Shared { settings, state: Mutex::new(state) });
        let tap = graph.tap(Box::new(BagSink(shared.clone())));
        Ok(Self { graph: graph.clone(), tap, shared })
    }

    /// Puts on the disk what has waited for a second, by the clock of the graph. To be called from
    /// time to time, for topics that fell silent.
    ///
    /// # Errors
    /// When a message could not be kept; nothing more is recorded then.
    pub fn keep(&self) -> Result<(), BagError> {
        let settings = &self.shared.settings;
        let now_ns = settings.clock.as_ref().map_or_else(|| self.graph.now_ns(), |now| now());
        let mut state = self.shared.lock();
        if let Some(Err(error)) = state.writer.as_mut().map(|writer| writer.advance_to(now_ns)) {
            state.fail(error);
        }
        state.failure.take().map_or(Ok(()), Err)
    }

    /// How many messages were recorded.
    #[must_use]
    pub fn messages(&self) -> u64 {
        self.shared.lock().messages
    }

    /// Ends the recording.
    ///
    /// # Errors
    /// When a message could not be kept, or the end cannot be written.
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
        let time_ns = settings.clock.as_ref().map_or(sample.time_ns, |now| now());
        if let Err(error) = state.take(settings, topic, sample, time_ns) {
            state.fail(error);
        }
    }
}

impl State {
    /// After a failure nothing more is taken; it is told at the end.
    fn fail(&mut self, error: BagError) {
        self.failure.get_or_insert(error);
        self.writer = None;
    }

    fn take(
        &mut self,
        settings: &RecordSettings,
        topic: &TopicInfo,
        sample: &Sample,
        time_ns: i64,
    ) -> Result<(), BagError> {
        let Some(writer) = &mut self.writer else { return Ok(()) };
        if !self.topics.contains_key(&topic.name) {
            let way = way(writer, settings, topic)?;
            self.topics.insert(topic.name.clone(), way);
        }
        let Some(Some(way)) = self.topics.get_mut(&topic.name) else { return Ok(()) };
        // A message that no wire could send is none for a recording either.
        let Ok(bytes) = sample.cdr() else { return Ok(()) };
        let Ok(data) = way.translation.translate(bytes) else { return Ok(()) };
        writer.write(way.id, Stamp::at(time_ns), data)?;
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
    Ok(Some(Way { id, translation }))
}

/// A topic of a graph as recordings have it.
fn describe(topic: &TopicInfo, offered: &[Qos]) -> BagTopic {
    let types = TypeRegistry::builtin();
    let text = types.schema_text(&topic.type_name).unwrap_or_default();
    let hash = topic.type_hash.clone().or_else(|| types.hash(&topic.type_name));
    let profiles = offered.iter().map(profile).collect();
    let info = crate::TopicInfo {
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
