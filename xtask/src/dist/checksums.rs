//! `SHA256SUMS`, which `sha256sum --check` reads.

use std::path::Path;

use sha2::{Digest as _, Sha256};

use super::{read, write};
use crate::step::Failed;

/// Name of the list.
const NAME: &str = "SHA256SUMS";

/// Writes the list of all files in a folder.
pub(super) fn write_list(folder: &Path) -> Result<(), Failed> {
    let entries = std::fs::read_dir(folder)
        .map_err(|error| Failed(format!("cannot read {}: {error}", folder.display())))?;
    let files = entries.filter_map(Result::ok).filter(|entry| entry.path().is_file());
    let mut names: Vec<String> = files.filter_map(|it| it.file_name().into_string().ok()).collect();
    names.retain(|name| name != NAME);
    names.sort();
    let mut list = String::new();
    for name in names {
        list += &format!("{}  {name}\n", of(&read(&folder.join(&name))?));
    }
    write(&folder.join(NAME), list.as_bytes())
}

/// Returns the SHA-256 of bytes in hexadecimal digits.
pub(super) fn of(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn digits_are_those_of_sha256sum() {
    // The test vector of FIPS 180-2.
    assert_eq!(of(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}
