//! Summary section at the end of a file.

use std::io::{Read, Seek};

use super::block::{Block, Kind};
use super::source::Source;
use super::{Contents, Limits, ReadError, fault, walk};
use crate::Fault;
use crate::record::{
    Channel, ChunkIndex, Cursor, FOOTER, Footer, MAGIC, PREFIX, Schema, Statistics, op,
};

/// Reads the content from the summary; none if it is missing or invalid.
pub(super) fn read<R: Read + Seek>(
    source: &mut Source<R>,
    limits: &Limits,
    faults: &mut Vec<Fault>,
) -> Result<Option<Contents>, ReadError> {
    let tail = (FOOTER + MAGIC.len()) as u64;
    let Some(footer_at) = source.length.checked_sub(tail) else { return Ok(None) };
    let tail = source.bytes(footer_at, tail)?;
    let footer = match Cursor::new(&tail).record() {
        Some((op::FOOTER, content)) if tail.ends_with(&MAGIC) => Footer::parse(content),
        _ => None,
    };
    let Some(footer) = footer else {
        fault(faults, source.length, "the file was not closed: its summary is missing");
        return Ok(None);
    };
    if footer.summary == 0 {
        return Ok(None);
    }
    if footer.summary < MAGIC.len() as u64 || footer.summary > footer_at {
        fault(faults, footer_at, "the footer refers to a summary outside of the file");
        return Ok(None);
    }
    let mut bytes = source.bytes(footer.summary, footer_at - footer.summary)?;
    let length = bytes.len();
    bytes.extend_from_slice(&tail[..PREFIX + 16]);
    if footer.crc != 0 && footer.crc != crc32fast::hash(&bytes) {
        fault(faults, footer_at, "the checksum of the summary is wrong");
        return Ok(None);
    }
    let Some((contents, chunks)) = parse(&bytes[..length]) else {
        fault(faults, footer.summary, "the summary is damaged");
        return Ok(None);
    };
    complete(source, contents, chunks, footer.summary, limits, faults)
}

fn parse(summary: &[u8]) -> Option<(Contents, Vec<ChunkIndex>)> {
    let mut contents = Contents::default();
    let mut chunks = Vec::new();
    let mut cursor = Cursor::new(summary);
    while !cursor.rest().is_empty() {
        let (opcode, content) = cursor.record()?;
        match opcode {
            op::SCHEMA => {
                let schema = Schema::parse(content)?;
                contents.schemas.insert(schema.id, schema);
            }
            op::CHANNEL => {
                let channel = Channel::parse(content)?;
                contents.channels.insert(channel.id, channel);
            }
            op::STATISTICS => {
                let statistics = Statistics::parse(content)?;
                contents.messages = Some(statistics.messages);
                contents.counts = statistics.by_channel;
            }
            op::CHUNK_INDEX => chunks.push(ChunkIndex::parse(content)?),
            _ => {}
        }
    }
    Some((contents, chunks))
}

/// Adds the blocks that the summary does not list: messages outside of chunks. None if the summary
/// is too incomplete to be trusted.
fn complete<R: Read + Seek>(
    source: &mut Source<R>,
    mut contents: Contents,
    mut chunks: Vec<ChunkIndex>,
    end: u64,
    limits: &Limits,
    faults: &mut Vec<Fault>,
) -> Result<Option<Contents>, ReadError> {
    // Repeated schemas and channels are optional, as are chunk indexes.
    let has_names = chunks
        .iter()
        .all(|chunk| chunk.indexes.keys().all(|channel| contents.channels.contains_key(channel)));
    let has_types = contents
        .channels
        .values()
        .all(|channel| channel.schema == 0 || contents.schemas.contains_key(&channel.schema));
    if !has_names || !has_types || contents.channels.is_empty() || chunks.is_empty() {
        return Ok(None);
    }
    chunks.sort_by_key(|chunk| chunk.offset);
    let mut at = MAGIC.len() as u64;
    for chunk in chunks {
        let next = chunk
            .offset
            .checked_add(chunk.stored)
            .and_then(|next| next.checked_add(chunk.indexes_length))
            .filter(|&next| chunk.offset >= at && next <= end);
        let Some(next) = next else {
            fault(faults, chunk.offset, "the summary refers to a chunk at an impossible offset");
            return Ok(None);
        };
        if chunk.length > limits.chunk {
            let wrong = format!("a chunk has {} bytes, more than the limit", chunk.length);
            fault(faults, chunk.offset, wrong);
        } else {
            contents.blocks.push(Block {
                offset: chunk.offset,
                stored: chunk.stored,
                start: chunk.start,
                end: chunk.end,
                length: chunk.length,
                kind: Kind::Chunk,
                // The channels are unknown without indexes.
                channels: (!chunk.indexes.is_empty())
                    .then(|| chunk.indexes.into_keys().map(u32::from).collect()),
                index_length: chunk.indexes_length,
            });
        }
        contents = walk::gap(source, at, chunk.offset, contents, faults)?;
        at = next;
    }
    walk::gap(source, at, end, contents, faults).map(Some)
}
