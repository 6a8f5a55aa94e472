//! Sessions as files.

use std::path::Path;

use periplus_host::Machine;
use periplus_resources::Host as _;
use periplus_slam::{Settings, Slam};

use super::options::SlamOptions;

/// The map to go on with: an empty one, or that of the session that is named.
pub(super) fn begin(options: &SlamOptions, settings: Settings) -> Result<Slam, String> {
    match &options.session {
        None => Ok(Slam::new(settings)),
        Some(path) => read(path, settings),
    }
}

fn read(path: &Path, settings: Settings) -> Result<Slam, String> {
    let bytes = Machine
        .read(path)
        .map_err(|why| format!("cannot read the session {}: {why}", path.display()))?;
    Slam::resume(&bytes, settings)
        .map_err(|why| format!("{} is no session to go on with: {why}", path.display()))
}
