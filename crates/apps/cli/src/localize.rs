//! `periplus localize`, and localization beside a simulated robot.

mod beside;
mod live;
mod offline;
mod options;
mod report;

use std::process::ExitCode;

use crate::error::CliError;

pub(crate) use beside::BesideOptions;
pub(crate) use options::{LocalizeOptions, map_grid};

pub(crate) fn run(options: &LocalizeOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    match (&options.log, &options.map, &options.out) {
        _ if options.live => live::run(options, ros),
        _ if !ros.is_empty() => Err(CliError::usage(
            "`--ros-args` require `periplus localize --live`; a log takes `-p`",
        )),
        (Some(log), Some(map), Some(out)) => offline::run(options, log, map, out),
        _ => Ok(ExitCode::from(2)),
    }
}
