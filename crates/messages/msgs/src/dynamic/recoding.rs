//! Conversion of messages between two formats and two revisions of their type.

use std::fmt;
use std::sync::Arc;

use super::{Adaptation, DynamicMessage, Layout};
use crate::{DecodeError, EncodeError, Format, recode};

/// Converts messages from one format and type to another, such as from ROS 1 to ROS 2.
#[derive(Debug)]
pub struct Recoding {
    source: Arc<Layout>,
    from: Format,
    to: Format,
    /// None if both types have the same serialization.
    adaptation: Option<Adaptation>,
}

/// Reason for which a message cannot be converted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RecodeError {
    /// The bytes cannot be decoded as the type.
    Decode(DecodeError),
    /// The target cannot represent the message.
    Encode(EncodeError),
}

impl fmt::Display for RecodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Decode(error) => error.fmt(f),
            Self::Encode(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for RecodeError {}

impl Recoding {
    /// Creates the conversion from `source` in the format `from` to `target` in the format `to`.
    #[must_use]
    pub fn new(source: &Arc<Layout>, from: Format, target: &Arc<Layout>, to: Format) -> Self {
        let is_same = source.has_bytes_of(target);
        let adaptation = (!is_same).then(|| Adaptation::new(source, target));
        Self { source: source.clone(), from, to, adaptation }
    }

    /// Conversion between revisions of the type, if they differ.
    #[must_use]
    pub fn adaptation(&self) -> Option<&Adaptation> {
        self.adaptation.as_ref()
    }

    /// Appends the converted message to `out`. After an error `out` may have a part of it.
    ///
    /// # Errors
    /// When the message cannot be decoded or encoded.
    pub fn convert(&self, data: &[u8], out: &mut Vec<u8>) -> Result<(), RecodeError> {
        let Some(adaptation) = &self.adaptation else {
            return recode(&self.source, self.from, data, self.to, out)
                .map_err(RecodeError::Decode);
        };
        let message = DynamicMessage::decode(&self.source, self.from, data);
        let message = adaptation.apply(message.map_err(RecodeError::Decode)?);
        message.encode(self.to, out).map_err(RecodeError::Encode)
    }
}
