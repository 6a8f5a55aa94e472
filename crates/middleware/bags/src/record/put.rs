//! Encoding of records.

use std::collections::BTreeMap;

use super::{Channel, ChunkHead, ChunkIndex, Footer, MessageHead, Schema, Statistics, op};

/// Starts a record of unknown length; [`end`] fills in the length.
pub(crate) fn begin(out: &mut Vec<u8>, opcode: u8) -> usize {
    out.push(opcode);
    out.extend([0; 8]);
    out.len()
}

/// Ends the record whose content started at `start`, with `more` bytes still to follow.
pub(crate) fn end(out: &mut [u8], start: usize, more: usize) {
    let length = (out.len() - start + more) as u64;
    out[start - 8..start].copy_from_slice(&length.to_le_bytes());
}

/// Writes a length in four bytes. Callers check the length of external data.
fn put_length(out: &mut Vec<u8>, length: usize) {
    out.extend(u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes());
}

pub(crate) fn put_text(out: &mut Vec<u8>, text: &str) {
    put_bytes(out, text.as_bytes());
}

pub(crate) fn put_bytes(out: &mut Vec<u8>, bytes: &[u8]) {
    put_length(out, bytes.len());
    out.extend_from_slice(bytes);
}

pub(crate) fn put_map(out: &mut Vec<u8>, map: &BTreeMap<String, String>) {
    put_length(out, map.iter().map(|(key, value)| 8 + key.len() + value.len()).sum());
    for (key, value) in map {
        put_text(out, key);
        put_text(out, value);
    }
}

fn put_counts(out: &mut Vec<u8>, counts: &BTreeMap<u16, u64>) {
    put_length(out, counts.len() * 10);
    for (id, count) in counts {
        out.extend(id.to_le_bytes());
        out.extend(count.to_le_bytes());
    }
}

impl Schema {
    pub(crate) fn put(&self, out: &mut Vec<u8>) {
        let start = begin(out, op::SCHEMA);
        out.extend(self.id.to_le_bytes());
        put_text(out, &self.name);
        put_text(out, &self.encoding);
        put_bytes(out, &self.data);
        end(out, start, 0);
    }
}

impl Channel {
    pub(crate) fn put(&self, out: &mut Vec<u8>) {
        let start = begin(out, op::CHANNEL);
        out.extend(self.id.to_le_bytes());
        out.extend(self.schema.to_le_bytes());
        put_text(out, &self.topic);
        put_text(out, &self.encoding);
        put_map(out, &self.metadata);
        end(out, start, 0);
    }
}

impl MessageHead {
    pub(crate) fn put(&self, data: &[u8], out: &mut Vec<u8>) {
        let start = begin(out, op::MESSAGE);
        out.extend(self.channel.to_le_bytes());
        out.extend(self.sequence.to_le_bytes());
        out.extend(self.log_time.to_le_bytes());
        out.extend(self.publish_time.to_le_bytes());
        out.extend_from_slice(data);
        end(out, start, 0);
    }
}

impl ChunkHead {
    /// Writes the record up to its compressed records.
    pub(crate) fn put(&self, out: &mut Vec<u8>) {
        let start = begin(out, op::CHUNK);
        out.extend(self.start.to_le_bytes());
        out.extend(self.end.to_le_bytes());
        out.extend(self.length.to_le_bytes());
        out.extend(self.crc.to_le_bytes());
        put_text(out, &self.compression);
        out.extend(self.packed.to_le_bytes());
        let more = usize::try_from(self.packed).unwrap_or(usize::MAX);
        end(out, start, more);
    }
}

/// Message index of a channel in a chunk: times, and offsets in the decompressed chunk.
pub(crate) fn put_message_index(out: &mut Vec<u8>, channel: u16, entries: &[(u64, u64)]) {
    let start = begin(out, op::MESSAGE_INDEX);
    out.extend(channel.to_le_bytes());
    put_length(out, entries.len() * 16);
    for (time, offset) in entries {
        out.extend(time.to_le_bytes());
        out.extend(offset.to_le_bytes());
    }
    end(out, start, 0);
}

impl ChunkIndex {
    pub(crate) fn put(&self, out: &mut Vec<u8>) {
        let start = begin(out, op::CHUNK_INDEX);
        for number in [self.start, self.end, self.offset, self.stored] {
            out.extend(number.to_le_bytes());
        }
        put_counts(out, &self.indexes);
        out.extend(self.indexes_length.to_le_bytes());
        put_text(out, &self.compression);
        out.extend(self.packed.to_le_bytes());
        out.extend(self.length.to_le_bytes());
        end(out, start, 0);
    }
}

impl Statistics {
    pub(crate) fn put(&self, out: &mut Vec<u8>) {
        let start = begin(out, op::STATISTICS);
        out.extend(self.messages.to_le_bytes());
        out.extend(self.schemas.to_le_bytes());
        for number in [self.channels, self.attachments, self.metadata, self.chunks] {
            out.extend(number.to_le_bytes());
        }
        out.extend(self.start.to_le_bytes());
        out.extend(self.end.to_le_bytes());
        put_counts(out, &self.by_channel);
        end(out, start, 0);
    }
}

/// Metadata record.
pub(crate) fn put_metadata(out: &mut Vec<u8>, name: &str, map: &BTreeMap<String, String>) {
    let start = begin(out, op::METADATA);
    put_text(out, name);
    put_map(out, map);
    end(out, start, 0);
}

/// Metadata index record.
pub(crate) fn put_metadata_index(out: &mut Vec<u8>, offset: u64, length: u64, name: &str) {
    let start = begin(out, op::METADATA_INDEX);
    out.extend(offset.to_le_bytes());
    out.extend(length.to_le_bytes());
    put_text(out, name);
    end(out, start, 0);
}

/// Summary offset record.
pub(crate) fn put_summary_offset(out: &mut Vec<u8>, opcode: u8, offset: u64, length: u64) {
    let start = begin(out, op::SUMMARY_OFFSET);
    out.push(opcode);
    out.extend(offset.to_le_bytes());
    out.extend(length.to_le_bytes());
    end(out, start, 0);
}

impl Footer {
    pub(crate) fn put(self, out: &mut Vec<u8>) {
        let start = begin(out, op::FOOTER);
        out.extend(self.summary.to_le_bytes());
        out.extend(self.offsets.to_le_bytes());
        out.extend(self.crc.to_le_bytes());
        end(out, start, 0);
    }
}
