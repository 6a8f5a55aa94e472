//! Estimators that are run on a recording.

use std::path::PathBuf;
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
}

/// Runs jobs.
pub trait Jobs: Send + Sync {
    /// Returns the parameters of a kind of job: a list of objects with `name`, `type`, `default`,
    /// `min`, `max`, `unit` and `doc`.
    ///
    /// # Errors
    /// A sentence for the user, when there is no such kind.
    fn parameters(&self, kind: &str) -> Result<Value, String>;

    /// Runs a job on the calling thread and returns the path of the recording that it wrote, which
    /// belongs to the caller. `progress` gets values from 0 to 1.
    ///
    /// # Errors
    /// A sentence for the user, also when `is_cancelled` became true.
    fn run(
        &self,
        job: &JobRequest,
        progress: &dyn Fn(f32),
        is_cancelled: &AtomicBool,
    ) -> Result<PathBuf, String>;
}
