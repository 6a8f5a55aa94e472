//! Iteration over messages in the order of time.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};
use std::io::{Read, Seek};
use std::ops::RangeInclusive;

use super::block::{Block, Kind};
use super::{ReadError, Reader, fault, signed};

/// Filter for messages.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selection {
    /// Topic names; none for all.
    pub topics: Option<BTreeSet<String>>,
    /// Range of log times \[ns\].
    pub span_ns: RangeInclusive<i64>,
}

impl Default for Selection {
    /// All messages.
    fn default() -> Self {
        Self { topics: None, span_ns: i64::MIN..=i64::MAX }
    }
}

impl Selection {
    /// All messages of some topics.
    pub fn topics<'a>(names: impl IntoIterator<Item = &'a str>) -> Self {
        let topics = names.into_iter().map(str::to_owned).collect();
        Self { topics: Some(topics), ..Self::default() }
    }
}

/// A message of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Message<'a> {
    /// Index into the [topics](Reader::topics).
    pub topic: usize,
    /// Sequence number of its publisher.
    pub sequence: u32,
    /// Time of recording \[ns\].
    pub log_ns: i64,
    /// Time of publication \[ns\].
    pub publish_ns: i64,
    /// Serialized message.
    pub data: &'a [u8],
}

/// A decompressed block: its selected messages, the next one last.
struct Open {
    kind: Kind,
    records: Vec<u8>,
    ahead: Vec<(u64, usize)>,
}

/// Messages of a [`Reader`] in the order of time.
pub struct Messages<'r, R> {
    reader: &'r mut Reader<R>,
    walk: Walk,
}

impl<'r, R: Read + Seek> Messages<'r, R> {
    pub(super) fn new(reader: &'r mut Reader<R>, selection: Selection) -> Self {
        let walk = Walk::new(reader, selection);
        Self { reader, walk }
    }

    /// Returns the next message. A damaged block is skipped and becomes a [fault](Reader::faults).
    ///
    /// # Errors
    /// When the source fails, or too many blocks would have to be decompressed at one
    /// time.
    #[expect(clippy::should_implement_trait, reason = "a message borrows from its chunk")]
    pub fn next(&mut self) -> Result<Option<Message<'_>>, ReadError> {
        self.walk.next(self.reader)
    }
}

/// Same as [`Messages`], with its own reader.
pub struct OwnMessages<R> {
    reader: Reader<R>,
    walk: Walk,
}

impl<R: Read + Seek> OwnMessages<R> {
    pub(super) fn new(reader: Reader<R>, selection: Selection) -> Self {
        let walk = Walk::new(&reader, selection);
        Self { reader, walk }
    }

    /// The reader.
    pub fn reader(&self) -> &Reader<R> {
        &self.reader
    }

    /// Log time of the next message \[ns\].
    ///
    /// # Errors
    /// As [`OwnMessages::next`].
    pub fn peek_ns(&mut self) -> Result<Option<i64>, ReadError> {
        self.walk.fill(&mut self.reader)?;
        Ok(self.walk.heads.peek().map(|Reverse((time, ..))| signed(*time)))
    }

    /// Same as [`Messages::next`].
    ///
    /// # Errors
    /// As [`Messages::next`].
    #[expect(clippy::should_implement_trait, reason = "a message borrows from its chunk")]
    pub fn next(&mut self) -> Result<Option<Message<'_>>, ReadError> {
        self.walk.next(&mut self.reader)
    }
}

/// State of the iteration.
struct Walk {
    channels: BTreeSet<u32>,
    span: RangeInclusive<u64>,
    /// Blocks to be read, the earliest last.
    blocks: Vec<Block>,
    open: BTreeMap<usize, Open>,
    /// Next time, offset in the file, and index into `open` of each open block.
    heads: BinaryHeap<Reverse<(u64, u64, usize)>>,
    unpacked: u64,
    opened: usize,
    /// The block of the last message returned.
    finished: Option<usize>,
}

impl Walk {
    fn new<R>(reader: &Reader<R>, selection: Selection) -> Self {
        let is_wanted = |topic: usize| {
            let name = &reader.topics[topic].name;
            selection.topics.as_ref().is_none_or(|names| names.contains(name))
        };
        let channels: BTreeSet<u32> = reader
            .by_channel
            .iter()
            .filter(|(_, topic)| is_wanted(**topic))
            .map(|(channel, _)| *channel)
            .collect();
        let unsigned = |time_ns: i64| u64::try_from(time_ns).unwrap_or(0);
        let (from, to) = (*selection.span_ns.start(), *selection.span_ns.end());
        // The maximum selects to the end of the file.
        let last = if to == i64::MAX { u64::MAX } else { unsigned(to) };
        #[expect(clippy::reversed_empty_ranges, reason = "an empty range")]
        let span = if to < 0 { 1..=0 } else { unsigned(from)..=last };
        let mut blocks: Vec<Block> = reader
            .blocks
            .iter()
            .filter(|block| block.start <= *span.end() && block.end >= *span.start())
            .filter(|block| block.channels.as_ref().is_none_or(|all| !all.is_disjoint(&channels)))
            .cloned()
            .collect();
        blocks.reverse();
        Self {
            channels,
            span,
            blocks,
            open: BTreeMap::new(),
            heads: BinaryHeap::new(),
            unpacked: 0,
            opened: 0,
            finished: None,
        }
    }

    /// Opens all blocks that may contain the next message.
    fn fill<R: Read + Seek>(&mut self, reader: &mut Reader<R>) -> Result<(), ReadError> {
        if let Some(done) = self.finished.take() {
            self.close(done);
        }
        while let Some(block) = self.blocks.last() {
            if self.heads.peek().is_some_and(|Reverse((time, ..))| *time < block.start) {
                break;
            }
            if let Some(block) = self.blocks.pop() {
                self.open(reader, &block)?;
            }
        }
        Ok(())
    }

    fn next<'a, R: Read + Seek>(
        &'a mut self,
        reader: &mut Reader<R>,
    ) -> Result<Option<Message<'a>>, ReadError> {
        self.fill(reader)?;
        let Some(Reverse((_, offset, number))) = self.heads.pop() else { return Ok(None) };
        let Some(open) = self.open.get_mut(&number) else { return Ok(None) };
        let Some((_, at)) = open.ahead.pop() else { return Ok(None) };
        match open.ahead.last() {
            Some(&(time, _)) => self.heads.push(Reverse((time, offset, number))),
            // Its buffer is still borrowed by the caller.
            None => self.finished = Some(number),
        }
        let Some(entry) = open.kind.messages(&open.records, at).next() else { return Ok(None) };
        Ok(Some(Message {
            topic: reader.by_channel.get(&entry.channel).copied().unwrap_or_default(),
            sequence: entry.sequence,
            log_ns: signed(entry.log_time),
            publish_ns: signed(entry.publish_time),
            data: entry.data,
        }))
    }

    fn open<R: Read + Seek>(
        &mut self,
        reader: &mut Reader<R>,
        block: &Block,
    ) -> Result<(), ReadError> {
        let unpacked = self.unpacked.saturating_add(block.length);
        if unpacked > reader.limits.unpacked {
            return Err(ReadError::TooLarge(unpacked));
        }
        let records = match block.load(&mut reader.source, reader.limits.chunk) {
            Ok(records) => records,
            Err(error) if error.kind() == std::io::ErrorKind::InvalidData => {
                fault(&mut reader.faults, block.offset, error.to_string());
                return Ok(());
            }
            Err(error) => return Err(error.into()),
        };
        let times = block.kind.messages(&records, 0).map(|entry| entry.log_time);
        if times.min().is_some_and(|earliest| earliest < block.start) {
            let wrong = "messages are older than their index states and may come late";
            fault(&mut reader.faults, block.offset, wrong);
        }
        let mut ahead: Vec<(u64, usize)> = block
            .kind
            .messages(&records, 0)
            .filter(|entry| self.channels.contains(&entry.channel))
            .filter(|entry| self.span.contains(&entry.log_time))
            .map(|entry| (entry.log_time, entry.at))
            .collect();
        ahead.sort_unstable_by(|a, b| b.cmp(a));
        if let Some(&(time, _)) = ahead.last() {
            let number = self.opened;
            self.opened += 1;
            self.heads.push(Reverse((time, block.offset, number)));
            self.unpacked += records.len() as u64;
            self.open.insert(number, Open { kind: block.kind, records, ahead });
        }
        Ok(())
    }

    fn close(&mut self, number: usize) {
        if let Some(open) = self.open.remove(&number) {
            self.unpacked -= open.records.len() as u64;
        }
    }
}
