//! Files of this machine, some of them with another text.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_os::Machine;
use periplus_resources::{EntryKind, FileReadError, Host};

/// This machine with texts in place of some files, which need not exist.
#[derive(Clone, Debug, Default)]
pub(super) struct Overlay {
    texts: BTreeMap<PathBuf, String>,
}

impl Overlay {
    /// Replaces a file. `path` is canonical, or names no file of the machine.
    pub(super) fn with(mut self, path: PathBuf, text: String) -> Self {
        self.texts.insert(path, text);
        self
    }

    fn text(&self, path: &Path) -> Option<&String> {
        if let Some(text) = self.texts.get(path) {
            return Some(text);
        }
        self.texts.get(&Machine.canonical(path)?)
    }
}

impl Host for Overlay {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError> {
        match self.text(path) {
            Some(text) => Ok(text.clone().into_bytes()),
            None => Machine.read(path),
        }
    }

    fn kind(&self, path: &Path) -> Option<EntryKind> {
        match self.texts.get(path) {
            Some(_) => Some(EntryKind::File),
            None => Machine.kind(path),
        }
    }

    fn list(&self, folder: &Path) -> Vec<String> {
        Machine.list(folder)
    }

    fn canonical(&self, path: &Path) -> Option<PathBuf> {
        match self.texts.get(path) {
            Some(_) => Some(path.to_owned()),
            None => Machine.canonical(path),
        }
    }

    fn variable(&self, name: &str) -> Option<String> {
        Machine.variable(name)
    }
}
