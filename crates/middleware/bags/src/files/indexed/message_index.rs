//! Index of the messages of a block.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::read::{Block, Kind};
use crate::record::{Cursor, op, parse_message_index};
use crate::ros1;

/// A message of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct IndexEntry {
    pub(super) topic: u32,
    pub(super) time: u64,
    /// Offset among the records of the block \[bytes\].
    pub(super) at: u32,
}

/// Entries in the order of topics, then of times.
pub(super) type BlockIndex = Vec<IndexEntry>;

/// Reads the index records that follow a block; none if they are damaged or incomplete, so that the
/// block itself must be read.
pub(super) fn from_records(
    block: &Block,
    bytes: &[u8],
    by_channel: &BTreeMap<u32, usize>,
) -> Option<BlockIndex> {
    let mut index = BlockIndex::new();
    let mut missing = block.channels.clone()?;
    let mut cursor = Cursor::new(bytes);
    while !missing.is_empty() {
        let (channel, entries) = match block.kind {
            Kind::Ros1 { is_cut: false } => ros1::next_index(&mut cursor)?,
            Kind::Chunk => match cursor.record()? {
                (op::MESSAGE_INDEX, content) => {
                    let (channel, entries) = parse_message_index(content)?;
                    (u32::from(channel), entries)
                }
                _ => return None,
            },
            _ => return None,
        };
        missing.remove(&channel);
        let Some(topic) = by_channel.get(&channel) else { continue };
        for (time, at) in entries {
            if at >= block.length {
                return None;
            }
            index.push(IndexEntry {
                topic: u32::try_from(*topic).ok()?,
                time,
                at: at.try_into().ok()?,
            });
        }
    }
    index.sort_unstable();
    Some(index)
}

/// Makes the index of a block from its records.
pub(super) fn from_messages(
    kind: Kind,
    records: &[u8],
    by_channel: &BTreeMap<u32, usize>,
) -> BlockIndex {
    let entry = |one: crate::read::Entry<'_>| {
        let topic = u32::try_from(*by_channel.get(&one.channel)?).ok()?;
        Some(IndexEntry { topic, time: one.log_time, at: one.at.try_into().ok()? })
    };
    let mut index: BlockIndex = kind.messages(records, 0).filter_map(entry).collect();
    index.sort_unstable();
    index
}

/// The first entries of a topic with `start <= t < end`, at most `limit`.
pub(super) fn in_span<'a>(
    index: &'a [IndexEntry],
    topic: usize,
    span: &Range<u64>,
    limit: usize,
) -> &'a [IndexEntry] {
    let entries = of_topic(index, topic);
    let from = entries.partition_point(|one| one.time < span.start);
    let entries = &entries[from..];
    let until = entries.partition_point(|one| one.time < span.end);
    &entries[..until.min(limit)]
}

/// Entries of a topic.
pub(super) fn of_topic(index: &[IndexEntry], topic: usize) -> &[IndexEntry] {
    let Ok(topic) = u32::try_from(topic) else { return &[] };
    let start = index.partition_point(|one| one.topic < topic);
    let length = index[start..].partition_point(|one| one.topic == topic);
    &index[start..start + length]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_takes_no_more_of_a_large_chunk_than_it_returns() {
        let entry = |topic, time| IndexEntry { topic, time, at: 0 };
        let mut index: BlockIndex =
            (0..1000).flat_map(|time| [entry(0, time), entry(1, time)]).collect();
        index.sort_unstable();
        let times = |span: Range<u64>, limit| -> Vec<u64> {
            in_span(&index, 1, &span, limit).iter().map(|one| one.time).collect()
        };
        assert_eq!(times(10..1000, 3), [10, 11, 12]);
        assert_eq!(times(998..2000, 3), [998, 999]);
        assert!(times(5..5, 3).is_empty());
        assert!(in_span(&index, 2, &(0..9), 3).is_empty());
    }
}
