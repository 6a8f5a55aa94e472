//! `periplus compare`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde_json::{Map, Value, json};

use crate::error::CliError;
use crate::paths;
use crate::score::{
    Run, RunScores, ScoreOutputs, ScoreSettings, difference_table, names, put_json, value,
    write_picture,
};
use crate::terminal::say;

/// Compare two runs: the scores of each against its truth, and their differences
///
/// A and B are recordings or trajectories as of `periplus score`, or results of `periplus score --json`. The picture
/// shows both runs over the map. Exit code 1: a run cannot be read.
#[derive(Debug, Args)]
pub(crate) struct RunComparisonOptions {
    /// First run
    #[arg(value_name = "A")]
    first: PathBuf,
    /// Second run
    #[arg(value_name = "B")]
    second: PathBuf,
    #[command(flatten)]
    settings: ScoreSettings,
    #[command(flatten)]
    outputs: ScoreOutputs,
}

pub(crate) fn run(options: &RunComparisonOptions) -> Result<ExitCode, CliError> {
    let settings = &options.settings;
    let first = scores(&options.first, settings)?;
    let second = scores(&options.second, settings)?;
    let outputs = &options.outputs;
    if let Some(path) = &outputs.picture {
        write_picture(path, &[&first, &second])?;
    }
    if outputs.json {
        let difference: Map<String, Value> = names([&first, &second], |_| true)
            .into_iter()
            .map(|name| {
                let difference = value(&second, &name) - value(&first, &name);
                (name, json!(difference))
            })
            .collect();
        put_json(&json!({
            "a": first.to_json(), "b": second.to_json(), "b_minus_a": difference,
        }))?;
        return Ok(ExitCode::SUCCESS);
    }
    difference_table(&mut anstream::stdout().lock(), [&first, &second])?;
    if let Some(path) = &outputs.picture {
        say(&format!(
            "{} shows A in green (truth) and blue (estimate), B in yellow (truth) and red (estimate)",
            path.display()
        ));
    }
    Ok(ExitCode::SUCCESS)
}

/// Scores of a run, or of a file of `periplus score --json`.
fn scores(path: &Path, settings: &ScoreSettings) -> Result<RunScores, CliError> {
    if path.extension().is_some_and(|it| it.eq_ignore_ascii_case("json")) {
        return RunScores::from_json(&path.display().to_string(), &paths::text(path)?);
    }
    RunScores::of(&Run::read(path, settings)?, settings)
}
