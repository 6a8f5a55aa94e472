//! Files that are named on the command line: reading and writing them, with words that help.

use std::io::{self, BufRead, Write};
use std::path::{Path, PathBuf};

use periplus_bagfiles::{Bag, BagError};
use periplus_diagnostics::plain_words;
use periplus_os::Machine;
use periplus_resources::{Host as _, ReadError, Store as _, nearest};

use crate::terminal::working_folder;

/// ``; did you mean `X`?`` for a path at which nothing is, if something similar is near.
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

/// The bytes of a file.
///
/// # Errors
/// The path and the reason, with the nearest file where it is missing.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, String> {
    Machine.read(path).map_err(|error| unreadable(path, &error))
}

/// The same, to be read bit by bit.
///
/// # Errors
/// As [`read`].
pub(crate) fn reader(path: &Path) -> Result<impl BufRead + use<>, String> {
    Machine.reader(path).map_err(|error| unreadable(path, &error))
}

fn unreadable(path: &Path, error: &ReadError) -> String {
    let advice = if *error == ReadError::Missing { advice(path) } else { String::new() };
    format!("cannot read {}: {error}{advice}", path.display())
}

/// The text of a file.
///
/// # Errors
/// As [`read`], and for what is not UTF-8.
pub(crate) fn text(path: &Path) -> Result<String, String> {
    String::from_utf8(read(path)?).map_err(|_| {
        format!("cannot read {}: this is not a text (not valid UTF-8)", path.display())
    })
}

/// A recording.
///
/// # Errors
/// The path and the reason, with the nearest file where it is missing.
pub(crate) fn bag(path: &Path) -> Result<Bag, String> {
    Bag::open(path).map_err(|error| bag_error(path, &error))
}

/// Words of an error with a recording, with the nearest file where it is missing.
pub(crate) fn bag_error(path: &Path, error: &BagError) -> String {
    format!("{error}{}", advice(path))
}

/// Makes a folder and those above it.
///
/// # Errors
/// The path and the reason.
pub(crate) fn make_folder(path: &Path) -> Result<(), String> {
    std::fs::create_dir_all(path).map_err(|error| {
        format!("cannot make the folder {}: {}", path.display(), plain_words(&error))
    })
}

/// Writes a file bit by bit, as a whole in the place of an old one.
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

/// Writes a file as a whole, in the place of an old one.
///
/// # Errors
/// The path and the reason.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    Machine.replace(path, bytes).map_err(|why| format!("cannot write {}: {why}", path.display()))
}
