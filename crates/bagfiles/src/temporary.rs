//! Files that are gone when nobody needs them any more.

use std::fs::{self, File};
use std::io::{BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use crate::BagError;
use crate::write::Packing;

/// A file unpacked beside others of its kind, removed when dropped.
#[derive(Debug)]
pub(crate) struct Temporary {
    path: PathBuf,
}

impl Temporary {
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Unpacks a file to the folder for temporary files.
    pub(crate) fn unpack(packed: &Path, packing: Packing) -> Result<Self, BagError> {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let name = format!("periplus-bag-{}-{number}", std::process::id());
        let temporary = Self { path: std::env::temp_dir().join(name) };
        let source = File::open(packed).map_err(BagError::file(packed))?;
        let target = File::create_new(temporary.path()).map_err(BagError::file(&temporary.path))?;
        let mut target = BufWriter::with_capacity(1 << 20, target);
        let wrong = |error: std::io::Error| {
            let words = periplus_diagnostics::plain_words(&error);
            BagError::Unpack(packed.to_owned(), words)
        };
        let mut unpacked: Box<dyn Read> = match packing {
            Packing::Zstd => Box::new(zstd::stream::read::Decoder::new(source).map_err(wrong)?),
            Packing::Lz4 => Box::new(lz4_flex::frame::FrameDecoder::new(source)),
        };
        // Of a file that is cut as much as comes out: its reader knows what to do with it.
        let mut buffer = vec![0; 1 << 20];
        loop {
            match unpacked.read(&mut buffer) {
                Ok(0) | Err(_) => break,
                Ok(count) => {
                    let part = buffer.get(..count).unwrap_or_default();
                    target.write_all(part).map_err(BagError::file(&temporary.path))?;
                }
            }
        }
        target.flush().map_err(BagError::file(&temporary.path))?;
        Ok(temporary)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // Nobody can do more about it here.
        let _ = fs::remove_file(&self.path);
    }
}
