//! `periplus bag reindex`.

use std::process::ExitCode;

use super::options::ReindexOptions;
use crate::error::CliError;

pub(super) fn run(options: &ReindexOptions) -> Result<ExitCode, CliError> {
    let bag = super::open(&options.bag)?;
    match bag.reindex(options.style.into()) {
        Ok(()) => Ok(ExitCode::SUCCESS),
        Err(error) => Err(CliError::failed(error)),
    }
}
