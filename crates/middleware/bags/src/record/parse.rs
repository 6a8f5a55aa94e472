//! Decoding of records. Input is untrusted: every length is checked against the available data.

use std::collections::BTreeMap;

use super::{Channel, ChunkHead, ChunkIndex, Footer, MessageHead, Schema, Statistics};

/// Read position in the content of a record.
pub(crate) struct Cursor<'a> {
    bytes: &'a [u8],
}

/// Reader of a fixed-size number.
macro_rules! number {
    ($name:ident, $type:ty) => {
        pub(crate) fn $name(&mut self) -> Option<$type> {
            let (bytes, rest) = self.bytes.split_first_chunk()?;
            self.bytes = rest;
            Some(<$type>::from_le_bytes(*bytes))
        }
    };
}

impl<'a> Cursor<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    number!(u8, u8);
    number!(u16, u16);
    number!(u32, u32);
    number!(u64, u64);

    /// Remaining bytes.
    pub(crate) fn rest(&self) -> &'a [u8] {
        self.bytes
    }

    pub(crate) fn take(&mut self, length: u64) -> Option<&'a [u8]> {
        let length = usize::try_from(length).ok()?;
        let (bytes, rest) = self.bytes.split_at_checked(length)?;
        self.bytes = rest;
        Some(bytes)
    }

    /// Bytes prefixed with their length in four bytes.
    pub(crate) fn bytes(&mut self) -> Option<&'a [u8]> {
        let length = self.u32()?;
        self.take(length.into())
    }

    /// Text; invalid UTF-8 is replaced, so that a malformed name does not lose the messages.
    pub(crate) fn text(&mut self) -> Option<String> {
        self.bytes().map(|bytes| String::from_utf8_lossy(bytes).into_owned())
    }

    pub(crate) fn map(&mut self) -> Option<BTreeMap<String, String>> {
        let mut entries = Cursor::new(self.bytes()?);
        let mut map = BTreeMap::new();
        while !entries.bytes.is_empty() {
            map.insert(entries.text()?, entries.text()?);
        }
        Some(map)
    }

    fn counts(&mut self) -> Option<BTreeMap<u16, u64>> {
        let mut entries = Cursor::new(self.bytes()?);
        let mut counts = BTreeMap::new();
        while !entries.bytes.is_empty() {
            counts.insert(entries.u16()?, entries.u64()?);
        }
        Some(counts)
    }

    /// Next record of a chunk or summary: opcode and content.
    pub(crate) fn record(&mut self) -> Option<(u8, &'a [u8])> {
        let opcode = self.u8()?;
        let length = self.u64()?;
        Some((opcode, self.take(length)?))
    }
}

impl Schema {
    pub(crate) fn parse(content: &[u8]) -> Option<Self> {
        let mut at = Cursor::new(content);
        let (id, name, encoding) = (at.u16()?, at.text()?, at.text()?);
        Some(Self { id, name, encoding, data: at.bytes()?.to_vec() })
    }
}

impl Channel {
    pub(crate) fn parse(content: &[u8]) -> Option<Self> {
        let mut at = Cursor::new(content);
        Some(Self {
            id: at.u16()?,
            schema: at.u16()?,
            topic: at.text()?,
            encoding: at.text()?,
            metadata: at.map()?,
        })
    }
}

impl MessageHead {
    /// Header and data.
    pub(crate) fn parse(content: &[u8]) -> Option<(Self, &[u8])> {
        let mut at = Cursor::new(content);
        let head = Self {
            channel: at.u16()?,
            sequence: at.u32()?,
            log_time: at.u64()?,
            publish_time: at.u64()?,
        };
        Some((head, at.rest()))
    }
}

impl ChunkHead {
    /// Header and the available part of the compressed records.
    pub(crate) fn parse(content: &[u8]) -> Option<(Self, &[u8])> {
        let mut at = Cursor::new(content);
        let head = Self {
            start: at.u64()?,
            end: at.u64()?,
            length: at.u64()?,
            crc: at.u32()?,
            compression: at.text()?,
            packed: at.u64()?,
        };
        Some((head, at.rest()))
    }
}

/// Channel, and times and offsets of its messages.
pub(crate) type MessageIndex = (u16, Vec<(u64, u64)>);

pub(crate) fn parse_message_index(content: &[u8]) -> Option<MessageIndex> {
    let mut at = Cursor::new(content);
    let channel = at.u16()?;
    let mut entries = Cursor::new(at.bytes()?);
    let mut index = Vec::new();
    while !entries.rest().is_empty() {
        index.push((entries.u64()?, entries.u64()?));
    }
    Some((channel, index))
}

impl ChunkIndex {
    pub(crate) fn parse(content: &[u8]) -> Option<Self> {
        let mut at = Cursor::new(content);
        Some(Self {
            start: at.u64()?,
            end: at.u64()?,
            offset: at.u64()?,
            stored: at.u64()?,
            indexes: at.counts()?,
            indexes_length: at.u64()?,
            compression: at.text()?,
            packed: at.u64()?,
            length: at.u64()?,
        })
    }
}

impl Statistics {
    pub(crate) fn parse(content: &[u8]) -> Option<Self> {
        let mut at = Cursor::new(content);
        Some(Self {
            messages: at.u64()?,
            schemas: at.u16()?,
            channels: at.u32()?,
            attachments: at.u32()?,
            metadata: at.u32()?,
            chunks: at.u32()?,
            start: at.u64()?,
            end: at.u64()?,
            by_channel: at.counts()?,
        })
    }
}

impl Footer {
    pub(crate) fn parse(content: &[u8]) -> Option<Self> {
        let mut at = Cursor::new(content);
        Some(Self { summary: at.u64()?, offsets: at.u64()?, crc: at.u32()? })
    }
}
