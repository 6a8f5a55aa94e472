//! In-memory machine for tests.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::dots::without_dots;
use crate::host::{EntryKind, FileReadError, Host};

/// Files and variables for tests and fuzzers. Folders exist if files are in them; relative paths start at
/// `/`.
#[derive(Clone, Debug, Default)]
pub struct MemoryHost {
    files: BTreeMap<PathBuf, Vec<u8>>,
    variables: BTreeMap<String, String>,
    links: BTreeMap<PathBuf, PathBuf>,
}

impl MemoryHost {
    /// Returns a machine without files.
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

    /// Adds a symbolic link at an absolute path to another absolute path.
    #[must_use]
    pub fn with_link(mut self, path: impl AsRef<Path>, target: impl AsRef<Path>) -> Self {
        self.links.insert(plain(path.as_ref()), plain(target.as_ref()));
        self
    }

    /// Path without `.`, `..` and links.
    fn followed(&self, path: &Path) -> PathBuf {
        let mut path = path.to_path_buf();
        // Linux follows the same number of links before it reports a loop.
        for _ in 0..40 {
            let crossed = path.ancestors().find_map(|up| {
                let target = self.links.get(&plain(up))?;
                Some(target.join(path.strip_prefix(up).unwrap_or(Path::new(""))))
            });
            match crossed {
                Some(further) => path = further,
                None => break,
            }
        }
        plain(&path)
    }

    /// Sets a variable.
    #[must_use]
    pub fn with_variable(mut self, name: &str, value: &str) -> Self {
        self.variables.insert(name.into(), value.into());
        self
    }
}

impl Host for MemoryHost {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError> {
        match (self.files.get(&self.followed(path)), self.kind(path)) {
            (Some(content), _) => Ok(content.clone()),
            (None, Some(_)) => Err(FileReadError::NotAFile),
            (None, None) => Err(FileReadError::Missing),
        }
    }

    fn kind(&self, path: &Path) -> Option<EntryKind> {
        let path = self.followed(path);
        if self.files.contains_key(&path) {
            return Some(EntryKind::File);
        }
        self.files.keys().any(|file| file.starts_with(&path)).then_some(EntryKind::Folder)
    }

    fn list(&self, folder: &Path) -> Vec<String> {
        let folder = self.followed(folder);
        let mut names: Vec<String> = self
            .files
            .keys()
            .filter_map(|file| file.strip_prefix(&folder).ok()?.components().next())
            .map(|name| name.as_os_str().to_string_lossy().into_owned())
            .collect();
        let links = self.links.keys().filter(|link| link.parent() == Some(folder.as_path()));
        names.extend(links.filter_map(|link| Some(link.file_name()?.to_string_lossy().into())));
        names.sort();
        names.dedup();
        names
    }

    fn canonical(&self, path: &Path) -> Option<PathBuf> {
        self.kind(path).map(|_| self.followed(path))
    }

    fn variable(&self, name: &str) -> Option<String> {
        self.variables.get(name).cloned()
    }
}

/// Path from the root, which is also the working folder, without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    without_dots(&Path::new("/").join(path))
}
