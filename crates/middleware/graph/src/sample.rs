//! Published messages.

use std::fmt;
use std::sync::Arc;

use periplus_msgs::{DecodeError, EncodeError, Message};

use crate::payload::Payload;

/// Id of a publisher, subscription, server or client of a graph; never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EndpointId(pub(crate) u64);

/// A published message. Clones share it: neither the value nor its bytes are copied.
#[derive(Clone)]
pub struct Sample {
    /// Time of publication on the clock of the graph \[ns\].
    pub time_ns: i64,
    /// Sequence number on its topic, from 1; messages without subscribers count.
    pub sequence: u64,
    /// The publisher; transports recognize their own messages by it.
    pub publisher: EndpointId,
    /// Time from which the message is no longer delivered \[ns\].
    pub(crate) stale_ns: i64,
    pub(crate) payload: Arc<Payload>,
}

impl Sample {
    pub(crate) fn is_stale(&self, now_ns: i64) -> bool {
        self.stale_ns < now_ns
    }

    /// Returns the message as a value. Bytes from a transport or a bag are decoded once for all
    /// readers.
    ///
    /// # Errors
    /// When the bytes cannot be decoded as this type.
    pub fn message<T: Message>(&self) -> Result<Arc<T>, DecodeError> {
        self.payload.message()
    }

    /// Returns the message as CDR, with the four-byte encapsulation header. It is encoded once for
    /// all readers; keep the sample to keep the bytes.
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
