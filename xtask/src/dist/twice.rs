//! A second build in another folder, from which the bytes must not differ.

use std::path::Path;
use std::process::Command;

use super::target::Target;
use super::{Sources, archive_of, checksums, make_folder, read};
use crate::step::{Failed, equal_start, root};

/// Builds the archive of a target from a copy of the tracked files, without anything that was built before, and
/// compares it.
pub(super) fn compare(target: &Target, sources: &Sources, first: &Path) -> Result<(), Failed> {
    let folder = root().join("target/distribution/second");
    let failed = |error: std::io::Error| Failed(format!("{}: {error}", folder.display()));
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(failed)?;
    }
    let copy = Sources {
        folder: folder.join("sources"),
        profile: sources.profile,
        native: sources.native.clone(),
    };
    copy_tracked(&copy.folder)?;
    let out = folder.join("out");
    make_folder(&out)?;
    let second = archive_of(&copy, target, &out)?;
    let (one, other) = (read(first)?, read(&second)?);
    if one != other {
        let at = equal_start(&one, &other);
        return Err(Failed(format!(
            "{} and {} differ at byte {at}: unpack both and compare their files",
            first.display(),
            second.display()
        )));
    }
    println!("two builds are equal: {} bytes, SHA-256 {}", one.len(), checksums::of(&one));
    std::fs::remove_dir_all(&folder).map_err(failed)
}

/// Copies the files that git tracks, as they are now.
fn copy_tracked(to: &Path) -> Result<(), Failed> {
    let listed = Command::new("git").args(["ls-files", "-z"]).current_dir(root()).output();
    let listed = listed.map_err(|error| Failed(format!("git: {error}")))?;
    for name in String::from_utf8_lossy(&listed.stdout).split_terminator('\0') {
        let (from, to) = (root().join(name), to.join(name));
        if let Some(parent) = to.parent() {
            make_folder(parent)?;
        }
        std::fs::copy(&from, &to)
            .map_err(|error| Failed(format!("cannot copy {}: {error}", from.display())))?;
    }
    Ok(())
}
