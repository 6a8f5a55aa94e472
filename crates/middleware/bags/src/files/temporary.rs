//! Temporary files, removed when they are dropped.

use std::io::{BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use periplus_os::fs::{self, File};

use crate::files::BagError;
use crate::files::write::Packing;
use crate::zstandard;

/// Maximum size of a decompressed file \[bytes\]: recorders split larger bags, and a few kilobytes
/// of Zstandard may decompress to any size.
const UNPACKED_MAX_BYTES: u64 = 64 << 30;

/// Maximum compression ratio of a file. Images without noise compress to a thousandth.
const UNPACKED_MAX_RATIO: u64 = 4_000;

/// Size from which [`UNPACKED_MAX_RATIO`] applies \[bytes\].
const UNPACKED_SMALL_BYTES: u64 = 256 << 20;

/// A decompressed temporary file, removed when dropped.
#[derive(Debug)]
pub(crate) struct Temporary {
    path: PathBuf,
}

impl Temporary {
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Reserves a name in the folder for temporary files.
    pub(crate) fn new() -> Self {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let name = format!("periplus-bag-{}-{number}", periplus_os::process_id());
        Self { path: fs::temp_dir().join(name) }
    }

    /// Decompresses a file to the folder for temporary files.
    pub(crate) fn unpack(packed: &Path, packing: Packing) -> Result<Self, BagError> {
        let temporary = Self::new();
        let source = File::open(packed).map_err(BagError::file(packed))?;
        let target = File::create_new(temporary.path()).map_err(BagError::file(&temporary.path))?;
        let mut target = BufWriter::with_capacity(1 << 20, target);
        let wrong = |error: std::io::Error| {
            let words = periplus_diagnostics::plain_words(&error);
            BagError::Unpack(packed.to_owned(), words)
        };
        let mut unpacked: Box<dyn Read> = match packing {
            Packing::Zstd => Box::new(zstandard::decoder(source).map_err(wrong)?),
            Packing::Lz4 => Box::new(lz4_flex::frame::FrameDecoder::new(source)),
        };
        let packed_bytes = fs::metadata(packed).map_err(BagError::file(packed))?.len();
        let limit = limit_bytes(packed_bytes);
        let mut written = 0_u64;
        // A truncated file is decompressed as far as possible; its reader handles the rest.
        let mut buffer = vec![0; 1 << 20];
        loop {
            match unpacked.read(&mut buffer) {
                Ok(0) | Err(_) => break,
                Ok(count) => {
                    written += count as u64;
                    if written > limit {
                        let why = format!(
                            "its {packed_bytes} bytes decompress to more than {limit}, the limit for a file of \
                             this size; decompress it yourself (`zstd -d`, `lz4 -d`) if that is intended"
                        );
                        return Err(BagError::Unpack(packed.to_owned(), why));
                    }
                    let part = buffer.get(..count).unwrap_or_default();
                    target.write_all(part).map_err(BagError::file(&temporary.path))?;
                }
            }
        }
        target.flush().map_err(BagError::file(&temporary.path))?;
        Ok(temporary)
    }
}

/// Maximum size of a decompressed file \[bytes\].
fn limit_bytes(packed_bytes: u64) -> u64 {
    let by_ratio = packed_bytes.saturating_mul(UNPACKED_MAX_RATIO);
    by_ratio.clamp(UNPACKED_SMALL_BYTES, UNPACKED_MAX_BYTES)
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // A failure cannot be handled here.
        let _ = fs::remove_file(&self.path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Regression test: zeros compress to almost nothing, so that a file of some kilobytes filled
    /// the disk.
    #[test]
    fn a_file_that_unpacks_to_far_more_than_it_holds_is_refused() {
        let name = format!("periplus-bag-test-{}.zst", std::process::id());
        let path = std::env::temp_dir().join(name);
        let mut encoder = zstd::stream::write::Encoder::new(Vec::new(), 1).unwrap();
        let zeros = vec![0; 1 << 20];
        for _ in 0..(UNPACKED_SMALL_BYTES >> 20) + 1 {
            encoder.write_all(&zeros).unwrap();
        }
        let packed = encoder.finish().unwrap();
        assert!(packed.len() < 1 << 16, "{}", packed.len());
        fs::write(&path, packed).unwrap();
        let told = Temporary::unpack(&path, Packing::Zstd).map(|_| ()).unwrap_err().to_string();
        let _ = fs::remove_file(&path);
        assert!(told.contains("decompress to more than 268435456"), "{told}");
    }

    #[test]
    fn the_limit_follows_the_size_of_the_packed_file() {
        assert_eq!(limit_bytes(1), UNPACKED_SMALL_BYTES);
        assert_eq!(limit_bytes(1 << 20), 4_000 << 20);
        assert_eq!(limit_bytes(u64::MAX), UNPACKED_MAX_BYTES);
    }
}
