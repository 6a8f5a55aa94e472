//! What a reading needs to know.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Origin, SourceMap};
use periplus_resources::{Host, Resolver};

/// What a reading needs to know.
#[derive(Clone)]
pub struct Setting<'a> {
    /// Files and environment.
    pub host: &'a dyn Host,
    /// Packages, models and paths.
    pub resolver: &'a Resolver<'a>,
    /// Where the user stands: paths below it are shown without it.
    pub working_folder: PathBuf,
    /// `name:=value` for xacro.
    pub arguments: Vec<(String, String)>,
    /// Whether mesh files are opened to see if they can be used.
    pub open_meshes: bool,
}

/// A path as messages show it.
pub(crate) fn shown(path: &Path, working_folder: &Path) -> String {
    path.strip_prefix(working_folder).unwrap_or(path).display().to_string()
}

/// The file in which a place stands; the working folder for a place that no file holds.
pub(crate) fn mentioned_in(origin: Origin, sources: &SourceMap, working_folder: &Path) -> PathBuf {
    match origin.0 {
        Some(span) => working_folder.join(&sources.file(span.file).name),
        None => working_folder.to_owned(),
    }
}
