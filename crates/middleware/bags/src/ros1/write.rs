//! Writer of ROS 1 bags.

use std::collections::BTreeMap;
use std::io::{self, Seek, SeekFrom, Write};

use super::record::{put_data, put_header, put_u32, time_bytes};
use super::{MAGIC, Ros1Compression, op};
use crate::{BagInfo, BagTopic, FileInfo, Stamp, TopicInformation, WriteError};

/// Settings of a ROS 1 bag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ros1Settings {
    /// File name, for the description of the bag.
    pub file_name: String,
    /// Compression of chunks.
    pub compression: Ros1Compression,
    /// Chunk size before compression \[bytes\]; a chunk that reaches it is closed.
    pub chunk_bytes: usize,
    /// Maximum time span of the messages of a chunk \[ns\].
    pub chunk_span_ns: u64,
}

impl Ros1Settings {
    /// Chunks of a second or 768 KiB without compression, as `rosbag record`.
    #[must_use]
    pub fn new(file_name: impl Into<String>) -> Self {
        Self {
            file_name: file_name.into(),
            compression: Ros1Compression::None,
            chunk_bytes: 768 << 10,
            chunk_span_ns: 1_000_000_000,
        }
    }
}

/// Writer of a ROS 1 bag. Without [`Ros1Writer::finish`] it has no index; flushed data can still be
/// read, here and by `rosbag reindex`.
pub struct Ros1Writer<W> {
    sink: W,
    settings: Ros1Settings,
    at: u64,
    topics: Vec<(BagTopic, TopicInformation)>,
    /// Topic ids by name and type.
    ids: BTreeMap<(String, String), u32>,
    chunk: Chunk,
    chunks: Vec<Chunk>,
    packed: Vec<u8>,
    record: Vec<u8>,
}

/// A chunk: its records while it is open, afterwards only the data for the index.
#[derive(Default)]
struct Chunk {
    records: Vec<u8>,
    at: u64,
    span: Option<(u64, u64)>,
    /// Message counts by connection.
    counts: BTreeMap<u32, u32>,
    /// By connection: times, and offsets of the messages in `records`.
    entries: BTreeMap<u32, Vec<(u64, usize)>>,
}

/// Maximum size of a message, chunk or index \[bytes\]: ROS 1 uses signed 32-bit lengths.
const MOST: usize = i32::MAX as usize - (1 << 20);

impl<W: Write + Seek> Ros1Writer<W> {
    /// Starts a file.
    ///
    /// # Errors
    /// When the sink fails.
    pub fn new(mut sink: W, settings: Ros1Settings) -> Result<Self, WriteError> {
        let mut head = MAGIC.to_vec();
        head.extend(bag_header(0, 0, 0));
        sink.write_all(&head)?;
        sink.flush()?;
        Ok(Self {
            sink,
            settings,
            at: head.len() as u64,
            topics: Vec::new(),
            ids: BTreeMap::new(),
            chunk: Chunk::default(),
            chunks: Vec::new(),
            packed: Vec::new(),
            record: Vec::new(),
        })
    }

    /// Adds a topic with ROS 1 encoding and a ROS 1 schema. Returns its id for
    /// [`Ros1Writer::write`].
    ///
    /// # Errors
    /// When a text is too long.
    pub fn topic(&mut self, topic: &BagTopic) -> Result<u32, WriteError> {
        let key = (topic.name.clone(), topic.type_name.clone());
        if let Some(&id) = self.ids.get(&key) {
            return Ok(id);
        }
        if topic.schema.len() + topic.name.len() + topic.type_name.len() > 1 << 28 {
            return Err(WriteError::TooLong("a name or type".into()));
        }
        let id = u32::try_from(self.topics.len()).map_err(|_| WriteError::TooManyTopics)?;
        put_connection(&mut self.chunk.records, id, topic);
        let info = TopicInformation {
            name: topic.name.clone(),
            type_name: topic.type_name.clone(),
            type_hash: String::new(),
            encoding: "ros1".into(),
            qos: Vec::new(),
            messages: 0,
        };
        self.topics.push((topic.clone(), info));
        self.ids.insert(key, id);
        Ok(id)
    }

    /// Writes a message. ROS 1 stores only the time of recording, and requires it to be positive.
    ///
    /// # Errors
    /// When the bag cannot hold the message, or the sink fails.
    pub fn write(&mut self, topic: u32, stamp: Stamp, data: &[u8]) -> Result<(), WriteError> {
        let time = u64::try_from(stamp.log_ns)
            .map_err(|_| WriteError::NegativeTime(stamp.log_ns))?
            // `ros::TIME_MIN`: players start there.
            .max(1);
        if data.len() > MOST {
            return Err(WriteError::TooLong("a message".into()));
        }
        let info = self.topics.get_mut(topic as usize).ok_or(WriteError::UnknownTopic)?;
        info.1.messages += 1;
        let is_over = |(start, _)| time.saturating_sub(start) >= self.settings.chunk_span_ns;
        if self.chunk.span.is_some_and(is_over)
            || self.chunk.records.len().saturating_add(data.len()) > MOST
        {
            self.close_chunk()?;
        }
        let chunk = &mut self.chunk;
        *chunk.counts.entry(topic).or_default() += 1;
        chunk.entries.entry(topic).or_default().push((time, chunk.records.len()));
        let (start, end) = chunk.span.unwrap_or((time, time));
        chunk.span = Some((start.min(time), end.max(time)));
        let fields: [(&str, &[u8]); 3] =
            [("op", &[op::MESSAGE]), ("conn", &topic.to_le_bytes()), ("time", &time_bytes(time))];
        put_header(&mut chunk.records, &fields);
        put_data(&mut chunk.records, data);
        if chunk.records.len() >= self.settings.chunk_bytes {
            self.close_chunk()?;
        }
        Ok(())
    }

    /// Declares that no message older than `time_ns` follows, so that an open chunk of sufficient
    /// duration is closed.
    ///
    /// # Errors
    /// When the sink fails.
    pub fn advance_to(&mut self, time_ns: i64) -> Result<(), WriteError> {
        let time = u64::try_from(time_ns).unwrap_or(0);
        let is_over = |(start, _)| time.saturating_sub(start) >= self.settings.chunk_span_ns;
        if self.chunk.span.is_some_and(is_over) { self.close_chunk() } else { Ok(()) }
    }

    /// Closes the open chunk and hands all messages to the sink.
    ///
    /// # Errors
    /// When the sink fails.
    pub fn flush(&mut self) -> Result<(), WriteError> {
        if self.chunk.records.is_empty() { Ok(()) } else { self.close_chunk() }
    }

    fn close_chunk(&mut self) -> Result<(), WriteError> {
        let mut chunk = std::mem::take(&mut self.chunk);
        self.settings.compression.pack(&chunk.records, &mut self.packed)?;
        chunk.at = self.at;
        let mut size = Vec::new();
        put_u32(&mut size, chunk.records.len());
        self.record.clear();
        let fields: [(&str, &[u8]); 3] = [
            ("op", &[op::CHUNK]),
            ("compression", self.settings.compression.name().as_bytes()),
            ("size", &size),
        ];
        put_header(&mut self.record, &fields);
        put_u32(&mut self.record, self.packed.len());
        put(&mut self.sink, &mut self.at, &self.record)?;
        put(&mut self.sink, &mut self.at, &self.packed)?;
        self.record.clear();
        for (connection, mut entries) in std::mem::take(&mut chunk.entries) {
            entries.sort_unstable();
            let mut count = Vec::new();
            put_u32(&mut count, entries.len());
            let fields: [(&str, &[u8]); 4] = [
                ("op", &[op::INDEX]),
                ("ver", &1_u32.to_le_bytes()),
                ("conn", &connection.to_le_bytes()),
                ("count", &count),
            ];
            put_header(&mut self.record, &fields);
            put_u32(&mut self.record, entries.len() * 12);
            for (time, offset) in entries {
                self.record.extend(time_bytes(time));
                put_u32(&mut self.record, offset);
            }
        }
        put(&mut self.sink, &mut self.at, &self.record)?;
        self.sink.flush()?;
        // The buffer is reused.
        let mut records = std::mem::take(&mut chunk.records);
        records.clear();
        self.chunk.records = records;
        self.chunks.push(chunk);
        Ok(())
    }

    /// Writes the index and returns the sink and a description of the content.
    ///
    /// # Errors
    /// When the sink fails.
    pub fn finish(mut self) -> Result<(W, BagInfo), WriteError> {
        self.flush()?;
        let index_at = self.at;
        let mut index = Vec::new();
        for (id, (topic, _)) in (0_u32..).zip(&self.topics) {
            put_connection(&mut index, id, topic);
        }
        for chunk in &self.chunks {
            put_info(&mut index, chunk);
        }
        put(&mut self.sink, &mut self.at, &index)?;
        self.sink.seek(SeekFrom::Start(MAGIC.len() as u64))?;
        self.sink.write_all(&bag_header(index_at, self.topics.len(), self.chunks.len()))?;
        self.sink.seek(SeekFrom::End(0))?;
        self.sink.flush()?;
        let spans = self.chunks.iter().filter_map(|chunk| chunk.span);
        let span = spans.reduce(|(start, end), (from, to)| (start.min(from), end.max(to)));
        let signed = |time: u64| i64::try_from(time).unwrap_or(i64::MAX);
        let topics: Vec<TopicInformation> = self.topics.into_iter().map(|(_, info)| info).collect();
        let file = FileInfo {
            path: self.settings.file_name.clone(),
            span_ns: span.map(|(start, end)| (signed(start), signed(end))),
            messages: topics.iter().map(|topic| topic.messages).sum(),
        };
        Ok((self.sink, BagInfo { topics, files: vec![file], ..BagInfo::default() }))
    }
}

fn put<W: Write>(sink: &mut W, at: &mut u64, bytes: &[u8]) -> io::Result<()> {
    sink.write_all(bytes)?;
    *at += bytes.len() as u64;
    Ok(())
}

/// The bag header record, always 4096 bytes long.
fn bag_header(index_at: u64, connections: usize, chunks: usize) -> Vec<u8> {
    let (mut conn_count, mut chunk_count) = (Vec::new(), Vec::new());
    put_u32(&mut conn_count, connections);
    put_u32(&mut chunk_count, chunks);
    let fields: [(&str, &[u8]); 4] = [
        ("op", &[op::BAG]),
        ("index_pos", &index_at.to_le_bytes()),
        ("conn_count", &conn_count),
        ("chunk_count", &chunk_count),
    ];
    let mut record = Vec::new();
    put_header(&mut record, &fields);
    let padding = 4096 - 4 - record.len();
    put_u32(&mut record, padding);
    record.resize(4096, b' ');
    record
}

fn put_connection(out: &mut Vec<u8>, id: u32, topic: &BagTopic) {
    let fields: [(&str, &[u8]); 3] =
        [("op", &[op::CONNECTION]), ("conn", &id.to_le_bytes()), ("topic", topic.name.as_bytes())];
    put_header(out, &fields);
    let about = |key: &str| topic.metadata.get(key).map_or("", String::as_str);
    // ROS 1 type names have no `msg` part.
    let type_name = topic.type_name.replacen("/msg/", "/", 1);
    let mut fields: Vec<(&str, &[u8])> = vec![
        ("topic", topic.name.as_bytes()),
        ("type", type_name.as_bytes()),
        ("md5sum", about("md5sum").as_bytes()),
        ("message_definition", &topic.schema),
    ];
    for key in ["callerid", "latching"] {
        if !about(key).is_empty() {
            fields.push((key, about(key).as_bytes()));
        }
    }
    // The data of a connection is a header, prefixed with its length.
    put_header(out, &fields);
}

fn put_info(out: &mut Vec<u8>, chunk: &Chunk) {
    let (start, end) = chunk.span.unwrap_or_default();
    let mut count = Vec::new();
    put_u32(&mut count, chunk.counts.len());
    let fields: [(&str, &[u8]); 6] = [
        ("op", &[op::CHUNK_INFO]),
        ("ver", &1_u32.to_le_bytes()),
        ("chunk_pos", &chunk.at.to_le_bytes()),
        ("start_time", &time_bytes(start)),
        ("end_time", &time_bytes(end)),
        ("count", &count),
    ];
    put_header(out, &fields);
    put_u32(out, chunk.counts.len() * 8);
    for (connection, count) in &chunk.counts {
        out.extend(connection.to_le_bytes());
        out.extend(count.to_le_bytes());
    }
}
