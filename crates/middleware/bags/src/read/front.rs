//! Records at the front of a file: the metadata that recorders write before the first message.

use std::collections::BTreeMap;
use std::io::{self, Read, Seek};

use super::source::Source;
use crate::metadata::embedded_custom_data;
use crate::record::{Cursor, MAGIC, PREFIX, op};

/// Name of rosbag2's metadata record, and of the entry that has the YAML.
const METADATA: &str = "rosbag2";
const SERIALIZED: &str = "serialized_metadata";

/// Maximum number of records that are read.
const MAX_RECORDS: usize = 16;

/// Maximum size of a record that is read \[bytes\].
const MAX_RECORD_BYTES: u64 = 16 << 20;

/// Returns the `custom_data` in the metadata of rosbag2; empty if there is none.
pub(super) fn custom_data<R: Read + Seek>(
    source: &mut Source<R>,
) -> io::Result<BTreeMap<String, String>> {
    let mut at = MAGIC.len() as u64;
    for _ in 0..MAX_RECORDS {
        let front = source.bytes(at, PREFIX as u64)?;
        let mut cursor = Cursor::new(&front);
        let (Some(opcode), Some(length)) = (cursor.u8(), cursor.u64()) else { break };
        if !matches!(opcode, op::HEADER | op::METADATA) || length > MAX_RECORD_BYTES {
            break;
        }
        let content_at = at + PREFIX as u64;
        if opcode == op::METADATA {
            let content = source.bytes(content_at, length)?;
            if let Some(data) = parse(&content) {
                return Ok(data);
            }
        }
        at = content_at + length;
    }
    Ok(BTreeMap::new())
}

fn parse(content: &[u8]) -> Option<BTreeMap<String, String>> {
    let mut cursor = Cursor::new(content);
    if cursor.text()? != METADATA {
        return None;
    }
    embedded_custom_data(cursor.map()?.get(SERIALIZED)?)
}
