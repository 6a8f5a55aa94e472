//! Compression of chunks.

use std::io::{self, Write as _};

use bzip2::read::BzDecoder;
use bzip2::write::BzEncoder;
use lz4_flex::frame::{BlockMode, BlockSize, FrameDecoder, FrameEncoder, FrameInfo};

use super::{op, record};
use crate::compression::read;
use crate::record::Cursor;

/// Compression of chunks of a ROS 1 bag.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ros1Compression {
    /// No compression, the default of `rosbag record`.
    #[default]
    None,
    /// bzip2: small and very slow.
    Bz2,
    /// LZ4 frames in the form that `roslz4` reads.
    Lz4,
}

impl Ros1Compression {
    /// Name of the compression in a chunk.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Bz2 => "bz2",
            Self::Lz4 => "lz4",
        }
    }

    /// Parses the name of the compression in a chunk.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::None, Self::Bz2, Self::Lz4].into_iter().find(|one| one.name() == name)
    }

    pub(super) fn pack(self, bytes: &[u8], packed: &mut Vec<u8>) -> io::Result<()> {
        packed.clear();
        match self {
            Self::None => packed.extend_from_slice(bytes),
            Self::Bz2 => {
                let mut encoder = BzEncoder::new(packed, bzip2::Compression::best());
                encoder.write_all(bytes)?;
                encoder.finish()?;
            }
            Self::Lz4 => {
                // roslz4 requires independent blocks, a checksum at the end and no content size.
                let frame = FrameInfo::new()
                    .block_size(BlockSize::Max1MB)
                    .block_mode(BlockMode::Independent)
                    .content_checksum(true);
                let mut encoder = FrameEncoder::with_frame_info(frame, packed);
                encoder.write_all(bytes)?;
                encoder.finish()?;
            }
        }
        Ok(())
    }

    /// Decompresses as much as possible, at most one byte more than `length`; returns the error
    /// that ended it.
    fn unpack_some(self, packed: &[u8], length: u64) -> (Vec<u8>, io::Result<()>) {
        let mut bytes = Vec::new();
        let outcome = match self {
            Self::None => read(packed, length, &mut bytes),
            Self::Bz2 => read(BzDecoder::new(packed), length, &mut bytes),
            Self::Lz4 => read(FrameDecoder::new(packed), length, &mut bytes),
        };
        (bytes, outcome)
    }
}

/// Decompresses the records of a chunk from its record; of a truncated one as many bytes as
/// possible.
pub(crate) fn unpack_record(stored: &[u8], is_cut: bool, most: u64) -> io::Result<Vec<u8>> {
    let wrong = |message: String| io::Error::new(io::ErrorKind::InvalidData, message);
    let mut cursor = Cursor::new(stored);
    let header = cursor.bytes().map(record::Header::new);
    let header = header.filter(|header| header.opcode() == Some(op::CHUNK));
    let header =
        header.ok_or_else(|| wrong("the index refers to an offset without a chunk".into()))?;
    let name = header.text("compression").unwrap_or_default();
    let compression = Ros1Compression::from_name(&name)
        .ok_or_else(|| wrong(format!("`{name}` is not a known compression")))?;
    let length = u64::from(header.u32("size").unwrap_or(0));
    if length > most {
        return Err(wrong(format!("a chunk has {length} bytes, more than the limit")));
    }
    let announced = cursor.u32().unwrap_or(0) as usize;
    let packed = cursor.rest();
    let packed = &packed[..announced.min(packed.len())];
    let (bytes, outcome) = compression.unpack_some(packed, length);
    if is_cut {
        return Ok(bytes);
    }
    outcome.map_err(|error| wrong(format!("a chunk cannot be decompressed: {error}")))?;
    if bytes.len() as u64 != length {
        let many = bytes.len();
        return Err(wrong(format!("a chunk declares {length} bytes but has {many}")));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_packed_is_unpacked() {
        let bytes: Vec<u8> = (0..300_000_u32).map(|i| (i / 7 % 251) as u8).collect();
        for compression in [Ros1Compression::None, Ros1Compression::Bz2, Ros1Compression::Lz4] {
            let mut packed = Vec::new();
            compression.pack(&bytes, &mut packed).unwrap();
            let (again, outcome) = compression.unpack_some(&packed, 300_000);
            assert!(outcome.is_ok() && again == bytes);
            assert_eq!(Ros1Compression::from_name(compression.name()), Some(compression));
        }
    }
}
