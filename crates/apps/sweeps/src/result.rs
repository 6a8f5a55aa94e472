//! Result of a job, as a small JSON file.

use periplus_scenarios::ScenarioReport;
use serde::{Deserialize, Serialize};

use crate::error::SweepError;
use crate::plan::{FORMAT, SweepJob};

/// Result of an assertion in a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JobAssertion {
    /// Word, such as `min_clearance`.
    pub word: String,
    /// True if it holds.
    pub passed: bool,
    /// Measured value; `None` if there is none.
    pub measured: Option<f64>,
    /// Unit of the measured value; may be empty.
    pub unit: String,
}

/// Result of a job. It depends on the key only: times, paths and machines are not in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JobResult {
    /// Version of the format.
    pub format: u32,
    /// Key of the job.
    pub key: String,
    /// Seed.
    pub seed: u64,
    /// True if all assertions hold, and no event or fault failed.
    pub passed: bool,
    /// End of the run, such as `complete`.
    pub outcome: String,
    /// Simulated time \[s\].
    pub duration_s: f64,
    /// Scores by name, in the order of the report.
    pub scores: Vec<(String, f64)>,
    /// Assertions, in the order of the file.
    pub assertions: Vec<JobAssertion>,
    /// Sentences about all that failed.
    pub failures: Vec<String>,
    /// Digest of all messages of the run.
    pub digest: String,
}

impl JobResult {
    /// Result of a report; `plain` removes the folder of the copy from texts.
    pub(crate) fn of_report(
        job: &SweepJob,
        report: &ScenarioReport,
        plain: impl Fn(&str) -> String,
    ) -> Self {
        let assertion = |it: &periplus_scenarios::AssertionReport| JobAssertion {
            word: it.text.split('(').next().unwrap_or_default().to_owned(),
            passed: it.has_passed,
            measured: it.measured.filter(|value| value.is_finite()),
            unit: it.unit.to_owned(),
        };
        let scores = report.scores.iter().filter(|(_, value)| value.is_finite());
        let failed = report.assertions.iter().filter(|it| !it.has_passed);
        let failures = report.problems.iter().map(|it| plain(it));
        Self {
            format: FORMAT,
            key: job.key.clone(),
            seed: report.seed,
            passed: report.has_passed(),
            outcome: plain(&report.outcome.to_string()),
            duration_s: report.duration_s,
            scores: scores.map(|(name, value)| ((*name).to_owned(), *value)).collect(),
            assertions: report.assertions.iter().map(assertion).collect(),
            failures: failures
                .chain(failed.map(|it| plain(&format!("{}: {}", it.text, it.message))))
                .collect(),
            digest: report.digest.clone().unwrap_or_default(),
        }
    }

    /// Reads a result from JSON.
    ///
    /// # Errors
    /// A text that is no result, or one of another job.
    pub fn from_json(text: &str, key: &str) -> Result<Self, SweepError> {
        let result: Self = serde_json::from_str(text).map_err(|error| {
            SweepError::Failed(format!("this is not the result of a run: {error}"))
        })?;
        if result.key != key || result.format != FORMAT {
            return Err(SweepError::Failed(format!(
                "this is the result of another run: {}",
                result.key
            )));
        }
        Ok(result)
    }

    /// JSON of the result.
    #[must_use]
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string_pretty(self);
        debug_assert!(text.is_ok(), "a result is plain data");
        text.unwrap_or_default() + "\n"
    }
}
