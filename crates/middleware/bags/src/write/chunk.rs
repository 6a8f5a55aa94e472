//! Chunks of messages.

use std::io;

use crate::compression::Packer;
use crate::record::MessageHead;

/// Messages that are compressed together.
#[derive(Debug, Default)]
pub(super) struct Chunk {
    /// New schemas and channels, written before the chunk.
    pub(super) preamble: Vec<u8>,
    /// The message records.
    pub(super) records: Vec<u8>,
    /// Earliest and latest message time \[ns\].
    pub(super) span: Option<(u64, u64)>,
    /// By channel: times, and offsets of the messages in `records`.
    pub(super) indexes: Vec<Vec<(u64, u64)>>,
    /// The compressed records; none without compression.
    pub(super) packed: Option<Vec<u8>>,
    /// Checksum of the records, set by [`Chunk::pack`].
    pub(super) crc: u32,
}

impl Chunk {
    pub(super) fn is_empty(&self) -> bool {
        self.preamble.is_empty() && self.records.is_empty()
    }

    /// True if a message of this time would exceed the maximum time span.
    pub(super) fn is_over(&self, time: u64, longest: u64) -> bool {
        self.span.is_some_and(|(start, _)| time.saturating_sub(start) >= longest)
    }

    pub(super) fn add(&mut self, head: MessageHead, data: &[u8]) {
        let channel = usize::from(head.channel);
        if self.indexes.len() <= channel {
            self.indexes.resize_with(channel + 1, Vec::new);
        }
        self.indexes[channel].push((head.log_time, self.records.len() as u64));
        head.put(data, &mut self.records);
        let (start, end) = self.span.unwrap_or((head.log_time, head.log_time));
        self.span = Some((start.min(head.log_time), end.max(head.log_time)));
    }

    /// Compresses the records and computes the checksum.
    pub(super) fn pack(&mut self, packer: &mut Packer) -> io::Result<()> {
        self.crc = crc32fast::hash(&self.records);
        packer.pack(&self.records, &mut self.packed)
    }

    /// Clears the chunk and keeps its memory.
    pub(super) fn clear(&mut self) {
        self.preamble.clear();
        self.records.clear();
        self.span = None;
        self.indexes.iter_mut().for_each(Vec::clear);
    }
}
