//! A piece of a file that is read at one time: a chunk, or messages that stand in none.

use std::collections::BTreeSet;
use std::io::{self, Read, Seek};

use super::source::Source;
use crate::compression::{Compression, unpack, unpack_some};
use crate::record::{ChunkHead, Cursor, MessageHead, PREFIX, op};

/// Where a piece is and what is in it.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) offset: u64,
    pub(super) stored: u64,
    pub(super) start: u64,
    pub(super) end: u64,
    /// Its length when it is unpacked.
    pub(super) length: u64,
    pub(super) kind: Kind,
    /// Its channels; none when nobody knows.
    pub(super) channels: Option<BTreeSet<u16>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A whole chunk.
    Chunk,
    /// A chunk that the end of the file cuts.
    CutChunk,
    /// Records that stand in no chunk.
    Plain,
}

impl Block {
    /// The records, unpacked and held against their sum.
    pub(super) fn load<R: Read + Seek>(
        &self,
        source: &mut Source<R>,
        most: u64,
    ) -> io::Result<Vec<u8>> {
        let stored = source.bytes(self.offset, self.stored)?;
        if self.kind == Kind::Plain {
            return Ok(stored);
        }
        let content = stored.get(PREFIX..).unwrap_or_default();
        let (head, packed) = ChunkHead::parse(content).ok_or_else(|| wrong("a chunk is cut"))?;
        unpack_chunk(&head, packed, self.kind == Kind::CutChunk, most)
    }
}

fn wrong(message: impl Into<String>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, message.into())
}

/// The records of a chunk; of one that is cut as many bytes as come out.
pub(super) fn unpack_chunk(
    head: &ChunkHead,
    packed: &[u8],
    is_cut: bool,
    most: u64,
) -> io::Result<Vec<u8>> {
    let compression = Compression::from_name(&head.compression)
        .ok_or_else(|| wrong(format!("`{}` is no known compression", head.compression)))?;
    if head.length > most {
        return Err(wrong(format!("a chunk holds {} bytes, more than is allowed", head.length)));
    }
    if is_cut {
        return Ok(unpack_some(compression, packed, head.length).0);
    }
    let records = unpack(compression, packed, head.length)?;
    if head.crc != 0 && crc32fast::hash(&records) != head.crc {
        return Err(wrong("the sum over a chunk is wrong"));
    }
    Ok(records)
}

/// The complete messages among records, with the place of each.
pub(super) fn messages(records: &[u8]) -> impl Iterator<Item = (usize, MessageHead)> + '_ {
    let mut cursor = Cursor::new(records);
    std::iter::from_fn(move || {
        loop {
            let at = records.len() - cursor.rest().len();
            let (opcode, content) = cursor.record()?;
            if opcode == op::MESSAGE
                && let Some((head, _)) = MessageHead::parse(content)
            {
                return Some((at, head));
            }
        }
    })
}
