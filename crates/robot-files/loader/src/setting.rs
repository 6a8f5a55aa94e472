//! Inputs of the loader.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Origin, SourceMap};
use periplus_resources::{Host, Resolver};

/// Inputs of the loader.
#[derive(Clone)]
pub struct LoadContext<'a> {
    /// Access to files and environment.
    pub host: &'a dyn Host,
    /// Search paths of packages and models.
    pub resolver: &'a Resolver<'a>,
    /// Working folder of the user; paths below it are shown relative to it.
    pub working_folder: PathBuf,
    /// `name:=value` arguments of xacro.
    pub arguments: Vec<(String, String)>,
    /// True if mesh files are opened and checked.
    pub open_meshes: bool,
}

/// Path as shown in messages.
pub(crate) fn shown(path: &Path, working_folder: &Path) -> String {
    path.strip_prefix(working_folder).unwrap_or(path).display().to_string()
}

/// File that contains an origin; the working folder if there is none.
pub(crate) fn mentioned_in(origin: Origin, sources: &SourceMap, working_folder: &Path) -> PathBuf {
    match origin.0 {
        Some(span) => working_folder.join(&sources.file(span.file).name),
        None => working_folder.to_owned(),
    }
}
