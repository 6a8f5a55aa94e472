//! Reading ahead: threads decompress and decode messages while Python works with earlier ones.

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use periplus::bags::Selection;
use periplus::bags::files::Storage;
use pyo3::prelude::*;

use super::source::{Source, SourceKind, Wanted};
use crate::errors::runtime_error;
use crate::messages::Tape;
use crate::work::lock;

/// Messages that were read together.
#[derive(Default)]
pub(super) struct Batch {
    pub(super) entries: Vec<Entry>,
    /// Values of the messages, unless they are raw.
    pub(super) tape: Tape,
    /// Bytes of raw messages.
    pub(super) bytes: Vec<u8>,
}

/// Message of a batch.
#[derive(Clone, Copy)]
pub(super) struct Entry {
    pub(super) topic: usize,
    pub(super) time_ns: i64,
    /// Length of a raw message [bytes].
    pub(super) length: usize,
}

enum Note {
    Batch(Batch),
    /// Descriptions of damaged parts and messages.
    Faults(Vec<String>),
    /// All messages of a time window were sent.
    WindowEnd,
    Failed(String),
}

/// Messages of a source, in order, from threads that read different time windows.
pub(super) struct Prefetch {
    workers: Vec<Receiver<Note>>,
    window: usize,
    windows: usize,
    pub(super) faults: Vec<String>,
    /// Memory of batches of raw messages, for the next ones.
    spare: Spare,
}

type Spare = Arc<Mutex<Vec<Vec<u8>>>>;

/// Size of a batch [bytes of messages].
const BATCH_BYTES: usize = 512 << 10;
/// Maximum number of messages of a batch.
const BATCH_MESSAGES: usize = 512;
/// Size of a time window that one thread reads at a time [bytes of the file].
const WINDOW_BYTES: u64 = 16 << 20;
/// Maximum number of batches that a thread reads ahead.
const BATCHES_AHEAD: usize = 48;
/// Maximum number of threads.
const MAX_THREADS: usize = 4;

impl Prefetch {
    pub(super) fn start(source: &Arc<Source>, wanted: &Wanted, raw: bool) -> std::io::Result<Self> {
        let windows = windows(source, wanted);
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let threads = cores.clamp(1, MAX_THREADS).min(windows.len());
        let mut workers = Vec::new();
        let spare = Spare::default();
        for worker in 0..threads {
            let (sender, receiver) = sync_channel(BATCHES_AHEAD);
            let own: Vec<(i64, i64)> =
                windows.iter().skip(worker).step_by(threads).copied().collect();
            let (source, wanted, spare) = (source.clone(), wanted.clone(), spare.clone());
            std::thread::Builder::new()
                .name("periplus-bag".into())
                .spawn(move || produce(&source, &wanted, &own, raw, &sender, &spare))?;
            workers.push(receiver);
        }
        Ok(Self { workers, window: 0, windows: windows.len(), faults: Vec::new(), spare })
    }

    /// Returns the memory of a batch that was read.
    pub(super) fn recycle(&self, mut bytes: Vec<u8>) {
        bytes.clear();
        if bytes.capacity() > 0 {
            lock(&self.spare).push(bytes);
        }
    }

    /// Next batch; none at the end. Waits without the interpreter.
    pub(super) fn next(&mut self, py: Python<'_>) -> PyResult<Option<Batch>> {
        while self.window < self.windows {
            let note = self.receive(py)?;
            match note {
                Note::Batch(batch) => return Ok(Some(batch)),
                Note::WindowEnd => self.window += 1,
                Note::Faults(faults) => {
                    for fault in faults {
                        if !self.faults.contains(&fault) {
                            self.faults.push(fault);
                        }
                    }
                }
                Note::Failed(why) => {
                    self.window = self.windows;
                    return Err(runtime_error(why));
                }
            }
        }
        Ok(None)
    }

    fn receive(&mut self, py: Python<'_>) -> PyResult<Note> {
        let worker = self.window % self.workers.len().max(1);
        let Some(receiver) = self.workers.get_mut(worker) else { return Ok(Note::WindowEnd) };
        if let Ok(note) = receiver.try_recv() {
            return Ok(note);
        }
        loop {
            let note = {
                let receiver = &mut *receiver;
                py.detach(move || receiver.recv_timeout(Duration::from_millis(50)))
            };
            match note {
                Ok(note) => return Ok(note),
                Err(RecvTimeoutError::Timeout) => py.check_signals()?,
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(runtime_error(
                        "reading the bag failed, which is a fault of Periplus",
                    ));
                }
            }
        }
    }
}

/// Time windows that are read one after the other. Only indexed files are divided.
fn windows(source: &Source, wanted: &Wanted) -> Vec<(i64, i64)> {
    let whole = vec![(wanted.start_ns, wanted.end_ns)];
    let Some(bag) = source.bag() else { return whole };
    let is_indexed = matches!(bag.storage(), Storage::Mcap | Storage::Ros1) && bag.is_whole();
    let is_packed = bag.files().any(|file| Storage::of_path(file).is_none());
    let Some((start, end)) = bag.span_ns().filter(|_| is_indexed && !is_packed) else {
        return whole;
    };
    let count = i64::try_from((bag.bytes() / WINDOW_BYTES).clamp(1, 10_000)).unwrap_or(1);
    let (start, end) = (start.max(wanted.start_ns), end.min(wanted.end_ns));
    if count < 2 || end <= start {
        return whole;
    }
    let step = (end.saturating_sub(start) / count).max(1);
    let mut windows = Vec::new();
    let mut from = wanted.start_ns;
    let mut border = start;
    for _ in 1..count {
        border = border.saturating_add(step);
        if border >= end {
            break;
        }
        windows.push((from, border));
        from = border + 1;
    }
    windows.push((from, wanted.end_ns));
    windows
}

/// Size of free memory that the allocator of glibc keeps for each thread at least [bytes]. Otherwise it returns the
/// memory of every chunk and image to the system, and asks for it again.
const KEPT_BYTES: usize = 24 << 20;

/// Sends the messages of time windows.
fn produce(
    source: &Source,
    wanted: &Wanted,
    windows: &[(i64, i64)],
    raw: bool,
    sender: &SyncSender<Note>,
    spare: &Spare,
) {
    // Freeing a block raises the limits of glibc (`mallopt`, M_MMAP_THRESHOLD) to its size. It is not touched.
    drop(std::hint::black_box(Vec::<u8>::with_capacity(KEPT_BYTES)));
    for (start, end) in windows {
        let mut producer = Producer {
            source,
            raw,
            sender,
            spare,
            batch: Batch::default(),
            bad: BTreeMap::new(),
            size: 0,
        };
        let selection = Selection { topics: wanted.topics.clone(), span_ns: *start..=*end };
        let done = match source.kind() {
            SourceKind::Bag(bag) => producer.bag(bag, selection),
            SourceKind::Memory(memory) => memory
                .messages
                .iter()
                .filter(|(topic, time_ns, _)| {
                    selection.span_ns.contains(time_ns) && wanted.takes(&memory.topics[*topic].name)
                })
                .try_for_each(|(topic, time_ns, data)| producer.add(*topic, *time_ns, data)),
        };
        // An error is a receiver that has gone.
        if done.and_then(|()| producer.finish()).is_err() {
            return;
        }
    }
}

/// Marks that no reader receives any more.
struct Gone;

struct Producer<'a> {
    source: &'a Source,
    raw: bool,
    sender: &'a SyncSender<Note>,
    spare: &'a Spare,
    batch: Batch,
    size: usize,
    /// Number of messages of a topic that cannot be decoded, with the first error.
    bad: BTreeMap<usize, (u64, String)>,
}

impl Producer<'_> {
    fn bag(&mut self, bag: &periplus::bags::files::Bag, selection: Selection) -> Result<(), Gone> {
        let mut messages = bag.messages(selection);
        loop {
            match messages.next() {
                Ok(Some(message)) => self.add(message.topic, message.log_ns, message.data)?,
                Ok(None) => break,
                Err(error) => {
                    self.send()?;
                    return self.sender.send(Note::Failed(error.to_string())).map_err(|_| Gone);
                }
            }
        }
        if !messages.faults().is_empty() {
            let faults = messages.faults().to_vec();
            self.sender.send(Note::Faults(faults)).map_err(|_| Gone)?;
        }
        Ok(())
    }

    fn add(&mut self, topic: usize, time_ns: i64, data: &[u8]) -> Result<(), Gone> {
        if self.raw {
            if self.batch.bytes.capacity() == 0 {
                self.batch.bytes = lock(self.spare).pop().unwrap_or_default();
                self.batch.bytes.reserve(BATCH_BYTES.max(data.len()));
            }
            self.batch.bytes.extend_from_slice(data);
        } else {
            let Some(known) = self.source.topics().get(topic) else { return Ok(()) };
            let decoded = match &known.plan {
                Ok((plan, format)) => {
                    self.batch.tape.append(plan, *format, data).map_err(|error| error.to_string())
                }
                Err(why) => Err(why.clone()),
            };
            if let Err(error) = decoded {
                self.bad.entry(topic).or_insert((0, error)).0 += 1;
                return Ok(());
            }
        }
        self.batch.entries.push(Entry { topic, time_ns, length: data.len() });
        self.size += data.len();
        if self.size >= BATCH_BYTES || self.batch.entries.len() >= BATCH_MESSAGES {
            self.send()?;
        }
        Ok(())
    }

    fn send(&mut self) -> Result<(), Gone> {
        self.size = 0;
        let batch = std::mem::take(&mut self.batch);
        if batch.entries.is_empty() {
            return Ok(());
        }
        self.sender.send(Note::Batch(batch)).map_err(|_| Gone)
    }

    fn finish(mut self) -> Result<(), Gone> {
        self.send()?;
        let faults: Vec<String> = std::mem::take(&mut self.bad)
            .into_iter()
            .map(|(topic, (count, error))| {
                let name = &self.source.topics()[topic].topic.name;
                format!("{count} messages of `{name}` were skipped: {error}")
            })
            .collect();
        if !faults.is_empty() {
            self.sender.send(Note::Faults(faults)).map_err(|_| Gone)?;
        }
        self.sender.send(Note::WindowEnd).map_err(|_| Gone)
    }
}
