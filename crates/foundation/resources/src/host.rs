//! What readers may ask of the machine.

use std::path::{Path, PathBuf};

/// The largest file that is read [bytes].
pub const LARGEST_FILE: u64 = 256 << 20;

/// What stands at a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A regular file.
    File,
    /// A folder.
    Folder,
}

/// Why a file could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReadError {
    /// Nothing is there.
    Missing,
    /// It is larger than [`LARGEST_FILE`]; its size [bytes].
    TooLarge(u64),
    /// It is not a regular file: a folder, a device, a pipe.
    NotAFile,
    /// The machine's own words.
    Other(String),
}

impl std::fmt::Display for ReadError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Missing => write!(f, "there is no such file"),
            Self::TooLarge(size) => write!(
                f,
                "the file is {} MiB large; at most {} MiB are read",
                size >> 20,
                LARGEST_FILE >> 20
            ),
            Self::NotAFile => write!(f, "this is not a regular file"),
            Self::Other(words) => f.write_str(words),
        }
    }
}

impl std::error::Error for ReadError {}

/// Files and environment, as far as readers need them. Below the edges of the program this is
/// the only way to either; tests and fuzzers give a [`crate::MemoryHost`].
pub trait Host {
    /// The bytes of a regular file of at most [`LARGEST_FILE`] bytes.
    ///
    /// # Errors
    /// Why it cannot be read.
    fn read(&self, path: &Path) -> Result<Vec<u8>, ReadError>;

    /// What stands at a path, links followed.
    fn kind(&self, path: &Path) -> Option<Kind>;

    /// Names in a folder, sorted; none when it cannot be read.
    fn list(&self, folder: &Path) -> Vec<String>;

    /// The absolute path without `.`, `..` and links, if something stands there.
    fn canonical(&self, path: &Path) -> Option<PathBuf>;

    /// An environment variable.
    fn variable(&self, name: &str) -> Option<String>;
}

/// Files that are written, for those who may not touch the machine themselves.
pub trait Store {
    /// Puts a file at a path, in the place of what stands there. Whoever reads meanwhile finds the
    /// old one or the new one, whole; when it cannot be written, the old one stays.
    ///
    /// # Errors
    /// The machine's own words.
    fn replace(&self, path: &Path, content: &[u8]) -> Result<(), String>;
}
