//! Reader of databases of any schema version.

use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};

use crate::metadata::embedded_custom_data;
use crate::{BagTopic, Message, Selection};
use rusqlite::config::DbConfig;
use rusqlite::{Connection, OpenFlags, OptionalExtension as _};

use super::rescue;
use crate::files::BagError;
use crate::files::part::Part;
use crate::files::write::Storage;

/// Number of messages of each topic, and the times of the first and last \[ns\].
type Sum = (Vec<u64>, Option<(i64, i64)>);

/// An open database.
pub(crate) struct Database {
    path: PathBuf,
    connection: Connection,
    /// Row ids of the topics, in the order of [`Part::topics`].
    ids: Vec<i64>,
    topics: Vec<BagTopic>,
    ros_distro: String,
    custom_data: BTreeMap<String, String>,
    /// True if times are indexed, so that no sorting is needed.
    is_indexed: bool,
}

/// An open database with its topics.
pub(super) struct DatabaseParts {
    pub(super) path: PathBuf,
    pub(super) connection: Connection,
    /// Row ids of the topics.
    pub(super) topic_ids: Vec<i64>,
    pub(super) topics: Vec<BagTopic>,
    pub(super) ros_distro: String,
    pub(super) custom_data: BTreeMap<String, String>,
}

impl Database {
    pub(crate) fn open(path: &Path) -> Result<Self, BagError> {
        let connection = connect(path).map_err(BagError::database(path))?;
        let tables = tables(&connection).map_err(BagError::database(path))?;
        if !tables.contains_key("messages") || !tables.contains_key("topics") {
            let why = "the database has no tables `topics` and `messages`".to_owned();
            return Err(BagError::NoBag(path.to_owned(), why));
        }
        let mut database = Self {
            path: path.to_owned(),
            connection,
            ids: Vec::new(),
            topics: Vec::new(),
            ros_distro: String::new(),
            custom_data: BTreeMap::new(),
            is_indexed: false,
        };
        database.describe(&tables).map_err(BagError::database(path))?;
        Ok(database)
    }

    fn describe(&mut self, tables: &BTreeMap<String, Vec<String>>) -> rusqlite::Result<()> {
        let has = |table: &str, column: &str| {
            tables.get(table).is_some_and(|columns| columns.iter().any(|one| one == column))
        };
        if has("schema", "ros_distro") {
            let query = "SELECT ros_distro FROM schema LIMIT 1";
            let distro = self.connection.query_row(query, [], |row| row.get(0)).optional()?;
            self.ros_distro = distro.unwrap_or_default();
        }
        if has("metadata", "metadata") {
            let query = "SELECT metadata FROM metadata ORDER BY rowid DESC LIMIT 1";
            // A damaged table loses the facts, not the messages.
            let stored = self.connection.query_row(query, [], |row| text(row, 0)).ok();
            self.custom_data =
                stored.and_then(|text| embedded_custom_data(&text)).unwrap_or_default();
        }
        let column = |name: &str| if has("topics", name) { name.to_owned() } else { "''".into() };
        let query = format!(
            "SELECT id, name, type, {}, {}, {} FROM topics ORDER BY id LIMIT 65535",
            column("serialization_format"),
            column("offered_qos_profiles"),
            column("type_description_hash"),
        );
        let mut texts = BTreeMap::new();
        if has("message_definitions", "encoded_message_definition") {
            let query = "SELECT topic_type, encoding, encoded_message_definition \
                         FROM message_definitions LIMIT 65535";
            let mut statement = self.connection.prepare(query)?;
            let mut rows = statement.query([])?;
            while let Some(row) = rows.next()? {
                texts.insert(text(row, 0)?, (text(row, 1)?, text(row, 2)?));
            }
        }
        let mut statement = self.connection.prepare(&query)?;
        let mut rows = statement.query([])?;
        while let Some(row) = rows.next()? {
            let type_name = text(row, 2)?;
            let (schema_encoding, schema) = texts.get(&type_name).cloned().unwrap_or_default();
            let mut metadata = BTreeMap::from([("offered_qos_profiles".to_owned(), text(row, 4)?)]);
            let hash = text(row, 5)?;
            if !hash.is_empty() {
                metadata.insert("topic_type_hash".into(), hash);
            }
            let encoding = Some(text(row, 3)?).filter(|name| !name.is_empty());
            self.ids.push(row.get(0)?);
            self.topics.push(BagTopic {
                name: text(row, 1)?,
                type_name,
                encoding: encoding.unwrap_or_else(|| "cdr".into()),
                schema_encoding,
                schema: schema.into_bytes(),
                metadata,
            });
        }
        drop(rows);
        drop(statement);
        let query = "SELECT count(*) FROM pragma_index_list('messages') AS list, \
                     pragma_index_info(list.name) AS info \
                     WHERE info.seqno = 0 AND info.name = 'timestamp'";
        let indexes: i64 = self.connection.query_row(query, [], |row| row.get(0))?;
        self.is_indexed = indexes > 0;
        Ok(())
    }

    pub(super) fn into_parts(self) -> DatabaseParts {
        DatabaseParts {
            path: self.path,
            connection: self.connection,
            topic_ids: self.ids,
            topics: self.topics,
            ros_distro: self.ros_distro,
            custom_data: self.custom_data,
        }
    }

    /// Reads the content.
    pub(crate) fn look(self) -> Result<Part, BagError> {
        let summed = self.sum();
        // Counting fails in a damaged database; its topics are known all the same.
        let (counts, span_ns, faults) = match summed {
            Ok((counts, span_ns)) => (counts, span_ns, Vec::new()),
            Err(error) => (vec![0; self.ids.len()], None, vec![error.to_string()]),
        };
        Ok(Part {
            path: self.path,
            storage: Storage::Sqlite,
            packing: None,
            topics: self.topics,
            counts,
            span_ns,
            is_whole: faults.is_empty(),
            faults,
            bytes: 0,
            ros_distro: self.ros_distro,
            custom_data: self.custom_data,
        })
    }

    fn sum(&self) -> rusqlite::Result<Sum> {
        let mut counts = vec![0; self.ids.len()];
        let query = "SELECT topic_id, count(*), min(timestamp), max(timestamp) FROM messages \
                     GROUP BY topic_id";
        let places: BTreeMap<i64, usize> =
            self.ids.iter().enumerate().rev().map(|(place, id)| (*id, place)).collect();
        let mut statement = self.connection.prepare(query)?;
        let mut rows = statement.query([])?;
        let mut span: Option<(i64, i64)> = None;
        while let Some(row) = rows.next()? {
            let id: i64 = row.get(0)?;
            let Some(&topic) = places.get(&id) else { continue };
            counts[topic] = u64::try_from(row.get::<_, i64>(1)?).unwrap_or(0);
            let (from, to) = (row.get(2)?, row.get(3)?);
            span = Some(span.map_or((from, to), |(start, end)| (start.min(from), end.max(to))));
        }
        Ok((counts, span))
    }

    /// Reads the messages in the order of time.
    pub(crate) fn read(self, selection: &Selection) -> Result<Rows, BagError> {
        let is_wanted = |topic: &BagTopic| {
            selection.topics.as_ref().is_none_or(|names| names.contains(&topic.name))
        };
        let wanted: BTreeMap<i64, usize> = self
            .ids
            .iter()
            .enumerate()
            .filter(|(at, _)| is_wanted(&self.topics[*at]))
            .map(|(at, id)| (*id, at))
            .collect();
        let (from_ns, to_ns) = (*selection.span_ns.start(), *selection.span_ns.end());
        let ids: Vec<String> = wanted.keys().map(ToString::to_string).collect();
        let next = |table: &str| {
            format!(
                "SELECT timestamp, id, topic_id FROM {table} WHERE (timestamp, id) > (?1, ?2) AND \
                 timestamp <= {to_ns} AND topic_id IN ({}) ORDER BY timestamp, id LIMIT {BATCH}",
                ids.join(", ")
            )
        };
        let mut is_sorted = self.is_indexed;
        if !self.is_indexed {
            // Sorted once, into a temporary table.
            let make = format!(
                "CREATE TEMP TABLE periplus_times(timestamp, id, topic_id, PRIMARY KEY(timestamp, \
                 id)) WITHOUT ROWID; INSERT OR IGNORE INTO periplus_times SELECT timestamp, id, \
                 topic_id FROM messages WHERE timestamp BETWEEN {from_ns} AND {to_ns};"
            );
            match self.connection.execute_batch(&make) {
                Ok(()) => is_sorted = true,
                Err(error) if is_corrupt(&error) => {}
                Err(error) => return Err(BagError::database(&self.path)(error)),
            }
        }
        let table = if self.is_indexed { "messages" } else { "periplus_times" };
        Ok(Rows {
            connection: self.connection,
            next: next(table),
            is_sorted,
            next_rescued: next(rescue::TABLE),
            wanted,
            // Ids may be negative; the minimum precedes all of them.
            after: (from_ns, i64::MIN),
            is_done: ids.is_empty() || from_ns > to_ns,
            ahead: VecDeque::new(),
            data: Vec::new(),
            is_rescued: false,
            faults: Vec::new(),
        })
    }
}

/// Number of rows read at once.
const BATCH: usize = 4096;

/// Messages of a database.
pub(crate) struct Rows {
    connection: Connection,
    next: String,
    /// Query for rows rescued from a damaged database.
    next_rescued: String,
    /// Topic index by row id.
    wanted: BTreeMap<i64, usize>,
    /// Time and id of the last known row.
    after: (i64, i64),
    is_done: bool,
    /// Time, id and topic of the next rows.
    ahead: VecDeque<(i64, i64, usize)>,
    data: Vec<u8>,
    /// True if rows can be queried in the order of time.
    is_sorted: bool,
    is_rescued: bool,
    faults: Vec<String>,
}

impl Rows {
    /// Damage found so far.
    pub(crate) fn faults(&self) -> &[String] {
        &self.faults
    }

    /// Reads the next rows; in a damaged database those that can be found without its index.
    fn fill(&mut self) -> rusqlite::Result<()> {
        if !self.ahead.is_empty() || self.is_done {
            return Ok(());
        }
        if self.is_sorted {
            match self.look_ahead() {
                Err(error) if !self.is_rescued && is_corrupt(&error) => {}
                looked => return looked,
            }
        }
        let rescued = rescue::rescue(&self.connection)?;
        self.faults.push(format!(
            "the database is damaged: {rescued} messages could still be found in it"
        ));
        (self.is_rescued, self.is_sorted) = (true, true);
        self.next = std::mem::take(&mut self.next_rescued);
        // Rows found before the failure come first.
        if self.ahead.is_empty() { self.look_ahead() } else { Ok(()) }
    }

    fn look_ahead(&mut self) -> rusqlite::Result<()> {
        let mut statement = self.connection.prepare_cached(&self.next)?;
        let mut rows = statement.query([self.after.0, self.after.1])?;
        let mut count = 0;
        while let Some(row) = rows.next()? {
            let (time, id): (i64, i64) = (row.get(0)?, row.get(1)?);
            // A damaged index may lead back, without end.
            if (time, id) <= self.after {
                let corrupt = rusqlite::ffi::Error::new(rusqlite::ffi::SQLITE_CORRUPT);
                let what = "the index of times is damaged: it is not in order".to_owned();
                return Err(rusqlite::Error::SqliteFailure(corrupt, Some(what)));
            }
            self.after = (time, id);
            count += 1;
            if let Some(topic) = self.wanted.get(&row.get(2)?) {
                self.ahead.push_back((time, id, *topic));
            }
        }
        self.is_done = count < BATCH;
        Ok(())
    }

    pub(crate) fn peek_ns(&mut self) -> rusqlite::Result<Option<i64>> {
        self.fill()?;
        Ok(self.ahead.front().map(|(time, ..)| *time))
    }

    pub(crate) fn next(&mut self) -> rusqlite::Result<Option<Message<'_>>> {
        loop {
            self.fill()?;
            let Some((time, id, topic)) = self.ahead.pop_front() else { return Ok(None) };
            match self.load(id) {
                Ok(()) => {
                    let (log_ns, publish_ns) = (time, time);
                    let data = &self.data;
                    return Ok(Some(Message { topic, sequence: 0, log_ns, publish_ns, data }));
                }
                Err(error) if is_corrupt(&error) => {
                    let why = format!("message {id} is lost: {error}");
                    if self.faults.len() < MOST_FAULTS {
                        self.faults.push(why);
                    }
                }
                Err(error) => return Err(error),
            }
        }
    }

    /// Reads the bytes of a message.
    fn load(&mut self, id: i64) -> rusqlite::Result<()> {
        let mut statement =
            self.connection.prepare_cached("SELECT data FROM messages WHERE id = ?1")?;
        let mut rows = statement.query([id])?;
        self.data.clear();
        if let Some(row) = rows.next()? {
            let bytes = row.get_ref(0)?;
            self.data.extend_from_slice(bytes.as_bytes().unwrap_or_default());
        }
        Ok(())
    }
}

/// Maximum number of lost messages reported individually.
const MOST_FAULTS: usize = 20;

/// True if the error means a damaged database.
pub(super) fn is_corrupt(error: &rusqlite::Error) -> bool {
    matches!(
        error.sqlite_error_code(),
        Some(rusqlite::ErrorCode::DatabaseCorrupt | rusqlite::ErrorCode::NotADatabase)
    )
}

/// Opens a database read-only, without running its triggers or views.
fn connect(path: &Path) -> rusqlite::Result<Connection> {
    let open = |path: &str, flags| {
        let connection = Connection::open_with_flags(path, flags)?;
        connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DEFENSIVE, true)?;
        connection.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false)?;
        connection.execute_batch("PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0;")?;
        // The first query shows if a write-ahead log can be read.
        connection.query_row("SELECT count(*) FROM sqlite_master", [], |_| Ok(()))?;
        Ok(connection)
    };
    let plain = path.to_string_lossy();
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    open(&plain, flags).or_else(|error: rusqlite::Error| {
        // In a read-only folder the write-ahead log is not read.
        let escaped = plain.replace('%', "%25").replace('?', "%3f").replace('#', "%23");
        let uri = format!("file:{escaped}?immutable=1");
        let flags = flags | OpenFlags::SQLITE_OPEN_URI;
        open(&uri, flags)
            .or_else(|_| if is_corrupt(&error) { open_cut(&uri, flags) } else { Err(error) })
    })
}

/// Opens a truncated database. SQLite allows it only with a writable schema; the connection is
/// read-only all the same.
fn open_cut(uri: &str, flags: OpenFlags) -> rusqlite::Result<Connection> {
    let connection = Connection::open_with_flags(uri, flags)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false)?;
    connection.execute_batch(
        "PRAGMA writable_schema = ON; PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0;",
    )?;
    connection.query_row("SELECT count(*) FROM sqlite_master", [], |_| Ok(()))?;
    Ok(connection)
}

/// Columns of the tables; views are ignored.
fn tables(connection: &Connection) -> rusqlite::Result<BTreeMap<String, Vec<String>>> {
    let mut tables = BTreeMap::new();
    for name in ["schema", "metadata", "topics", "messages", "message_definitions"] {
        let query = "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = ?1 AND \
                     sql NOT LIKE 'CREATE VIRTUAL%'";
        let count: i64 = connection.query_row(query, [name], |row| row.get(0))?;
        if count != 1 {
            continue;
        }
        let mut statement = connection.prepare("SELECT name FROM pragma_table_info(?1)")?;
        let columns = statement.query_map([name], |row| row.get::<_, String>(0))?;
        tables.insert(name.to_owned(), columns.collect::<Result<Vec<_>, _>>()?);
    }
    Ok(tables)
}

/// Text of a column of any type.
fn text(row: &rusqlite::Row<'_>, at: usize) -> rusqlite::Result<String> {
    let value = row.get_ref(at)?;
    Ok(String::from_utf8_lossy(value.as_bytes().unwrap_or_default()).into_owned())
}
