//! Work on whole recordings that this crate leaves to others: estimators, reports, differences.

use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use serde_json::{Map, Value};

/// A job: an estimator with changed parameters over a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct JobRequest {
    /// Kind: `slam`, `amcl` or `costmap`.
    pub kind: String,
    /// Path of the recording that the job reads.
    pub path: PathBuf,
    /// Changed parameters by name.
    pub parameters: Map<String, Value>,
    /// Folder for the result. It is removed when the result is closed, and at the end of the program.
    pub out_folder: PathBuf,
}

/// Error of a job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum JobError {
    /// The client cancelled it.
    Cancelled,
    /// A failure, or an unknown kind; a sentence for the user.
    Failed(String),
}

impl fmt::Display for JobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cancelled => f.write_str("the job was cancelled"),
            Self::Failed(why) => f.write_str(why),
        }
    }
}

impl Error for JobError {}

/// Runs jobs.
pub trait Jobs: Send + Sync {
    /// Returns the parameters of a kind of job: a list of objects with `name`, `type`, `default`,
    /// `min`, `max`, `unit` and `doc`.
    ///
    /// # Errors
    /// When there is no such kind.
    fn parameters(&self, kind: &str) -> Result<Value, JobError>;

    /// Runs a job on the calling thread and returns the path of the recording that it wrote to
    /// `out_folder`. `progress` gets values from 0 to 1.
    ///
    /// # Errors
    /// When it fails, and when `is_cancelled` became true.
    fn run(
        &self,
        job: &JobRequest,
        progress: &dyn Fn(f32),
        is_cancelled: &AtomicBool,
    ) -> Result<PathBuf, JobError>;

    /// Returns the report of one recording, or of two and their difference, as an HTML document
    /// that needs no other file.
    ///
    /// # Errors
    /// When a recording cannot be read, or this program writes no reports.
    fn report(&self, paths: &[&Path]) -> Result<String, JobError>;

    /// Compares two recordings; see `docs/live.md` for the answer.
    ///
    /// # Errors
    /// When a recording cannot be read, and when `is_cancelled` became true.
    fn difference(
        &self,
        first: &Path,
        second: &Path,
        is_cancelled: &AtomicBool,
    ) -> Result<Value, JobError>;
}
