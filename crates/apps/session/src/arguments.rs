//! Names, remaps and parameters of nodes, as `--ros-args` has them.

use std::path::Path;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{Arguments, ParameterFileError};
use periplus_os::Machine;
use periplus_resources::{FileReadError, Host as _};

use crate::error::RunError;
use crate::terminal;

/// Reads the words of `--ros-args` and prints the findings.
///
/// # Errors
/// When a word or a parameter file has errors, which are printed.
pub fn read_arguments(words: &[String]) -> Result<Arguments, RunError> {
    let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
    let arguments = Arguments::read(words, &mut sources, &mut diagnostics, &mut text);
    terminal::diagnostics(&mut terminal::messages(), &diagnostics, &sources)?;
    if diagnostics.has_errors() { Err(RunError::Reported) } else { Ok(arguments) }
}

fn text(path: &Path) -> Result<String, ParameterFileError> {
    let bytes = Machine.read(path).map_err(|error| match error {
        FileReadError::Missing => ParameterFileError::Missing,
        error => ParameterFileError::Unreadable(error.to_string()),
    })?;
    String::from_utf8(bytes).map_err(|_| ParameterFileError::NotText)
}
