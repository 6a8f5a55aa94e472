//! One message on its way.

use std::fmt;
use std::sync::Arc;

use periplus_msgs::{DecodeError, EncodeError, Message};

use crate::payload::Payload;

/// A publisher, subscription, server or client of a graph; never used twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EndpointId(pub(crate) u64);

/// One published message. Cloning shares it: neither the value nor its bytes are ever copied.
#[derive(Clone)]
pub struct Sample {
    /// When it was published, on the clock of the graph \[ns\].
    pub time_ns: i64,
    /// Its number on its topic, from 1; messages that nobody heard count.
    pub sequence: u64,
    /// Who published it; a wire knows its own messages by this.
    pub publisher: EndpointId,
    /// When it is too old to be delivered \[ns\].
    pub(crate) stale_ns: i64,
    pub(crate) payload: Arc<Payload>,
}

impl Sample {
    pub(crate) fn is_stale(&self, now_ns: i64) -> bool {
        self.stale_ns < now_ns
    }

    /// The message as a value. Bytes from a wire or a bag are decoded once for all who ask.
    ///
    /// # Errors
    /// When the bytes are no such message.
    pub fn message<T: Message>(&self) -> Result<Arc<T>, DecodeError> {
        self.payload.message()
    }

    /// The message as CDR, with the four bytes in front that say how it is coded. It is encoded
    /// once for all who ask; keep the sample to keep the bytes.
    ///
    /// # Errors
    /// When a string or list is longer than its type allows.
    pub fn cdr(&self) -> Result<&[u8], EncodeError> {
        self.payload.cdr()
    }
}

impl fmt::Debug for Sample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sample")
            .field("time_ns", &self.time_ns)
            .field("sequence", &self.sequence)
            .field("publisher", &self.publisher)
            .finish_non_exhaustive()
    }
}
