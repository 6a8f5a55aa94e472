//! Scan of a file from front to back, for files without a valid index.

use std::collections::BTreeMap;
use std::io::{Read, Seek};

use super::read::Topics;
use super::record::{Header, next};
use super::{MAGIC, op, unpack_record};
use crate::read::{Block, Found, Kind, Source, fault};
use crate::record::Cursor;
use crate::{Fault, Limits, ReadError};

/// Maximum size of a header \[bytes\]; type definitions are in the data.
const LONGEST_HEADER: u32 = 1 << 20;

/// Reads all records.
pub(super) fn all<R: Read + Seek>(
    source: &mut Source<R>,
    limits: &Limits,
    faults: &mut Vec<Fault>,
) -> Result<Found, ReadError> {
    let mut walk = Walk { topics: Topics::default(), blocks: Vec::new(), counts: BTreeMap::new() };
    let mut at = MAGIC.len() as u64;
    while at < source.length {
        let lead = source.bytes(at, 4)?;
        let Some(length) = Cursor::new(&lead).u32().filter(|&length| length <= LONGEST_HEADER)
        else {
            fault(faults, at, "a record is damaged or truncated; nothing after it can be read");
            break;
        };
        let head_length = 8 + u64::from(length);
        let head = source.bytes(at, head_length)?;
        let mut cursor = Cursor::new(&head);
        let (Some(header), Some(data_length)) = (cursor.bytes(), cursor.u32()) else {
            fault(faults, at, "the file ends in the middle of a record");
            break;
        };
        let header = Header::new(header);
        let stored = head_length + u64::from(data_length);
        let is_cut = at + stored > source.length;
        match header.opcode() {
            Some(op::CHUNK) => {
                let bytes = source.bytes(at, stored)?;
                walk.chunk(at, &bytes, is_cut, limits, faults);
            }
            Some(op::CONNECTION) if !is_cut => {
                let data = source.bytes(at + head_length, data_length.into())?;
                walk.topics.add(header, &data);
            }
            Some(op::BAG | op::INDEX | op::CHUNK_INFO | op::CONNECTION) => {}
            Some(op::MESSAGE) => {
                fault(faults, at, "a message is outside of all chunks and is skipped");
            }
            _ => {
                fault(faults, at, "this is not a record; nothing after it can be read");
                break;
            }
        }
        if is_cut {
            fault(faults, at, "the file ends in the middle of a record");
            break;
        }
        at += stored;
    }
    Ok(walk.found())
}

struct Walk {
    topics: Topics,
    blocks: Vec<Block>,
    /// Message counts by connection.
    counts: BTreeMap<u32, u64>,
}

impl Walk {
    fn chunk(
        &mut self,
        at: u64,
        bytes: &[u8],
        is_cut: bool,
        limits: &Limits,
        faults: &mut Vec<Fault>,
    ) {
        let records = match unpack_record(bytes, is_cut, limits.chunk) {
            Ok(records) => records,
            Err(error) => return fault(faults, at, error.to_string()),
        };
        let mut cursor = Cursor::new(&records);
        while let Some((header, data)) = next(&mut cursor) {
            if header.opcode() == Some(op::CONNECTION) {
                self.topics.add(header, data);
            }
        }
        let mut block = Block {
            offset: at,
            stored: bytes.len() as u64,
            start: u64::MAX,
            end: 0,
            length: records.len() as u64,
            kind: Kind::Ros1 { is_cut },
            channels: Some([].into()),
            index_length: 0,
        };
        for entry in block.kind.messages(&records, 0) {
            block.start = block.start.min(entry.log_time);
            block.end = block.end.max(entry.log_time);
            block.channels.get_or_insert_default().insert(entry.channel);
            *self.counts.entry(entry.channel).or_default() += 1;
        }
        if block.start <= block.end {
            self.blocks.push(block);
        }
    }

    fn found(self) -> Found {
        let Topics { topics, by_connection, .. } = self.topics;
        let mut counts = vec![0; topics.len()];
        for (connection, count) in &self.counts {
            if let Some(&topic) = by_connection.get(connection) {
                counts[topic] += count;
            }
        }
        let messages = Some(counts.iter().sum());
        // Messages of an undescribed topic cannot be used.
        let blocks = self.blocks;
        Found { topics, by_channel: by_connection, counts, blocks, messages, has_summary: false }
    }
}
