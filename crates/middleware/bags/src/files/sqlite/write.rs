//! Writer of databases with the schema of `rosbag2_storage_sqlite3` in ROS 2 Jazzy (version 4).
//! Older versions read it: they query the columns that they know.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::{BagInfo, BagTopic, FileInfo, Stamp, Stored, Style, TopicInformation, WriteError};
use rusqlite::Connection;

use crate::files::BagError;
use crate::files::profile::topic_info;
use crate::files::write::WriteSettings;

/// Writes one database.
pub(crate) struct SqliteWriter {
    path: PathBuf,
    connection: Connection,
    style: Style,
    custom_data: BTreeMap<String, String>,
    topics: Vec<TopicInformation>,
    span_ns: Option<(i64, i64)>,
    /// Message time at which the open transaction started \[ns\].
    since_ns: Option<i64>,
    pending_bytes: usize,
    bytes: u64,
}

/// Limits of a transaction: time span of its messages \[ns\] and size \[bytes\].
const SPAN_NS: i64 = 1_000_000_000;
const MOST_PENDING: usize = 16 << 20;

const TABLES: &str = "
    CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
    CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL,
        metadata TEXT NOT NULL);
    CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
        serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL,
        type_description_hash TEXT NOT NULL);
    CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL,
        encoding TEXT NOT NULL, encoded_message_definition TEXT NOT NULL,
        type_description_hash TEXT NOT NULL);
    CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,
        timestamp INTEGER NOT NULL, data BLOB NOT NULL);
    CREATE INDEX timestamp_idx ON messages (timestamp ASC);
";

impl SqliteWriter {
    /// Creates a file. If the settings are for live recordings, the file survives a crash at any time,
    /// except for the last second; otherwise writing is faster.
    pub(crate) fn create(path: &Path, settings: &WriteSettings) -> Result<Self, BagError> {
        let begin = || {
            let connection = Connection::open(path)?;
            let mode = if settings.is_live {
                "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;"
            } else {
                "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;"
            };
            connection.execute_batch("PRAGMA page_size = 8192;")?;
            connection.execute_batch(mode)?;
            connection.execute_batch(TABLES)?;
            connection.execute("INSERT INTO schema VALUES (4, ?1)", [&settings.ros_distro])?;
            Ok(connection)
        };
        let connection = begin().map_err(BagError::database(path))?;
        Ok(Self {
            path: path.to_owned(),
            connection,
            style: settings.style,
            custom_data: settings.custom_data.clone(),
            topics: Vec::new(),
            span_ns: None,
            since_ns: None,
            pending_bytes: 0,
            bytes: 0,
        })
    }

    pub(crate) fn topic(&mut self, topic: &BagTopic) -> Result<usize, BagError> {
        let info = topic_info(topic);
        let same =
            |one: &TopicInformation| one.name == info.name && one.type_name == info.type_name;
        if let Some(at) = self.topics.iter().position(same) {
            return Ok(at);
        }
        let at = self.topics.len();
        let profiles = info.qos_text(self.style);
        let schema = String::from_utf8_lossy(&topic.schema);
        let put = || {
            let known: i64 = self.connection.query_row(
                "SELECT count(*) FROM message_definitions WHERE topic_type = ?1",
                [&info.type_name],
                |row| row.get(0),
            )?;
            if known == 0 {
                self.connection.execute(
                    "INSERT INTO message_definitions(topic_type, encoding, \
                     encoded_message_definition, type_description_hash) VALUES (?1, ?2, ?3, ?4)",
                    (&info.type_name, &topic.schema_encoding, &schema, &info.type_hash),
                )?;
            }
            self.connection.execute(
                "INSERT INTO topics VALUES (?1, ?2, ?3, ?4, ?5, ?6)",
                (
                    row_id(at),
                    &info.name,
                    &info.type_name,
                    &info.encoding,
                    &profiles,
                    &info.type_hash,
                ),
            )
        };
        put().map_err(BagError::database(&self.path))?;
        self.topics.push(info);
        Ok(at)
    }

    pub(crate) fn write(
        &mut self,
        topic: usize,
        stamp: Stamp,
        data: &[u8],
    ) -> Result<(), BagError> {
        let time_ns = stamp.log_ns;
        let unknown = || BagError::Write(self.path.clone(), WriteError::UnknownTopic);
        self.topics.get_mut(topic).ok_or_else(unknown)?.messages += 1;
        self.advance_to(time_ns)?;
        let put = || {
            if self.since_ns.is_none() {
                self.connection.execute_batch("BEGIN")?;
            }
            let mut insert = self.connection.prepare_cached(
                "INSERT INTO messages(topic_id, timestamp, data) VALUES (?1, ?2, ?3)",
            )?;
            insert.execute((row_id(topic), time_ns, data))
        };
        put().map_err(BagError::database(&self.path))?;
        self.since_ns.get_or_insert(time_ns);
        self.pending_bytes += data.len();
        self.bytes += data.len() as u64 + 64;
        let (start, end) = self.span_ns.unwrap_or((time_ns, time_ns));
        self.span_ns = Some((start.min(time_ns), end.max(time_ns)));
        if self.pending_bytes >= MOST_PENDING { self.flush() } else { Ok(()) }
    }

    /// Approximate size of the file \[bytes\].
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Commits the open transaction if it has lasted long enough.
    pub(crate) fn advance_to(&mut self, time_ns: i64) -> Result<(), BagError> {
        let is_over = |since_ns: i64| time_ns.saturating_sub(since_ns) >= SPAN_NS;
        if self.since_ns.is_some_and(is_over) { self.flush() } else { Ok(()) }
    }

    pub(crate) fn flush(&mut self) -> Result<(), BagError> {
        if self.since_ns.take().is_some() {
            self.connection.execute_batch("COMMIT").map_err(BagError::database(&self.path))?;
        }
        self.pending_bytes = 0;
        Ok(())
    }

    /// Completes the file.
    pub(crate) fn finish(mut self, stored: &Stored) -> Result<BagInfo, BagError> {
        self.flush()?;
        let name = self.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let messages = self.topics.iter().map(|topic| topic.messages).sum();
        let file = FileInfo { path: name, span_ns: self.span_ns, messages };
        let info = BagInfo {
            topics: self.topics,
            files: vec![file],
            ros_distro: String::new(),
            custom_data: self.custom_data,
        };
        let text = info.to_yaml_for(self.style, stored);
        let end = || {
            self.connection.execute(
                "INSERT INTO metadata(metadata_version, metadata) VALUES (?1, ?2)",
                (self.style.version(), text),
            )?;
            // Merges the write-ahead log into the file.
            self.connection.execute_batch("PRAGMA journal_mode = DELETE;")
        };
        end().map_err(BagError::database(&self.path))?;
        Ok(info)
    }
}

/// Topic ids start at 1.
fn row_id(topic: usize) -> i64 {
    i64::try_from(topic).unwrap_or(i64::MAX - 1) + 1
}
