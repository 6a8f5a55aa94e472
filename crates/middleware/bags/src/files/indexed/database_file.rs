//! Random access to a database.

use std::ops::{ControlFlow, Range};
use std::sync::Mutex;

use super::location::MessageLocation;
use super::lock;
use crate::files::BagError;
use crate::files::sqlite::TimeTable;
use crate::files::temporary::Temporary;

/// A database with a table of its times.
pub(super) struct DatabaseFile {
    table: Mutex<TimeTable>,
    /// Row ids of each topic of the recording.
    ids: Vec<Vec<i64>>,
    /// Decompressed copy of the file.
    _copy: Option<Temporary>,
}

impl DatabaseFile {
    /// `by_topic` has the topic of the recording of each topic of the file, of which there are
    /// `topics`.
    pub(super) fn new(
        table: TimeTable,
        copy: Option<Temporary>,
        by_topic: &[usize],
        topics: usize,
    ) -> Self {
        let mut ids = vec![Vec::new(); topics];
        for (id, topic) in table.topic_ids().iter().zip(by_topic) {
            if let Some(of_topic) = ids.get_mut(*topic) {
                of_topic.push(*id);
            }
        }
        Self { table: Mutex::new(table), ids, _copy: copy }
    }

    /// Appends the newest messages of a topic at or before a time.
    pub(super) fn newest(
        &self,
        topic: usize,
        at_ns: i64,
        count: usize,
        file: usize,
        found: &mut Vec<MessageLocation>,
    ) -> Result<(), BagError> {
        let table = lock(&self.table);
        for &id in self.ids.get(topic).into_iter().flatten() {
            table.newest(id, at_ns, count, &mut |time_ns, row| {
                found.push(location(time_ns, row, topic, file));
            })?;
        }
        Ok(())
    }

    /// Appends the first messages of some topics in a span.
    pub(super) fn between(
        &self,
        topics: &[usize],
        span_ns: &Range<i64>,
        limit: usize,
        file: usize,
        found: &mut Vec<MessageLocation>,
    ) -> Result<(), BagError> {
        let table = lock(&self.table);
        for &topic in topics {
            for &id in self.ids.get(topic).into_iter().flatten() {
                table.between(id, span_ns, limit, &mut |time_ns, row| {
                    found.push(location(time_ns, row, topic, file));
                    ControlFlow::Continue(())
                })?;
            }
        }
        Ok(())
    }

    /// Visits topic and time of all messages of some topics.
    pub(super) fn visit_times(
        &self,
        topics: &[usize],
        visit: &mut dyn FnMut(usize, i64) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BagError> {
        let table = lock(&self.table);
        let mut flow = ControlFlow::Continue(());
        for &topic in topics {
            for &id in self.ids.get(topic).into_iter().flatten() {
                table.between(id, &(i64::MIN..i64::MAX), usize::MAX, &mut |time_ns, _| {
                    flow = visit(topic, time_ns);
                    flow
                })?;
                if flow.is_break() {
                    return Ok(flow);
                }
            }
        }
        Ok(flow)
    }

    /// Reads the bytes of a message. The reason, if its part of the file is damaged.
    pub(super) fn load(
        &self,
        row: i64,
        data: &mut Vec<u8>,
    ) -> Result<Result<(), String>, BagError> {
        lock(&self.table).load(row, data)
    }
}

fn location(time_ns: i64, row: i64, topic: usize, file: usize) -> MessageLocation {
    let file = u32::try_from(file).unwrap_or(u32::MAX);
    MessageLocation { time_ns, file, chunk: 0, at: row, topic }
}
