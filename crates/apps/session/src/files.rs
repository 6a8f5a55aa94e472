//! Reading and writing files that a user named, with helpful messages.

use std::error::Error;
use std::fmt;
use std::io::{self, BufRead, Write};
use std::path::{Path, PathBuf};

use periplus_diagnostics::plain_words;
use periplus_os::Machine;
use periplus_resources::{FileReadError, Host as _, Store as _, nearest};

use crate::terminal::working_folder;

/// Failed access to a file, with its path and the reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    /// Failed action, such as `read`.
    action: &'static str,
    path: PathBuf,
    reason: String,
}

impl FileError {
    fn new(action: &'static str, path: &Path, reason: impl Into<String>) -> Self {
        Self { action, path: path.to_owned(), reason: reason.into() }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cannot {} {}: {}", self.action, self.path.display(), self.reason)
    }
}

impl Error for FileError {}

/// Returns ``; did you mean `X`?`` for a missing path with a similar name nearby.
#[must_use]
pub fn advice(path: &Path) -> String {
    let here = working_folder();
    let whole = here.join(path);
    if Machine.kind(&whole).is_some() {
        return String::new();
    }
    let Some(near) = nearest(&Machine, &whole) else { return String::new() };
    let near: PathBuf = near.strip_prefix(&here).map(Path::to_owned).unwrap_or(near);
    format!("; did you mean `{}`?", near.display())
}

/// Reads the bytes of a file.
///
/// # Errors
/// The path and the reason, with the nearest name if the file is missing.
pub fn read(path: &Path) -> Result<Vec<u8>, FileError> {
    Machine.read(path).map_err(|error| unreadable(path, &error))
}

/// Opens a file for buffered reading.
///
/// # Errors
/// As for [`read`].
pub fn reader(path: &Path) -> Result<impl BufRead + use<>, FileError> {
    Machine.reader(path).map_err(|error| unreadable(path, &error))
}

fn unreadable(path: &Path, error: &FileReadError) -> FileError {
    let advice = if *error == FileReadError::Missing { advice(path) } else { String::new() };
    FileError::new("read", path, format!("{error}{advice}"))
}

/// Reads a text file.
///
/// # Errors
/// As for [`read`], and for text that is not UTF-8.
pub fn text(path: &Path) -> Result<String, FileError> {
    String::from_utf8(read(path)?)
        .map_err(|_| FileError::new("read", path, "not a text file (invalid UTF-8)"))
}

/// Creates a folder and its parents.
///
/// # Errors
/// The path and the reason.
pub fn make_folder(path: &Path) -> Result<(), FileError> {
    periplus_os::fs::create_dir_all(path)
        .map_err(|error| FileError::new("create the folder", path, plain_words(&error)))
}

/// Writes a file through a callback and replaces an old one atomically.
///
/// # Errors
/// The path and the reason.
pub fn write_by(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), FileError> {
    Machine
        .replace_by(path, content)
        .map_err(|error| FileError::new("write", path, error.to_string()))
}

/// Writes a file and replaces an old one atomically.
///
/// # Errors
/// The path and the reason.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    Machine.replace(path, bytes).map_err(|error| FileError::new("write", path, error.to_string()))
}
