//! Compression of single messages.
//!
//! ROS 2 messages start with a zero byte, so that the magic number of a compression format is
//! unambiguous.

use std::io::Read;

use crate::files::write::Packing;
use crate::zstandard;

/// Compression of a message, if any.
pub(crate) fn packing_of(data: &[u8]) -> Option<Packing> {
    [Packing::Zstd, Packing::Lz4].into_iter().find(|packing| data.starts_with(&packing.magic()))
}

/// Maximum size of a decompressed message \[bytes\]; protects against small messages that
/// decompress to any size.
const LARGEST: u64 = 256 << 20;

/// Decompresses a message into `out`.
pub(crate) fn unpack(packing: Packing, data: &[u8], out: &mut Vec<u8>) -> Result<(), String> {
    out.clear();
    let read = match packing {
        Packing::Zstd => zstandard::decoder_of(data)
            .and_then(|decoder| decoder.take(LARGEST + 1).read_to_end(out)),
        Packing::Lz4 => lz4_flex::frame::FrameDecoder::new(data).take(LARGEST + 1).read_to_end(out),
    };
    read.map_err(|error| error.to_string())?;
    if out.len() as u64 > LARGEST {
        return Err(format!("it has more than {LARGEST} bytes"));
    }
    Ok(())
}
