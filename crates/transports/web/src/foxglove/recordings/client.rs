//! Requests of a client about recordings.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use periplus_bags::files::BagError;
use periplus_graph::Graph;
use periplus_transport::lock;

use super::entry::Recording;
use super::fetch::FetchAnswer;
use super::marks::MarkWatcher;
use super::series::SeriesRequest;
use super::service::Recordings;
use super::upload::Upload;
use super::{density, file, messages, series, state, summary};
use crate::foxglove::fetch_queue::FetchQueue;
use crate::foxglove::outbox::Outbox;
use crate::foxglove::protocol::{self, ReplayRequest, StatusLevel};

/// Maximum number of pending fetches of a client.
const MAX_PENDING: usize = 256;

/// Maximum number of topics of a request.
const MAX_TOPICS: usize = 4096;

/// Maximum number of paths of a request.
const MAX_PATHS: usize = 256;

/// Maximum number of uploads of a client at one time.
const MAX_UPLOADS: usize = 4;

/// Pending fetches by request, true once they are cancelled.
type Pending = Arc<Mutex<BTreeMap<u32, Arc<AtomicBool>>>>;

/// Work of a fetch; its failure is sent to the client.
type Fetch = Box<dyn FnOnce(&Recording, &FetchAnswer<'_>) -> Result<(), BagError> + Send>;

/// A client that replays recordings. Its fetches and uploads end when this is dropped.
pub(crate) struct RecordingClient {
    id: u64,
    recordings: Arc<Recordings>,
    outbox: Arc<Outbox>,
    pending: Pending,
    /// Messages, which the page waits for.
    quick: FetchQueue,
    /// Summaries of whole recordings.
    slow: FetchQueue,
    uploads: BTreeMap<u32, Upload>,
    /// Recordings that jobs of this client make, by request.
    jobs: BTreeMap<u32, u32>,
    /// Recordings of complete uploads.
    uploaded: BTreeMap<u32, u32>,
}

/// Speed of a fetch.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Speed {
    Quick,
    Slow,
}

impl RecordingClient {
    pub(crate) fn new(id: u64, recordings: Arc<Recordings>, outbox: Arc<Outbox>) -> Self {
        Self {
            id,
            recordings,
            outbox,
            pending: Pending::default(),
            quick: FetchQueue::new("fetch"),
            slow: FetchQueue::new("fetch-summary"),
            uploads: BTreeMap::new(),
            jobs: BTreeMap::new(),
            uploaded: BTreeMap::new(),
        }
    }

    /// Processes a request.
    pub(crate) fn request(&mut self, request: ReplayRequest, graph: &Graph) {
        let id = request.request_id();
        if let Err(why) = self.process(request, graph)
            && let Some(id) = id
        {
            self.outbox.push(protocol::fetch_failure(id, &why));
        }
    }

    fn process(&mut self, request: ReplayRequest, graph: &Graph) -> Result<(), String> {
        match request {
            ReplayRequest::SubscribeRecordings => {
                self.recordings.subscribe(self.id, &self.outbox);
                Ok(())
            }
            ReplayRequest::CancelFetch { request_ids } => {
                request_ids.iter().for_each(|id| self.cancel(*id));
                Ok(())
            }
            ReplayRequest::FetchState { request_id, recording, time_ns, topics } => {
                limit(topics.len(), MAX_TOPICS, "topics")?;
                let run: Fetch = Box::new(move |recording, answer| {
                    state::fetch(recording, time_ns.0, &topics, answer)
                });
                self.fetch(Speed::Quick, request_id, recording, run)
            }
            ReplayRequest::FetchMessages {
                request_id,
                recording,
                topics,
                start_ns,
                end_ns,
                max_bytes,
            } => {
                limit(topics.len(), MAX_TOPICS, "topics")?;
                let run: Fetch = Box::new(move |recording, answer| {
                    let span_ns = start_ns.0..end_ns.0;
                    messages::fetch(recording, &topics, &span_ns, max_bytes, answer)
                });
                self.fetch(Speed::Quick, request_id, recording, run)
            }
            ReplayRequest::FetchDensity { request_id, recording, bins } => {
                let run: Fetch =
                    Box::new(move |recording, answer| density::fetch(recording, bins, answer));
                self.fetch(Speed::Slow, request_id, recording, run)
            }
            ReplayRequest::FetchMarks { request_id, recording } => {
                self.fetch_marks(request_id, recording)
            }
            ReplayRequest::FetchSeries {
                request_id,
                recording,
                topic,
                paths,
                start_ns,
                end_ns,
                points,
            } => {
                limit(paths.len(), MAX_PATHS, "paths")?;
                let request = SeriesRequest { topic, paths, span_ns: start_ns.0..end_ns.0, points };
                let run: Fetch =
                    Box::new(move |recording, answer| series::fetch(recording, &request, answer));
                self.fetch(Speed::Slow, request_id, recording, run)
            }
            ReplayRequest::OpenRecording { upload, .. } => self.open_upload(upload),
            ReplayRequest::CloseRecording { recording, .. } => self.recordings.close(recording),
            ReplayRequest::StartUpload { request_id, files } => {
                self.start_upload(request_id, &files)
            }
            ReplayRequest::FetchJobParameters { request_id, kind } => {
                let parameters = self.recordings.job_parameters(&kind)?;
                self.outbox.push(protocol::job_parameters(request_id, &kind, &parameters));
                Ok(())
            }
            ReplayRequest::StartJob { request_id, kind, recording, parameters } => {
                let made = self.recordings.start_job(&kind, recording, parameters)?;
                self.jobs.insert(request_id, made);
                Ok(())
            }
            ReplayRequest::FetchReport { request_id, recordings } => {
                self.fetch_report(request_id, &recordings)
            }
            ReplayRequest::FetchDifference { request_id, recording, other } => {
                let jobs = self.recordings.jobs()?;
                let other = self.recordings.ready(other)?;
                let run: Fetch = Box::new(move |recording, answer| {
                    summary::difference(&*jobs, recording, &other, answer);
                    Ok(())
                });
                self.fetch(Speed::Slow, request_id, recording, run)
            }
            ReplayRequest::FetchFile { request_id, recording } => {
                let run: Fetch = Box::new(|recording, answer| {
                    file::fetch(recording, answer);
                    Ok(())
                });
                self.fetch(Speed::Slow, request_id, recording, run)
            }
            ReplayRequest::StartRecording { .. } => self.recordings.start_recording(graph),
            ReplayRequest::StopRecording { .. } => {
                let dropped = self.recordings.stop_recording()?;
                if dropped > 0 {
                    let why = format!(
                        "{dropped} messages were not recorded: they arrived faster than the disk \
                         writes"
                    );
                    self.outbox.push(protocol::status(StatusLevel::Warning, &why, None));
                }
                Ok(())
            }
        }
    }

    fn fetch_report(&mut self, id: u32, recordings: &[u32]) -> Result<(), String> {
        let (first, second) = match recordings {
            [first] => (*first, None),
            [first, second] => (*first, Some(self.recordings.ready(*second)?)),
            others => {
                return Err(format!("a report is about 1 or 2 recordings, not {}", others.len()));
            }
        };
        let jobs = self.recordings.jobs()?;
        let run: Fetch = Box::new(move |recording, answer| {
            summary::report(&*jobs, recording, second.as_deref(), answer);
            Ok(())
        });
        self.fetch(Speed::Slow, id, first, run)
    }

    /// Enters a pending request; returns its flag that it is cancelled.
    fn begin(&self, id: u32) -> Result<Arc<AtomicBool>, String> {
        let mut pending = lock(&self.pending);
        limit(pending.len() + 1, MAX_PENDING, "pending requests")?;
        if pending.contains_key(&id) {
            return Err(format!("request {id} is pending already"));
        }
        let is_cancelled = Arc::new(AtomicBool::new(false));
        pending.insert(id, is_cancelled.clone());
        Ok(is_cancelled)
    }

    /// Sends the marks, again while more are found in the background.
    fn fetch_marks(&self, id: u32, recording: u32) -> Result<(), String> {
        let recording = self.recordings.ready(recording)?;
        let is_cancelled = self.begin(id)?;
        let pending = self.pending.clone();
        let done = Box::new(move || {
            lock(&pending).remove(&id);
        });
        let outbox = self.outbox.clone();
        recording.marks.watch(MarkWatcher { request_id: id, outbox, is_cancelled, done });
        Ok(())
    }

    /// Runs a fetch on a thread of this client.
    fn fetch(&mut self, speed: Speed, id: u32, recording: u32, run: Fetch) -> Result<(), String> {
        let recording = self.recordings.ready(recording)?;
        let is_cancelled = self.begin(id)?;
        let (outbox, pending) = (self.outbox.clone(), self.pending.clone());
        let task = Box::new(move || {
            let release = || {
                lock(&pending).remove(&id);
            };
            let answer = FetchAnswer {
                outbox: &outbox,
                request_id: id,
                is_cancelled: &is_cancelled,
                release: &release,
            };
            let count = usize::from(speed == Speed::Quick);
            recording.fetches.fetch_add(count, Ordering::Relaxed);
            let outcome = run(&recording, &answer);
            recording.fetches.fetch_sub(count, Ordering::Relaxed);
            if let Err(error) = outcome {
                answer.fail(&error.to_string());
            }
        });
        let queue = if speed == Speed::Quick { &mut self.quick } else { &mut self.slow };
        if queue.push(task) {
            return Ok(());
        }
        lock(&self.pending).remove(&id);
        Err("no thread can be started".to_owned())
    }

    fn cancel(&mut self, id: u32) {
        if let Some(is_cancelled) = lock(&self.pending).get(&id) {
            is_cancelled.store(true, Ordering::Relaxed);
        }
        if self.uploads.remove(&id).is_some() {
            self.outbox.push(protocol::fetch_failure(id, "the upload was cancelled"));
        }
        if let Some(made) = self.jobs.remove(&id) {
            // It may be closed already.
            let _ = self.recordings.close(made);
        }
    }

    fn start_upload(&mut self, id: u32, files: &[protocol::UploadFile]) -> Result<(), String> {
        limit(self.uploads.len() + 1, MAX_UPLOADS, "uploads at one time")?;
        if self.uploads.contains_key(&id) {
            return Err(format!("upload {id} has begun already"));
        }
        let settings = &self.recordings.settings;
        let upload = Upload::start(&settings.upload_folder, files, settings.upload_max_bytes)?;
        self.uploads.insert(id, upload);
        self.outbox.push(protocol::upload_started(id));
        if self.uploads.get(&id).is_some_and(Upload::is_complete) {
            return self.finish_upload(id);
        }
        Ok(())
    }

    /// Stores bytes of an upload.
    pub(crate) fn upload(&mut self, id: u32, bytes: &[u8]) {
        let received = match self.uploads.get_mut(&id) {
            Some(upload) => upload.receive(bytes).map(|()| upload),
            // Bytes that were sent before the upload ended.
            None => return,
        };
        let outcome = match received {
            Ok(upload) => {
                let is_complete = upload.is_complete();
                self.outbox.push(protocol::upload_progress(id, upload.received_bytes()));
                if is_complete { self.finish_upload(id) } else { Ok(()) }
            }
            Err(why) => {
                self.uploads.remove(&id);
                Err(why)
            }
        };
        if let Err(why) = outcome {
            self.outbox.push(protocol::fetch_failure(id, &why));
        }
    }

    fn finish_upload(&mut self, id: u32) -> Result<(), String> {
        let Some(upload) = self.uploads.remove(&id) else { return Ok(()) };
        let recording = self.recordings.open_upload(upload.finish());
        let recording = recording.map_err(|error| error.to_string())?;
        self.uploaded.insert(id, recording);
        Ok(())
    }

    /// An upload is opened when its last byte has arrived.
    fn open_upload(&self, id: u32) -> Result<(), String> {
        if self.uploads.contains_key(&id) {
            return Err("the upload is not complete".to_owned());
        }
        if self.uploaded.contains_key(&id) {
            return Ok(());
        }
        Err(format!("there is no upload {id}"))
    }
}

fn limit(count: usize, most: usize, what: &str) -> Result<(), String> {
    if count > most { Err(format!("there are too many {what}: at most {most}")) } else { Ok(()) }
}

impl Drop for RecordingClient {
    fn drop(&mut self) {
        self.recordings.unsubscribe(self.id);
        for is_cancelled in lock(&self.pending).values() {
            is_cancelled.store(true, Ordering::Relaxed);
        }
    }
}
