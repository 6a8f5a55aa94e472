//! Random access to a file.

use std::io::{self, BufReader, Read, Seek, SeekFrom};

/// Maximum size of the memory that is reserved before data arrives [bytes].
const MAX_RESERVED_BYTES: u64 = 16 << 20;

pub(crate) struct Source<R> {
    inner: BufReader<R>,
    at: u64,
    pub(crate) length: u64,
}

impl<R: Read + Seek> Source<R> {
    pub(super) fn new(mut inner: R) -> io::Result<Self> {
        let length = inner.seek(SeekFrom::End(0))?;
        inner.seek(SeekFrom::Start(0))?;
        Ok(Self { inner: BufReader::with_capacity(1 << 16, inner), at: 0, length })
    }

    /// Reads bytes from `offset`; fewer at the end of the file. Memory of large blocks is allocated as
    /// data arrives.
    pub(crate) fn bytes(&mut self, offset: u64, length: u64) -> io::Result<Vec<u8>> {
        let length = length.min(self.length.saturating_sub(offset));
        // Small steps stay in the buffer.
        match i64::try_from(i128::from(offset) - i128::from(self.at)) {
            Ok(0) => {}
            Ok(step) => self.inner.seek_relative(step)?,
            Err(_) => {
                self.inner.seek(SeekFrom::Start(offset))?;
            }
        }
        let mut bytes = Vec::new();
        bytes.try_reserve_exact(usize::try_from(length.min(MAX_RESERVED_BYTES)).unwrap_or(0))?;
        self.inner.by_ref().take(length).read_to_end(&mut bytes)?;
        self.at = offset + bytes.len() as u64;
        Ok(bytes)
    }
}
