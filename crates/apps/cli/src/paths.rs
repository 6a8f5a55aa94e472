//! Files of the command line.

use std::path::Path;

use periplus_bags::files::{Bag, BagError};

pub(crate) use periplus_session::files::{advice, make_folder, text, write};

use crate::error::CliError;

/// Opens a recording. The message names the path and the reason, and the nearest name if the file
/// is missing.
pub(crate) fn bag(path: &Path) -> Result<Bag, CliError> {
    Bag::open(path).map_err(|error| CliError::Failed(bag_error(path, &error)))
}

/// Opens a recording, or a CARMEN log as one.
pub(crate) fn log(path: &Path) -> Result<Bag, CliError> {
    Bag::open_log(path).map_err(|error| CliError::Failed(bag_error(path, &error)))
}

/// Message for an error of a recording, with the nearest name if the file is missing.
pub(crate) fn bag_error(path: &Path, error: &BagError) -> String {
    format!("{error}{}", advice(path))
}
