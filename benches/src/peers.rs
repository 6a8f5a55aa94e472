//! Peer programs that report their run time.

use std::io::Write as _;
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::files::Job;

/// Runs an oracle over files and gives the seconds it spent on them, its start not counted.
pub(crate) fn seconds(program: &mut Command, jobs: &[Job]) -> Result<f64, String> {
    let name = program.get_program().to_string_lossy().into_owned();
    let mut child = program
        .arg("--bench")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(|error| format!("{name}: {error}"))?;
    let input: String = jobs.iter().map(|job| format!("{}\n", job.line)).collect();
    if let Some(mut stdin) = child.stdin.take() {
        stdin.write_all(input.as_bytes()).map_err(|error| format!("{name}: {error}"))?;
    }
    let output = child.wait_with_output().map_err(|error| format!("{name}: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let answer: Value = text
        .lines()
        .last()
        .and_then(|line| serde_json::from_str(line).ok())
        .ok_or_else(|| format!("{name} gave no result: {text}"))?;
    answer["seconds"].as_f64().ok_or_else(|| format!("{name} gave no seconds: {answer}"))
}
