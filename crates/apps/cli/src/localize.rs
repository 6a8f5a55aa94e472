//! `periplus localize`, and localization beside a simulated robot.

mod beside;
mod live;
mod offline;
mod options;
mod report;

use std::io;
use std::process::ExitCode;

use crate::terminal;

pub(crate) use beside::{BesideOptions, Localization};
pub(crate) use options::LocalizeOptions;

pub(crate) fn run(options: &LocalizeOptions, ros: Vec<String>) -> io::Result<ExitCode> {
    match (&options.log, &options.map, &options.out) {
        _ if options.live => live::run(options, ros),
        _ if !ros.is_empty() => {
            terminal::complain("`--ros-args` require `periplus localize --live`; a log takes `-p`");
            Ok(ExitCode::from(2))
        }
        (Some(log), Some(map), Some(out)) => offline::run(options, log, map, out),
        _ => Ok(ExitCode::from(2)),
    }
}
