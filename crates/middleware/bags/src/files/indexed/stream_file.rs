//! Random access to an MCAP file or ROS 1 bag.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::io;
use std::ops::{ControlFlow, Range};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use periplus_os::fs::{File, read_exact_at};

use super::location::MessageLocation;
use super::lock;
use super::message_index::{
    BlockIndex, IndexEntry, from_messages, from_records, in_span, of_topic,
};
use crate::files::BagError;
use crate::files::temporary::Temporary;
use crate::read::Block;
use crate::{Limits, ReadError};

/// Maximum number of index entries that are kept; 16 bytes each.
const MAX_KEPT_ENTRIES: usize = 2_000_000;

/// An MCAP file or ROS 1 bag: where its chunks are.
pub(super) struct StreamFile {
    path: PathBuf,
    file: File,
    /// Decompressed copy of the file.
    _copy: Option<Temporary>,
    /// Blocks in the order of their start times.
    blocks: Vec<Block>,
    /// Block at each offset of the file.
    by_offset: HashMap<u64, usize>,
    /// Topic of the recording of each channel.
    by_channel: BTreeMap<u32, usize>,
    /// Blocks that contain each topic, with the latest end of these and all earlier ones.
    by_topic: Vec<Vec<(usize, u64)>>,
    /// Latest end of each block and all earlier ones.
    ends: Vec<u64>,
    indexes: Mutex<KeptIndexes>,
    /// Blocks that cannot be decompressed.
    damaged: Mutex<BTreeSet<usize>>,
    /// Blocks whose index does not agree with their messages.
    wrongly_indexed: Mutex<BTreeSet<usize>>,
}

#[derive(Default)]
struct KeptIndexes {
    by_block: HashMap<usize, Arc<BlockIndex>>,
    entries: usize,
}

impl StreamFile {
    /// `by_channel` has the topics of the recording, of which there are `topics`.
    pub(super) fn new(
        path: &Path,
        copy: Option<Temporary>,
        blocks: Vec<Block>,
        by_channel: BTreeMap<u32, usize>,
        topics: usize,
    ) -> Result<Self, BagError> {
        let file_path = copy.as_ref().map_or(path, Temporary::path);
        let file = File::open(file_path).map_err(BagError::file(file_path))?;
        let mut by_topic = vec![Vec::new(); topics];
        let mut ends = Vec::with_capacity(blocks.len());
        for (number, block) in blocks.iter().enumerate() {
            ends.push(block.end.max(ends.last().copied().unwrap_or(0)));
            let known: Option<BTreeSet<usize>> = block.channels.as_ref().map(|channels| {
                channels.iter().filter_map(|channel| by_channel.get(channel).copied()).collect()
            });
            // A block with unknown channels may contain any topic.
            for topic in known.unwrap_or_else(|| (0..topics).collect()) {
                if let Some(of_topic) = by_topic.get_mut(topic) {
                    let before = of_topic.last().map_or(0, |(_, end)| *end);
                    of_topic.push((number, block.end.max(before)));
                }
            }
        }
        let offsets = blocks.iter().enumerate().map(|(number, block)| (block.offset, number));
        Ok(Self {
            path: path.to_owned(),
            file,
            _copy: copy,
            by_offset: offsets.collect(),
            blocks,
            by_channel,
            by_topic,
            ends,
            indexes: Mutex::default(),
            damaged: Mutex::default(),
            wrongly_indexed: Mutex::default(),
        })
    }

    /// Appends the newest messages of a topic at or before a time, in any order, at least the
    /// newest `count`.
    pub(super) fn newest(
        &self,
        topic: usize,
        at_ns: i64,
        count: usize,
        file: usize,
        found: &mut Vec<MessageLocation>,
    ) -> Result<(), BagError> {
        let Ok(at) = u64::try_from(at_ns) else { return Ok(()) };
        let Some(blocks) = self.by_topic.get(topic) else { return Ok(()) };
        let mut own: Vec<MessageLocation> = Vec::new();
        let started = blocks.partition_point(|(block, _)| self.blocks[*block].start <= at);
        for &(block, end) in blocks[..started].iter().rev() {
            // Sorted, the oldest first.
            let oldest = own.len().checked_sub(count).and_then(|first| own.get(first));
            let is_older = |oldest: &MessageLocation| {
                i64::try_from(end).is_ok_and(|end_ns| end_ns < oldest.time_ns)
            };
            if count == 0 || oldest.is_some_and(is_older) {
                break;
            }
            let Some(index) = self.index(block)? else { continue };
            let entries = of_topic(&index, topic);
            let until = entries.partition_point(|one| one.time <= at);
            let newest = &entries[until.saturating_sub(count)..until];
            own.extend(newest.iter().map(|one| self.location(one, block, file)));
            own.sort_unstable();
        }
        found.extend(own);
        Ok(())
    }

    /// Appends the first messages of some topics in a span, in any order, at least the first
    /// `limit`.
    pub(super) fn between(
        &self,
        topics: &[usize],
        span_ns: &Range<i64>,
        limit: usize,
        file: usize,
        found: &mut Vec<MessageLocation>,
    ) -> Result<(), BagError> {
        let unsigned = |time_ns: i64| u64::try_from(time_ns).unwrap_or(0);
        let span = unsigned(span_ns.start)..unsigned(span_ns.end);
        let mut own: Vec<MessageLocation> = Vec::new();
        for block in self.blocks_of(topics, span.clone()) {
            if own.len() >= limit {
                own.sort_unstable();
                own.truncate(limit);
                let last = own.last().and_then(|last| u64::try_from(last.time_ns).ok());
                if last.is_some_and(|last| last < self.blocks[block].start) {
                    break;
                }
            }
            let Some(index) = self.index(block)? else { continue };
            for &topic in topics {
                let entries = in_span(&index, topic, &span, limit);
                own.extend(entries.iter().map(|one| self.location(one, block, file)));
            }
        }
        found.extend(own);
        Ok(())
    }

    /// Visits topic and time of all messages of some topics.
    pub(super) fn visit_times(
        &self,
        topics: &[usize],
        visit: &mut dyn FnMut(usize, i64) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BagError> {
        for block in self.blocks_of(topics, 0..u64::MAX) {
            let Some(index) = self.read_index(block)? else { continue };
            for &topic in topics {
                for one in of_topic(&index, topic) {
                    if visit(topic, signed(one.time)).is_break() {
                        return Ok(ControlFlow::Break(()));
                    }
                }
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Blocks with messages of some topics in a span, in the order of their start times.
    fn blocks_of(&self, topics: &[usize], span: Range<u64>) -> Vec<usize> {
        let from = self.ends.partition_point(|end| *end < span.start);
        let until = self.blocks.partition_point(|block| block.start < span.end);
        let mut blocks: Vec<usize> = topics
            .iter()
            .filter_map(|topic| self.by_topic.get(*topic))
            .flat_map(|blocks| &blocks[blocks.partition_point(|(block, _)| *block < from)..])
            .map(|(block, _)| *block)
            .filter(|&block| block < until && self.blocks[block].end >= span.start)
            .collect();
        blocks.sort_unstable();
        blocks.dedup();
        blocks
    }

    fn location(&self, one: &IndexEntry, block: usize, file: usize) -> MessageLocation {
        MessageLocation {
            time_ns: signed(one.time),
            file: u32::try_from(file).unwrap_or(u32::MAX),
            chunk: self.blocks[block].offset,
            at: one.at.into(),
            topic: one.topic as usize,
        }
    }

    /// Number of the block of a message.
    pub(super) fn block_of(&self, location: &MessageLocation) -> Option<usize> {
        self.by_offset.get(&location.chunk).copied()
    }

    /// The message at an offset among the records of a block.
    pub(super) fn message<'a>(
        &self,
        block: usize,
        records: &'a [u8],
        location: &MessageLocation,
    ) -> Option<&'a [u8]> {
        let at = usize::try_from(location.at).ok()?;
        let entry = self.blocks[block].kind.messages(records, at).next()?;
        let is_it = entry.at == at
            && signed(entry.log_time) == location.time_ns
            && self.by_channel.get(&entry.channel) == Some(&location.topic);
        is_it.then_some(entry.data)
    }

    /// Decompressed size of a block \[bytes\].
    pub(super) fn block_bytes(&self, block: usize) -> u64 {
        self.blocks[block].length
    }

    /// Decompresses a block. None, with the reason, if it is damaged.
    pub(super) fn load(&self, block: usize) -> Result<Result<Vec<u8>, String>, BagError> {
        let about = &self.blocks[block];
        let stored = self.bytes(about.offset, about.stored)?;
        match about.unpack(stored, Limits::default().chunk) {
            Ok(records) => Ok(Ok(records)),
            Err(error) if error.kind() == io::ErrorKind::InvalidData => {
                lock(&self.damaged).insert(block);
                Ok(Err(format!("`{}`: {error} (byte {})", self.path.display(), about.offset)))
            }
            Err(error) => Err(self.failed(error)),
        }
    }

    /// Ignores the index of a block because it does not agree with the messages.
    pub(super) fn ignore_index(&self, block: usize) -> String {
        lock(&self.wrongly_indexed).insert(block);
        lock(&self.indexes).by_block.remove(&block);
        let offset = self.blocks[block].offset;
        format!("`{}`: the index of a chunk is wrong (byte {offset})", self.path.display())
    }

    /// Index of a block; none if the block is damaged.
    fn index(&self, block: usize) -> Result<Option<Arc<BlockIndex>>, BagError> {
        if let Some(index) = lock(&self.indexes).by_block.get(&block) {
            return Ok(if self.is_damaged(block) { None } else { Some(index.clone()) });
        }
        let Some(index) = self.read_index(block)? else { return Ok(None) };
        let index = Arc::new(index);
        let mut kept = lock(&self.indexes);
        if kept.entries.saturating_add(index.len()) > MAX_KEPT_ENTRIES {
            *kept = KeptIndexes::default();
        }
        kept.entries += index.len();
        kept.by_block.insert(block, index.clone());
        Ok(Some(index))
    }

    fn is_damaged(&self, block: usize) -> bool {
        lock(&self.damaged).contains(&block)
    }

    fn read_index(&self, block: usize) -> Result<Option<BlockIndex>, BagError> {
        if self.is_damaged(block) {
            return Ok(None);
        }
        let about = &self.blocks[block];
        if about.index_length > 0 && !lock(&self.wrongly_indexed).contains(&block) {
            let bytes =
                self.bytes(about.offset.saturating_add(about.stored), about.index_length)?;
            if let Some(index) = from_records(about, &bytes, &self.by_channel) {
                return Ok(Some(index));
            }
        }
        let records = self.load(block)?;
        Ok(records.ok().map(|records| from_messages(about.kind, &records, &self.by_channel)))
    }

    /// Reads bytes of the file; fewer at its end.
    fn bytes(&self, offset: u64, length: u64) -> Result<Vec<u8>, BagError> {
        let size = self.file.metadata().map_err(|error| self.failed(error))?.len();
        let length = length.min(size.saturating_sub(offset));
        let mut bytes = vec![0; usize::try_from(length).unwrap_or(usize::MAX)];
        read_exact_at(&self.file, &mut bytes, offset).map_err(|error| self.failed(error))?;
        Ok(bytes)
    }

    fn failed(&self, error: io::Error) -> BagError {
        BagError::Read(self.path.clone(), ReadError::Source(error))
    }
}

fn signed(time: u64) -> i64 {
    i64::try_from(time).unwrap_or(i64::MAX)
}
