//! `--ros-args` of a command line.

use std::path::Path;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{Arguments, ParameterFileError};
use periplus_os::Machine;
use periplus_resources::{FileReadError, Host as _};

use crate::error::CliError;
use crate::terminal;

/// Reads the words of `--ros-args` and prints the findings; an error is wrong usage.
pub(crate) fn read(words: Vec<String>) -> Result<Arguments, CliError> {
    let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
    let arguments = Arguments::read(&words, &mut sources, &mut diagnostics, &mut text);
    terminal::diagnostics(&mut anstream::stderr().lock(), &diagnostics, &sources)?;
    if diagnostics.has_errors() { Err(CliError::Reported(2)) } else { Ok(arguments) }
}

fn text(path: &Path) -> Result<String, ParameterFileError> {
    let bytes = Machine.read(path).map_err(|error| match error {
        FileReadError::Missing => ParameterFileError::Missing,
        error => ParameterFileError::Unreadable(error.to_string()),
    })?;
    String::from_utf8(bytes).map_err(|_| ParameterFileError::NotText)
}
