//! Scan of a file from front to back, for files without a valid summary.

use std::io::{Read, Seek};

use super::block::{Block, Kind, unpack_chunk};
use super::source::Source;
use super::{Contents, Limits, ReadError, fault};
use crate::Fault;
use crate::record::{Channel, ChunkHead, Cursor, MAGIC, MessageHead, PREFIX, Schema, op};

/// Approximate maximum size of a block of messages outside of chunks \[bytes\].
const PLAIN_BLOCK: u64 = 1 << 20;

/// Size of the start of a record that is read \[bytes\]: enough for a message header.
const FRONT: u64 = (PREFIX + 22) as u64;

/// Reads all records.
pub(super) fn all<R: Read + Seek>(
    source: &mut Source<R>,
    limits: &Limits,
    faults: &mut Vec<Fault>,
) -> Result<Contents, ReadError> {
    let mut walk = Walk { contents: Contents::default(), count: 0, plain: None };
    let end = source.length;
    walk.range(source, MAGIC.len() as u64, end, Some(limits), faults)?;
    walk.contents.messages = Some(walk.count);
    Ok(walk.contents)
}

/// Reads the records between known chunks.
pub(super) fn gap<R: Read + Seek>(
    source: &mut Source<R>,
    from: u64,
    to: u64,
    mut contents: Contents,
    faults: &mut Vec<Fault>,
) -> Result<Contents, ReadError> {
    // The summary's counts include these messages.
    let counts = std::mem::take(&mut contents.counts);
    let mut walk = Walk { contents, count: 0, plain: None };
    walk.range(source, from, to, None, faults)?;
    Ok(Contents { counts, ..walk.contents })
}

struct Walk {
    contents: Contents,
    count: u64,
    plain: Option<Block>,
}

impl Walk {
    /// Reads the records of a range. With limits, chunks are scanned, too.
    fn range<R: Read + Seek>(
        &mut self,
        source: &mut Source<R>,
        mut at: u64,
        end: u64,
        chunks: Option<&Limits>,
        faults: &mut Vec<Fault>,
    ) -> Result<(), ReadError> {
        while at < end {
            let front = source.bytes(at, FRONT.min(end - at))?;
            let mut cursor = Cursor::new(&front);
            let (Some(opcode), Some(length)) = (cursor.u8(), cursor.u64()) else {
                fault(faults, at, "the file ends in the middle of a record");
                break;
            };
            let next = at.checked_add(PREFIX as u64).and_then(|at| at.checked_add(length));
            let next = next.filter(|&next| next <= end);
            if opcode == op::DATA_END && next.is_some() {
                break;
            }
            if opcode != op::MESSAGE {
                self.contents.blocks.extend(self.plain.take());
            }
            let stored = next.unwrap_or(end) - at;
            match (opcode, chunks) {
                (op::CHUNK, Some(limits)) => {
                    let bytes = source.bytes(at, stored)?;
                    self.chunk(at, &bytes, next.is_none(), limits, faults);
                }
                (op::MESSAGE, _) if next.is_some() => self.message(at, stored, cursor.rest()),
                (op::SCHEMA | op::CHANNEL, _) if next.is_some() => {
                    let bytes = source.bytes(at, stored)?;
                    self.name(opcode, bytes.get(PREFIX..).unwrap_or_default());
                }
                _ => {}
            }
            let Some(next) = next else {
                fault(faults, at, "the file ends in the middle of a record");
                break;
            };
            at = next;
        }
        self.contents.blocks.extend(self.plain.take());
        Ok(())
    }

    fn name(&mut self, opcode: u8, content: &[u8]) {
        if opcode == op::SCHEMA
            && let Some(schema) = Schema::parse(content)
        {
            self.contents.schemas.insert(schema.id, schema);
        } else if opcode == op::CHANNEL
            && let Some(channel) = Channel::parse(content)
        {
            self.contents.channels.insert(channel.id, channel);
        }
    }

    fn message(&mut self, at: u64, stored: u64, front: &[u8]) {
        let Some((head, _)) = MessageHead::parse(front) else { return };
        self.count += 1;
        *self.contents.counts.entry(head.channel).or_default() += 1;
        let time = head.log_time;
        let block = self.plain.get_or_insert_with(|| Block {
            offset: at,
            stored: 0,
            start: time,
            end: time,
            length: 0,
            kind: Kind::Plain,
            channels: Some([].into()),
            index_length: 0,
        });
        block.start = block.start.min(time);
        block.end = block.end.max(time);
        block.stored += stored;
        block.length += stored;
        block.channels.get_or_insert_default().insert(head.channel.into());
        if block.length >= PLAIN_BLOCK {
            self.contents.blocks.extend(self.plain.take());
        }
    }

    fn chunk(
        &mut self,
        at: u64,
        bytes: &[u8],
        is_cut: bool,
        limits: &Limits,
        faults: &mut Vec<Fault>,
    ) {
        let Some((head, packed)) = ChunkHead::parse(bytes.get(PREFIX..).unwrap_or_default()) else {
            return;
        };
        let records = match unpack_chunk(&head, packed, is_cut, limits.chunk) {
            Ok(records) => records,
            Err(error) => return fault(faults, at, error.to_string()),
        };
        let mut cursor = Cursor::new(&records);
        while let Some((opcode, content)) = cursor.record() {
            self.name(opcode, content);
        }
        let mut block = Block {
            offset: at,
            stored: bytes.len() as u64,
            start: u64::MAX,
            end: 0,
            length: head.length,
            kind: if is_cut { Kind::CutChunk } else { Kind::Chunk },
            channels: Some([].into()),
            index_length: 0,
        };
        let before = self.count;
        for entry in block.kind.messages(&records, 0) {
            block.start = block.start.min(entry.log_time);
            block.end = block.end.max(entry.log_time);
            block.channels.get_or_insert_default().insert(entry.channel);
            if let Ok(channel) = u16::try_from(entry.channel) {
                *self.contents.counts.entry(channel).or_default() += 1;
            }
            self.count += 1;
        }
        if self.count > before {
            self.contents.blocks.push(block);
        }
    }
}
