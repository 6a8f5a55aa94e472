//! Errors of mapping a log.

use std::fmt;
use std::io;
use std::path::PathBuf;

use periplus_diagnostics::plain_words;

use crate::files::FileError;
use crate::scan_log::ScanLogError;

/// Reason for which a log is not mapped, or its results are not written.
#[derive(Debug)]
#[non_exhaustive]
pub enum LogMappingError {
    /// The parameters have errors, which have been printed.
    Reported,
    /// A parameter is not written as `name:=value`.
    Parameter(String),
    /// The log cannot be read.
    Log(ScanLogError),
    /// The log has no scans.
    NoScans(PathBuf),
    /// The session cannot be continued.
    Session(String),
    /// The method has no graph, which a requested file needs.
    NoGraph,
    /// A file cannot be read or written.
    File(FileError),
    /// The map is too large to draw.
    TooLarge,
    /// Findings cannot be printed.
    Output(io::Error),
}

impl fmt::Display for LogMappingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reported => f.write_str("the parameters have errors"),
            Self::Parameter(why) | Self::Session(why) => f.write_str(why),
            Self::Log(error) => error.fmt(f),
            Self::NoScans(path) => write!(f, "{} has no scans", path.display()),
            Self::NoGraph => f.write_str(
                "gmapping has no graph: sessions and g2o (`--session`, `--save-session`, `--g2o`) need \
                 `--method graph`",
            ),
            Self::File(error) => error.fmt(f),
            Self::TooLarge => f.write_str(
                "the map is too large to draw; try `--max-range 30` or a coarser `--resolution`. The \
                 trajectory is written",
            ),
            Self::Output(error) => write!(f, "cannot write the output: {}", plain_words(error)),
        }
    }
}

impl std::error::Error for LogMappingError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Log(error) => Some(error),
            Self::File(error) => Some(error),
            Self::Output(error) => Some(error),
            Self::Reported
            | Self::Parameter(_)
            | Self::NoScans(_)
            | Self::Session(_)
            | Self::NoGraph
            | Self::TooLarge => None,
        }
    }
}

impl From<FileError> for LogMappingError {
    fn from(error: FileError) -> Self {
        Self::File(error)
    }
}

impl From<ScanLogError> for LogMappingError {
    fn from(error: ScanLogError) -> Self {
        Self::Log(error)
    }
}
