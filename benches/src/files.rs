//! The files that a peer accepts.

use std::path::{Path, PathBuf};

use serde_json::Value;

/// A file, and the one whose surroundings it is looked at from.
#[derive(Clone)]
pub(crate) struct Job {
    pub(crate) file: PathBuf,
    /// As the peer's standard input wants it.
    pub(crate) line: String,
}

/// The files of an oracle's answers that it accepted and that `wanted` takes.
pub(crate) fn accepted(
    answers: &Path,
    line: impl Fn(&str) -> String,
    wanted: impl Fn(&Value) -> bool,
) -> Result<Vec<Job>, String> {
    let text = std::fs::read_to_string(answers).map_err(|error| {
        format!("cannot read {}: {error}; run `cargo xtask corpus` first", answers.display())
    })?;
    let mut jobs = Vec::new();
    for row in text.lines() {
        let answer: Value = serde_json::from_str(row).map_err(|error| error.to_string())?;
        let Some(file) = answer["file"].as_str() else { continue };
        if answer["ok"] == true && wanted(&answer) {
            jobs.push(Job { file: PathBuf::from(file), line: line(file) });
        }
    }
    Ok(jobs)
}

/// Total size of the files in megabytes.
pub(crate) fn megabytes(jobs: &[Job]) -> f64 {
    let bytes = jobs.iter().filter_map(|job| std::fs::metadata(&job.file).ok()).map(|m| m.len());
    bytes.sum::<u64>() as f64 / 1e6
}
