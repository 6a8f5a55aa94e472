//! `periplus score`.

mod options;
mod picture;
mod recording;
mod run;
mod scores;
mod table;

use std::process::ExitCode;

use crate::error::CliError;
use crate::terminal::say;

pub(crate) use options::{Align, ScoreOptions, ScoreOutputs, ScoreSettings};
pub(crate) use picture::write_picture;
pub(crate) use run::Run;
pub(crate) use scores::RunScores;
pub(crate) use table::{difference_table, names, number, put_json, table, value};

pub(crate) fn run(options: &ScoreOptions) -> Result<ExitCode, CliError> {
    let settings = &options.settings;
    let run = Run::read(&options.run, settings)?;
    let scores = RunScores::of(&run, settings)?;
    if let Some(path) = &options.outputs.picture {
        write_picture(path, &[&scores])?;
    }
    if options.outputs.json {
        put_json(&scores.to_json())?;
        return Ok(ExitCode::SUCCESS);
    }
    table(&mut anstream::stdout().lock(), &scores)?;
    if let Some(path) = &options.outputs.picture {
        say(&format!(
            "{} shows the true path in green, the estimated path in blue",
            path.display()
        ));
    }
    Ok(ExitCode::SUCCESS)
}
