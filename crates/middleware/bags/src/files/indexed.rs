//! Random access to recordings.
//!
//! An [`IndexedBag`] finds the newest message of a topic at a time, and all messages of a span,
//! without reading what lies between: by the message indexes of MCAP and ROS 1 chunks, or a table
//! of times for databases. Several threads may use it at once.

mod carmen;
mod chunk_cache;
mod database_file;
mod location;
mod message_index;
mod open;
mod progress;
mod read_chunks;
mod stream_file;

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use periplus_diagnostics::Diagnostics;

use crate::files::{BagError, BagKind, Storage};
use crate::{BagTopic, Translation};

use chunk_cache::CachedChunks;
use database_file::DatabaseFile;
use stream_file::StreamFile;

pub(crate) use carmen::convert as convert_carmen;
pub(crate) use open::is_carmen_file;

pub use chunk_cache::ChunkCache;
pub use location::{LocationSpan, MessageLocation};
pub use progress::OpenProgress;

/// Format of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecordingFormat {
    /// A single MCAP file.
    Mcap,
    /// A folder of `ros2 bag`, or a database.
    Rosbag2,
    /// A ROS 1 bag.
    Ros1,
    /// A CARMEN log.
    Carmen,
}

/// True if chunks that were read are kept for the next requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChunkUse {
    /// Chunks are kept in the cache.
    Keep,
    /// Chunks are dropped: a pass over the whole recording would replace all others.
    Once,
}

/// A recording of any kind with random access. Messages are those of ROS 2: those of ROS 1 bags
/// and CARMEN logs are translated where their types have a counterpart.
pub struct IndexedBag {
    path: PathBuf,
    format: RecordingFormat,
    topics: Vec<BagTopic>,
    counts: Vec<u64>,
    span_ns: Option<(i64, i64)>,
    bytes: u64,
    custom_data: BTreeMap<String, String>,
    findings: Diagnostics,
    files: Vec<IndexedFile>,
    /// Conversion of each topic; none if its messages stay as they are.
    translations: Vec<Option<Mutex<Translation>>>,
    /// True for topics whose messages may be compressed one by one.
    is_cdr: Vec<bool>,
    cache: CachedChunks,
    faults: Mutex<Vec<String>>,
}

/// A file of a recording.
enum IndexedFile {
    Stream(StreamFile),
    Database(DatabaseFile),
}

/// Maximum number of faults kept.
const MAX_FAULTS: usize = 100;

impl IndexedBag {
    /// Opens a recording of any kind; see [`Bag::open`](crate::files::Bag::open). A file without a
    /// valid index is read completely, which `progress` shows.
    ///
    /// # Errors
    /// When there is no recording at the path, or opening was cancelled.
    pub fn open(path: impl AsRef<Path>, progress: &OpenProgress) -> Result<Self, BagError> {
        Self::open_sharing(path, progress, Arc::default())
    }

    /// Same as [`IndexedBag::open`], with a cache that several recordings share.
    ///
    /// # Errors
    /// As [`IndexedBag::open`].
    pub fn open_sharing(
        path: impl AsRef<Path>,
        progress: &OpenProgress,
        cache: Arc<ChunkCache>,
    ) -> Result<Self, BagError> {
        open::open(path.as_ref(), progress, CachedChunks::new(cache))
    }

    /// Path of the recording.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Format of the recording.
    #[must_use]
    pub fn format(&self) -> RecordingFormat {
        self.format
    }

    /// Topics.
    #[must_use]
    pub fn topics(&self) -> &[BagTopic] {
        &self.topics
    }

    /// Number of messages of each topic.
    #[must_use]
    pub fn counts(&self) -> &[u64] {
        &self.counts
    }

    /// Number of messages.
    #[must_use]
    pub fn message_count(&self) -> u64 {
        self.counts.iter().fold(0, |sum, count| u64::saturating_add(sum, *count))
    }

    /// Times of the first and last message \[ns\]; none without messages.
    #[must_use]
    pub fn span_ns(&self) -> Option<(i64, i64)> {
        self.span_ns
    }

    /// Size of the files \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Facts that the recorder wrote by name.
    #[must_use]
    pub fn custom_data(&self) -> &BTreeMap<String, String> {
        &self.custom_data
    }

    /// Problems found while opening.
    #[must_use]
    pub fn findings(&self) -> &Diagnostics {
        &self.findings
    }

    /// Damage found while reading messages.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        lock(&self.faults).clone()
    }

    /// Returns the newest messages of a topic at or before a time, at most `count`, in the order of
    /// time.
    ///
    /// # Errors
    /// When a file becomes unreadable.
    pub fn newest(
        &self,
        topic: usize,
        at_ns: i64,
        count: usize,
    ) -> Result<Vec<MessageLocation>, BagError> {
        let mut found = Vec::new();
        for (number, file) in self.files.iter().enumerate() {
            match file {
                IndexedFile::Stream(file) => file.newest(topic, at_ns, count, number, &mut found),
                IndexedFile::Database(file) => file.newest(topic, at_ns, count, number, &mut found),
            }?;
        }
        found.sort_unstable();
        found.drain(..found.len().saturating_sub(count));
        Ok(found)
    }

    /// Returns the messages of some topics with `start_ns <= t < end_ns` in the order of time. At
    /// most about `max_count` are returned at once, but always all of one time; continue at
    /// [`LocationSpan::next_ns`].
    ///
    /// # Errors
    /// When a file becomes unreadable.
    pub fn between(
        &self,
        topics: &[usize],
        start_ns: i64,
        end_ns: i64,
        max_count: usize,
    ) -> Result<LocationSpan, BagError> {
        let limit = max_count.max(1);
        // One more, to know whether the last time is complete.
        let mut locations =
            self.first_between(topics, start_ns, end_ns, limit.saturating_add(1))?;
        let Some(over) = locations.get(limit) else {
            return Ok(LocationSpan { locations, next_ns: None });
        };
        let over_ns = over.time_ns;
        locations.retain(|one| one.time_ns < over_ns);
        let mut next_ns = Some(over_ns);
        if locations.is_empty() {
            // All have the same time.
            next_ns = over_ns.checked_add(1).filter(|&next_ns| next_ns < end_ns);
            let end_ns = next_ns.unwrap_or(end_ns);
            locations = self.first_between(topics, over_ns, end_ns, usize::MAX)?;
        }
        Ok(LocationSpan { locations, next_ns })
    }

    fn first_between(
        &self,
        topics: &[usize],
        start_ns: i64,
        end_ns: i64,
        limit: usize,
    ) -> Result<Vec<MessageLocation>, BagError> {
        let mut found = Vec::new();
        if start_ns >= end_ns {
            return Ok(found);
        }
        let span = start_ns..end_ns;
        for (number, file) in self.files.iter().enumerate() {
            match file {
                IndexedFile::Stream(file) => file.between(topics, &span, limit, number, &mut found),
                IndexedFile::Database(file) => {
                    file.between(topics, &span, limit, number, &mut found)
                }
            }?;
        }
        found.sort_unstable();
        found.truncate(limit);
        Ok(found)
    }

    /// Reads messages in the order of `locations` until `visit` breaks. Returns false if some could
    /// not be read because their part of the file is damaged; these locations are not found again.
    ///
    /// # Errors
    /// When a file becomes unreadable.
    pub fn read(
        &self,
        locations: &[MessageLocation],
        chunks: ChunkUse,
        visit: &mut dyn FnMut(&MessageLocation, &[u8]) -> ControlFlow<()>,
    ) -> Result<bool, BagError> {
        read_chunks::read(self, locations, chunks, visit)
    }

    /// Visits topic and time of all messages of some topics, in any order, until `visit` breaks.
    /// Where a file has message indexes nothing is decompressed.
    ///
    /// # Errors
    /// When a file becomes unreadable.
    pub fn visit_times(
        &self,
        topics: &[usize],
        visit: &mut dyn FnMut(usize, i64) -> ControlFlow<()>,
    ) -> Result<(), BagError> {
        for file in &self.files {
            let flow = match file {
                IndexedFile::Stream(file) => file.visit_times(topics, visit),
                IndexedFile::Database(file) => file.visit_times(topics, visit),
            }?;
            if flow.is_break() {
                break;
            }
        }
        Ok(())
    }

    /// ROS version of the recording.
    #[must_use]
    pub fn kind(&self) -> BagKind {
        if self.format == RecordingFormat::Ros1 { BagKind::Ros1 } else { BagKind::Ros2 }
    }

    fn fault(&self, message: String) {
        let mut faults = lock(&self.faults);
        if faults.len() < MAX_FAULTS && !faults.contains(&message) {
            faults.push(message);
        }
    }
}

impl std::fmt::Debug for IndexedBag {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("IndexedBag").field("path", &self.path).finish_non_exhaustive()
    }
}

/// Locks a mutex and ignores poisoning.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Format of a recording at a path with files of a storage format.
fn format_of(is_folder: bool, storage: Storage) -> RecordingFormat {
    match storage {
        Storage::Ros1 => RecordingFormat::Ros1,
        Storage::Mcap if !is_folder => RecordingFormat::Mcap,
        Storage::Mcap | Storage::Sqlite => RecordingFormat::Rosbag2,
    }
}
