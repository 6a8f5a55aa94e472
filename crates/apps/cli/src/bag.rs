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

use crate::{paths, terminal};

pub(crate) use options::BagCommand;

pub(crate) fn run(command: &BagCommand) -> io::Result<ExitCode> {
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

/// Opens a recording and prints its findings; `None` when it cannot be opened.
fn open(path: &Path) -> io::Result<Option<Bag>> {
    match paths::bag(path) {
        Ok(bag) => {
            tell(bag.findings())?;
            Ok(Some(bag))
        }
        Err(error) => {
            terminal::complain(&error);
            Ok(None)
        }
    }
}

/// Writes findings to stderr.
fn tell(findings: &Diagnostics) -> io::Result<()> {
    terminal::diagnostics(&mut anstream::stderr().lock(), findings, &SourceMap::new())
}
