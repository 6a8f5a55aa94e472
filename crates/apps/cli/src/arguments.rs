//! `--ros-args` of a command line.

use periplus_graph::Arguments;
use periplus_session::{RunError, read_arguments};

use crate::error::CliError;

/// Reads the words of `--ros-args` and prints the findings; an error is wrong usage.
pub(crate) fn read(words: Vec<String>) -> Result<Arguments, CliError> {
    read_arguments(&words).map_err(|error| match error {
        RunError::Reported => CliError::Reported(2),
        error => error.into(),
    })
}
