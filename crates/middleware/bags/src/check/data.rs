//! Validation of the data section.

use std::collections::BTreeMap;

use super::{Faults, record_at};
use crate::Limits;
use crate::compression::{Compression, unpack};
use crate::record::{
    Channel, ChunkHead, ChunkIndex, Cursor, MAGIC, MessageHead, PREFIX, Schema, Statistics, op,
    parse_message_index,
};

/// Findings of the data section.
#[derive(Default)]
pub(super) struct Data {
    pub(super) schemas: BTreeMap<u16, Schema>,
    pub(super) channels: BTreeMap<u16, Channel>,
    pub(super) chunks: Vec<ChunkIndex>,
    /// Offset and length of metadata records.
    pub(super) metadata: Vec<(u64, u64)>,
    pub(super) statistics: Statistics,
    /// End of the data section.
    pub(super) end: usize,
}

/// Messages of a chunk by channel: times and offsets in the order of the chunk.
type Messages = BTreeMap<u16, Vec<(u64, u64)>>;

impl Data {
    /// Walks from the first record to the end of the data section. None if it has no end.
    pub(super) fn walk(bytes: &[u8], faults: &mut Faults) -> Option<Self> {
        let mut data = Self::default();
        let mut at = MAGIC.len();
        let mut unindexed: Option<(usize, Messages)> = None;
        loop {
            let Some((opcode, content)) = record_at(bytes, at) else {
                faults.add(at, "a record is truncated, or the data section has no end");
                return None;
            };
            let next = at + PREFIX + content.len();
            faults.unless(
                (at == MAGIC.len()) == (opcode == op::HEADER),
                at,
                "the header must be the first record",
            );
            if opcode == op::MESSAGE_INDEX {
                data.index(at, next, content, unindexed.as_mut(), faults);
                at = next;
                continue;
            }
            if let Some((chunk, left)) = unindexed.take() {
                let is_empty = left.values().all(Vec::is_empty);
                faults.unless(is_empty, chunk, "messages of the chunk are missing in the index");
            }
            match opcode {
                op::CHUNK => {
                    let messages = data.chunk(at, next, content, faults);
                    unindexed = Some((at, messages.unwrap_or_default()));
                }
                op::METADATA => {
                    data.statistics.metadata += 1;
                    data.metadata.push((at as u64, (next - at) as u64));
                }
                op::ATTACHMENT => data.statistics.attachments += 1,
                op::DATA_END => {
                    let crc = Cursor::new(content).u32();
                    let right = crc == Some(0) || crc == Some(crc32fast::hash(&bytes[..at]));
                    faults.unless(right, at, "the checksum of the data section is wrong");
                    data.end = next;
                    data.statistics.schemas = u16::try_from(data.schemas.len()).unwrap_or(u16::MAX);
                    data.statistics.channels =
                        u32::try_from(data.channels.len()).unwrap_or(u32::MAX);
                    return Some(data);
                }
                op::HEADER => {}
                _ => {
                    data.plain(at, opcode, content, faults);
                }
            }
            at = next;
        }
    }

    /// Checks a record that may be inside or outside of chunks.
    fn plain(
        &mut self,
        at: usize,
        opcode: u8,
        content: &[u8],
        faults: &mut Faults,
    ) -> Option<MessageHead> {
        match opcode {
            op::SCHEMA => match Schema::parse(content) {
                Some(schema) => {
                    let same = self.schemas.get(&schema.id).is_none_or(|known| *known == schema);
                    faults.unless(
                        same && schema.id > 0,
                        at,
                        "two schemas have the same id, or the id is 0",
                    );
                    self.schemas.insert(schema.id, schema);
                }
                None => faults.add(at, "a schema is truncated"),
            },
            op::CHANNEL => match Channel::parse(content) {
                Some(channel) => {
                    let is_known =
                        channel.schema == 0 || self.schemas.contains_key(&channel.schema);
                    faults.unless(is_known, at, "a channel precedes its schema");
                    let same = self.channels.get(&channel.id).is_none_or(|known| *known == channel);
                    faults.unless(same, at, "two channels have the same id");
                    self.channels.insert(channel.id, channel);
                }
                None => faults.add(at, "a channel is truncated"),
            },
            op::MESSAGE => match MessageHead::parse(content) {
                Some((head, _)) => {
                    let is_known = self.channels.contains_key(&head.channel);
                    faults.unless(is_known, at, "a message precedes its channel");
                    let sums = &mut self.statistics;
                    let is_first = sums.messages == 0;
                    sums.start =
                        if is_first { head.log_time } else { sums.start.min(head.log_time) };
                    sums.end = sums.end.max(head.log_time);
                    sums.messages += 1;
                    *sums.by_channel.entry(head.channel).or_default() += 1;
                    return Some(head);
                }
                None => faults.add(at, "a message is truncated"),
            },
            _ => faults.add(at, format!("a record with opcode {opcode:#04x} is not allowed here")),
        }
        None
    }

    fn chunk(
        &mut self,
        at: usize,
        next: usize,
        content: &[u8],
        faults: &mut Faults,
    ) -> Option<Messages> {
        self.statistics.chunks += 1;
        let Some((head, packed)) = ChunkHead::parse(content) else {
            faults.add(at, "a chunk is truncated");
            return None;
        };
        faults.unless(packed.len() as u64 == head.packed, at, "the length of a chunk is wrong");
        let records = Compression::from_name(&head.compression)
            .ok_or_else(|| format!("`{}` is not a known compression", head.compression))
            .and_then(|kind| {
                let limit = Limits::default().chunk;
                if head.length > limit {
                    return Err(format!(
                        "a chunk declares {} bytes, more than the limit of {limit}",
                        head.length
                    ));
                }
                unpack(kind, packed, head.length).map_err(|error| error.to_string())
            });
        let records = match records {
            Ok(records) => records,
            Err(error) => {
                faults.add(at, error);
                return None;
            }
        };
        let right = head.crc == 0 || crc32fast::hash(&records) == head.crc;
        faults.unless(right, at, "the checksum of a chunk is wrong");
        let mut messages = Messages::new();
        let mut cursor = Cursor::new(&records);
        let mut span: Option<(u64, u64)> = None;
        while !cursor.rest().is_empty() {
            let offset = (records.len() - cursor.rest().len()) as u64;
            let Some((opcode, content)) = cursor.record() else {
                faults.add(at, format!("a record is truncated at offset {offset} of the chunk"));
                break;
            };
            let head = self.plain(at, opcode, content, faults);
            // No record has opcode 0; what follows it is padding. A small file may unpack to 200 million
            // records: none is read for faults that are not reported.
            if opcode == 0 || faults.are_full() {
                break;
            }
            if let Some(head) = head {
                let (start, end) = span.unwrap_or((head.log_time, head.log_time));
                span = Some((start.min(head.log_time), end.max(head.log_time)));
                messages.entry(head.channel).or_default().push((head.log_time, offset));
            }
        }
        let right = (head.start, head.end) == span.unwrap_or((0, 0));
        faults.unless(right, at, "the time range of a chunk does not match its messages");
        self.chunks.push(ChunkIndex {
            start: head.start,
            end: head.end,
            offset: at as u64,
            stored: (next - at) as u64,
            indexes: BTreeMap::new(),
            indexes_length: 0,
            compression: head.compression,
            packed: head.packed,
            length: head.length,
        });
        Some(messages)
    }

    /// Checks that an index lists exactly the messages of its channel, by time.
    fn index(
        &mut self,
        at: usize,
        next: usize,
        content: &[u8],
        chunk: Option<&mut (usize, Messages)>,
        faults: &mut Faults,
    ) {
        let Some((channel, entries)) = parse_message_index(content) else {
            return faults.add(at, "a message index is truncated");
        };
        let Some((_, messages)) = chunk else {
            return faults.add(at, "a message index follows no chunk");
        };
        let mut expected = messages.remove(&channel).unwrap_or_default();
        expected.sort_unstable();
        faults.unless(entries == expected, at, "a message index does not match the messages");
        if let Some(chunk) = self.chunks.last_mut() {
            chunk.indexes.insert(channel, at as u64);
            chunk.indexes_length += (next - at) as u64;
        }
    }
}
