//! Encoding and decoding of MCAP records.
//!
//! Layouts from the MCAP specification, version 1: every record is an opcode, the length of its
//! content in eight bytes, and the content; numbers are little endian; strings, maps and lists are
//! prefixed with their length in **bytes**.

mod parse;
mod put;

use std::collections::BTreeMap;

pub(crate) use parse::{Cursor, parse_message_index};
pub(crate) use put::{
    begin, end, put_message_index, put_metadata, put_metadata_index, put_summary_offset, put_text,
};

/// First and last eight bytes of a file.
pub(crate) const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";

/// Size of opcode and length before each record \[bytes\].
pub(crate) const PREFIX: usize = 9;

/// Size of a footer with its prefix \[bytes\].
pub(crate) const FOOTER: usize = PREFIX + 8 + 8 + 4;

pub(crate) mod op {
    pub(crate) const HEADER: u8 = 0x01;
    pub(crate) const FOOTER: u8 = 0x02;
    pub(crate) const SCHEMA: u8 = 0x03;
    pub(crate) const CHANNEL: u8 = 0x04;
    pub(crate) const MESSAGE: u8 = 0x05;
    pub(crate) const CHUNK: u8 = 0x06;
    pub(crate) const MESSAGE_INDEX: u8 = 0x07;
    pub(crate) const CHUNK_INDEX: u8 = 0x08;
    pub(crate) const ATTACHMENT: u8 = 0x09;
    pub(crate) const ATTACHMENT_INDEX: u8 = 0x0a;
    pub(crate) const STATISTICS: u8 = 0x0b;
    pub(crate) const METADATA: u8 = 0x0c;
    pub(crate) const METADATA_INDEX: u8 = 0x0d;
    pub(crate) const SUMMARY_OFFSET: u8 = 0x0e;
    pub(crate) const DATA_END: u8 = 0x0f;
}

/// Schema record: a message type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Schema {
    pub(crate) id: u16,
    pub(crate) name: String,
    pub(crate) encoding: String,
    pub(crate) data: Vec<u8>,
}

/// Channel record: a topic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Channel {
    pub(crate) id: u16,
    pub(crate) schema: u16,
    pub(crate) topic: String,
    pub(crate) encoding: String,
    pub(crate) metadata: BTreeMap<String, String>,
}

/// Header of a message record; the data follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct MessageHead {
    pub(crate) channel: u16,
    pub(crate) sequence: u32,
    pub(crate) log_time: u64,
    pub(crate) publish_time: u64,
}

/// Header of a chunk record; the compressed records follow.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ChunkHead {
    pub(crate) start: u64,
    pub(crate) end: u64,
    pub(crate) length: u64,
    pub(crate) crc: u32,
    pub(crate) compression: String,
    /// Size of the compressed records \[bytes\].
    pub(crate) packed: u64,
}

/// Chunk index record.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ChunkIndex {
    pub(crate) start: u64,
    pub(crate) end: u64,
    pub(crate) offset: u64,
    pub(crate) stored: u64,
    /// Offset of the message index of each channel.
    pub(crate) indexes: BTreeMap<u16, u64>,
    pub(crate) indexes_length: u64,
    pub(crate) compression: String,
    pub(crate) packed: u64,
    pub(crate) length: u64,
}

/// Statistics record.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Statistics {
    pub(crate) messages: u64,
    pub(crate) schemas: u16,
    pub(crate) channels: u32,
    pub(crate) attachments: u32,
    pub(crate) metadata: u32,
    pub(crate) chunks: u32,
    pub(crate) start: u64,
    pub(crate) end: u64,
    pub(crate) by_channel: BTreeMap<u16, u64>,
}

/// Footer record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Footer {
    pub(crate) summary: u64,
    pub(crate) offsets: u64,
    pub(crate) crc: u32,
}
