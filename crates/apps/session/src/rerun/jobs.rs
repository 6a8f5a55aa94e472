//! Reruns as jobs of the page.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use periplus_web::foxglove::{JobError, JobRequest, Jobs};
use serde_json::Value;

use super::{RerunError, RerunKind, RerunRequest, job_parameters, rerun};

/// Runs the jobs of the page, and writes their results to a folder.
#[derive(Debug)]
pub struct RerunJobs {
    folder: PathBuf,
    /// Number of jobs that were started.
    count: AtomicU64,
}

impl RerunJobs {
    /// Writes results to a folder that exists.
    #[must_use]
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into(), count: AtomicU64::new(0) }
    }
}

impl Jobs for RerunJobs {
    fn parameters(&self, kind: &str) -> Result<Value, JobError> {
        let kind: RerunKind = kind.parse().map_err(failed)?;
        job_parameters(kind).map_err(failed)
    }

    fn run(
        &self,
        job: &JobRequest,
        progress: &dyn Fn(f32),
        is_cancelled: &AtomicBool,
    ) -> Result<PathBuf, JobError> {
        let kind: RerunKind = job.kind.parse().map_err(failed)?;
        let number = self.count.fetch_add(1, Ordering::Relaxed);
        let name = format!("periplus-{}-{}-{number}.mcap", kind.name(), periplus_os::process_id());
        let request = RerunRequest {
            kind,
            recording: job.path.clone(),
            parameters: job.parameters.clone().into_iter().collect(),
            out: self.folder.join(name),
        };
        let summary = rerun(&request, progress, is_cancelled).map_err(|error| match error {
            RerunError::Cancelled => JobError::Cancelled,
            error => failed(error),
        })?;
        if summary.recorded == 0 {
            return Err(JobError::Failed(summary.faults.join("; ")));
        }
        Ok(request.out)
    }
}

#[expect(clippy::needless_pass_by_value, reason = "the error of a result")]
fn failed(error: impl ToString) -> JobError {
    JobError::Failed(error.to_string())
}
