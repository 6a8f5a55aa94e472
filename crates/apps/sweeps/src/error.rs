//! Errors of sweeps.

use std::fmt;

use periplus_scenarios::{ScenarioError, ScenarioFileError};
use periplus_session::files::FileError;

/// Reasons that a sweep cannot start or end.
#[derive(Debug)]
pub enum SweepError {
    /// The scenario file has mistakes.
    Findings(Box<ScenarioFileError>),
    /// The scenario cannot start.
    Scenario(ScenarioError),
    /// A file cannot be read or written.
    File(FileError),
    /// Wrong values or names of parameters.
    Usage(String),
    /// Anything else, in words.
    Failed(String),
}

impl fmt::Display for SweepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Findings(error) => {
                let first = error.diagnostics.iter().next().map(|it| it.message.as_str());
                f.write_str(first.unwrap_or("the scenario cannot be read"))
            }
            Self::Scenario(error) => error.fmt(f),
            Self::File(error) => error.fmt(f),
            Self::Usage(message) | Self::Failed(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for SweepError {}

impl From<ScenarioFileError> for SweepError {
    fn from(error: ScenarioFileError) -> Self {
        Self::Findings(Box::new(error))
    }
}

impl From<ScenarioError> for SweepError {
    fn from(error: ScenarioError) -> Self {
        Self::Scenario(error)
    }
}

impl From<FileError> for SweepError {
    fn from(error: FileError) -> Self {
        Self::File(error)
    }
}
