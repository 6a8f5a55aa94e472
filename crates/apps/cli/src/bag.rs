//! `periplus bag`.

mod check;
mod convert;
mod info;
mod options;
mod outputs;
mod play;
mod progress;
mod record;
mod reindex;
mod select;

use std::io;
use std::path::Path;
use std::process::ExitCode;

use periplus_bags::files::Bag;
use periplus_diagnostics::{Diagnostics, SourceMap};

use crate::error::CliError;
use crate::{paths, terminal};

pub(crate) use options::BagCommand;

pub(crate) fn run(command: &BagCommand) -> Result<ExitCode, CliError> {
    match command {
        BagCommand::Info(options) => info::run(options),
        BagCommand::Convert(options) => convert::run(options),
        BagCommand::Cut(options) => convert::cut(options),
        BagCommand::Check(options) => check::run(options),
        BagCommand::Play(options) => play::run(options),
        BagCommand::Record(options) => record::run(options),
        BagCommand::Reindex(options) => reindex::run(options),
    }
}

/// Opens a recording and prints its findings.
fn open(path: &Path) -> Result<Bag, CliError> {
    let bag = paths::bag(path)?;
    tell(bag.findings())?;
    Ok(bag)
}

/// Opens one of several recordings; prints the error and returns `None` if it cannot be opened.
fn try_open(path: &Path) -> Result<Option<Bag>, CliError> {
    match open(path) {
        Ok(bag) => Ok(Some(bag)),
        Err(CliError::Failed(message)) => {
            terminal::complain(&message);
            Ok(None)
        }
        Err(error) => Err(error),
    }
}

/// Writes findings to stderr.
fn tell(findings: &Diagnostics) -> io::Result<()> {
    terminal::diagnostics(&mut anstream::stderr().lock(), findings, &SourceMap::new())
}
