//! The map to build, and session files.

use std::path::Path;

use periplus_slam::{AnyMapper, Gmapping, GmappingSettings, Method, Settings, Slam};

use super::error::LogMappingError;
use super::parameters::SlamParameters;
use super::request::LogMappingRequest;
use crate::files;

/// Initial map: an empty one, or that of the given session.
pub(super) fn initial(
    request: &LogMappingRequest,
    parameters: &SlamParameters,
) -> Result<AnyMapper, LogMappingError> {
    let values = &parameters.values;
    match (parameters.method, &request.session) {
        (Method::Graph, None) => Ok(AnyMapper::Graph(Box::new(Slam::new(Settings::of(values))))),
        (Method::Graph, Some(path)) => {
            Ok(AnyMapper::Graph(Box::new(read(path, Settings::of(values))?)))
        }
        (Method::Gmapping, None) if request.session_out.is_none() && request.g2o_out.is_none() => {
            Ok(AnyMapper::Gmapping(Box::new(Gmapping::new(GmappingSettings::of(values)))))
        }
        (Method::Gmapping, _) => Err(LogMappingError::NoGraph),
    }
}

fn read(path: &Path, settings: Settings) -> Result<Slam, LogMappingError> {
    let bytes = files::read(path)?;
    Slam::resume(&bytes, settings).map_err(|why| {
        LogMappingError::Session(format!("cannot continue the session {}: {why}", path.display()))
    })
}
