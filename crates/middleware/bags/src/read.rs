//! Reading of files, complete or damaged.
//!
//! A file with a valid summary is opened by it. A file with a missing or damaged summary is scanned
//! from front to back: all complete records are read, and of a truncated chunk all that can be
//! decompressed. Chunks are decompressed on demand, so that memory does not grow with the file.

mod block;
mod front;
mod messages;
mod source;
mod summary;
mod walk;

use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Read, Seek};

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_msgs::TypeRegistry;
use periplus_rosidl::{InterfaceDialect, TypeName};

#[cfg(feature = "files")]
pub(crate) use block::Entry;
pub(crate) use block::{Block, Kind};
pub(crate) use source::Source;

pub use messages::{Message, Messages, OwnMessages, Selection};

use crate::record::{Channel, MAGIC, Schema};
use crate::{Fault, QosProfile, qos, ros1};

/// Limits of memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Maximum size of a chunk after decompression \[bytes\]; larger chunks are skipped.
    pub chunk: u64,
    /// Maximum size of all chunks decompressed at one time because their times overlap \[bytes\].
    pub unpacked: u64,
}

impl Default for Limits {
    /// 256 MiB and 384 MiB: far above the chunks of recorders (1 to 10 MiB), and below half a
    /// gigabyte together with the growth of one chunk.
    fn default() -> Self {
        Self { chunk: 256 << 20, unpacked: 384 << 20 }
    }
}

/// Reason for which a file cannot be read.
#[derive(Debug)]
pub enum ReadError {
    /// The source failed.
    Source(io::Error),
    /// The file is not a bag; with its format, if that is recognized.
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
            Self::Unknown(Some(other)) => write!(f, "this is not a bag but {other}"),
            Self::Unknown(None) => {
                write!(f, "this is not a bag: neither MCAP nor a ROS 1 bag")
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
    /// Full name.
    pub name: String,
    /// Full type name; empty if the file does not contain it.
    pub type_name: String,
    /// Message encoding: `cdr`, `ros1`, `json`, ...
    pub encoding: String,
    /// Schema encoding: `ros2msg`, `ros2idl`, `ros1msg`, `jsonschema`, ...
    pub schema_encoding: String,
    /// Schema text.
    pub schema: Vec<u8>,
    /// Other metadata of the topic, such as `offered_qos_profiles`.
    pub metadata: BTreeMap<String, String>,
}

impl BagTopic {
    /// QoS offered by each of its publishers; empty if the file does not contain it.
    #[must_use]
    pub fn offered_qos(&self) -> Vec<QosProfile> {
        self.metadata
            .get("offered_qos_profiles")
            .map(|text| qos::from_text(text))
            .unwrap_or_default()
    }
}

/// Reader of a bag file.
pub struct Reader<R> {
    source: Source<R>,
    limits: Limits,
    topics: Vec<BagTopic>,
    /// Topic index of each channel.
    by_channel: BTreeMap<u32, usize>,
    /// Number of messages of each topic.
    counts: Vec<u64>,
    blocks: Vec<Block>,
    faults: Vec<Fault>,
    has_summary: bool,
    messages: Option<u64>,
    custom_data: BTreeMap<String, String>,
}

/// Content of a file, from its summary or from a scan.
#[derive(Default)]
struct Contents {
    schemas: BTreeMap<u16, Schema>,
    channels: BTreeMap<u16, Channel>,
    blocks: Vec<Block>,
    messages: Option<u64>,
    /// Message counts by channel.
    counts: BTreeMap<u16, u64>,
}

/// Content of a file in the same form for all formats.
pub(crate) struct Found {
    pub(crate) topics: Vec<BagTopic>,
    /// Topic index of each channel.
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
    /// When the source fails, or is neither MCAP nor a ROS 1 bag. Damage after the header
    /// is not an error but a [fault](Self::faults).
    pub fn open(source: R) -> Result<Self, ReadError> {
        Self::open_within(source, Limits::default())
    }

    /// Opens a file with other limits.
    ///
    /// # Errors
    /// As [`Reader::open`].
    pub fn open_within(source: R, limits: Limits) -> Result<Self, ReadError> {
        let mut source = Source::new(source)?;
        let start = source.bytes(0, 16)?;
        let mut faults = Vec::new();
        let mut custom_data = BTreeMap::new();
        let found = if start.starts_with(&MAGIC) {
            custom_data = front::custom_data(&mut source)?;
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
            custom_data,
        })
    }

    /// Facts that the recorder wrote by name.
    #[cfg(feature = "files")]
    pub(crate) fn custom_data(&self) -> &BTreeMap<String, String> {
        &self.custom_data
    }

    /// Blocks in the order of their start times, and the topic of each channel.
    #[cfg(feature = "files")]
    pub(crate) fn into_index(self) -> (Vec<Block>, BTreeMap<u32, usize>) {
        (self.blocks, self.by_channel)
    }

    /// Topics in the order of their channels.
    #[must_use]
    pub fn topics(&self) -> &[BagTopic] {
        &self.topics
    }

    /// Damage found so far: chunks are checked when they are read.
    #[must_use]
    pub fn faults(&self) -> &[Fault] {
        &self.faults
    }

    /// True if the file was closed properly: it has a valid summary.
    #[must_use]
    pub fn has_summary(&self) -> bool {
        self.has_summary
    }

    /// Number of messages, if the file contains it or was scanned.
    #[must_use]
    pub fn message_count(&self) -> Option<u64> {
        self.messages
    }

    /// Number of messages of each topic, if the file contains it or was scanned.
    #[must_use]
    pub fn counts(&self) -> Option<&[u64]> {
        (self.messages == Some(self.counts.iter().sum())).then_some(&*self.counts)
    }

    /// Times of the first and last message \[ns\]; none without messages.
    #[must_use]
    pub fn span_ns(&self) -> Option<(i64, i64)> {
        let start = self.blocks.iter().map(|block| block.start).min()?;
        let end = self.blocks.iter().map(|block| block.end).max()?;
        Some((signed(start), signed(end)))
    }

    /// Iterates over messages in the order of log times; those of equal time in the order of the
    /// file. If the index has wrong times, which is a [fault](Self::faults), some messages may come
    /// late.
    pub fn messages(&mut self, selection: Selection) -> Messages<'_, R> {
        Messages::new(self, selection)
    }

    /// Same as [`Reader::messages`], but takes the reader by value.
    pub fn into_messages(self, selection: Selection) -> OwnMessages<R> {
        OwnMessages::new(self, selection)
    }

    /// Returns the types of the topics for decoding. Schemas that cannot be used are skipped with a
    /// finding.
    #[must_use]
    pub fn types(&self, sources: &mut SourceMap, diagnostics: &mut Diagnostics) -> TypeRegistry {
        let mut registry = periplus_rosidl::Registry::new();
        for topic in &self.topics {
            let dialect = match topic.schema_encoding.as_str() {
                "ros2msg" => InterfaceDialect::Ros2,
                "ros1msg" => InterfaceDialect::Ros1,
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

/// Recognizes other formats by their first bytes.
fn other_format(start: &[u8]) -> Option<&'static str> {
    let known: [(&[u8], &str); 3] = [
        (b"SQLite format 3", "a database (sqlite3), which is not read as a stream"),
        (b"#ROSBAG V", "a ROS 1 bag before version 2.0; convert it with `rosbag fix`"),
        (b"rosbag2_bagfile", "the metadata.yaml of a bag; open the .mcap file"),
    ];
    known.iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, name)| *name)
}

/// Opens an MCAP file by its summary or by a scan.
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

/// Maximum number of faults kept.
const MOST_FAULTS: usize = 100;

pub(crate) fn fault(faults: &mut Vec<Fault>, offset: u64, message: impl Into<String>) {
    if faults.len() < MOST_FAULTS {
        faults.push(Fault { offset, message: message.into() });
    }
}
