//! Repair of damaged files: copies all readable messages into a new file with an index.

use std::fmt;
use std::io::{Read, Seek, Write};

use crate::{BagInfo, ReadError, Reader, Selection, Settings, Stamp, WriteError, Writer};

/// Reason for which a file cannot be repaired.
#[derive(Debug)]
pub enum RepairError {
    /// The source cannot be read.
    Read(ReadError),
    /// The result cannot be written.
    Write(WriteError),
}

impl fmt::Display for RepairError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(error) => error.fmt(f),
            Self::Write(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for RepairError {}

impl From<ReadError> for RepairError {
    fn from(error: ReadError) -> Self {
        Self::Read(error)
    }
}

impl From<WriteError> for RepairError {
    fn from(error: WriteError) -> Self {
        Self::Write(error)
    }
}

/// Copies all readable messages to a new file in the order of time. Types and topics are copied
/// unchanged, in any encoding.
///
/// # Errors
/// When the source cannot be read or the result cannot be written. Damage is not an error:
/// see [`Reader::faults`].
pub fn repair<R: Read + Seek, W: Write + Send + 'static>(
    reader: &mut Reader<R>,
    sink: W,
    settings: Settings,
) -> Result<(W, BagInfo), RepairError> {
    let mut bag = Writer::new(sink, settings)?;
    let topics = reader.topics().iter().map(|topic| bag.copy_topic(topic));
    let topics = topics.collect::<Result<Vec<_>, _>>()?;
    let mut messages = reader.messages(Selection::default());
    while let Some(message) = messages.next()? {
        let stamp = Stamp {
            log_ns: message.log_ns,
            publish_ns: message.publish_ns,
            sequence: Some(message.sequence),
        };
        bag.write(topics[message.topic], stamp, message.data)?;
    }
    Ok(bag.finish()?)
}
