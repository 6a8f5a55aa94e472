//! Reruns as jobs of the page.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use periplus_web::foxglove::{JobRequest, Jobs};
use serde_json::Value;

use super::{RerunKind, RerunRequest, job_parameters, rerun};

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
    fn parameters(&self, kind: &str) -> Result<Value, String> {
        let kind: RerunKind = kind.parse().map_err(text)?;
        job_parameters(kind).map_err(text)
    }

    fn run(
        &self,
        job: &JobRequest,
        progress: &dyn Fn(f32),
        is_cancelled: &AtomicBool,
    ) -> Result<PathBuf, String> {
        let kind: RerunKind = job.kind.parse().map_err(text)?;
        let number = self.count.fetch_add(1, Ordering::Relaxed);
        let name = format!("periplus-{}-{}-{number}.mcap", kind.name(), std::process::id());
        let request = RerunRequest {
            kind,
            recording: job.path.clone(),
            parameters: job.parameters.clone().into_iter().collect(),
            out: self.folder.join(name),
        };
        let summary = rerun(&request, progress, is_cancelled).map_err(text)?;
        if summary.recorded == 0 {
            return Err(summary.faults.join("; "));
        }
        Ok(request.out)
    }
}

/// Text for the user.
#[expect(clippy::needless_pass_by_value, reason = "the error of a result")]
fn text(error: impl ToString) -> String {
    error.to_string()
}
