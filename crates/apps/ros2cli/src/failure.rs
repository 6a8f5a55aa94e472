//! Errors of verbs.

use std::io;

/// Reason why a verb failed.
#[derive(Debug)]
pub enum Failure {
    /// Failure: the problem, and what to do about it.
    Failed(String),
    /// Usage error.
    Usage(String),
    /// Refusal by a node. `ros2` exits with 0 in this case.
    Refused(NodeRefusal),
    /// Interrupted.
    Interrupted,
    /// The output cannot be written.
    Output(io::Error),
}

/// Refusal by a node, in words of Periplus and in those of `ros2`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeRefusal {
    /// Refused request and reason.
    pub message: String,
    /// Line that `ros2` prints in this case.
    pub ros2: Ros2Line,
}

/// Line that `ros2` prints about a refusal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ros2Line {
    /// Nothing, because it is printed already.
    Nothing,
    /// On standard output.
    Stdout(String),
    /// On standard error.
    Stderr(String),
}

/// Result of a verb.
pub type Outcome<T = ()> = Result<T, Failure>;

impl Failure {
    /// Exit code: 2 for usage errors, 130 for interrupts, otherwise 1.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_) => 2,
            Self::Interrupted => 130,
            Self::Failed(_) | Self::Refused(_) | Self::Output(_) => 1,
        }
    }

    /// Failure with a message.
    pub fn failed(what: impl Into<String>) -> Self {
        Self::Failed(what.into())
    }
}

/// Treats an interrupt as success, for verbs that run until interrupted.
pub(crate) fn endless(outcome: Outcome) -> Outcome {
    match outcome {
        Err(Failure::Interrupted) => Ok(()),
        outcome => outcome,
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}

impl From<periplus_graph::GraphError> for Failure {
    fn from(error: periplus_graph::GraphError) -> Self {
        Self::Failed(error.to_string())
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Failed(what) | Self::Usage(what) => f.write_str(what),
            Self::Refused(refusal) => f.write_str(&refusal.message),
            Self::Interrupted => f.write_str("interrupted"),
            Self::Output(error) => write!(f, "cannot write the output: {error}"),
        }
    }
}
