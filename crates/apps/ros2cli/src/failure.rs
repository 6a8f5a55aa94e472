//! How a verb can end.

use std::io;

/// Why a verb did not do what it was asked to.
#[derive(Debug)]
pub enum Failure {
    /// It could not: what is wrong, and what to do about it.
    Failed(String),
    /// What was typed has no meaning.
    Usage(String),
    /// A node answered that it does not do it. `ros2` exits with 0 there.
    Refused(Refusal),
    /// It was told to stop.
    Interrupted,
    /// Its output cannot be written.
    Output(io::Error),
}

/// A refusal, in words of Periplus and in those of `ros2`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// What was refused and why.
    pub message: String,
    /// What `ros2` prints at this place.
    pub ros2: Ros2Line,
}

/// A line that `ros2` prints about a refusal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ros2Line {
    /// It has said all already.
    Nothing,
    /// On standard output.
    Stdout(String),
    /// On standard error.
    Stderr(String),
}

/// How a verb ends.
pub type Outcome<T = ()> = Result<T, Failure>;

impl Failure {
    /// The exit code of a program that ends so: 2 where what was typed has no meaning, 130 where it was
    /// interrupted, else 1.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_) => 2,
            Self::Interrupted => 130,
            Self::Failed(_) | Self::Refused(_) | Self::Output(_) => 1,
        }
    }

    /// What went wrong, said.
    pub fn failed(what: impl Into<String>) -> Self {
        Self::Failed(what.into())
    }
}

/// What has no end of its own ends well when it is told to stop.
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
