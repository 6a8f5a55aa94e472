//! `periplus slam`.

mod live;
mod options;

use std::process::ExitCode;

use indicatif::ProgressBar;
use periplus_session::log_mapping::{LogMapping, MappingStep};

use crate::error::CliError;
use crate::terminal;

pub(crate) use options::SlamOptions;

/// Number of log errors that are printed.
const MAX_PRINTED: usize = 20;

pub(crate) fn run(options: &SlamOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    if options.live.live {
        return live::run(options, ros);
    }
    if !ros.is_empty() {
        return Err(CliError::usage("`--ros-args` require `periplus slam --live`"));
    }
    from_log(options)
}

fn from_log(options: &SlamOptions) -> Result<ExitCode, CliError> {
    let mut mapping = LogMapping::open(options.request())?;
    let bar = |mapping: &LogMapping| -> ProgressBar {
        terminal::bar(mapping.progress().scans.1 as u64, "scans", options.quiet)
    };
    let mut shown = bar(&mapping);
    loop {
        match mapping.step()? {
            MappingStep::Scan => shown.set_position(mapping.position().0 as u64),
            MappingStep::Restarted(_) => {
                shown.finish_and_clear();
                shown = bar(&mapping);
            }
            MappingStep::Complete => break,
        }
    }
    shown.finish_and_clear();
    let report = mapping.report();
    let written = mapping.write(&report);
    if !options.quiet {
        report.write_text(&mut anstream::stdout().lock(), written.is_ok())?;
    }
    written?;
    for fault in mapping.faults().iter().take(MAX_PRINTED) {
        terminal::complain(fault);
    }
    if let Some(why) = report.failure() {
        return Err(CliError::failed(why));
    }
    Ok(if mapping.faults().is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
