//! Files of the tests of navigation.

use std::path::{Path, PathBuf};

use periplus_resources::{EntryKind, FileReadError, FileWriteError, Host, MemoryHost, Store};

/// Files in memory; what is written is dropped.
pub(crate) struct MemoryFiles(pub(crate) MemoryHost);

impl Host for MemoryFiles {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError> {
        self.0.read(path)
    }

    fn kind(&self, path: &Path) -> Option<EntryKind> {
        self.0.kind(path)
    }

    fn list(&self, folder: &Path) -> Vec<String> {
        self.0.list(folder)
    }

    fn canonical(&self, path: &Path) -> Option<PathBuf> {
        self.0.canonical(path)
    }

    fn variable(&self, name: &str) -> Option<String> {
        self.0.variable(name)
    }
}

impl Store for MemoryFiles {
    fn replace(&self, _: &Path, _: &[u8]) -> Result<(), FileWriteError> {
        Ok(())
    }
}
