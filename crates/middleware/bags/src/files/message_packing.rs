//! Messages that are packed one by one.
//!
//! Messages of ROS 2 begin with a zero, so the magic of a packing tells itself apart.

use std::io::Read;

use crate::files::write::Packing;

/// How a message is packed, if it is.
pub(crate) fn packing_of(data: &[u8]) -> Option<Packing> {
    [Packing::Zstd, Packing::Lz4].into_iter().find(|packing| data.starts_with(&packing.magic()))
}

/// Larger messages are refused \[bytes\]: those of ROS are far smaller, and a few kilobytes may
/// unpack to this.
const LARGEST: u64 = 256 << 20;

/// Unpacks a message into `out`.
pub(crate) fn unpack(packing: Packing, data: &[u8], out: &mut Vec<u8>) -> Result<(), String> {
    out.clear();
    let read = match packing {
        Packing::Zstd => zstd::stream::read::Decoder::with_buffer(data)
            .and_then(|decoder| decoder.take(LARGEST + 1).read_to_end(out)),
        Packing::Lz4 => lz4_flex::frame::FrameDecoder::new(data).take(LARGEST + 1).read_to_end(out),
    };
    read.map_err(|error| error.to_string())?;
    if out.len() as u64 > LARGEST {
        return Err(format!("it holds more than {LARGEST} bytes"));
    }
    Ok(())
}
