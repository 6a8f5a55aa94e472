//! Strict validation of a file against the format: every checksum, offset and index.
//!
//! Readers are lenient; this is not. Tests use it to verify what we write, and users to diagnose
//! files of other writers.

mod data;
mod summary;

use std::fmt;

use crate::record::{FOOTER, Footer, MAGIC, op};
use data::Data;

/// A violation of the format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Offset from the start of the file \[bytes\].
    pub offset: u64,
    /// Description, in one sentence without a full stop.
    pub message: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} (byte {})", self.message, self.offset)
    }
}

/// Maximum number of violations reported.
const MOST_FAULTS: usize = 100;

/// Violations in the order of detection.
#[derive(Default)]
struct Faults(Vec<Fault>);

impl Faults {
    fn add(&mut self, offset: usize, message: impl Into<String>) {
        if !self.are_full() {
            self.0.push(Fault { offset: offset as u64, message: message.into() });
        }
    }

    /// True if no further violations are reported.
    fn are_full(&self) -> bool {
        self.0.len() >= MOST_FAULTS
    }

    fn unless(&mut self, is_right: bool, offset: usize, message: &str) {
        if !is_right {
            self.add(offset, message);
        }
    }
}

/// Validates a whole file. Returns nothing if it is valid.
#[must_use]
pub fn check(bytes: &[u8]) -> Vec<Fault> {
    let mut faults = Faults::default();
    faults.unless(bytes.starts_with(&MAGIC), 0, "the file does not begin with the MCAP magic");
    let tail = bytes.len().saturating_sub(MAGIC.len());
    faults.unless(bytes.ends_with(&MAGIC), tail, "the file does not end with the MCAP magic");
    if !faults.0.is_empty() {
        return faults.0;
    }
    let data = Data::walk(bytes, &mut faults);
    let footer_at = tail.saturating_sub(FOOTER);
    let footer = record_at(bytes, footer_at)
        .filter(|(opcode, content)| *opcode == op::FOOTER && content.len() == 20)
        .and_then(|(_, content)| Footer::parse(content));
    match (data, footer) {
        (Some(data), Some(footer)) => summary::check(bytes, &data, footer, footer_at, &mut faults),
        (_, None) => faults.add(footer_at, "there is no footer before the last magic"),
        (None, _) => {}
    }
    faults.0
}

/// Opcode and content of the record at an offset.
fn record_at(bytes: &[u8], at: usize) -> Option<(u8, &[u8])> {
    crate::record::Cursor::new(bytes.get(at..)?).record()
}
