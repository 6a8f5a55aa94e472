//! Recognition of files by name and first bytes.

use std::io::Read;
use std::path::{Path, PathBuf};

use periplus_os::fs::{self, File};

use crate::files::BagError;
use crate::files::write::{Packing, Storage};

/// Content of a file, from its first bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Content {
    /// An uncompressed bag file.
    Plain(Storage),
    /// A compressed file; its content is known only after decompression.
    Packed(Packing),
}

/// Recognizes a file by its first bytes.
pub(crate) fn content(path: &Path) -> Result<Option<Content>, BagError> {
    let file = File::open(path).map_err(BagError::file(path))?;
    let mut start = Vec::new();
    file.take(16).read_to_end(&mut start).map_err(BagError::file(path))?;
    let known: [(&[u8], Content); 5] = [
        (b"\x89MCAP", Content::Plain(Storage::Mcap)),
        (b"SQLite format 3", Content::Plain(Storage::Sqlite)),
        (b"#ROSBAG V", Content::Plain(Storage::Ros1)),
        (&Packing::Zstd.magic(), Content::Packed(Packing::Zstd)),
        (&Packing::Lz4.magic(), Content::Packed(Packing::Lz4)),
    ];
    Ok(known.iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, content)| *content))
}

/// Files of a folder that may be parts of a bag, in the order of their numbers.
pub(crate) fn bag_files(folder: &Path) -> Result<Vec<PathBuf>, BagError> {
    let entries = fs::read_dir(folder).map_err(BagError::file(folder))?;
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.map_err(BagError::file(folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let plain = name.strip_suffix(".zstd").or_else(|| name.strip_suffix(".lz4"));
        let plain = plain.unwrap_or(&name);
        let stem = plain.strip_suffix(".mcap").or_else(|| plain.strip_suffix(".db3"));
        if let Some(stem) = stem.filter(|_| fs::is_file(&path)) {
            files.push((number(stem), name.to_string(), path.clone()));
        }
    }
    files.sort();
    Ok(files.into_iter().map(|(.., path)| path).collect())
}

/// The number at the end of `name_12`.
fn number(stem: &str) -> u64 {
    stem.rsplit('_').next().and_then(|number| number.parse().ok()).unwrap_or(0)
}
