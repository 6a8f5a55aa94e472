//! ZIP archives: their directory, and files that are stored or deflated.
//!
//! Written here because the crate `zip` needs `wasm-bindgen` in WebAssembly, whose generated code the module does without.
//! Archives in the ZIP64 format, which is for more than 4 GB or 65,535 entries, are refused.

use std::io::Read;

use flate2::read::DeflateDecoder;

use super::UnpackError;

/// First bytes of a local header, of an entry of the directory, and of the end of the directory.
const LOCAL_MARK: &[u8] = b"PK\x03\x04";
const ENTRY_MARK: &[u8] = b"PK\x01\x02";
const END_MARK: &[u8] = b"PK\x05\x06";

/// Sizes of these headers without names, extra fields and comments \[bytes\].
const LOCAL_BYTES: usize = 30;
const ENTRY_BYTES: usize = 46;
const END_BYTES: usize = 22;

/// Largest comment after the end of the directory \[bytes\].
const MAX_COMMENT_BYTES: usize = u16::MAX as usize;

/// Flag of an encrypted file.
const ENCRYPTED_FLAG: u16 = 1;

/// Compression methods.
const STORED: u16 = 0;
const DEFLATED: u16 = 8;

/// Number of Unix among the systems that make archives, and its file type of a symbolic link.
const UNIX: u16 = 3;
const LINK_TYPE: u32 = 0o120_000;
const TYPE_MASK: u32 = 0o170_000;

/// An entry of the directory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ZipEntry {
    pub(super) name: String,
    pub(super) is_link: bool,
    pub(super) is_encrypted: bool,
    method: u16,
    checksum: u32,
    packed_bytes: usize,
    /// Position of the local header.
    position: usize,
}

impl ZipEntry {
    pub(super) fn is_folder(&self) -> bool {
        self.name.ends_with(['/', '\\'])
    }
}

fn damaged(why: &str) -> UnpackError {
    UnpackError::Damaged(why.to_owned())
}

fn half(bytes: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_le_bytes(bytes.get(at..at + 2)?.try_into().ok()?))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}

/// Position of the end of the directory, which a comment may follow.
fn end_of_directory(bytes: &[u8]) -> Option<usize> {
    let last = bytes.len().checked_sub(END_BYTES)?;
    let first = last.saturating_sub(MAX_COMMENT_BYTES);
    (first..=last).rev().find(|&at| {
        bytes[at..].starts_with(END_MARK)
            && half(bytes, at + 20)
                .is_some_and(|comment| at + END_BYTES + usize::from(comment) <= bytes.len())
    })
}

/// Entries of the directory, at most this number.
pub(super) fn directory(bytes: &[u8], max_count: usize) -> Result<Vec<ZipEntry>, UnpackError> {
    let end =
        end_of_directory(bytes).ok_or_else(|| damaged("its directory at the end is missing"))?;
    let count = usize::from(half(bytes, end + 10).unwrap_or(0));
    let mut at = word(bytes, end + 16).unwrap_or(0) as usize;
    if count == usize::from(u16::MAX) || at == u32::MAX as usize {
        return Err(damaged("it is in the ZIP64 format"));
    }
    if count > max_count {
        return Err(UnpackError::TooMany);
    }
    (0..count)
        .map(|_| {
            let (entry, next) = entry(bytes, at).ok_or_else(|| damaged("its directory is cut"))?;
            at = next;
            Ok(entry)
        })
        .collect()
}

/// The entry of the directory at a position, and the position of the next.
fn entry(bytes: &[u8], at: usize) -> Option<(ZipEntry, usize)> {
    let header = bytes.get(at..at.checked_add(ENTRY_BYTES)?)?;
    if !header.starts_with(ENTRY_MARK) {
        return None;
    }
    let name_end = at + ENTRY_BYTES + usize::from(half(header, 28)?);
    let name = bytes.get(at + ENTRY_BYTES..name_end)?;
    let next = name_end + usize::from(half(header, 30)?) + usize::from(half(header, 32)?);
    let file_type = (word(header, 38)? >> 16) & TYPE_MASK;
    let entry = ZipEntry {
        name: String::from_utf8_lossy(name).into_owned(),
        is_link: half(header, 4)? >> 8 == UNIX && file_type == LINK_TYPE,
        is_encrypted: half(header, 8)? & ENCRYPTED_FLAG != 0,
        method: half(header, 10)?,
        checksum: word(header, 16)?,
        packed_bytes: word(header, 20)? as usize,
        position: word(header, 42)? as usize,
    };
    Some((entry, next))
}

/// Content of a file, of at most this size.
pub(super) fn content(
    bytes: &[u8],
    entry: &ZipEntry,
    max_bytes: u64,
) -> Result<Vec<u8>, UnpackError> {
    let wrong = |why: &str| UnpackError::Damaged(format!("`{}` {why}", entry.name));
    let packed = packed(bytes, entry).ok_or_else(|| wrong("is cut"))?;
    let mut content = Vec::new();
    // One byte more shows that there is more.
    let limit = max_bytes.saturating_add(1);
    match entry.method {
        STORED => packed.take(limit).read_to_end(&mut content),
        DEFLATED => DeflateDecoder::new(packed).take(limit).read_to_end(&mut content),
        other => return Err(wrong(&format!("has the compression method {other}"))),
    }?;
    if content.len() as u64 > max_bytes {
        return Err(UnpackError::TooLarge);
    }
    if crc32fast::hash(&content) != entry.checksum {
        return Err(wrong("has a wrong checksum"));
    }
    Ok(content)
}

fn packed<'a>(bytes: &'a [u8], entry: &ZipEntry) -> Option<&'a [u8]> {
    let header = bytes.get(entry.position..entry.position.checked_add(LOCAL_BYTES)?)?;
    if !header.starts_with(LOCAL_MARK) {
        return None;
    }
    let names = usize::from(half(header, 26)?) + usize::from(half(header, 28)?);
    let start = entry.position + LOCAL_BYTES + names;
    bytes.get(start..start.checked_add(entry.packed_bytes)?)
}
