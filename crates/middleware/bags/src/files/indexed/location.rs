//! Location of a message in a recording.

/// Location of a message in a recording, without its bytes. The order is that of a linear read:
/// time, then file, then position in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MessageLocation {
    /// Time of recording \[ns\].
    pub time_ns: i64,
    /// Number of the file.
    pub(crate) file: u32,
    /// Offset of the chunk in the file; 0 in a database \[bytes\].
    pub(crate) chunk: u64,
    /// Offset in the decompressed chunk \[bytes\], or the row id of a database.
    pub(crate) at: i64,
    /// Index into [`IndexedBag::topics`](super::IndexedBag::topics).
    pub topic: usize,
}

/// Messages of a span.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LocationSpan {
    /// Messages in the order of time.
    pub locations: Vec<MessageLocation>,
    /// Time from which more messages follow; none if these are all \[ns\].
    pub next_ns: Option<i64>,
}
