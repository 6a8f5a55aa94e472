//! Decoding of XML bytes.

use std::borrow::Cow;

use crate::error::{MeshError, MeshLocation};

/// UTF-8, UTF-16 with a byte order mark, or Latin-1 if declared.
pub(super) fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, MeshError> {
    if let Some(rest) = bytes.strip_prefix(b"\xFF\xFE") {
        return utf16(rest, u16::from_le_bytes).map(Cow::Owned);
    }
    if let Some(rest) = bytes.strip_prefix(b"\xFE\xFF") {
        return utf16(rest, u16::from_be_bytes).map(Cow::Owned);
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    std::str::from_utf8(bytes).map(Cow::Borrowed).or_else(|error| {
        let head = bytes[..bytes.len().min(200)].to_ascii_lowercase();
        let declares = |name: &[u8]| head.windows(name.len()).any(|window| window == name);
        if declares(b"iso-8859-1") || declares(b"windows-1252") || declares(b"latin1") {
            return Ok(Cow::Owned(bytes.iter().map(|&b| char::from(b)).collect()));
        }
        Err(not_text().at(MeshLocation::Byte(error.valid_up_to())))
    })
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String, MeshError> {
    let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    char::decode_utf16(units).collect::<Result<_, _>>().map_err(|_| not_text())
}

fn not_text() -> MeshError {
    MeshError::new("the COLLADA file is not valid UTF-8 text", "save the file as UTF-8")
}
