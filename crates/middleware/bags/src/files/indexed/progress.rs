//! Progress of opening.

use std::io::{self, Read, Seek, SeekFrom};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use periplus_os::fs::File;

/// Progress of opening a recording, shared by the thread that opens it and those that watch.
#[derive(Debug, Default)]
pub struct OpenProgress {
    total_bytes: AtomicU64,
    /// Bytes of the files that are finished.
    finished_bytes: AtomicU64,
    /// Read position in the present file \[bytes\].
    position_bytes: AtomicU64,
    is_cancelled: AtomicBool,
}

impl OpenProgress {
    /// Fraction of the files that has been read, 0 to 1.
    #[must_use]
    pub fn fraction(&self) -> f64 {
        let total = self.total_bytes.load(Ordering::Relaxed);
        let finished = self.finished_bytes.load(Ordering::Relaxed);
        let read = finished.saturating_add(self.position_bytes.load(Ordering::Relaxed));
        if total == 0 { 0.0 } else { (read as f64 / total as f64).min(1.0) }
    }

    /// Makes opening fail soon.
    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// True if opening is to fail.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }

    pub(super) fn set_total(&self, bytes: u64) {
        self.total_bytes.store(bytes, Ordering::Relaxed);
    }

    pub(super) fn set_position(&self, bytes: u64) {
        self.position_bytes.store(bytes, Ordering::Relaxed);
    }

    pub(super) fn finish_file(&self, bytes: u64) {
        self.position_bytes.store(0, Ordering::Relaxed);
        self.finished_bytes.fetch_add(bytes, Ordering::Relaxed);
    }
}

/// A file that reports its read position, and fails once opening is cancelled.
pub(super) struct WatchedFile<'a> {
    pub(super) file: File,
    pub(super) progress: &'a OpenProgress,
    pub(super) position: u64,
}

impl WatchedFile<'_> {
    fn moved_to(&mut self, position: u64) -> io::Result<()> {
        self.position = position;
        self.progress.set_position(position);
        if self.progress.is_cancelled() {
            return Err(io::Error::other("opening was cancelled"));
        }
        Ok(())
    }
}

impl Read for WatchedFile<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(buffer)?;
        self.moved_to(self.position + count as u64)?;
        Ok(count)
    }
}

impl Seek for WatchedFile<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let position = self.file.seek(to)?;
        // The length is found by seeking to the end, which is not progress.
        if !matches!(to, SeekFrom::End(_)) {
            self.moved_to(position)?;
        }
        self.position = position;
        Ok(position)
    }
}
