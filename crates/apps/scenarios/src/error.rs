//! Errors of scenarios that cannot run.

use std::fmt;

use periplus_graph::GraphError;
use periplus_session::RunError;
use periplus_session::files::FileError;

/// Reasons that a scenario cannot run.
#[derive(Debug)]
pub enum ScenarioError {
    /// The world, the robot or a node cannot start.
    Run(RunError),
    /// A file cannot be read or written.
    File(FileError),
    /// Something is missing, in words.
    Failed(String),
}

impl fmt::Display for ScenarioError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Run(error) => error.fmt(f),
            Self::File(error) => error.fmt(f),
            Self::Failed(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for ScenarioError {}

impl From<RunError> for ScenarioError {
    fn from(error: RunError) -> Self {
        Self::Run(error)
    }
}

impl From<FileError> for ScenarioError {
    fn from(error: FileError) -> Self {
        Self::File(error)
    }
}

impl From<GraphError> for ScenarioError {
    fn from(error: GraphError) -> Self {
        Self::Run(error.into())
    }
}
