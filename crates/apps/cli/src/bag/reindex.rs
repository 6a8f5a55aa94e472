//! `periplus bag reindex`.

use std::io;
use std::process::ExitCode;

use super::options::ReindexOptions;
use crate::terminal;

pub(super) fn run(options: &ReindexOptions) -> io::Result<ExitCode> {
    let Some(bag) = super::open(&options.bag)? else { return Ok(ExitCode::FAILURE) };
    match bag.reindex(options.style.into()) {
        Ok(()) => Ok(ExitCode::SUCCESS),
        Err(error) => {
            terminal::complain(&error.to_string());
            Ok(ExitCode::FAILURE)
        }
    }
}
