//! The map to build, and session files.

use std::path::Path;

use periplus_slam::{Gmapping, GmappingSettings, Mapper, Method, Settings, Slam};

use super::error::LogMappingError;
use super::parameters::SlamParameters;
use super::request::LogMappingRequest;
use crate::files;

/// Map, by method.
pub(super) enum SelectedMapper {
    Graph(Box<Slam>),
    Gmapping(Box<Gmapping>),
}

impl SelectedMapper {
    /// Initial map: an empty one, or that of the given session.
    pub(super) fn new(
        request: &LogMappingRequest,
        parameters: &SlamParameters,
    ) -> Result<Self, LogMappingError> {
        let values = &parameters.values;
        match (parameters.method, &request.session) {
            (Method::Graph, None) => Ok(Self::Graph(Box::new(Slam::new(Settings::of(values))))),
            (Method::Graph, Some(path)) => {
                Ok(Self::Graph(Box::new(read(path, Settings::of(values))?)))
            }
            (Method::Gmapping, None)
                if request.session_out.is_none() && request.g2o_out.is_none() =>
            {
                Ok(Self::Gmapping(Box::new(Gmapping::new(GmappingSettings::of(values)))))
            }
            (Method::Gmapping, _) => Err(LogMappingError::NoGraph),
        }
    }

    pub(super) fn mapper(&self) -> &dyn Mapper {
        match self {
            Self::Graph(slam) => &**slam,
            Self::Gmapping(slam) => &**slam,
        }
    }

    pub(super) fn mapper_mut(&mut self) -> &mut dyn Mapper {
        match self {
            Self::Graph(slam) => &mut **slam,
            Self::Gmapping(slam) => &mut **slam,
        }
    }

    /// Pose graph, if the method has one.
    pub(super) fn graph(&self) -> Option<&Slam> {
        match self {
            Self::Graph(slam) => Some(slam),
            Self::Gmapping(_) => None,
        }
    }
}

fn read(path: &Path, settings: Settings) -> Result<Slam, LogMappingError> {
    let bytes = files::read(path)?;
    Slam::resume(&bytes, settings).map_err(|why| {
        LogMappingError::Session(format!("cannot continue the session {}: {why}", path.display()))
    })
}
