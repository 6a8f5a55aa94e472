//! Table of the times of a database, for random access.

use std::ops::{ControlFlow, Range};
use std::path::PathBuf;

use rusqlite::Connection;

use super::read::{Database, is_corrupt};
use super::{TimeSummary, rescue};
use crate::files::BagError;

/// Rows copied per statement, after which progress is reported.
const COPY_ROWS: i64 = 50_000;

/// A database with a temporary table of topic, time and row of its messages, in this order. SQLite
/// keeps it on the disk, so that memory does not grow with the number of messages.
pub(crate) struct TimeTable {
    path: PathBuf,
    connection: Connection,
    topic_ids: Vec<i64>,
}

/// Number of messages of each topic, and the times of the first and last \[ns\].
type TimeSum = (Vec<u64>, Option<(i64, i64)>);

impl TimeTable {
    /// Reads the times. `report` gets the fraction that is done, and breaks to cancel.
    pub(crate) fn new(
        database: Database,
        report: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(Self, TimeSummary), BagError> {
        let parts = database.into_parts();
        let table =
            Self { path: parts.path, connection: parts.connection, topic_ids: parts.topic_ids };
        let mut faults = Vec::new();
        let failed = |error| BagError::database(&table.path)(error);
        table.connection.execute_batch(CREATE).map_err(failed)?;
        match table.copy(report) {
            Ok(()) => {}
            Err(error) if is_corrupt(&error) => {
                let rescued = table.rescue().map_err(failed)?;
                faults.push(format!(
                    "the database is damaged: {rescued} messages could still be found in it"
                ));
            }
            Err(error) => return Err(failed(error)),
        }
        let (counts, span_ns) = table.sum().map_err(failed)?;
        let summary = TimeSummary {
            topics: parts.topics,
            counts,
            span_ns,
            faults,
            ros_distro: parts.ros_distro,
            custom_data: parts.custom_data,
        };
        Ok((table, summary))
    }

    /// Row ids of the topics.
    pub(crate) fn topic_ids(&self) -> &[i64] {
        &self.topic_ids
    }

    /// Copies the times in steps of rows, which are sparse in a database with deleted messages.
    fn copy(&self, report: &mut dyn FnMut(f64) -> ControlFlow<()>) -> rusqlite::Result<()> {
        let mut after = i64::MIN;
        let mut first = None;
        let last: Option<i64> =
            self.connection.query_row("SELECT max(id) FROM messages", [], |row| row.get(0))?;
        let mut next = self.connection.prepare(
            "SELECT min(id), max(id) FROM (SELECT id FROM messages WHERE id > ?1 ORDER BY id \
             LIMIT ?2)",
        )?;
        let mut copy = self.connection.prepare(
            "INSERT OR IGNORE INTO temp.periplus_index SELECT topic_id, timestamp, id FROM \
             messages WHERE id BETWEEN ?1 AND ?2 AND typeof(timestamp) = 'integer'",
        )?;
        self.connection.execute_batch("BEGIN")?;
        loop {
            let ends = next.query_row([after, COPY_ROWS], |row| Ok((row.get(0)?, row.get(1)?)))?;
            let (Some(from), Some(to)): (Option<i64>, Option<i64>) = ends else { break };
            copy.execute([from, to])?;
            after = to;
            let first = *first.get_or_insert(from);
            let span = last.unwrap_or(to).saturating_sub(first).max(1) as f64;
            if report(after.saturating_sub(first) as f64 / span).is_break() {
                let cancelled = rusqlite::ffi::Error::new(rusqlite::ffi::SQLITE_INTERRUPT);
                let what = Some("opening was cancelled".to_owned());
                return Err(rusqlite::Error::SqliteFailure(cancelled, what));
            }
        }
        self.connection.execute_batch("COMMIT")
    }

    /// Fills the table with what can be found in a damaged database.
    fn rescue(&self) -> rusqlite::Result<usize> {
        if !self.connection.is_autocommit() {
            self.connection.execute_batch("ROLLBACK")?;
        }
        self.connection.execute_batch("DELETE FROM temp.periplus_index")?;
        let rescued = rescue::rescue(&self.connection)?;
        self.connection.execute_batch(&format!(
            "INSERT OR IGNORE INTO temp.periplus_index SELECT topic_id, timestamp, id FROM {}",
            rescue::TABLE
        ))?;
        Ok(rescued)
    }

    fn sum(&self) -> rusqlite::Result<TimeSum> {
        let mut statement = self.connection.prepare(
            "SELECT count(*), min(timestamp), max(timestamp) FROM temp.periplus_index WHERE \
             topic_id = ?1",
        )?;
        let mut counts = Vec::new();
        let mut span: Option<(i64, i64)> = None;
        for id in &self.topic_ids {
            let (count, ends) = statement.query_row([id], |row| {
                let ends: (Option<i64>, Option<i64>) = (row.get(1)?, row.get(2)?);
                Ok((row.get::<_, i64>(0)?, ends.0.zip(ends.1)))
            })?;
            counts.push(u64::try_from(count).unwrap_or(0));
            let ends = ends.into_iter().chain(span);
            span = ends.reduce(|(start, end), (from, to)| (start.min(from), end.max(to)));
        }
        Ok((counts, span))
    }

    /// Visits time and row of the newest messages of a topic at or before a time, the newest first.
    pub(crate) fn newest(
        &self,
        topic_id: i64,
        at_ns: i64,
        count: usize,
        visit: &mut dyn FnMut(i64, i64),
    ) -> Result<(), BagError> {
        let query = "SELECT timestamp, id FROM temp.periplus_index WHERE topic_id = ?1 AND \
                     timestamp <= ?2 ORDER BY timestamp DESC, id DESC LIMIT ?3";
        let mut read = || -> rusqlite::Result<()> {
            let mut statement = self.connection.prepare_cached(query)?;
            let mut rows = statement.query([topic_id, at_ns, row_limit(count)])?;
            while let Some(row) = rows.next()? {
                visit(row.get(0)?, row.get(1)?);
            }
            Ok(())
        };
        read().map_err(BagError::database(&self.path))
    }

    /// Visits time and row of the first messages of a topic in a span, in the order of time, until
    /// `visit` breaks.
    pub(crate) fn between(
        &self,
        topic_id: i64,
        span_ns: &Range<i64>,
        limit: usize,
        visit: &mut dyn FnMut(i64, i64) -> ControlFlow<()>,
    ) -> Result<(), BagError> {
        let query = "SELECT timestamp, id FROM temp.periplus_index WHERE topic_id = ?1 AND \
                     timestamp >= ?2 AND timestamp < ?3 ORDER BY timestamp, id LIMIT ?4";
        let mut read = || -> rusqlite::Result<()> {
            let mut statement = self.connection.prepare_cached(query)?;
            let limit = row_limit(limit);
            let mut rows = statement.query([topic_id, span_ns.start, span_ns.end, limit])?;
            while let Some(row) = rows.next()? {
                if visit(row.get(0)?, row.get(1)?).is_break() {
                    break;
                }
            }
            Ok(())
        };
        read().map_err(BagError::database(&self.path))
    }

    /// Reads the bytes of a row. The reason, if it is damaged.
    pub(crate) fn load(
        &self,
        row_id: i64,
        data: &mut Vec<u8>,
    ) -> Result<Result<(), String>, BagError> {
        let mut read = || -> rusqlite::Result<()> {
            let query = "SELECT data FROM messages WHERE id = ?1";
            let mut statement = self.connection.prepare_cached(query)?;
            let mut rows = statement.query([row_id])?;
            data.clear();
            if let Some(row) = rows.next()? {
                data.extend_from_slice(row.get_ref(0)?.as_bytes().unwrap_or_default());
            }
            Ok(())
        };
        match read() {
            Ok(()) => Ok(Ok(())),
            Err(error) if is_corrupt(&error) => {
                let path = self.path.display();
                Ok(Err(format!("`{path}`: message {row_id} is lost: {error}")))
            }
            Err(error) => Err(BagError::database(&self.path)(error)),
        }
    }
}

const CREATE: &str = "CREATE TEMP TABLE periplus_index(topic_id, timestamp, id, \
                      PRIMARY KEY(topic_id, timestamp, id)) WITHOUT ROWID";

/// A number of rows for SQLite.
fn row_limit(count: usize) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}
