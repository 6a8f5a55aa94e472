//! Pipeline of chunks to the file: direct, or through threads that compress and one that writes.

use std::io::{self, Write};
use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};
use std::thread::JoinHandle;

use super::Settings;
use super::chunk::Chunk;
use super::sealer::Sealer;
use crate::compression::Packer;

pub(super) enum Line<W> {
    Straight(Box<(Sealer<W>, Packer)>),
    Threaded(Threads<W>),
    /// Ended early; its error was returned.
    Broken,
}

/// Chunks are distributed to the compression threads in turn, and the writing thread collects them
/// in the same order, so that the order is kept.
pub(super) struct Threads<W> {
    /// A bounded queue per compression thread; a full one blocks the writer.
    full: Vec<SyncSender<Chunk>>,
    /// Index of the next thread.
    next: usize,
    /// Written chunks, whose memory is reused.
    empty: Receiver<Chunk>,
    sealing: JoinHandle<io::Result<Sealer<W>>>,
}

/// Maximum number of compression threads; more are faster than any disk.
const MOST_THREADS: usize = 8;

impl<W: Write + Send + 'static> Line<W> {
    pub(super) fn new(sealer: Sealer<W>, settings: &Settings) -> io::Result<Self> {
        // WebAssembly has no threads; the bytes do not depend on them.
        if settings.threads == 0 || cfg!(target_family = "wasm") {
            let packer = Packer::new(settings.compression)?;
            return Ok(Self::Straight(Box::new((sealer, packer))));
        }
        let (mut full, mut packed) = (Vec::new(), Vec::new());
        for _ in 0..settings.threads.min(MOST_THREADS) {
            let packer = Packer::new(settings.compression)?;
            let (to, chunks) = sync_channel(1);
            let (done, from) = sync_channel(1);
            std::thread::spawn(move || pack(packer, &chunks, &done));
            full.push(to);
            packed.push(from);
        }
        let (done, empty) = channel();
        let sealing = std::thread::spawn(move || seal(sealer, &packed, &done));
        Ok(Self::Threaded(Threads { full, next: 0, empty, sealing }))
    }

    /// Passes a chunk to the pipeline and replaces it by an empty one.
    pub(super) fn seal(&mut self, chunk: &mut Chunk) -> io::Result<()> {
        match self {
            Self::Straight(both) => {
                let (sealer, packer) = &mut **both;
                let result = chunk.pack(packer).and_then(|()| sealer.seal(chunk));
                chunk.clear();
                if result.is_err() {
                    *self = Self::Broken;
                }
                result
            }
            Self::Threaded(line) => {
                let next = line.empty.try_recv().unwrap_or_default();
                let full = std::mem::replace(chunk, next);
                let to = line.next;
                line.next = (to + 1) % line.full.len();
                match line.full[to].send(full) {
                    Ok(()) => Ok(()),
                    Err(_) => std::mem::replace(self, Self::Broken).finish().map(drop),
                }
            }
            Self::Broken => Err(broken()),
        }
    }

    /// Waits until everything is written.
    pub(super) fn finish(self) -> io::Result<Sealer<W>> {
        match self {
            Self::Straight(both) => Ok(both.0),
            Self::Threaded(Threads { full, sealing, .. }) => {
                drop(full);
                sealing.join().unwrap_or_else(|_| Err(broken()))
            }
            Self::Broken => Err(broken()),
        }
    }
}

/// Compresses until there are no more chunks or the receiver is gone.
fn pack(mut packer: Packer, chunks: &Receiver<Chunk>, done: &SyncSender<io::Result<Chunk>>) {
    for mut chunk in chunks {
        let result = chunk.pack(&mut packer).map(|()| chunk);
        if done.send(result).is_err() {
            return;
        }
    }
}

/// Writes until the next compression thread in turn has no more chunks; then none has.
fn seal<W: Write>(
    mut sealer: Sealer<W>,
    packed: &[Receiver<io::Result<Chunk>>],
    done: &std::sync::mpsc::Sender<Chunk>,
) -> io::Result<Sealer<W>> {
    for from in packed.iter().cycle() {
        let Ok(chunk) = from.recv() else { break };
        let mut chunk = chunk?;
        sealer.seal(&chunk)?;
        chunk.clear();
        // Fails only when the writer is gone.
        let _ = done.send(chunk);
    }
    Ok(sealer)
}

fn broken() -> io::Error {
    io::Error::other("an earlier part of it could not be written")
}
