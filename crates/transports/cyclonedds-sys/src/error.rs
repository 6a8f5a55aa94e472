//! What DDS refused.

use std::ffi::CStr;
use std::fmt;

use crate::{ffi, log};

/// What DDS refused, and why as far as it says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// What was wanted.
    pub what: String,
    /// Why not.
    pub why: String,
    code: i32,
}

/// Codes of Cyclone, `dds/ddsrt/retcode.h`.
const TIMEOUT: i32 = -10;

impl Error {
    pub(crate) fn new(what: impl Into<String>, why: impl Into<String>) -> Self {
        Self { what: what.into(), why: why.into(), code: -1 }
    }

    /// Whether it only took too long: whoever receives is slow, and its history is full.
    #[must_use]
    pub fn is_timeout(&self) -> bool {
        self.code == TIMEOUT
    }
}

/// What C answered: a number, or an error below zero.
pub(crate) fn check(code: i32, what: impl FnOnce() -> String) -> Result<i32, Error> {
    if code >= 0 {
        return Ok(code);
    }
    // SAFETY: it gives a constant string for any number.
    let why = unsafe { CStr::from_ptr(ffi::pp_error(code)) };
    let mut why = why.to_string_lossy().into_owned();
    if let Some(line) = log::last_of_this_thread() {
        why = format!("{why} ({line})");
    }
    Err(Error { what: what(), why, code })
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "DDS refuses {}: {}", self.what, self.why)
    }
}

impl std::error::Error for Error {}
