//! Messages of several files in the order of time.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::{BagTopic, Message, Selection};

use crate::files::BagError;
use crate::files::bag::TopicIndex;
use crate::files::message_packing::{packing_of, unpack};
use crate::files::part::{Open, Part};

/// A message of a bag; its topic is an index into [`crate::files::Bag::topics`].
pub type BagMessage<'a> = Message<'a>;

/// Messages of a bag in the order of time; those of equal time in the order of the files.
pub struct BagMessages {
    selection: Selection,
    topics: TopicIndex,
    /// Files that are not open yet, the earliest last.
    waiting: Vec<(usize, Part)>,
    open: Vec<Option<Input>>,
    /// Time of the next message of each open file, and the index of the file.
    heads: BinaryHeap<Reverse<(i64, usize)>>,
    /// The file of the last message returned.
    given: Option<usize>,
    unpacked: Vec<u8>,
    faults: Vec<String>,
}

struct Input {
    open: Open,
    /// Topic index in the bag of each topic of the file.
    topics: Vec<usize>,
    /// True if messages may be compressed: uncompressed ROS 2 messages start with zero.
    is_cdr: Vec<bool>,
}

impl BagMessages {
    pub(crate) fn new(parts: &[Part], topics: &[BagTopic], selection: Selection) -> Self {
        let is_wanted = |part: &Part| {
            part.span_ns.is_none_or(|(from, to)| {
                from <= *selection.span_ns.end() && to >= *selection.span_ns.start()
            })
        };
        let mut waiting: Vec<(usize, Part)> =
            parts.iter().cloned().enumerate().filter(|(_, part)| is_wanted(part)).collect();
        waiting.sort_by_key(|(at, part)| Reverse((start_ns(part), *at)));
        let open = parts.iter().map(|_| None).collect();
        Self {
            selection,
            topics: TopicIndex::of(topics),
            waiting,
            open,
            heads: BinaryHeap::new(),
            given: None,
            unpacked: Vec::new(),
            faults: Vec::new(),
        }
    }

    /// Opens all files that may contain the next message.
    fn fill(&mut self) -> Result<(), BagError> {
        if let Some(number) = self.given.take() {
            self.ahead(number)?;
        }
        while let Some((_, part)) = self.waiting.last() {
            let next_ns = self.heads.peek().map(|Reverse((time_ns, _))| *time_ns);
            if next_ns.is_some_and(|next_ns| next_ns < start_ns(part)) {
                break;
            }
            let Some((number, part)) = self.waiting.pop() else { break };
            let topics = part.topics.iter().map(|topic| self.topics.find(topic));
            let input = Input {
                topics: topics.map(Option::unwrap_or_default).collect(),
                is_cdr: part.topics.iter().map(|topic| topic.encoding == "cdr").collect(),
                open: part.read(self.selection.clone())?,
            };
            self.open[number] = Some(input);
            self.ahead(number)?;
        }
        Ok(())
    }

    /// Peeks at the next message of a file; closes the file at its end.
    fn ahead(&mut self, number: usize) -> Result<(), BagError> {
        let Some(input) = &mut self.open[number] else { return Ok(()) };
        match input.open.peek_ns()? {
            Some(time_ns) => self.heads.push(Reverse((time_ns, number))),
            None => {
                self.faults.extend(input.open.faults());
                self.open[number] = None;
            }
        }
        Ok(())
    }

    /// Time of the next message \[ns\].
    ///
    /// # Errors
    /// As [`BagMessages::next`].
    pub fn peek_ns(&mut self) -> Result<Option<i64>, BagError> {
        self.fill()?;
        Ok(self.heads.peek().map(|Reverse((time_ns, _))| *time_ns))
    }

    /// Returns the next message. Damaged parts are skipped and reported by [`BagMessages::faults`].
    ///
    /// # Errors
    /// When a file becomes unreadable.
    #[expect(clippy::should_implement_trait, reason = "a message borrows from its file")]
    pub fn next(&mut self) -> Result<Option<BagMessage<'_>>, BagError> {
        self.fill()?;
        let Some(Reverse((_, number))) = self.heads.pop() else { return Ok(None) };
        self.given = Some(number);
        let Some(Input { open, topics, is_cdr }) = &mut self.open[number] else { return Ok(None) };
        let Some(message) = open.next()? else { return Ok(None) };
        let mut data = message.data;
        if is_cdr.get(message.topic) == Some(&true)
            && let Some(packing) = packing_of(data)
        {
            match unpack(packing, data, &mut self.unpacked) {
                Ok(()) => data = &self.unpacked,
                // The message is returned as it is; decoding it fails, too.
                Err(why) => self.faults.push(format!("a message cannot be decompressed: {why}")),
            }
        }
        let topic = topics.get(message.topic).copied().unwrap_or_default();
        Ok(Some(Message { topic, data, ..message }))
    }

    /// Damage found in the files so far.
    #[must_use]
    pub fn faults(&self) -> &[String] {
        &self.faults
    }
}

fn start_ns(part: &Part) -> i64 {
    // A file with unknown times is opened at once.
    part.span_ns.map_or(i64::MIN, |(start, _)| start)
}
