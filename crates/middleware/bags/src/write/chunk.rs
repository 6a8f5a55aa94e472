//! The messages of about a second.

use std::io;

use crate::compression::Packer;
use crate::record::MessageHead;

/// Messages that are packed together.
#[derive(Debug, Default)]
pub(super) struct Chunk {
    /// Types and topics that are new: they stand in front of the chunk.
    pub(super) preamble: Vec<u8>,
    /// The message records.
    pub(super) records: Vec<u8>,
    /// Earliest and latest time of a message.
    pub(super) span: Option<(u64, u64)>,
    /// By channel: times, and where in `records` the message begins.
    pub(super) indexes: Vec<Vec<(u64, u64)>>,
    /// The records when they are packed; none where they stay as they are.
    pub(super) packed: Option<Vec<u8>>,
    /// Sum of the records, once [`Chunk::pack`] has been called.
    pub(super) crc: u32,
}

impl Chunk {
    pub(super) fn is_empty(&self) -> bool {
        self.preamble.is_empty() && self.records.is_empty()
    }

    /// Whether a message of this time would make it last too long.
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

    /// What takes time before a chunk can be written.
    pub(super) fn pack(&mut self, packer: &mut Packer) -> io::Result<()> {
        self.crc = crc32fast::hash(&self.records);
        packer.pack(&self.records, &mut self.packed)
    }

    /// Empty again, with the memory that it has.
    pub(super) fn clear(&mut self) {
        self.preamble.clear();
        self.records.clear();
        self.span = None;
        self.indexes.iter_mut().for_each(Vec::clear);
    }
}
