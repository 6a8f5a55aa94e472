//! A file in any state made whole: all messages that can be read, with a new index.

use std::fmt;
use std::io::{Read, Seek, Write};

use crate::{BagInfo, ReadError, Reader, Selection, Settings, Stamp, WriteError, Writer};

/// Why a file cannot be made whole.
#[derive(Debug)]
pub enum RepairError {
    /// It cannot be read.
    Read(ReadError),
    /// The new one cannot be written.
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

/// Copies all that can be read to a new file, in the order of time. Types and topics stay as they
/// are, whatever their encoding.
///
/// # Errors
/// When the one cannot be read or the other not be written. Damage is no error: see
/// [`Reader::faults`].
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
