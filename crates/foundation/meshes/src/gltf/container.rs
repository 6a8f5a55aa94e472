//! The binary container (GLB), section 4.4 of the specification.

use crate::error::{MeshError, MeshLocation};

/// Parts of a glTF file.
pub(super) struct Parts<'a> {
    pub(super) json: &'a [u8],
    /// BIN chunk of a `.glb`.
    pub(super) binary: Option<&'a [u8]>,
}

/// Splits a `.glb` into its chunks; other bytes are treated as JSON.
pub(super) fn split(bytes: &[u8]) -> Result<Parts<'_>, MeshError> {
    if !bytes.starts_with(b"glTF") {
        let json = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        return Ok(Parts { json, binary: None });
    }
    match word(bytes, 4) {
        Some(2) => {}
        version => {
            let version = version.map_or("none".to_owned(), |v| v.to_string());
            return Err(MeshError::new(
                format!("GLB version {version} is not supported"),
                "convert the file to glTF 2.0",
            )
            .at(MeshLocation::Byte(4)));
        }
    }
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while at < bytes.len() {
        let chunk = chunk(bytes, at).ok_or_else(|| {
            MeshError::new(
                "a GLB chunk reaches beyond the end of the file",
                "the file is cut short: export or fetch it again",
            )
            .at(MeshLocation::Byte(at))
        })?;
        match chunk.kind {
            b"JSON" if json.is_none() => json = Some(chunk.data),
            b"BIN\0" if binary.is_none() => binary = Some(chunk.data),
            // The specification requires readers to skip unknown chunks.
            _ => {}
        }
        at += 8 + chunk.data.len();
    }
    let json = json.ok_or_else(|| {
        MeshError::new("the GLB file has no JSON chunk", "export the file again")
            .at(MeshLocation::Byte(12))
    })?;
    Ok(Parts { json, binary })
}

struct Chunk<'a> {
    kind: &'a [u8],
    data: &'a [u8],
}

fn chunk(bytes: &[u8], at: usize) -> Option<Chunk<'_>> {
    let len = usize::try_from(word(bytes, at)?).ok()?;
    let kind = bytes.get(at.checked_add(4)?..at.checked_add(8)?)?;
    let start = at.checked_add(8)?;
    Some(Chunk { kind, data: bytes.get(start..start.checked_add(len)?)? })
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(4)?)?.try_into().ok()?;
    Some(u32::from_le_bytes(four))
}
