//! Log of the files and environment variables that this process reads.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use periplus_resources::{EntryKind, without_dots};

static IS_ON: AtomicBool = AtomicBool::new(false);
static LOG: Mutex<FileLog> = Mutex::new(FileLog::EMPTY);

/// Files, folders and environment variables that [`crate::Machine`] read while the log was on.
///
/// ```
/// use std::path::Path;
///
/// use periplus_os::{FileLog, Machine};
/// use periplus_resources::Host as _;
///
/// FileLog::start();
/// assert!(Machine.read(Path::new("Cargo.toml")).is_ok());
/// let log = FileLog::take();
/// assert!(log.read.iter().any(|path| path.is_absolute() && path.ends_with("Cargo.toml")));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FileLog {
    /// Files whose content was read; absolute, without `.` and `..`.
    pub read: BTreeSet<PathBuf>,
    /// Files that were looked at, but not read; absolute, without `.` and `..`.
    pub seen: BTreeSet<PathBuf>,
    /// Folders that were looked at; absolute, without `.` and `..`.
    pub folders: BTreeSet<PathBuf>,
    /// Environment variables that were read, with their values.
    pub variables: BTreeMap<String, Option<String>>,
}

impl FileLog {
    const EMPTY: Self = Self {
        read: BTreeSet::new(),
        seen: BTreeSet::new(),
        folders: BTreeSet::new(),
        variables: BTreeMap::new(),
    };

    /// Turns the log of this process on, and empties it.
    pub fn start() {
        *log() = Self::EMPTY;
        IS_ON.store(true, Ordering::Relaxed);
    }

    /// Turns the log off, and returns its entries.
    #[must_use]
    pub fn take() -> Self {
        IS_ON.store(false, Ordering::Relaxed);
        let mut taken = std::mem::take(&mut *log());
        taken.seen.retain(|path| !taken.read.contains(path));
        taken
    }

    /// Adds the entries of another log.
    pub fn extend(&mut self, other: Self) {
        self.read.extend(other.read);
        self.seen.extend(other.seen);
        self.folders.extend(other.folders);
        self.variables.extend(other.variables);
        self.seen.retain(|path| !self.read.contains(path));
    }
}

fn log() -> MutexGuard<'static, FileLog> {
    LOG.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Logs a file whose content was read.
pub(crate) fn note_read(path: &Path) {
    if IS_ON.load(Ordering::Relaxed) {
        log().read.insert(plain(path));
    }
}

/// Logs an entry whose type was looked at.
pub(crate) fn note_kind(path: &Path, kind: Option<EntryKind>) {
    if !IS_ON.load(Ordering::Relaxed) {
        return;
    }
    match kind {
        Some(EntryKind::File) => log().seen.insert(plain(path)),
        Some(EntryKind::Folder) => log().folders.insert(plain(path)),
        None => false,
    };
}

/// Logs an environment variable.
pub(crate) fn note_variable(name: &str, value: Option<&String>) {
    if IS_ON.load(Ordering::Relaxed) {
        log().variables.insert(name.to_owned(), value.cloned());
    }
}

/// Absolute path without `.` and `..`, links not followed.
#[must_use]
pub fn plain(path: &Path) -> PathBuf {
    without_dots(&std::path::absolute(path).unwrap_or_else(|_| path.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_absolute_and_without_dots() {
        let here = std::env::current_dir().unwrap();
        assert_eq!(plain(Path::new("a/./b/../c.sdf")), here.join("a/c.sdf"));
        assert_eq!(plain(&here.join("../x")), here.parent().unwrap().join("x"));
    }

    #[test]
    fn a_file_that_was_read_is_not_only_seen() {
        let path = || PathBuf::from("/a.sdf");
        let mut log = FileLog { seen: [path()].into(), ..FileLog::default() };
        log.extend(FileLog { read: [path()].into(), ..FileLog::default() });
        assert_eq!((log.read.len(), log.seen.len()), (1, 0));
    }
}
