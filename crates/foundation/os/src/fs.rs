//! Files: those of the operating system, or in WebAssembly those in the memory of the tab.
//!
//! Same names and signatures as `std::fs`, as far as crates of this project use them.

#[cfg(not(target_family = "wasm"))]
mod system {
    #![allow(
        clippy::disallowed_methods,
        reason = "the edge through which all other code reads files"
    )]

    #[cfg(not(windows))]
    pub use std::fs::canonicalize;
    pub use std::fs::{
        File, create_dir_all, metadata, read, read_dir, remove_dir_all, remove_file, rename, write,
    };
    use std::path::{Path, PathBuf};

    /// Returns the absolute path without links, as users write it.
    ///
    /// # Errors
    /// When there is no such entry.
    #[cfg(windows)]
    pub fn canonicalize(path: impl AsRef<Path>) -> std::io::Result<PathBuf> {
        let path = std::fs::canonicalize(path)?;
        Ok(path.to_str().and_then(crate::verbatim::without_prefix).map_or(path, PathBuf::from))
    }

    /// Returns true if an entry exists at the path.
    #[must_use]
    pub fn exists(path: &Path) -> bool {
        path.exists()
    }

    /// Returns true for a regular file, links followed.
    #[must_use]
    pub fn is_file(path: &Path) -> bool {
        path.is_file()
    }

    /// Returns true for a folder, links followed.
    #[must_use]
    pub fn is_dir(path: &Path) -> bool {
        path.is_dir()
    }

    /// Reads bytes at an offset, also from several threads at a time.
    ///
    /// # Errors
    /// When the file ends before, or cannot be read.
    #[cfg(unix)]
    pub fn read_exact_at(file: &File, bytes: &mut [u8], offset: u64) -> std::io::Result<()> {
        std::os::unix::fs::FileExt::read_exact_at(file, bytes, offset)
    }

    /// Reads bytes at an offset, also from several threads at a time.
    ///
    /// # Errors
    /// When the file ends before, or cannot be read.
    #[cfg(windows)]
    pub fn read_exact_at(
        file: &File,
        mut bytes: &mut [u8],
        mut offset: u64,
    ) -> std::io::Result<()> {
        while !bytes.is_empty() {
            let count = std::os::windows::fs::FileExt::seek_read(file, bytes, offset)?;
            if count == 0 {
                return Err(std::io::ErrorKind::UnexpectedEof.into());
            }
            bytes = &mut bytes[count..];
            offset += count as u64;
        }
        Ok(())
    }

    /// Folder for temporary files.
    #[must_use]
    pub fn temp_dir() -> PathBuf {
        std::env::temp_dir()
    }
}

#[cfg(not(target_family = "wasm"))]
pub use system::{
    File, canonicalize, create_dir_all, exists, is_dir, is_file, metadata, read, read_dir,
    read_exact_at, remove_dir_all, remove_file, rename, temp_dir, write,
};

#[cfg(target_family = "wasm")]
pub use crate::memory_fs::{
    File, canonicalize, create_dir_all, exists, is_dir, is_file, metadata, read, read_dir,
    read_exact_at, remove_dir_all, remove_file, rename, temp_dir, write,
};
