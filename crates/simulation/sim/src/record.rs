//! Recording to a bag.

use std::collections::BTreeMap;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use periplus_bags::{
    BagInfo, Compression, QosProfile, Settings, Stamp, Style, Topic, TopicId, WriteError, Writer,
};
use periplus_diagnostics::plain_words;
use periplus_graph::{
    Durability, GraphError, History, Liveliness, Mailbox, NodeSettings, Qos, Reliability, Sample,
    Sink, TapId, TopicInfo,
};
use periplus_msgs::TypeRegistry;
use periplus_msgs::gazebo_msgs::ModelStates;
use periplus_msgs::vision_msgs::Detection3DArray;
use periplus_os::Stopwatch;
use periplus_os::fs::{self, File};

use crate::Simulation;
use crate::profile::Work;

/// Filter of the topics to record, by their full names.
pub type TopicFilter = Box<dyn Fn(&str) -> bool + Send + Sync>;

/// Writes published messages to a bag.
pub struct SimulationRecorder {
    path: PathBuf,
    /// Folder of `metadata.yaml`.
    folder: Option<PathBuf>,
    tap: TapId,
    shared: Arc<Shared>,
    /// Subscription that makes the simulation publish the true poses.
    truth: Option<Mailbox<ModelStates>>,
    /// Subscription that makes the simulation publish people.
    people: Option<Mailbox<Detection3DArray>>,
}

/// Topic of the true poses of all models in the frame of the world, `gazebo_msgs/msg/ModelStates`.
pub const TRUTH_TOPIC: &str = "/gazebo/model_states";

/// Topic of the true boxes of people, `vision_msgs/msg/Detection3DArray`.
pub const PEOPLE_TOPIC: &str = "/people";

/// Result of a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordingSummary {
    /// File or folder.
    pub path: PathBuf,
    /// Number of messages.
    pub messages: u64,
    /// Number of topics.
    pub topics: usize,
    /// Size of the file.
    pub bytes: u64,
}

/// Reasons that a bag is missing or incomplete.
#[derive(Debug)]
pub enum RecordError {
    /// A file or folder cannot be created.
    File(PathBuf, io::Error),
    /// The folder exists already.
    Exists(PathBuf),
    /// A message cannot be written.
    Write(WriteError),
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path, error) => {
                write!(f, "`{}` cannot be created: {}", path.display(), plain_words(error))
            }
            Self::Exists(path) => write!(
                f,
                "the folder `{}` exists already; remove it or use another name",
                path.display()
            ),
            Self::Write(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for RecordError {}

struct Shared {
    wanted: TopicFilter,
    state: Mutex<State>,
}

struct State {
    /// `None` after the end or a failure.
    writer: Option<Writer<File>>,
    topics: BTreeMap<String, TopicId>,
    /// Time of the start while the retained messages of latched topics are delivered \[ns\].
    start_ns: Option<i64>,
    failure: Option<WriteError>,
    spent: Duration,
}

struct BagSink(Arc<Shared>);

impl SimulationRecorder {
    /// Starts a bag: a file if the path ends in `.mcap` (an existing one is replaced), otherwise a
    /// new folder with a file and its `metadata.yaml`, like `ros2 bag`. `custom_data` are facts of the
    /// run by name, for the metadata.
    ///
    /// # Errors
    /// When the file cannot be created, or the folder exists.
    pub fn start(
        simulation: &Simulation,
        path: &Path,
        wanted: TopicFilter,
        custom_data: BTreeMap<String, String>,
    ) -> Result<Self, RecordError> {
        Self::start_with(simulation, path, Compression::default(), wanted, custom_data)
    }

    /// As [`Self::start`], with a compression.
    ///
    /// # Errors
    /// As for [`Self::start`], and when this build cannot compress in this way.
    pub fn start_with(
        simulation: &Simulation,
        path: &Path,
        compression: Compression,
        wanted: TopicFilter,
        custom_data: BTreeMap<String, String>,
    ) -> Result<Self, RecordError> {
        let is_file = path.extension().is_some_and(|extension| extension == "mcap");
        let folder = (!is_file).then(|| path.to_owned());
        let file = match &folder {
            None => path.to_owned(),
            Some(folder) => {
                if fs::exists(folder) {
                    return Err(RecordError::Exists(folder.clone()));
                }
                fs::create_dir_all(folder)
                    .map_err(|error| RecordError::File(folder.clone(), error))?;
                let name = folder.file_name().map(|name| name.to_string_lossy().into_owned());
                folder.join(format!("{}_0.mcap", name.unwrap_or_default()))
            }
        };
        let name = file.file_name().map(|name| name.to_string_lossy().into_owned());
        let sink = File::create(&file).map_err(|error| RecordError::File(file.clone(), error))?;
        let settings =
            Settings { compression, custom_data, ..Settings::new(name.unwrap_or_default()) };
        let writer = Writer::new(sink, settings).map_err(RecordError::Write)?;
        let state = State {
            writer: Some(writer),
            topics: BTreeMap::new(),
            start_ns: Some(simulation.time_ns()),
            failure: None,
            spent: Duration::ZERO,
        };
        let shared = Arc::new(Shared { wanted, state: Mutex::new(state) });
        let tap = simulation.graph().tap(Box::new(BagSink(Arc::clone(&shared))));
        shared.lock().start_ns = None;
        Ok(Self { path: file, folder, tap, shared, truth: None, people: None })
    }

    /// Records the true poses of all models on [`TRUTH_TOPIC`], too, and people on [`PEOPLE_TOPIC`].
    ///
    /// # Errors
    /// When the topic has another type.
    pub fn with_truth(mut self, simulation: &Simulation) -> Result<Self, GraphError> {
        let node = simulation.graph().node(NodeSettings::new("truth_recorder"))?;
        self.truth = Some(node.mailbox(TRUTH_TOPIC, Qos::reliable(1))?);
        if simulation.has_people() {
            self.people = Some(node.mailbox(PEOPLE_TOPIC, Qos::reliable(1))?);
        }
        Ok(self)
    }

    /// Returns the file of a failed recording and the reason; `None` without a failure.
    #[must_use]
    pub fn failure(&self) -> Option<(PathBuf, String)> {
        let state = self.shared.lock();
        state.failure.as_ref().map(|failure| (self.path.clone(), failure.to_string()))
    }

    /// Finishes the bag.
    ///
    /// # Errors
    /// When a message could not be written, or the end cannot be written.
    pub fn finish(self, simulation: &mut Simulation) -> Result<RecordingSummary, RecordError> {
        simulation.graph().untap(self.tap);
        let mut state = self.shared.lock();
        simulation.shares_mut().shift(Work::Sensing, Work::Recording, state.spent);
        if let Some(failure) = state.failure.take() {
            return Err(RecordError::Write(failure));
        }
        let Some(writer) = state.writer.take() else {
            return Ok(RecordingSummary {
                path: self.path.clone(),
                messages: 0,
                topics: 0,
                bytes: 0,
            });
        };
        let stopwatch = Stopwatch::start();
        let (file, info) = writer.finish().map_err(RecordError::Write)?;
        let bytes = file.metadata().map(|metadata| metadata.len()).unwrap_or_default();
        if let Some(folder) = &self.folder {
            write_metadata(folder, &info)?;
        }
        simulation.shares_mut().add(Work::Recording, stopwatch.elapsed());
        let path = self.folder.clone().unwrap_or_else(|| self.path.clone());
        Ok(RecordingSummary { path, messages: info.messages(), topics: info.topics.len(), bytes })
    }
}

fn write_metadata(folder: &Path, info: &BagInfo) -> Result<(), RecordError> {
    let path = folder.join("metadata.yaml");
    fs::write(&path, info.to_yaml(Style::default())).map_err(|error| RecordError::File(path, error))
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Sink for BagSink {
    fn wants(&self, topic: &TopicInfo) -> bool {
        (self.0.wanted)(&topic.name)
    }

    fn take(&self, topic: &TopicInfo, sample: &Sample) {
        let stopwatch = Stopwatch::start();
        let mut state = self.0.lock();
        state.take(topic, sample);
        state.spent += stopwatch.elapsed();
    }
}

impl State {
    /// After a failure no messages are written; `finish` reports it.
    fn take(&mut self, topic: &TopicInfo, sample: &Sample) {
        let Some(writer) = &mut self.writer else { return };
        // As in rosbag2, messages that were published before the start are received at the start.
        let log_ns = self.start_ns.map_or(sample.time_ns, |start| start.max(sample.time_ns));
        let stamp = Stamp { log_ns, ..Stamp::at(sample.time_ns) };
        if let Err(failure) = write(writer, &mut self.topics, topic, sample, stamp) {
            self.failure = Some(failure);
            self.writer = None;
        }
    }
}

fn write(
    writer: &mut Writer<File>,
    topics: &mut BTreeMap<String, TopicId>,
    topic: &TopicInfo,
    sample: &Sample,
    stamp: Stamp,
) -> Result<(), WriteError> {
    let id = match topics.get(&topic.name) {
        Some(id) => *id,
        None => {
            let id = writer.topic(description(topic))?;
            topics.insert(topic.name.clone(), id);
            id
        }
    };
    let bytes = sample.cdr().map_err(|_| WriteError::TooLong(topic.name.clone()))?;
    writer.write(id, stamp, bytes)
}

fn description(topic: &TopicInfo) -> Topic {
    let text = TypeRegistry::builtin().schema_text(&topic.type_name).unwrap_or_default();
    Topic {
        name: topic.name.clone(),
        type_name: topic.type_name.clone(),
        schema_text: text.to_owned(),
        type_hash: topic.type_hash.clone().unwrap_or_default(),
        qos: topic.publishers.iter().map(|publisher| profile(&publisher.qos)).collect(),
    }
}

fn profile(qos: &Qos) -> QosProfile {
    let span = |ns: Option<i64>| ns.and_then(|ns| u64::try_from(ns).ok());
    QosProfile {
        history: match qos.history {
            History::KeepLast => periplus_bags::History::KeepLast,
            History::KeepAll => periplus_bags::History::KeepAll,
        },
        depth: qos.depth as u64,
        reliability: match qos.reliability {
            Reliability::Reliable => periplus_bags::Reliability::Reliable,
            Reliability::BestEffort => periplus_bags::Reliability::BestEffort,
        },
        durability: match qos.durability {
            Durability::TransientLocal => periplus_bags::Durability::TransientLocal,
            Durability::Volatile => periplus_bags::Durability::Volatile,
        },
        deadline_ns: span(qos.deadline_ns),
        lifespan_ns: span(qos.lifespan_ns),
        liveliness: match qos.liveliness {
            Liveliness::Automatic => periplus_bags::Liveliness::Automatic,
            Liveliness::ManualByTopic => periplus_bags::Liveliness::ManualByTopic,
        },
        lease_ns: span(qos.lease_ns),
    }
}
