//! Writing a file.
//!
//! Messages gather in a chunk. It is closed when the next message is a second younger than its first
//! or when it is full; then it is packed, written and flushed, so that whatever happens to the
//! program, everything up to the last second can be read. Types and topics stand in front of the
//! first chunk that uses them, outside of it: a damaged chunk takes only its own messages with it.

mod chunk;
mod line;
mod sealer;
mod topics;

use std::fmt;
use std::io::{self, Write};

use chunk::Chunk;
use line::Line;
use sealer::Sealer;
use topics::Topics;

pub use topics::{Topic, TopicId};

use crate::record::MessageHead;
use crate::{BagInfo, BagTopic, Compression, Style};

/// How a file is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The name of the file, for its metadata.
    pub file_name: String,
    /// How chunks are packed.
    pub compression: Compression,
    /// For which readers the metadata is written.
    pub style: Style,
    /// A chunk is closed before its messages span this time \[ns\].
    pub chunk_span_ns: u64,
    /// A chunk is closed when it holds this many bytes, before they are packed.
    pub chunk_bytes: usize,
    /// How many threads pack chunks, beside one that writes them; with none all is done by who calls.
    /// The bytes are the same. Each thread holds up to four chunks.
    pub threads: usize,
    /// The name of the ROS distribution whose messages these are; may be empty.
    pub ros_distro: String,
}

impl Settings {
    /// Chunks of a second or 4 MiB, packed by a thread of their own.
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
        }
    }
}

/// When a message was sent and recorded, in simulated nanoseconds, and which one it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp {
    /// When it was recorded \[ns\]; bags are played in this order.
    pub log_ns: i64,
    /// When it was sent \[ns\].
    pub publish_ns: i64,
    /// Its number among the messages of its publisher; none counts them here, from 1.
    pub sequence: Option<u32>,
}

impl Stamp {
    /// Sent and recorded at one time \[ns\].
    #[must_use]
    pub fn at(time_ns: i64) -> Self {
        Self { log_ns: time_ns, publish_ns: time_ns, sequence: None }
    }
}

/// Why a message cannot be recorded.
#[derive(Debug)]
pub enum WriteError {
    /// The sink does not take the bytes. Everything after that is lost.
    Sink(io::Error),
    /// Times of bags begin at zero \[ns\].
    NegativeTime(i64),
    /// A bag holds at most 65535 topics and as many types.
    TooManyTopics,
    /// A text or message is longer than the format can tell, 4 GiB.
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
                write!(f, "the bag cannot hold the time {time_ns} ns: its times begin at 0")
            }
            Self::TooManyTopics => {
                write!(f, "a bag holds at most 65535 topics; record fewer, or several bags")
            }
            Self::TooLong(what) => write!(f, "{what} is longer than 4 GiB: a bag cannot hold it"),
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

/// Writes one file to a sink, from front to back.
///
/// Same messages and settings, same bytes. When a writer is dropped, the chunk that is open is lost
/// and the file has no index, as after a crash; call [`Writer::finish`].
pub struct Writer<W: Write> {
    settings: Settings,
    topics: Topics,
    chunk: Chunk,
    line: Line<W>,
}

impl<W: Write + Send + 'static> Writer<W> {
    /// Begins a file.
    ///
    /// # Errors
    /// When the sink does not take its first bytes.
    pub fn new(sink: W, settings: Settings) -> Result<Self, WriteError> {
        let sealer = Sealer::new(sink, &settings)?;
        let line = Line::new(sealer, &settings)?;
        Ok(Self { settings, topics: Topics::default(), chunk: Chunk::default(), line })
    }

    /// Adds a topic. One that is there already with the same type is the same; its profiles stay
    /// as they were.
    ///
    /// # Errors
    /// When there are too many of them or a text is too long.
    pub fn topic(&mut self, topic: Topic) -> Result<TopicId, WriteError> {
        self.topics.add(topic, self.settings.style, &mut self.chunk.preamble)
    }

    /// Adds a topic of another file as it is there, whatever its encoding.
    ///
    /// # Errors
    /// When there are too many of them.
    pub fn copy_topic(&mut self, topic: &BagTopic) -> Result<TopicId, WriteError> {
        self.topics.copy(topic, &mut self.chunk.preamble)
    }

    /// Records a message, encoded as its topic says.
    ///
    /// # Errors
    /// When the bag cannot hold it. An error of the sink may be that of an earlier message, and
    /// every later call returns one as well.
    pub fn write(&mut self, topic: TopicId, stamp: Stamp, data: &[u8]) -> Result<(), WriteError> {
        let time = |time_ns| u64::try_from(time_ns).map_err(|_| WriteError::NegativeTime(time_ns));
        let (log_time, publish_time) = (time(stamp.log_ns)?, time(stamp.publish_ns)?);
        // The length of a list of bytes in memory formats is four bytes; CDR ends there as well.
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

    /// Says that no message older than `time_ns` will come: when the open chunk has lasted long
    /// enough by then, it is closed. For live runs in which nothing is recorded for a while.
    ///
    /// # Errors
    /// When the sink does not take the bytes.
    pub fn advance_to(&mut self, time_ns: i64) -> Result<(), WriteError> {
        let time = u64::try_from(time_ns).unwrap_or(0);
        if self.chunk.is_over(time, self.settings.chunk_span_ns) {
            self.close_chunk()
        } else {
            Ok(())
        }
    }

    /// Closes the open chunk: all that was recorded is on its way to the sink.
    ///
    /// # Errors
    /// When the sink does not take the bytes.
    pub fn flush(&mut self) -> Result<(), WriteError> {
        if self.chunk.is_empty() { Ok(()) } else { self.close_chunk() }
    }

    fn close_chunk(&mut self) -> Result<(), WriteError> {
        Ok(self.line.seal(&mut self.chunk)?)
    }

    /// Ends the file with its index and gives the sink back, with what is in the file.
    ///
    /// # Errors
    /// When the sink does not take the bytes, now or earlier.
    pub fn finish(mut self) -> Result<(W, BagInfo), WriteError> {
        self.flush()?;
        Ok(self.line.finish()?.finish(&self.topics, &self.settings)?)
    }
}
