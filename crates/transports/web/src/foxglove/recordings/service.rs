//! The recordings of a server.

use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, Weak};

use periplus_bags::files::{BagError, ChunkCache, IndexedBag};
use periplus_graph::Graph;
use periplus_os::{fs, start_thread};
use periplus_transport::lock;
use serde_json::{Map, Value};

use super::background;
use super::entry::{Entry, EntryProgress, EntryState, Recording};
use super::jobs::{JobRequest, Jobs};
use super::live::LiveRecording;
use super::upload::{TemporaryFolder, UploadedRecording};
use crate::foxglove::outbox::Outbox;
use crate::foxglove::protocol::{self, OriginText};

/// Maximum number of recordings.
const MAX_RECORDINGS: usize = 64;

/// Change of progress at which clients get it, 0 to 1.
const PROGRESS_STEP: f64 = 0.01;

/// Calls of [`Recordings::tick`] between two checks.
const TICKS_PER_CHECK: u32 = 5;

/// Folders and limits of recordings.
#[derive(Clone, Debug)]
pub struct RecordingSettings {
    /// Folder in which recordings of the graph are created.
    pub record_folder: PathBuf,
    /// Folder for uploads while they are open.
    pub upload_folder: PathBuf,
    /// Maximum size of an upload \[bytes\].
    pub upload_max_bytes: u64,
    /// Facts by name that recordings of the graph contain.
    pub custom_data: BTreeMap<String, String>,
}

impl RecordingSettings {
    /// Folders, and uploads of at most 64 GiB.
    #[must_use]
    pub fn new(record_folder: impl Into<PathBuf>, upload_folder: impl Into<PathBuf>) -> Self {
        Self {
            record_folder: record_folder.into(),
            upload_folder: upload_folder.into(),
            upload_max_bytes: 64 << 30,
            custom_data: BTreeMap::new(),
        }
    }
}

/// Reason for which a recording cannot be opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OpenRecordingError {
    /// Too many recordings are open.
    TooMany,
    /// The system starts no thread, with the reason.
    NoThread(String),
}

impl fmt::Display for OpenRecordingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooMany => write!(f, "{MAX_RECORDINGS} recordings are open; close one first"),
            Self::NoThread(why) => write!(f, "no thread can be started: {why}"),
        }
    }
}

impl std::error::Error for OpenRecordingError {}

/// The recordings of a server, shared by all clients.
pub struct Recordings {
    pub(super) settings: RecordingSettings,
    state: Mutex<State>,
    jobs: Mutex<Option<Arc<dyn Jobs>>>,
    /// Decompressed chunks of all recordings.
    cache: Arc<ChunkCache>,
}

#[derive(Default)]
struct State {
    last_id: u32,
    entries: BTreeMap<u32, Entry>,
    /// Clients that get the list.
    subscribers: BTreeMap<u64, Arc<Outbox>>,
    live: Option<LiveRecording>,
    ticks: u32,
    /// Sum of the progress of all recordings that clients have.
    sent_progress: f64,
}

impl Recordings {
    /// Creates a service without recordings.
    #[must_use]
    pub fn new(settings: RecordingSettings) -> Arc<Self> {
        Arc::new(Self {
            settings,
            state: Mutex::default(),
            jobs: Mutex::default(),
            cache: Arc::default(),
        })
    }

    /// Sets the estimators that clients may run.
    pub fn set_jobs(&self, jobs: Arc<dyn Jobs>) {
        *lock(&self.jobs) = Some(jobs);
    }

    /// Opens a recording in the background and returns its id.
    ///
    /// # Errors
    /// When too many recordings are open or the system starts no thread.
    pub fn open(self: &Arc<Self>, path: &Path) -> Result<u32, OpenRecordingError> {
        let (entry, progress) = opening(name_of(path), path.to_owned());
        self.add(entry, progress, self.opener())
    }

    /// True while a recording is being opened.
    #[must_use]
    pub fn is_opening(&self) -> bool {
        let state = lock(&self.state);
        state.entries.values().any(|entry| matches!(entry.state, EntryState::Opening(_)))
    }

    /// Reasons for which recordings cannot be read, in the order of opening.
    #[must_use]
    pub fn failures(&self) -> Vec<String> {
        let reason = |entry: &Entry| match &entry.state {
            EntryState::Failed(why) => Some(why.clone()),
            EntryState::Opening(_) | EntryState::Ready(_) => None,
        };
        lock(&self.state).entries.values().filter_map(reason).collect()
    }

    /// Opens an upload.
    pub(super) fn open_upload(
        self: &Arc<Self>,
        upload: UploadedRecording,
    ) -> Result<u32, OpenRecordingError> {
        let UploadedRecording { folder, name, path } = upload;
        let (entry, progress) = opening(name, path);
        self.add(Entry { _folder: Some(folder), ..entry }, progress, self.opener())
    }

    /// Opens recordings with the common cache.
    fn opener(
        &self,
    ) -> impl Fn(&Path, &EntryProgress) -> Result<IndexedBag, String> + Send + use<> {
        let cache = self.cache.clone();
        move |path, progress| {
            let opened = IndexedBag::open_sharing(path, &progress.opening, cache.clone());
            opened.map_err(|error| error.to_string())
        }
    }

    /// Adds a recording that `make` opens on a separate thread.
    fn add(
        self: &Arc<Self>,
        entry: Entry,
        progress: Arc<EntryProgress>,
        make: impl FnOnce(&Path, &EntryProgress) -> Result<IndexedBag, String> + Send + 'static,
    ) -> Result<u32, OpenRecordingError> {
        let path = entry.path.clone();
        let id = {
            let mut state = lock(&self.state);
            if state.entries.len() >= MAX_RECORDINGS {
                return Err(OpenRecordingError::TooMany);
            }
            state.last_id += 1;
            let id = state.last_id;
            state.entries.insert(id, entry);
            state.send();
            id
        };
        // The thread does not keep the service alive.
        let service = Arc::downgrade(self);
        let run = move || {
            let made = make(&path, &progress);
            if let Some(recording) = Self::opened(&service, id, made) {
                background::run(&recording);
            }
        };
        start_thread("recording", run).map_err(|error| {
            lock(&self.state).entries.remove(&id);
            OpenRecordingError::NoThread(error.to_string())
        })?;
        Ok(id)
    }

    /// Enters the result of opening; none if it failed or the recording was closed in between.
    fn opened(
        service: &Weak<Self>,
        id: u32,
        made: Result<IndexedBag, String>,
    ) -> Option<Arc<Recording>> {
        let service = service.upgrade()?;
        let mut state = lock(&service.state);
        let entry = state.entries.get_mut(&id)?;
        let recording = match made {
            Ok(bag) => {
                bag.path().clone_into(&mut entry.path);
                let recording = Arc::new(Recording::new(bag));
                entry.state = EntryState::Ready(recording.clone());
                Some(recording)
            }
            Err(why) => {
                entry.state = EntryState::Failed(why);
                None
            }
        };
        state.send();
        recording
    }

    /// A recording that can be replayed.
    ///
    /// # Errors
    /// A sentence for the user, when there is none.
    pub(super) fn ready(&self, id: u32) -> Result<Arc<Recording>, String> {
        match lock(&self.state).entries.get(&id).map(|entry| &entry.state) {
            Some(EntryState::Ready(recording)) => Ok(recording.clone()),
            Some(EntryState::Opening(_)) => Err(format!("recording {id} is not open yet")),
            Some(EntryState::Failed(why)) => Err(why.clone()),
            None => Err(format!("there is no recording {id}")),
        }
    }

    /// Closes a recording; ends opening it, and the job that makes it.
    pub(super) fn close(&self, id: u32) -> Result<(), String> {
        let mut state = lock(&self.state);
        let entry = state.entries.remove(&id);
        let entry = entry.ok_or_else(|| format!("there is no recording {id}"))?;
        entry.end();
        state.send();
        Ok(())
    }

    /// Sends the list to a client, now and at each change.
    pub(super) fn subscribe(&self, client: u64, outbox: &Arc<Outbox>) {
        let mut state = lock(&self.state);
        outbox.push(state.frame());
        state.subscribers.insert(client, outbox.clone());
    }

    pub(super) fn unsubscribe(&self, client: u64) {
        lock(&self.state).subscribers.remove(&client);
    }

    /// Parameters of a kind of job.
    pub(super) fn job_parameters(&self, kind: &str) -> Result<Value, String> {
        self.jobs()?.parameters(kind).map_err(|error| error.to_string())
    }

    pub(super) fn jobs(&self) -> Result<Arc<dyn Jobs>, String> {
        lock(&self.jobs).clone().ok_or_else(|| "this server runs no estimators".to_owned())
    }

    /// Runs a job over a recording; returns the id of the recording that it makes.
    pub(super) fn start_job(
        self: &Arc<Self>,
        kind: &str,
        source: u32,
        parameters: Map<String, Value>,
    ) -> Result<u32, String> {
        let jobs = self.jobs()?;
        let recording = self.ready(source)?;
        let path = recording.bag.path().to_owned();
        let name = {
            let state = lock(&self.state);
            let name = state.entries.get(&source).map(|entry| entry.name.clone());
            format!("{} ({kind})", name.unwrap_or_default())
        };
        let origin =
            OriginText { recording: source, kind: kind.to_owned(), parameters: parameters.clone() };
        let (entry, job_progress) = opening(name, path.clone());
        let folder = TemporaryFolder::create(&self.settings.upload_folder, "job")?;
        let out_folder = folder.path().to_owned();
        let entry = Entry { origin: Some(origin), _folder: Some(folder), ..entry };
        let job = JobRequest { kind: kind.to_owned(), path, parameters, out_folder };
        let open = self.opener();
        let added = self.add(entry, job_progress, move |_, progress| {
            // The files of an upload stay while the job reads them.
            let _source = recording;
            let report = |fraction| progress.set_job(fraction);
            let made = jobs.run(&job, &report, &progress.is_cancelled);
            let made = made.map_err(|error| error.to_string())?;
            open(&made, progress)
        });
        added.map_err(|error| error.to_string())
    }

    /// Starts to record the graph.
    pub(super) fn start_recording(&self, graph: &Graph) -> Result<(), String> {
        let mut state = lock(&self.state);
        if let Some(live) = &state.live {
            return Err(format!("`{}` is being recorded already", live.path.display()));
        }
        let live = LiveRecording::start(graph, &self.settings);
        state.live = Some(live.map_err(|error| error.to_string())?);
        state.send();
        Ok(())
    }

    /// Ends recording the graph and opens the result; returns the number of lost messages.
    pub(super) fn stop_recording(self: &Arc<Self>) -> Result<u64, String> {
        // Not under the lock: messages of the tap are written.
        let live = lock(&self.state).live.take();
        let live = live.ok_or_else(|| "nothing is being recorded".to_owned())?;
        let finished = live.finish();
        lock(&self.state).send();
        let (path, dropped) = finished.map_err(|error| error.to_string())?;
        self.open(&path).map_err(|error| error.to_string())?;
        Ok(dropped)
    }

    /// True while the graph is recorded.
    pub(crate) fn is_recording(&self) -> bool {
        lock(&self.state).live.is_some()
    }

    /// Sends progress and keeps the recording of the graph on the disk. Call it periodically.
    pub(crate) fn tick(&self) {
        let mut state = lock(&self.state);
        state.ticks = state.ticks.wrapping_add(1);
        if !state.ticks.is_multiple_of(TICKS_PER_CHECK) {
            return;
        }
        if let Some(live) = &state.live
            && let Err(error) = live.keep()
        {
            let path = live.path.clone();
            state.live = None;
            state.fail(&path, &error);
        }
        let progress = state.progress();
        if (progress - state.sent_progress).abs() >= PROGRESS_STEP {
            state.sent_progress = progress;
            state.send();
        }
    }

    /// Closes everything; a recording of the graph becomes complete.
    pub(crate) fn end(&self) {
        let mut state = lock(&self.state);
        std::mem::take(&mut state.entries).values().for_each(Entry::end);
        state.subscribers.clear();
        let live = state.live.take();
        drop(state);
        if let Some(live) = live {
            // No client is left that could show a failure.
            let _ = live.finish();
        }
    }
}

impl State {
    fn frame(&self) -> crate::foxglove::WebSocketFrame {
        let list: Vec<_> = self.entries.iter().map(|(id, entry)| entry.text(*id)).collect();
        protocol::recordings(&list, self.live.is_some())
    }

    /// Sends the list to all subscribers.
    fn send(&self) {
        if self.subscribers.is_empty() {
            return;
        }
        let frame = self.frame();
        self.subscribers.values().for_each(|outbox| outbox.push(frame.clone()));
    }

    /// Sum of the progress of all recordings that are being opened.
    fn progress(&self) -> f64 {
        let fraction = |entry: &Entry| match &entry.state {
            EntryState::Opening(progress) => progress.fraction(),
            EntryState::Ready(_) | EntryState::Failed(_) => 0.0,
        };
        self.entries.values().map(fraction).sum()
    }

    /// Lists a recording of the graph that failed.
    fn fail(&mut self, path: &Path, error: &BagError) {
        self.last_id += 1;
        let why = format!("the recording stopped: {error}; what came before can be opened");
        let (entry, _) = opening(name_of(path), path.into());
        let entry = Entry { state: EntryState::Failed(why), ..entry };
        self.entries.insert(self.last_id, entry);
        self.send();
    }
}

impl Entry {
    /// Ends all work for the recording.
    fn end(&self) {
        match &self.state {
            EntryState::Opening(progress) => progress.cancel(),
            EntryState::Ready(recording) => recording.is_closed.store(true, Ordering::Relaxed),
            EntryState::Failed(_) => {}
        }
    }
}

/// A recording that is being opened, with its progress.
fn opening(name: String, path: PathBuf) -> (Entry, Arc<EntryProgress>) {
    let progress = Arc::<EntryProgress>::default();
    let state = EntryState::Opening(progress.clone());
    (Entry { name, path, origin: None, state, _folder: None }, progress)
}

/// Name of a recording by its path.
fn name_of(path: &Path) -> String {
    let is_metadata = path.file_name().is_some_and(|name| name == "metadata.yaml");
    let named = if is_metadata { path.parent().unwrap_or(path) } else { path };
    let name = if fs::is_dir(named) { named.file_name() } else { named.file_stem() };
    name.unwrap_or(named.as_os_str()).to_string_lossy().into_owned()
}

impl std::fmt::Debug for Recordings {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Recordings").field("settings", &self.settings).finish_non_exhaustive()
    }
}
