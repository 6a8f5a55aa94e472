//! `periplus conformance`.

use std::io::{self, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use periplus_conformance::run as run_cases;
use periplus_os::Machine;

use crate::error::CliError;

/// Run conformance cases: files that describe the behaviour of ROS programs
///
/// Prints a table of case kinds, and the failures. An unknown kind counts as not passed. Exit code
/// 1 unless every case passes.
#[derive(Debug, Args)]
pub(crate) struct ConformanceOptions {
    /// Folder of case files (JSON), or one file
    #[arg(value_name = "DIR")]
    path: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(options: &ConformanceOptions) -> Result<ExitCode, CliError> {
    let report = run_cases(&options.path, &Machine).map_err(CliError::failed)?;
    let text = if options.json { format!("{:#}\n", report.to_json()) } else { report.to_text() };
    io::stdout().lock().write_all(text.as_bytes())?;
    Ok(if report.is_passed() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
