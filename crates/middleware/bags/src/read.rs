//! Reading a file, whatever state it is in.
//!
//! A file with a good summary is opened by it. One without, or with one that is damaged, is walked
//! from front to back: what is complete is read, of a chunk that is cut as much as can be unpacked.
//! Chunks are unpacked when their time comes, so memory does not grow with the file.

mod block;
mod messages;
mod source;
mod summary;
mod walk;

use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Read, Seek};

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_msgs::TypeRegistry;
use periplus_rosidl::{Dialect, TypeName};

pub(crate) use block::{Block, Kind};
pub(crate) use source::Source;

pub use messages::{Message, Messages, OwnMessages, Selection};

use crate::record::{Channel, MAGIC, Schema};
use crate::{Fault, QosProfile, qos, ros1};

/// How much memory a file may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The largest chunk, unpacked \[bytes\]; a larger one is left out.
    pub chunk: u64,
    /// All chunks that are unpacked at one time, because their times overlap \[bytes\].
    pub unpacked: u64,
}

impl Default for Limits {
    /// 256 MiB and 384 MiB: far above what recorders write (1 to 10 MiB), and together with the
    /// growth of one chunk below half a gigabyte.
    fn default() -> Self {
        Self { chunk: 256 << 20, unpacked: 384 << 20 }
    }
}

/// Why a file cannot be read.
#[derive(Debug)]
pub enum ReadError {
    /// The source fails.
    Source(io::Error),
    /// The file does not begin as recordings do; what it is instead, if that can be seen.
    Unknown(Option<&'static str>),
    /// The chunks of one moment need more memory than [`Limits::unpacked`].
    TooLarge(u64),
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Source(error) => {
                write!(f, "the bag cannot be read: {}", periplus_diagnostics::plain_words(error))
            }
            Self::Unknown(Some(other)) => write!(f, "this is not a recording but {other}"),
            Self::Unknown(None) => {
                write!(f, "this is no recording: neither MCAP nor a bag of ROS 1")
            }
            Self::TooLarge(bytes) => write!(
                f,
                "the chunks of one moment need {bytes} bytes: the times of the bag overlap too much"
            ),
        }
    }
}

impl std::error::Error for ReadError {}

impl From<io::Error> for ReadError {
    fn from(error: io::Error) -> Self {
        Self::Source(error)
    }
}

/// A topic of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BagTopic {
    /// Its full name.
    pub name: String,
    /// The full name of its type; empty when the file does not tell it.
    pub type_name: String,
    /// How its messages are encoded: `cdr`, `ros1`, `json`, ...
    pub encoding: String,
    /// What kind of text defines the type: `ros2msg`, `ros2idl`, `ros1msg`, `jsonschema`, ...
    pub schema_encoding: String,
    /// That text.
    pub schema: Vec<u8>,
    /// What else the file tells of it, such as `offered_qos_profiles`.
    pub metadata: BTreeMap<String, String>,
}

impl BagTopic {
    /// How each of its publishers offered it; none when the file does not tell.
    #[must_use]
    pub fn offered_qos(&self) -> Vec<QosProfile> {
        self.metadata
            .get("offered_qos_profiles")
            .map(|text| qos::from_text(text))
            .unwrap_or_default()
    }
}

/// A file of messages.
pub struct Reader<R> {
    source: Source<R>,
    limits: Limits,
    topics: Vec<BagTopic>,
    /// Which topic a channel is.
    by_channel: BTreeMap<u32, usize>,
    /// How many messages each topic has.
    counts: Vec<u64>,
    blocks: Vec<Block>,
    faults: Vec<Fault>,
    has_summary: bool,
    messages: Option<u64>,
}

/// What opening a file finds, by its summary or by a walk.
#[derive(Default)]
struct Contents {
    schemas: BTreeMap<u16, Schema>,
    channels: BTreeMap<u16, Channel>,
    blocks: Vec<Block>,
    messages: Option<u64>,
    /// By channel.
    counts: BTreeMap<u16, u64>,
}

/// The same for every format.
pub(crate) struct Found {
    pub(crate) topics: Vec<BagTopic>,
    /// Which topic a channel is.
    pub(crate) by_channel: BTreeMap<u32, usize>,
    pub(crate) counts: Vec<u64>,
    pub(crate) blocks: Vec<Block>,
    pub(crate) messages: Option<u64>,
    pub(crate) has_summary: bool,
}

impl<R: Read + Seek> Reader<R> {
    /// Opens a file.
    ///
    /// # Errors
    /// When the source fails or is neither MCAP nor a bag of ROS 1. Damage further in is no error but a
    /// [fault](Self::faults).
    pub fn open(source: R) -> Result<Self, ReadError> {
        Self::open_within(source, Limits::default())
    }

    /// As [`Reader::open`], with other limits.
    ///
    /// # Errors
    /// As [`Reader::open`].
    pub fn open_within(source: R, limits: Limits) -> Result<Self, ReadError> {
        let mut source = Source::new(source)?;
        let start = source.bytes(0, 16)?;
        let mut faults = Vec::new();
        let found = if start.starts_with(&MAGIC) {
            mcap(&mut source, &limits, &mut faults)?
        } else if start.starts_with(ros1::MAGIC) {
            ros1::read(&mut source, &limits, &mut faults)?
        } else {
            return Err(ReadError::Unknown(other_format(&start)));
        };
        let Found { topics, by_channel, counts, mut blocks, messages, has_summary } = found;
        blocks.sort_by_key(|block| (block.start, block.offset));
        Ok(Self {
            source,
            limits,
            topics,
            by_channel,
            counts,
            blocks,
            faults,
            has_summary,
            messages,
        })
    }

    /// The topics, in the order of their channels.
    #[must_use]
    pub fn topics(&self) -> &[BagTopic] {
        &self.topics
    }

    /// What is damaged, as far as anyone looked: chunks are looked at when they are read.
    #[must_use]
    pub fn faults(&self) -> &[Fault] {
        &self.faults
    }

    /// Whether the file was closed properly: it has a summary, and that is in order.
    #[must_use]
    pub fn has_summary(&self) -> bool {
        self.has_summary
    }

    /// How many messages there are, if the file tells it or was walked through.
    #[must_use]
    pub fn message_count(&self) -> Option<u64> {
        self.messages
    }

    /// How many messages each topic has, if the file tells it or was walked through.
    #[must_use]
    pub fn counts(&self) -> Option<&[u64]> {
        (self.messages == Some(self.counts.iter().sum())).then_some(&*self.counts)
    }

    /// Time of the first message and of the last \[ns\]; none without messages.
    #[must_use]
    pub fn span_ns(&self) -> Option<(i64, i64)> {
        let start = self.blocks.iter().map(|block| block.start).min()?;
        let end = self.blocks.iter().map(|block| block.end).max()?;
        Some((signed(start), signed(end)))
    }

    /// Messages in the order of their log times; those of one time in the order of the file. Where the
    /// index is wrong about times, which becomes a [fault](Self::faults), some may come late.
    pub fn messages(&mut self, selection: Selection) -> Messages<'_, R> {
        Messages::new(self, selection)
    }

    /// As [`Reader::messages`], without lending the reader.
    pub fn into_messages(self, selection: Selection) -> OwnMessages<R> {
        OwnMessages::new(self, selection)
    }

    /// The types of the topics, ready to decode their messages. What cannot be used is left out,
    /// and the findings say why.
    #[must_use]
    pub fn types(&self, sources: &mut SourceMap, diagnostics: &mut Diagnostics) -> TypeRegistry {
        let mut registry = periplus_rosidl::Registry::new();
        for topic in &self.topics {
            let dialect = match topic.schema_encoding.as_str() {
                "ros2msg" => Dialect::Ros2,
                "ros1msg" => Dialect::Ros1,
                _ => continue,
            };
            let Some(name) = TypeName::read(&topic.type_name) else { continue };
            let text = String::from_utf8_lossy(&topic.schema).into_owned();
            let file = sources.add(format!("schema of {}", topic.name), text);
            registry.add_schema(&name, file, sources, dialect, diagnostics);
        }
        TypeRegistry::new(registry, diagnostics)
    }
}

/// What else a file may be, by its first bytes.
fn other_format(start: &[u8]) -> Option<&'static str> {
    let known: [(&[u8], &str); 3] = [
        (b"SQLite format 3", "a database (sqlite3), which is not read as a stream"),
        (b"#ROSBAG V", "a bag of ROS 1 before version 2.0; `rosbag fix` makes it new"),
        (b"rosbag2_bagfile", "the metadata.yaml of a bag; name the .mcap file"),
    ];
    known.iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, name)| *name)
}

/// An MCAP file, by its summary or by a walk.
fn mcap<R: Read + Seek>(
    source: &mut Source<R>,
    limits: &Limits,
    faults: &mut Vec<Fault>,
) -> Result<Found, ReadError> {
    let by_summary = summary::read(source, limits, faults)?;
    let has_summary = by_summary.is_some();
    let contents = match by_summary {
        Some(contents) => contents,
        None => walk::all(source, limits, faults)?,
    };
    let mut by_channel = BTreeMap::new();
    let mut topics = Vec::new();
    let mut counts = Vec::new();
    for channel in contents.channels.values() {
        let schema = contents.schemas.get(&channel.schema);
        by_channel.insert(channel.id.into(), topics.len());
        counts.push(contents.counts.get(&channel.id).copied().unwrap_or(0));
        topics.push(BagTopic {
            name: channel.topic.clone(),
            type_name: schema.map(|schema| schema.name.clone()).unwrap_or_default(),
            encoding: channel.encoding.clone(),
            schema_encoding: schema.map(|schema| schema.encoding.clone()).unwrap_or_default(),
            schema: schema.map(|schema| schema.data.clone()).unwrap_or_default(),
            metadata: channel.metadata.clone(),
        });
    }
    let Contents { blocks, messages, .. } = contents;
    Ok(Found { topics, by_channel, counts, blocks, messages, has_summary })
}

fn signed(time: u64) -> i64 {
    i64::try_from(time).unwrap_or(i64::MAX)
}

/// More faults than this are not kept.
const MOST_FAULTS: usize = 100;

pub(crate) fn fault(faults: &mut Vec<Fault>, offset: u64, message: impl Into<String>) {
    if faults.len() < MOST_FAULTS {
        faults.push(Fault { offset, message: message.into() });
    }
}
