//! What an expansion needs to know.

use std::path::{Path, PathBuf};

use periplus_resources::{Host, Resolver};

/// What an expansion needs to know.
#[derive(Clone)]
pub struct Setting<'a> {
    /// The file that is expanded.
    pub path: PathBuf,
    /// Where the user stands, for `$(cwd)`, and to show paths shorter.
    pub working_folder: PathBuf,
    /// `name:=value` of the command line.
    pub arguments: Vec<(String, String)>,
    /// Files and environment.
    pub host: &'a dyn Host,
    /// Packages and paths.
    pub resolver: &'a Resolver<'a>,
}

impl Setting<'_> {
    /// A path as messages show it.
    pub(crate) fn shown(&self, path: &Path) -> String {
        match path.strip_prefix(&self.working_folder) {
            Ok(rest) if rest.as_os_str().is_empty() => ".".into(),
            Ok(rest) => rest.display().to_string(),
            Err(_) => path.display().to_string(),
        }
    }
}
