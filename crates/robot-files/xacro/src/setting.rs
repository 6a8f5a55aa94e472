//! Inputs of an expansion.

use std::path::{Path, PathBuf};

use periplus_resources::{Host, Resolver};

/// Inputs of an expansion.
#[derive(Clone)]
pub struct XacroContext<'a> {
    /// File to expand.
    pub path: PathBuf,
    /// Working folder of the user, for `$(cwd)` and for short paths in messages.
    pub working_folder: PathBuf,
    /// `name:=value` arguments of the command line.
    pub arguments: Vec<(String, String)>,
    /// Access to files and environment.
    pub host: &'a dyn Host,
    /// Search paths of packages and resources.
    pub resolver: &'a Resolver<'a>,
}

impl XacroContext<'_> {
    /// Path as shown in messages.
    pub(crate) fn shown(&self, path: &Path) -> String {
        match path.strip_prefix(&self.working_folder) {
            Ok(rest) if rest.as_os_str().is_empty() => ".".into(),
            Ok(rest) => rest.display().to_string(),
            Err(_) => path.display().to_string(),
        }
    }
}
