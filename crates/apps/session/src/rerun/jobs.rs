//! Jobs of the page: reruns, reports, differences.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use periplus_bags::files::Bag;
use periplus_web::foxglove::{JobError, JobRequest, Jobs};
use serde_json::Value;

use crate::difference::{RecordingDifference, TopicDifference, compare_topics};

use super::{RerunError, RerunKind, RerunRequest, job_parameters, rerun};

/// Writes a report of one recording, or of two, as an HTML document. The command line has the
/// reports, which need more than a session does.
pub type ReportWriter = fn(&[&Path]) -> Result<String, JobError>;

/// Runs the jobs of the page.
pub struct RerunJobs {
    report: Option<ReportWriter>,
    /// Number of jobs that were started.
    count: AtomicU64,
}

impl RerunJobs {
    /// Jobs of a page; without a writer it offers no reports.
    #[must_use]
    pub fn new(report: Option<ReportWriter>) -> Self {
        Self { report, count: AtomicU64::new(0) }
    }
}

impl fmt::Debug for RerunJobs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RerunJobs").field("count", &self.count).finish_non_exhaustive()
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
        let name = format!("{}-{number}.mcap", kind.name());
        let request = RerunRequest {
            kind,
            recording: job.path.clone(),
            parameters: job.parameters.clone().into_iter().collect(),
            out: job.out_folder.join(name),
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

    fn report(&self, paths: &[&Path]) -> Result<String, JobError> {
        let writer = self.report.ok_or_else(|| {
            failed("this program writes no reports; use `periplus report` in a terminal")
        })?;
        writer(paths)
    }

    fn difference(
        &self,
        first: &Path,
        second: &Path,
        is_cancelled: &AtomicBool,
    ) -> Result<Value, JobError> {
        let (first, second) =
            (Bag::open_log(first).map_err(failed)?, Bag::open_log(second).map_err(failed)?);
        let difference = RecordingDifference::of(&first, &second).map_err(failed)?;
        let topics = compare_topics(&first, &second, is_cancelled).map_err(failed)?;
        let Some(topics) = topics else { return Err(JobError::Cancelled) };
        let mut json = difference.to_json();
        json["topics"] = topics.iter().map(TopicDifference::to_json).collect();
        Ok(json)
    }
}

#[expect(clippy::needless_pass_by_value, reason = "the error of a result")]
fn failed(error: impl ToString) -> JobError {
    JobError::Failed(error.to_string())
}
