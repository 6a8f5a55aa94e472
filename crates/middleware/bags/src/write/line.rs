//! The way of chunks to the file: straight, or by threads that pack and one that writes.

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
    /// It ended early; its error was told.
    Broken,
}

/// Chunks go to the packers in turn, and the sealer takes them in the same turn, so that they stay
/// in order whoever is faster.
pub(super) struct Threads<W> {
    /// One for each packer; a full one makes the writer wait.
    full: Vec<SyncSender<Chunk>>,
    /// Whose turn it is.
    next: usize,
    /// Chunks that are written, whose memory is used again.
    empty: Receiver<Chunk>,
    sealing: JoinHandle<io::Result<Sealer<W>>>,
}

/// More threads than this pack faster than any disk writes.
const MOST_THREADS: usize = 8;

impl<W: Write + Send + 'static> Line<W> {
    pub(super) fn new(sealer: Sealer<W>, settings: &Settings) -> io::Result<Self> {
        if settings.threads == 0 {
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

    /// Seals a chunk and leaves an empty one.
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

    /// Waits until all is written.
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

/// Packs until no more chunks come or nobody wants them.
fn pack(mut packer: Packer, chunks: &Receiver<Chunk>, done: &SyncSender<io::Result<Chunk>>) {
    for mut chunk in chunks {
        let result = chunk.pack(&mut packer).map(|()| chunk);
        if done.send(result).is_err() {
            return;
        }
    }
}

/// Writes until the packer whose turn it is has no more: then nobody has.
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
        // When nobody wants its memory, the writer is gone.
        let _ = done.send(chunk);
    }
    Ok(sealer)
}

fn broken() -> io::Error {
    io::Error::other("an earlier part of it could not be written")
}
