//! A piece of a file that is read at one time: a chunk, or messages that stand in none.

use std::collections::BTreeSet;
use std::io::{self, Read, Seek};

use super::source::Source;
use crate::compression::{Compression, unpack, unpack_some};
use crate::record::{ChunkHead, Cursor, MessageHead, PREFIX, op};
use crate::ros1;

/// Where a piece is and what is in it.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub(crate) offset: u64,
    pub(crate) stored: u64,
    pub(crate) start: u64,
    pub(crate) end: u64,
    /// Its length when it is unpacked.
    pub(crate) length: u64,
    pub(crate) kind: Kind,
    /// Its channels; none when nobody knows.
    pub(crate) channels: Option<BTreeSet<u32>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A whole chunk.
    Chunk,
    /// A chunk that the end of the file cuts.
    CutChunk,
    /// Records that stand in no chunk.
    Plain,
    /// A chunk of a ROS 1 bag, whole or cut.
    Ros1 {
        /// Whether the end of the file cuts it.
        is_cut: bool,
    },
}

impl Block {
    /// The records, unpacked and held against their sum.
    pub(super) fn load<R: Read + Seek>(
        &self,
        source: &mut Source<R>,
        most: u64,
    ) -> io::Result<Vec<u8>> {
        let stored = source.bytes(self.offset, self.stored)?;
        match self.kind {
            Kind::Plain => return Ok(stored),
            Kind::Ros1 { is_cut } => return ros1::unpack_record(&stored, is_cut, most),
            Kind::Chunk | Kind::CutChunk => {}
        }
        let content = stored.get(PREFIX..).unwrap_or_default();
        let (head, packed) = ChunkHead::parse(content).ok_or_else(|| wrong("a chunk is cut"))?;
        unpack_chunk(&head, packed, self.kind == Kind::CutChunk, most)
    }
}

/// One message among records.
#[derive(Clone, Copy)]
pub(crate) struct Entry<'a> {
    /// Where its record begins.
    pub(crate) at: usize,
    pub(crate) channel: u32,
    pub(crate) sequence: u32,
    pub(crate) log_time: u64,
    pub(crate) publish_time: u64,
    pub(crate) data: &'a [u8],
}

impl Kind {
    /// The complete messages among records of this kind, from a place on.
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
        return Err(wrong(format!(
            "a chunk announces {} bytes, more than the {most} that are read",
            head.length
        )));
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
