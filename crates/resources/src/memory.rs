//! A machine that exists only in memory.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use crate::host::{Host, Kind, ReadError};

/// Files and variables for tests and fuzzers. Folders exist where files are in them.
#[derive(Clone, Debug, Default)]
pub struct MemoryHost {
    files: BTreeMap<PathBuf, Vec<u8>>,
    variables: BTreeMap<String, String>,
}

impl MemoryHost {
    /// A machine without files.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file at an absolute path.
    #[must_use]
    pub fn with_file(mut self, path: impl AsRef<Path>, content: impl Into<Vec<u8>>) -> Self {
        self.files.insert(plain(path.as_ref()), content.into());
        self
    }

    /// Sets a variable.
    #[must_use]
    pub fn with_variable(mut self, name: &str, value: &str) -> Self {
        self.variables.insert(name.into(), value.into());
        self
    }
}

impl Host for MemoryHost {
    fn read(&self, path: &Path) -> Result<Vec<u8>, ReadError> {
        match (self.files.get(&plain(path)), self.kind(path)) {
            (Some(content), _) => Ok(content.clone()),
            (None, Some(_)) => Err(ReadError::NotAFile),
            (None, None) => Err(ReadError::Missing),
        }
    }

    fn kind(&self, path: &Path) -> Option<Kind> {
        let path = plain(path);
        if self.files.contains_key(&path) {
            return Some(Kind::File);
        }
        self.files.keys().any(|file| file.starts_with(&path)).then_some(Kind::Folder)
    }

    fn list(&self, folder: &Path) -> Vec<String> {
        let folder = plain(folder);
        let mut names: Vec<String> = self
            .files
            .keys()
            .filter_map(|file| file.strip_prefix(&folder).ok()?.components().next())
            .map(|name| name.as_os_str().to_string_lossy().into_owned())
            .collect();
        names.dedup();
        names
    }

    fn canonical(&self, path: &Path) -> Option<PathBuf> {
        self.kind(path).map(|_| plain(path))
    }

    fn variable(&self, name: &str) -> Option<String> {
        self.variables.get(name).cloned()
    }
}

/// The path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir => {
                out.pop();
            }
            other => out.push(other),
        }
    }
    out
}
