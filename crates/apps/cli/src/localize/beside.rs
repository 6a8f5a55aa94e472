//! Localization options of `periplus sim`.

use std::path::PathBuf;

use clap::Args;

/// Localization options of `periplus sim`.
#[derive(Debug, Args)]
pub(crate) struct BesideOptions {
    /// Run `map_server` and `amcl` of Nav2 beside the robot: the YAML of a map, a file with their
    /// parameters, or both, separated by a space
    #[arg(long, value_name = "MAP.yaml|FILE")]
    localize: Vec<PathBuf>,
}

impl BesideOptions {
    /// Files of the map and of the parameters.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        self.localize.clone()
    }
}
