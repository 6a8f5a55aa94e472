//! Blocks, the units of reading: a chunk, or messages outside of chunks.

use std::collections::BTreeSet;
use std::io::{self, Read, Seek};

use super::source::Source;
use crate::compression::{Compression, unpack, unpack_some};
use crate::record::{ChunkHead, Cursor, MessageHead, PREFIX, op};
use crate::ros1;

/// Location and content of a block.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub(crate) offset: u64,
    pub(crate) stored: u64,
    pub(crate) start: u64,
    pub(crate) end: u64,
    /// Length after decompression \[bytes\].
    pub(crate) length: u64,
    pub(crate) kind: Kind,
    /// Channels of the block; none if unknown.
    pub(crate) channels: Option<BTreeSet<u32>>,
    /// Maximum length of the message indexes that follow the block; 0 without indexes \[bytes\].
    #[cfg_attr(not(feature = "files"), expect(dead_code, reason = "for random access"))]
    pub(crate) index_length: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A complete chunk.
    Chunk,
    /// A chunk truncated by the end of the file.
    CutChunk,
    /// Records outside of chunks.
    Plain,
    /// A chunk of a ROS 1 bag, complete or truncated.
    Ros1 {
        /// True if the end of the file truncates it.
        is_cut: bool,
    },
}

impl Block {
    /// Reads and decompresses the records and verifies their checksum.
    pub(super) fn load<R: Read + Seek>(
        &self,
        source: &mut Source<R>,
        most: u64,
    ) -> io::Result<Vec<u8>> {
        self.unpack(source.bytes(self.offset, self.stored)?, most)
    }

    /// Decompresses the stored bytes of the block and verifies their checksum.
    pub(crate) fn unpack(&self, stored: Vec<u8>, most: u64) -> io::Result<Vec<u8>> {
        match self.kind {
            Kind::Plain => return Ok(stored),
            Kind::Ros1 { is_cut } => return ros1::unpack_record(&stored, is_cut, most),
            Kind::Chunk | Kind::CutChunk => {}
        }
        let content = stored.get(PREFIX..).unwrap_or_default();
        let (head, packed) =
            ChunkHead::parse(content).ok_or_else(|| wrong("a chunk is truncated"))?;
        let length = packed.len() as u64;
        let is_plain = Compression::from_name(&head.compression) == Some(Compression::None);
        if is_plain && self.kind == Kind::Chunk && head.length == length && length <= most {
            require_checksum(&head, packed)?;
            let start = stored.len() - packed.len();
            let mut records = stored;
            records.drain(..start);
            return Ok(records);
        }
        unpack_chunk(&head, packed, self.kind == Kind::CutChunk, most)
    }
}

/// A message among records.
#[derive(Clone, Copy)]
pub(crate) struct Entry<'a> {
    /// Start of its record.
    pub(crate) at: usize,
    pub(crate) channel: u32,
    pub(crate) sequence: u32,
    pub(crate) log_time: u64,
    pub(crate) publish_time: u64,
    pub(crate) data: &'a [u8],
}

impl Kind {
    /// Iterates over the complete messages among records of this kind, from an offset.
    pub(crate) fn messages(self, records: &[u8], from: usize) -> impl Iterator<Item = Entry<'_>> {
        let mut at = from;
        std::iter::from_fn(move || match self {
            Self::Ros1 { .. } => ros1::next_message(records, &mut at).map(|(at, one)| Entry {
                at,
                channel: one.connection,
                sequence: 0,
                log_time: one.time,
                publish_time: one.time,
                data: one.data,
            }),
            _ => next_message(records, &mut at),
        })
    }
}

fn next_message<'a>(records: &'a [u8], at: &mut usize) -> Option<Entry<'a>> {
    let mut cursor = Cursor::new(records.get(*at..)?);
    loop {
        let place = records.len() - cursor.rest().len();
        let (opcode, content) = cursor.record()?;
        *at = records.len() - cursor.rest().len();
        if opcode == op::MESSAGE
            && let Some((head, data)) = MessageHead::parse(content)
        {
            return Some(Entry {
                at: place,
                channel: head.channel.into(),
                sequence: head.sequence,
                log_time: head.log_time,
                publish_time: head.publish_time,
                data,
            });
        }
    }
}

fn wrong(message: impl Into<String>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, message.into())
}

/// Decompresses the records of a chunk; of a truncated one as many bytes as possible.
pub(super) fn unpack_chunk(
    head: &ChunkHead,
    packed: &[u8],
    is_cut: bool,
    most: u64,
) -> io::Result<Vec<u8>> {
    let compression = Compression::from_name(&head.compression)
        .ok_or_else(|| wrong(format!("`{}` is not a known compression", head.compression)))?;
    if head.length > most {
        return Err(wrong(format!(
            "a chunk declares {} bytes, more than the limit of {most}",
            head.length
        )));
    }
    if is_cut {
        return Ok(unpack_some(compression, packed, head.length).0);
    }
    let records = unpack(compression, packed, head.length)?;
    require_checksum(head, &records)?;
    Ok(records)
}

fn require_checksum(head: &ChunkHead, records: &[u8]) -> io::Result<()> {
    if head.crc != 0 && crc32fast::hash(records) != head.crc {
        return Err(wrong("the checksum of a chunk is wrong"));
    }
    Ok(())
}
