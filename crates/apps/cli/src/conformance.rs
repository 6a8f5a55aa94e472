//! `periplus conformance`.

use std::io::{self, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use periplus_conformance::run as run_cases;
use periplus_os::Machine;

use crate::terminal::complain;

/// Run case files, each of which says how a program of ROS behaves, against this one
///
/// Prints a table of kinds, and what is wrong. A kind that is not checked yet counts as not passed.
/// Exit code 1 unless every case is passed.
#[derive(Debug, Args)]
pub(crate) struct ConformanceOptions {
    /// A folder of case files (JSON), or one of them
    #[arg(value_name = "DIR")]
    path: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(options: &ConformanceOptions) -> io::Result<ExitCode> {
    let report = match run_cases(&options.path, &Machine) {
        Ok(report) => report,
        Err(error) => {
            complain(&error.to_string());
            return Ok(ExitCode::FAILURE);
        }
    };
    let text = if options.json { format!("{:#}\n", report.to_json()) } else { report.to_text() };
    io::stdout().lock().write_all(text.as_bytes())?;
    Ok(if report.is_passed() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
