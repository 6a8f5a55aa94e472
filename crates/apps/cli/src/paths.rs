//! Reading and writing files of the command line, with helpful messages.

use std::io::{self, BufRead, Write};
use std::path::{Path, PathBuf};

use periplus_bags::files::{Bag, BagError};
use periplus_diagnostics::plain_words;
use periplus_os::Machine;
use periplus_resources::{FileReadError, Host as _, Store as _, nearest};

use crate::terminal::working_folder;

/// Returns ``; did you mean `X`?`` for a missing path with a similar name nearby.
pub(crate) fn advice(path: &Path) -> String {
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
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, String> {
    Machine.read(path).map_err(|error| unreadable(path, &error))
}

/// Opens a file for buffered reading.
///
/// # Errors
/// As for [`read`].
pub(crate) fn reader(path: &Path) -> Result<impl BufRead + use<>, String> {
    Machine.reader(path).map_err(|error| unreadable(path, &error))
}

fn unreadable(path: &Path, error: &FileReadError) -> String {
    let advice = if *error == FileReadError::Missing { advice(path) } else { String::new() };
    format!("cannot read {}: {error}{advice}", path.display())
}

/// Reads a text file.
///
/// # Errors
/// As for [`read`], and for text that is not UTF-8.
pub(crate) fn text(path: &Path) -> Result<String, String> {
    String::from_utf8(read(path)?)
        .map_err(|_| format!("cannot read {}: not a text file (invalid UTF-8)", path.display()))
}

/// Opens a recording.
///
/// # Errors
/// The path and the reason, with the nearest name if the file is missing.
pub(crate) fn bag(path: &Path) -> Result<Bag, String> {
    Bag::open(path).map_err(|error| bag_error(path, &error))
}

/// Message for an error of a recording, with the nearest name if the file is missing.
pub(crate) fn bag_error(path: &Path, error: &BagError) -> String {
    format!("{error}{}", advice(path))
}

/// Creates a folder and its parents.
///
/// # Errors
/// The path and the reason.
pub(crate) fn make_folder(path: &Path) -> Result<(), String> {
    std::fs::create_dir_all(path).map_err(|error| {
        format!("cannot create the folder {}: {}", path.display(), plain_words(&error))
    })
}

/// Writes a file through a callback and replaces an old one atomically.
///
/// # Errors
/// The path and the reason.
pub(crate) fn write_by(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), String> {
    Machine
        .replace_by(path, content)
        .map_err(|why| format!("cannot write {}: {why}", path.display()))
}

/// Writes a file and replaces an old one atomically.
///
/// # Errors
/// The path and the reason.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    Machine.replace(path, bytes).map_err(|why| format!("cannot write {}: {why}", path.display()))
}
