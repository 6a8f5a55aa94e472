//! Opening of a file by its index.

use std::collections::BTreeMap;
use std::io::{Read, Seek};

use super::record::{Header, next, time};
use super::{MAGIC, op, walk};
use crate::read::{Block, Found, Kind, Source, fault};
use crate::record::Cursor;
use crate::{BagTopic, Fault, Limits, ReadError};

/// Reads the content of a file from its index or from a scan.
pub(crate) fn read<R: Read + Seek>(
    source: &mut Source<R>,
    limits: &Limits,
    faults: &mut Vec<Fault>,
) -> Result<Found, ReadError> {
    if let Some(found) = by_index(source, limits, faults)? {
        return Ok(found);
    }
    walk::all(source, limits, faults)
}

/// Maximum length of the header of an index record with its lengths \[bytes\]; it has four short
/// fields.
const INDEX_HEADER_BYTES: u64 = 96;

/// Topics so far, and the topic of each connection.
#[derive(Default)]
pub(super) struct Topics {
    pub(super) topics: Vec<BagTopic>,
    pub(super) by_connection: BTreeMap<u32, usize>,
    /// Topic index by name, type and MD5 sum.
    by_name: BTreeMap<[String; 3], usize>,
}

impl Topics {
    /// Adds a connection; publishers of the same topic and type share one topic.
    pub(super) fn add(&mut self, header: Header<'_>, data: &[u8]) -> Option<()> {
        let connection = header.u32("conn")?;
        let about = Header::new(data);
        // The name in the record header is the recorded one.
        let name = header.text("topic").or_else(|| about.text("topic"))?;
        let mut metadata = BTreeMap::new();
        for key in ["md5sum", "callerid", "latching"] {
            metadata.extend(about.text(key).map(|value| (key.to_owned(), value)));
        }
        let topic = BagTopic {
            name,
            type_name: about.text("type").unwrap_or_default(),
            encoding: "ros1".into(),
            schema_encoding: "ros1msg".into(),
            schema: about.get("message_definition").unwrap_or_default().to_vec(),
            metadata,
        };
        let sum = topic.metadata.get("md5sum").cloned().unwrap_or_default();
        let key = [topic.name.clone(), topic.type_name.clone(), sum];
        let at = *self.by_name.entry(key).or_insert(self.topics.len());
        if at == self.topics.len() {
            self.topics.push(topic);
        }
        self.by_connection.insert(connection, at);
        Some(())
    }
}

/// Reads the index; none if it is missing or invalid.
fn by_index<R: Read + Seek>(
    source: &mut Source<R>,
    limits: &Limits,
    faults: &mut Vec<Fault>,
) -> Result<Option<Found>, ReadError> {
    // The header is padded to 4096 bytes so that it can be rewritten.
    let front = source.bytes(MAGIC.len() as u64, 4096)?;
    let header = Cursor::new(&front).bytes().map(Header::new);
    let header = header.filter(|header| header.opcode() == Some(op::BAG));
    let index_at = header.and_then(|header| header.u64("index_pos")).unwrap_or(0);
    if index_at == 0 || index_at > source.length {
        fault(faults, MAGIC.len() as u64, "the file was not closed: its index is missing");
        return Ok(None);
    }
    let index = source.bytes(index_at, source.length - index_at)?;
    let announced = |name| header.and_then(|header| header.u32(name)).unwrap_or(0) as usize;
    let is_whole = |(topics, infos): &(Topics, Vec<ChunkInfo>)| {
        topics.by_connection.len() == announced("conn_count")
            && infos.len() == announced("chunk_count")
    };
    let Some((topics, infos)) = parse(&index).filter(is_whole) else {
        fault(faults, index_at, "the index is damaged");
        return Ok(None);
    };
    let mut counts = vec![0_u64; topics.topics.len()];
    let mut blocks = Vec::new();
    for info in infos {
        let Some((stored, length)) = chunk_at(source, info.at, index_at)? else {
            fault(faults, info.at, "the index refers to an offset without a chunk");
            return Ok(None);
        };
        for (connection, count) in &info.counts {
            let Some(&topic) = topics.by_connection.get(connection) else {
                fault(
                    faults,
                    info.at,
                    "the index refers to a connection that it does not describe",
                );
                return Ok(None);
            };
            counts[topic] = counts[topic].saturating_add(u64::from(*count));
        }
        if length > limits.chunk {
            let wrong = format!("a chunk has {length} bytes, more than the limit");
            fault(faults, info.at, wrong);
            continue;
        }
        if !info.counts.is_empty() {
            blocks.push(Block {
                offset: info.at,
                stored,
                start: info.start,
                end: info.end,
                length,
                kind: Kind::Ros1 { is_cut: false },
                index_length: index_length(&info.counts),
                channels: Some(info.counts.keys().copied().collect()),
            });
        }
    }
    let messages = Some(counts.iter().fold(0, |sum, one| u64::saturating_add(sum, *one)));
    let Topics { topics, by_connection: by_channel, .. } = topics;
    Ok(Some(Found { topics, by_channel, counts, blocks, messages, has_summary: true }))
}

struct ChunkInfo {
    at: u64,
    start: u64,
    end: u64,
    counts: BTreeMap<u32, u32>,
}

fn parse(index: &[u8]) -> Option<(Topics, Vec<ChunkInfo>)> {
    let mut topics = Topics::default();
    let mut infos = Vec::new();
    let mut cursor = Cursor::new(index);
    while !cursor.rest().is_empty() {
        let (header, data) = next(&mut cursor)?;
        match header.opcode()? {
            op::CONNECTION => topics.add(header, data)?,
            op::CHUNK_INFO => {
                let mut counts = BTreeMap::new();
                let mut entries = Cursor::new(data);
                while !entries.rest().is_empty() {
                    counts.insert(entries.u32()?, entries.u32()?);
                }
                let at = header.u64("chunk_pos")?;
                let start = time(&mut Cursor::new(header.get("start_time")?))?;
                let end = header.time("end_time")?;
                infos.push(ChunkInfo { at, start, end, counts });
            }
            _ => {}
        }
    }
    Some((topics, infos))
}

/// Maximum length of the indexes of a chunk: for each connection a header, and 12 bytes per message.
fn index_length(counts: &BTreeMap<u32, u32>) -> u64 {
    counts.values().map(|&count| INDEX_HEADER_BYTES + 12 * u64::from(count)).sum()
}

/// Sizes of a chunk's record and of its content.
fn chunk_at<R: Read + Seek>(
    source: &mut Source<R>,
    at: u64,
    end: u64,
) -> Result<Option<(u64, u64)>, ReadError> {
    // Its header has three short fields.
    let front = source.bytes(at, 256)?;
    let mut cursor = Cursor::new(&front);
    let Some(header) = cursor.bytes().map(Header::new) else { return Ok(None) };
    let (Some(op::CHUNK), Some(size), Some(packed)) =
        (header.opcode(), header.u32("size"), cursor.u32())
    else {
        return Ok(None);
    };
    let head = (front.len() - cursor.rest().len()) as u64;
    let stored = head + u64::from(packed);
    let is_inside = at.checked_add(stored).is_some_and(|next| next <= end);
    Ok(is_inside.then_some((stored, size.into())))
}
