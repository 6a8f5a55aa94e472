//! Encoding and decoding of records.

use super::op;
use crate::record::Cursor;

/// Fields of a record's header. Input is untrusted.
#[derive(Clone, Copy)]
pub(super) struct Header<'a>(&'a [u8]);

impl<'a> Header<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    pub(super) fn get(self, name: &str) -> Option<&'a [u8]> {
        let mut cursor = Cursor::new(self.0);
        loop {
            let field = cursor.bytes()?;
            let value =
                field.strip_prefix(name.as_bytes()).and_then(|rest| rest.strip_prefix(b"="));
            if value.is_some() {
                return value;
            }
        }
    }

    pub(super) fn text(self, name: &str) -> Option<String> {
        self.get(name).map(|bytes| String::from_utf8_lossy(bytes).into_owned())
    }

    pub(super) fn u32(self, name: &str) -> Option<u32> {
        Cursor::new(self.get(name)?).u32()
    }

    pub(super) fn u64(self, name: &str) -> Option<u64> {
        Cursor::new(self.get(name)?).u64()
    }

    pub(super) fn time(self, name: &str) -> Option<u64> {
        time(&mut Cursor::new(self.get(name)?))
    }

    pub(super) fn opcode(self) -> Option<u8> {
        self.get("op")?.first().copied()
    }
}

/// The latest time that a bag can represent, in the year 2106 \[ns\].
const LATEST: u64 = u32::MAX as u64 * 1_000_000_000 + 999_999_999;

/// Time from seconds and nanoseconds \[ns\]. The nanoseconds may exceed a second in damaged bags.
pub(super) fn time(cursor: &mut Cursor<'_>) -> Option<u64> {
    let (sec, nsec) = (cursor.u32()?, cursor.u32()?);
    Some((u64::from(sec) * 1_000_000_000 + u64::from(nsec)).min(LATEST))
}

/// Next record: header and data.
pub(super) fn next<'a>(cursor: &mut Cursor<'a>) -> Option<(Header<'a>, &'a [u8])> {
    let header = cursor.bytes()?;
    Some((Header::new(header), cursor.bytes()?))
}

/// A message of a chunk.
pub(crate) struct Message<'a> {
    pub(crate) connection: u32,
    pub(crate) time: u64,
    pub(crate) data: &'a [u8],
}

/// Returns the next complete message from offset `at` with its offset, and advances `at`.
pub(crate) fn next_message<'a>(records: &'a [u8], at: &mut usize) -> Option<(usize, Message<'a>)> {
    let mut cursor = Cursor::new(records.get(*at..)?);
    loop {
        let place = records.len() - cursor.rest().len();
        let (header, data) = next(&mut cursor)?;
        *at = records.len() - cursor.rest().len();
        if header.opcode() == Some(op::MESSAGE)
            && let (Some(connection), Some(time)) = (header.u32("conn"), header.time("time"))
        {
            return Some((place, Message { connection, time, data }));
        }
    }
}

/// Connection, and times and offsets of its messages, of an index record.
#[cfg(feature = "files")]
pub(crate) type ConnectionIndex = (u32, Vec<(u64, u64)>);

/// Reads the next index record at the cursor; none at another record or if it is damaged.
#[cfg(feature = "files")]
pub(crate) fn next_index(cursor: &mut Cursor<'_>) -> Option<ConnectionIndex> {
    let (header, data) = next(cursor)?;
    if header.opcode() != Some(op::INDEX) || header.u32("ver") != Some(1) {
        return None;
    }
    let connection = header.u32("conn")?;
    let mut entries = Cursor::new(data);
    let mut index = Vec::new();
    while !entries.rest().is_empty() {
        index.push((time(&mut entries)?, u64::from(entries.u32()?)));
    }
    (header.u32("count").map(|count| count as usize) == Some(index.len()))
        .then_some((connection, index))
}

/// Appends a header, prefixed with its length.
pub(super) fn put_header(out: &mut Vec<u8>, fields: &[(&str, &[u8])]) {
    let length: usize = fields.iter().map(|(name, value)| 4 + name.len() + 1 + value.len()).sum();
    put_u32(out, length);
    for (name, value) in fields {
        put_u32(out, name.len() + 1 + value.len());
        out.extend_from_slice(name.as_bytes());
        out.push(b'=');
        out.extend_from_slice(value);
    }
}

/// Appends data, prefixed with its length.
pub(super) fn put_data(out: &mut Vec<u8>, data: &[u8]) {
    put_u32(out, data.len());
    out.extend_from_slice(data);
}

/// Writes a length; callers have checked it against the limit of the format.
#[expect(clippy::cast_possible_truncation, reason = "longer data was rejected")]
pub(super) fn put_u32(out: &mut Vec<u8>, value: usize) {
    out.extend((value as u32).to_le_bytes());
}

/// A time as seconds and nanoseconds, saturated at the latest time.
pub(super) fn time_bytes(time: u64) -> [u8; 8] {
    let time = time.min(LATEST);
    let sec = u32::try_from(time / 1_000_000_000).unwrap_or(u32::MAX);
    let nsec = (time % 1_000_000_000) as u32;
    let mut bytes = [0; 8];
    bytes[..4].copy_from_slice(&sec.to_le_bytes());
    bytes[4..].copy_from_slice(&nsec.to_le_bytes());
    bytes
}
