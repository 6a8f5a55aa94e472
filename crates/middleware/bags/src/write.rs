//! Writer of MCAP bags.
//!
//! Messages are collected in a chunk. It is closed when the next message is a second later than its
//! first or when it is full; then it is compressed, written and flushed, so that after a crash
//! everything up to the last second can be read. Schemas and channels are written before the first
//! chunk that uses them, outside of it: a damaged chunk loses only its own messages.

mod chunk;
mod line;
mod sealer;
mod topics;

use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Write};

use chunk::Chunk;
use line::Line;
use sealer::Sealer;
use topics::Topics;

pub use topics::{Topic, TopicId};

use crate::record::MessageHead;
use crate::{BagInfo, BagTopic, Compression, Style};

/// Settings of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// File name, for the metadata.
    pub file_name: String,
    /// Compression of chunks.
    pub compression: Compression,
    /// Version of the metadata.
    pub style: Style,
    /// Maximum time span of the messages of a chunk \[ns\].
    pub chunk_span_ns: u64,
    /// Chunk size before compression \[bytes\]; a chunk that reaches it is closed.
    pub chunk_bytes: usize,
    /// Number of compression threads, in addition to one that writes; with none the caller's thread
    /// does all. The bytes are the same. Each thread holds up to four chunks.
    pub threads: usize,
    /// Name of the ROS distribution of the message definitions; may be empty.
    pub ros_distro: String,
    /// Facts of the recorder by name.
    pub custom_data: BTreeMap<String, String>,
}

impl Settings {
    /// Chunks of a second or 4 MiB, compressed by one thread.
    #[must_use]
    pub fn new(file_name: impl Into<String>) -> Self {
        Self {
            file_name: file_name.into(),
            compression: Compression::default(),
            style: Style::default(),
            chunk_span_ns: 1_000_000_000,
            chunk_bytes: 4 << 20,
            threads: 1,
            ros_distro: String::new(),
            custom_data: BTreeMap::new(),
        }
    }
}

/// Times of publication and recording, and sequence number of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp {
    /// Time of recording \[ns\]; bags are played in this order.
    pub log_ns: i64,
    /// Time of publication \[ns\].
    pub publish_ns: i64,
    /// Sequence number of its publisher; none to count here, from 1.
    pub sequence: Option<u32>,
}

impl Stamp {
    /// Published and recorded at the same time \[ns\].
    #[must_use]
    pub fn at(time_ns: i64) -> Self {
        Self { log_ns: time_ns, publish_ns: time_ns, sequence: None }
    }
}

/// Reason for which a message cannot be recorded.
#[derive(Debug)]
pub enum WriteError {
    /// The sink failed. All later messages are lost.
    Sink(io::Error),
    /// The time is negative; bags start at zero \[ns\].
    NegativeTime(i64),
    /// The bag has 65535 topics or types already.
    TooManyTopics,
    /// A text or message exceeds the limit of the format, 4 GiB.
    TooLong(String),
    /// The topic belongs to another writer.
    UnknownTopic,
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sink(error) => {
                write!(f, "the bag cannot be written: {}", periplus_diagnostics::plain_words(error))
            }
            Self::NegativeTime(time_ns) => {
                write!(f, "the bag cannot store the time {time_ns} ns: times start at 0")
            }
            Self::TooManyTopics => {
                write!(f, "a bag has at most 65535 topics; record fewer topics, or several bags")
            }
            Self::TooLong(what) => write!(f, "{what} is longer than 4 GiB, the limit of a bag"),
            Self::UnknownTopic => write!(f, "the topic belongs to another bag"),
        }
    }
}

impl std::error::Error for WriteError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Sink(error) => Some(error),
            _ => None,
        }
    }
}

impl From<io::Error> for WriteError {
    fn from(error: io::Error) -> Self {
        Self::Sink(error)
    }
}

/// Writes a file to a sink, from front to back.
///
/// The same messages and settings give the same bytes. If a writer is dropped, the open chunk is
/// lost and the file has no index, as after a crash; call [`Writer::finish`].
pub struct Writer<W: Write> {
    settings: Settings,
    topics: Topics,
    chunk: Chunk,
    line: Line<W>,
}

impl<W: Write + Send + 'static> Writer<W> {
    /// Starts a file.
    ///
    /// # Errors
    /// When the sink fails.
    pub fn new(sink: W, settings: Settings) -> Result<Self, WriteError> {
        let sealer = Sealer::new(sink, &settings)?;
        let line = Line::new(sealer, &settings)?;
        Ok(Self { settings, topics: Topics::default(), chunk: Chunk::default(), line })
    }

    /// Adds a topic. A topic of the same name and type is reused with its QoS profiles.
    ///
    /// # Errors
    /// When there are too many topics or a text is too long.
    pub fn topic(&mut self, topic: Topic) -> Result<TopicId, WriteError> {
        self.topics.add(topic, self.settings.style, &mut self.chunk.preamble)
    }

    /// Adds a topic of another file unchanged, in any encoding.
    ///
    /// # Errors
    /// When there are too many of them.
    pub fn copy_topic(&mut self, topic: &BagTopic) -> Result<TopicId, WriteError> {
        self.topics.copy(topic, &mut self.chunk.preamble)
    }

    /// Writes a message in the encoding of its topic.
    ///
    /// # Errors
    /// When the bag cannot store it. An error of the sink may belong to an earlier
    /// message, and all later calls return an error as well.
    pub fn write(&mut self, topic: TopicId, stamp: Stamp, data: &[u8]) -> Result<(), WriteError> {
        let time = |time_ns| u64::try_from(time_ns).map_err(|_| WriteError::NegativeTime(time_ns));
        let (log_time, publish_time) = (time(stamp.log_ns)?, time(stamp.publish_ns)?);
        // Byte arrays in memory formats and CDR have 32-bit lengths.
        if u32::try_from(data.len()).is_err() {
            return Err(WriteError::TooLong("a message".into()));
        }
        let channel = self.topics.count(topic)?;
        let sequence = stamp.sequence.unwrap_or(channel.sequence);
        let head = MessageHead { channel: channel.id, sequence, log_time, publish_time };
        if self.chunk.is_over(log_time, self.settings.chunk_span_ns) {
            self.close_chunk()?;
        }
        self.chunk.add(head, data);
        if self.chunk.records.len() >= self.settings.chunk_bytes {
            self.close_chunk()?;
        }
        Ok(())
    }

    /// Declares that no message older than `time_ns` follows, so that an open chunk of sufficient
    /// duration is closed. For live runs with pauses in recording.
    ///
    /// # Errors
    /// When the sink fails.
    pub fn advance_to(&mut self, time_ns: i64) -> Result<(), WriteError> {
        let time = u64::try_from(time_ns).unwrap_or(0);
        if self.chunk.is_over(time, self.settings.chunk_span_ns) {
            self.close_chunk()
        } else {
            Ok(())
        }
    }

    /// Closes the open chunk and hands all messages to the threads that write.
    ///
    /// # Errors
    /// When the sink fails.
    pub fn flush(&mut self) -> Result<(), WriteError> {
        if self.chunk.is_empty() { Ok(()) } else { self.close_chunk() }
    }

    fn close_chunk(&mut self) -> Result<(), WriteError> {
        Ok(self.line.seal(&mut self.chunk)?)
    }

    /// Writes the index and returns the sink and a description of the content.
    ///
    /// # Errors
    /// When the sink fails, now or earlier.
    pub fn finish(mut self) -> Result<(W, BagInfo), WriteError> {
        self.flush()?;
        Ok(self.line.finish()?.finish(&self.topics, &self.settings)?)
    }
}
