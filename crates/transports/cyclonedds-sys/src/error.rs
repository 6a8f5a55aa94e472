//! Errors of DDS.

use std::ffi::CStr;
use std::fmt;

use crate::{ffi, log};

/// Error of a DDS operation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The operation that failed.
    pub what: String,
    /// Cause.
    pub why: String,
    code: i32,
}

/// Return code of Cyclone, `dds/ddsrt/retcode.h`.
const TIMEOUT: i32 = -10;

impl Error {
    pub(crate) fn new(what: impl Into<String>, why: impl Into<String>) -> Self {
        Self { what: what.into(), why: why.into(), code: -1 }
    }

    /// True for a timeout: a receiver is slow and the history is full.
    #[must_use]
    pub fn is_timeout(&self) -> bool {
        self.code == TIMEOUT
    }
}

/// Checks a return value of C: a number, or an error below zero.
pub(crate) fn check(code: i32, what: impl FnOnce() -> String) -> Result<i32, Error> {
    if code >= 0 {
        return Ok(code);
    }
    // SAFETY: the function returns a constant string for any number.
    let why = unsafe { CStr::from_ptr(ffi::pp_error(code)) };
    let mut why = why.to_string_lossy().into_owned();
    if let Some(line) = log::last_of_this_thread() {
        why = format!("{why} ({line})");
    }
    Err(Error { what: what(), why, code })
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "DDS cannot {}: {}", self.what, self.why)
    }
}

impl std::error::Error for Error {}
