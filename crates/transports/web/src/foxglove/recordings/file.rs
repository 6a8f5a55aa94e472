//! File of a recording, for a client that keeps it.
#![expect(clippy::disallowed_methods, reason = "transports are an edge: this file is on the disk")]

use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use periplus_diagnostics::plain_words;
use periplus_os::fs::{self, File};

use super::entry::Recording;
use super::fetch::FetchAnswer;
use crate::foxglove::protocol;

/// Size of a part \[bytes\].
const PART_BYTES: usize = 1 << 20;

/// Answers with the name, the size and the parts of the file.
pub(super) fn fetch(recording: &Recording, answer: &FetchAnswer<'_>) {
    if let Err(why) = send(recording.bag.path(), answer) {
        answer.fail(&why);
    }
}

fn send(path: &Path, answer: &FetchAnswer<'_>) -> Result<(), String> {
    let path = only_file(path)?;
    let failed = |error: io::Error| format!("`{}`: {}", path.display(), plain_words(&error));
    let mut file = File::open(&path).map_err(failed)?;
    let mut left = file.metadata().map_err(failed)?.len();
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let id = answer.request_id;
    if answer.push(protocol::file_head(id, &name, left)).is_break() {
        return Ok(());
    }
    let mut part = vec![0; PART_BYTES];
    loop {
        if answer.is_cancelled() {
            answer.fail_cancelled();
            return Ok(());
        }
        let count = usize::try_from(left).unwrap_or(PART_BYTES).min(PART_BYTES);
        file.read_exact(&mut part[..count]).map_err(failed)?;
        left -= count as u64;
        let frame = protocol::file_part(id, &part[..count], left == 0);
        if left == 0 {
            answer.finish(frame);
            return Ok(());
        }
        if answer.push(frame).is_break() {
            return Ok(());
        }
    }
}

/// The file itself, or the only file with messages in a folder.
fn only_file(path: &Path) -> Result<PathBuf, String> {
    if !fs::is_dir(path) {
        return Ok(path.to_owned());
    }
    let failed = |error: io::Error| format!("`{}`: {}", path.display(), plain_words(&error));
    let mut files = Vec::new();
    for entry in fs::read_dir(path).map_err(failed)? {
        let file = entry.map_err(failed)?.path();
        if fs::is_file(&file) && file.file_name().is_some_and(|name| name != "metadata.yaml") {
            files.push(file);
        }
    }
    match files.as_slice() {
        [one] => Ok(one.clone()),
        several => Err(format!(
            "`{}` is a folder with {} files; only a single file can be downloaded. Copy the folder, or write \
             it as one file with `periplus bag convert`",
            path.display(),
            several.len()
        )),
    }
}
