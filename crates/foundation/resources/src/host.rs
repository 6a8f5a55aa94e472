//! Access to files and environment for readers.

use std::path::{Path, PathBuf};

use periplus_diagnostics::DiagnosticCause;

/// Maximum size of a file that is read [bytes].
pub const MAX_FILE_BYTES: u64 = 256 << 20;

/// Type of a file system entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryKind {
    /// A regular file.
    File,
    /// A folder.
    Folder,
}

/// Error of a file that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileReadError {
    /// No such file.
    Missing,
    /// Larger than [`MAX_FILE_BYTES`]; size [bytes].
    TooLarge(u64),
    /// Not a regular file: a folder, a device, a pipe.
    NotAFile,
    /// Message of the operating system.
    Other(String),
}

impl std::fmt::Display for FileReadError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Missing => write!(f, "there is no such file"),
            Self::TooLarge(size) => write!(
                f,
                "the file is {} MiB large; at most {} MiB are read",
                size >> 20,
                MAX_FILE_BYTES >> 20
            ),
            Self::NotAFile => write!(f, "this is not a regular file"),
            Self::Other(words) => f.write_str(words),
        }
    }
}

impl std::error::Error for FileReadError {}

impl FileReadError {
    /// Class of a finding about this error.
    #[must_use]
    pub fn cause(&self) -> Option<DiagnosticCause> {
        matches!(self, Self::Missing).then_some(DiagnosticCause::MissingFile)
    }
}

/// Files and environment, as far as readers need them. All access in library crates uses this trait; tests
/// and fuzzers pass a [`crate::MemoryHost`].
pub trait Host {
    /// Reads a regular file of at most [`MAX_FILE_BYTES`] bytes.
    ///
    /// # Errors
    /// If it cannot be read.
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError>;

    /// Type of the entry at a path, links followed.
    fn kind(&self, path: &Path) -> Option<EntryKind>;

    /// Names in a folder, sorted; empty if it cannot be read.
    fn list(&self, folder: &Path) -> Vec<String>;

    /// Absolute path without `.`, `..` and links, if the entry exists.
    fn canonical(&self, path: &Path) -> Option<PathBuf>;

    /// An environment variable.
    fn variable(&self, name: &str) -> Option<String>;
}

/// Error of a file that cannot be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileWriteError {
    /// The path has no file name.
    NoFileName,
    /// Message of the operating system.
    Other(String),
}

impl std::fmt::Display for FileWriteError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NoFileName => write!(f, "this names no file"),
            Self::Other(words) => f.write_str(words),
        }
    }
}

impl std::error::Error for FileWriteError {}

impl From<FileWriteError> for String {
    fn from(error: FileWriteError) -> Self {
        error.to_string()
    }
}

/// Writing of files, for code without direct access to the machine.
pub trait Store {
    /// Writes a file atomically: concurrent readers see the old or the new content, and the old file
    /// remains if writing fails.
    ///
    /// # Errors
    /// If the file cannot be written.
    fn replace(&self, path: &Path, content: &[u8]) -> Result<(), FileWriteError>;
}
