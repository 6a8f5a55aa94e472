//! Messages of an MCAP stream that cannot be sought in, such as a pipe: the file format is the
//! specification of MCAP, version 1 (mcap.dev).

use std::collections::BTreeMap;
use std::io::{self, ErrorKind, Read};

const MAGIC: &[u8; 8] = b"\x89MCAP0\r\n";

/// Records are no longer than this \[bytes\]; recorders write chunks of a few MiB.
const MAX_RECORD_BYTES: u64 = 256 << 20;

mod op {
    pub(super) const FOOTER: u8 = 0x02;
    pub(super) const SCHEMA: u8 = 0x03;
    pub(super) const CHANNEL: u8 = 0x04;
    pub(super) const MESSAGE: u8 = 0x05;
    pub(super) const CHUNK: u8 = 0x06;
}

/// A topic with the name of its type.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Topic {
    pub(crate) name: String,
    pub(crate) type_name: String,
}

/// A recording that is read while it is written.
pub(crate) struct Stream<R> {
    source: R,
    schemas: BTreeMap<u16, String>,
    topics: BTreeMap<u16, Topic>,
}

fn bad(what: &str) -> io::Error {
    io::Error::new(ErrorKind::InvalidData, format!("the recording is not an MCAP file: {what}"))
}

/// Reads fields of a record from its front.
struct Fields<'a>(&'a [u8]);

impl<'a> Fields<'a> {
    fn bytes(&mut self, length: usize) -> io::Result<&'a [u8]> {
        let (front, rest) = self.0.split_at_checked(length).ok_or_else(|| bad("a short record"))?;
        self.0 = rest;
        Ok(front)
    }

    fn array<const N: usize>(&mut self) -> io::Result<[u8; N]> {
        let mut array = [0; N];
        array.copy_from_slice(self.bytes(N)?);
        Ok(array)
    }

    fn u16(&mut self) -> io::Result<u16> {
        self.array().map(u16::from_le_bytes)
    }

    fn u32(&mut self) -> io::Result<u32> {
        self.array().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> io::Result<u64> {
        self.array().map(u64::from_le_bytes)
    }

    fn text(&mut self) -> io::Result<String> {
        let length = self.u32()? as usize;
        Ok(String::from_utf8_lossy(self.bytes(length)?).into_owned())
    }

    /// The next record of a chunk.
    fn record(&mut self) -> io::Result<Option<(u8, Fields<'a>)>> {
        if self.0.is_empty() {
            return Ok(None);
        }
        let [op] = self.array()?;
        let length = usize::try_from(self.u64()?).map_err(|_| bad("a long record"))?;
        Ok(Some((op, Fields(self.bytes(length)?))))
    }
}

impl<R: Read> Stream<R> {
    pub(crate) fn open(mut source: R) -> io::Result<Self> {
        let mut magic = [0; 8];
        source.read_exact(&mut magic)?;
        if magic != *MAGIC {
            return Err(bad("another beginning"));
        }
        Ok(Self { source, schemas: BTreeMap::new(), topics: BTreeMap::new() })
    }

    /// Calls `visit` with the topic, the time \[ns\] and the bytes of every message, until the end of the
    /// stream.
    pub(crate) fn each(
        &mut self,
        mut visit: impl FnMut(&Topic, u64, &[u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        let (mut content, mut is_over) = (Vec::new(), false);
        loop {
            let mut prefix = [0; 9];
            match self.source.read_exact(&mut prefix) {
                Err(error) if error.kind() == ErrorKind::UnexpectedEof && is_over => return Ok(()),
                other => other?,
            }
            let (op, mut length) = (prefix[0], Fields(&prefix[1..]));
            let length = length.u64()?;
            if length > MAX_RECORD_BYTES {
                return Err(bad("a record of over 256 MiB"));
            }
            content.clear();
            let read = (&mut self.source).take(length).read_to_end(&mut content)?;
            if read as u64 != length {
                return Err(bad("the recording is cut off"));
            }
            match op {
                op::CHUNK => self.chunk(&content, &mut visit)?,
                op::FOOTER => {
                    is_over = true;
                    // The magic ends the file.
                    let mut magic = [0; 8];
                    self.source.read_exact(&mut magic)?;
                }
                // After the data come schemas and channels once more, as a summary.
                _ => self.record(op, Fields(&content), &mut visit)?,
            }
        }
    }

    fn chunk(
        &mut self,
        content: &[u8],
        visit: &mut impl FnMut(&Topic, u64, &[u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut head = Fields(content);
        let (_start, _end, length, _crc) = (head.u64()?, head.u64()?, head.u64()?, head.u32()?);
        let compression = head.text()?;
        let packed = head.u64()? as usize;
        let packed = head.bytes(packed)?;
        if length > MAX_RECORD_BYTES {
            return Err(bad("a chunk of over 256 MiB"));
        }
        let unpacked = match compression.as_str() {
            "" => packed.to_vec(),
            "zstd" => zstd::bulk::decompress(packed, length as usize)?,
            other => return Err(bad(&format!("chunks packed by `{other}` are not read here"))),
        };
        let mut records = Fields(&unpacked);
        while let Some((op, fields)) = records.record()? {
            self.record(op, fields, visit)?;
        }
        Ok(())
    }

    fn record(
        &mut self,
        op: u8,
        mut fields: Fields<'_>,
        visit: &mut impl FnMut(&Topic, u64, &[u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        match op {
            op::SCHEMA => {
                let id = fields.u16()?;
                self.schemas.insert(id, fields.text()?);
            }
            op::CHANNEL => {
                let (id, schema) = (fields.u16()?, fields.u16()?);
                let type_name = self.schemas.get(&schema).cloned().unwrap_or_default();
                self.topics.insert(id, Topic { name: fields.text()?, type_name });
            }
            op::MESSAGE => {
                let (channel, _sequence) = (fields.u16()?, fields.u32()?);
                let (time_ns, _published) = (fields.u64()?, fields.u64()?);
                let topic = self.topics.get(&channel).ok_or_else(|| bad("an unknown channel"))?;
                visit(topic, time_ns, fields.0)?;
            }
            _ => {}
        }
        Ok(())
    }
}
