//! Errors of calls.

use std::fmt;
use std::io;
use std::path::PathBuf;

use periplus_diagnostics::plain_words;
use periplus_session::RunError;
use periplus_session::log_mapping::LogMappingError;

use crate::unpack::UnpackError;

/// Reason for which a call has no answer.
#[derive(Debug)]
#[non_exhaustive]
pub enum TabCallError {
    /// The call is not valid JSON, or has unknown names.
    Invalid(serde_json::Error),
    /// Another call must precede this one.
    NotReady(&'static str),
    /// An argument has no valid value.
    Argument(String),
    /// A log is too large: its size and the limit \[MB\].
    TooLarge(PathBuf, u64, u64),
    /// A log is not mapped, or its results are not written.
    Mapping(LogMappingError),
    /// The results of a session are not written.
    Results(RunError),
    /// A file cannot be read or written.
    File(PathBuf, io::Error),
    /// An archive is not unpacked.
    Archive(PathBuf, UnpackError),
    /// A text cannot be written.
    Output(io::Error),
}

impl fmt::Display for TabCallError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Invalid(error) => write!(f, "the call is not valid: {error}"),
            Self::NotReady(what) => f.write_str(what),
            Self::Argument(why) => f.write_str(why),
            Self::TooLarge(path, size_mb, max_mb) => write!(
                f,
                "{} has {size_mb} MB; a browser tab maps logs of at most {max_mb} MB. `periplus slam LOG --out DIR` \
                 maps it on your machine",
                path.display()
            ),
            Self::Mapping(error) => error.fmt(f),
            Self::Results(error) => error.fmt(f),
            Self::File(path, error) => write!(f, "`{}`: {}", path.display(), plain_words(error)),
            Self::Archive(path, error) => write!(f, "`{}`: {error}", path.display()),
            Self::Output(error) => write!(f, "cannot write the output: {}", plain_words(error)),
        }
    }
}

impl std::error::Error for TabCallError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Invalid(error) => Some(error),
            Self::Mapping(error) => Some(error),
            Self::Results(error) => Some(error),
            Self::File(_, error) | Self::Output(error) => Some(error),
            Self::Archive(_, error) => Some(error),
            Self::NotReady(_) | Self::Argument(_) | Self::TooLarge(..) => None,
        }
    }
}

impl From<LogMappingError> for TabCallError {
    fn from(error: LogMappingError) -> Self {
        Self::Mapping(error)
    }
}
