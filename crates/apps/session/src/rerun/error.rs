//! Errors of reruns.

use std::fmt;

use periplus_bags::files::BagError;
use periplus_graph::GraphError;

use crate::error::RunError;
use crate::files::FileError;

/// Reason for which estimators cannot run over a recording.
#[derive(Debug)]
#[non_exhaustive]
pub enum RerunError {
    /// The recording cannot be read.
    Recording(BagError),
    /// The result cannot be written.
    Result(BagError),
    /// No such kind of rerun.
    Kind(String),
    /// A parameter is unknown or has a value that is not valid.
    Parameter(String),
    /// The recording lacks something that the estimators need.
    Missing(String),
    /// A node cannot start.
    Node(RunError),
    /// A file of a parameter cannot be read.
    File(FileError),
    /// The user has cancelled it.
    Cancelled,
}

impl fmt::Display for RerunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Recording(error) => error.fmt(f),
            Self::Result(error) => write!(f, "the result cannot be written: {error}"),
            Self::Kind(kind) => {
                write!(f, "there is no job `{kind}`; use `slam`, `amcl` or `costmap`")
            }
            Self::Parameter(why) | Self::Missing(why) => f.write_str(why),
            Self::Node(error) => error.fmt(f),
            Self::File(error) => error.fmt(f),
            Self::Cancelled => f.write_str("cancelled"),
        }
    }
}

impl std::error::Error for RerunError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Recording(error) | Self::Result(error) => Some(error),
            Self::Node(error) => Some(error),
            Self::File(error) => Some(error),
            Self::Kind(_) | Self::Parameter(_) | Self::Missing(_) | Self::Cancelled => None,
        }
    }
}

impl From<GraphError> for RerunError {
    fn from(error: GraphError) -> Self {
        Self::Node(error.into())
    }
}

impl From<RunError> for RerunError {
    fn from(error: RunError) -> Self {
        Self::Node(error)
    }
}

impl From<FileError> for RerunError {
    fn from(error: FileError) -> Self {
        Self::File(error)
    }
}
