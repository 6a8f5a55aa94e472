//! How the bytes of a chunk are packed.

use std::io::{self, Write as _};

use bzip2::read::BzDecoder;
use bzip2::write::BzEncoder;
use lz4_flex::frame::{BlockMode, BlockSize, FrameDecoder, FrameEncoder, FrameInfo};

use super::{op, record};
use crate::compression::read;
use crate::record::Cursor;

/// How the chunks of a bag of ROS 1 are packed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ros1Compression {
    /// As they are, as `rosbag record` has it by itself.
    #[default]
    None,
    /// bzip2: small and very slow.
    Bz2,
    /// LZ4 frames of the kind that `roslz4` reads.
    Lz4,
}

impl Ros1Compression {
    /// The name that a chunk carries.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Bz2 => "bz2",
            Self::Lz4 => "lz4",
        }
    }

    /// From the name that a chunk carries.
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
                // Blocks of their own, a sum at the end and no length: others it refuses.
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

    /// As much as comes out, at most one byte more than `length`, and why no more.
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

/// The records of a chunk, given its record; of one that is cut as many bytes as come out.
pub(crate) fn unpack_record(stored: &[u8], is_cut: bool, most: u64) -> io::Result<Vec<u8>> {
    let wrong = |message: String| io::Error::new(io::ErrorKind::InvalidData, message);
    let mut cursor = Cursor::new(stored);
    let header = cursor.bytes().map(record::Header::new);
    let header = header.filter(|header| header.opcode() == Some(op::CHUNK));
    let header = header.ok_or_else(|| wrong("no chunk is where the index names one".into()))?;
    let name = header.text("compression").unwrap_or_default();
    let compression = Ros1Compression::from_name(&name)
        .ok_or_else(|| wrong(format!("`{name}` is no known compression")))?;
    let length = u64::from(header.u32("size").unwrap_or(0));
    if length > most {
        return Err(wrong(format!("a chunk holds {length} bytes, more than is allowed")));
    }
    let announced = cursor.u32().unwrap_or(0) as usize;
    let packed = cursor.rest();
    let packed = &packed[..announced.min(packed.len())];
    let (bytes, outcome) = compression.unpack_some(packed, length);
    if is_cut {
        return Ok(bytes);
    }
    outcome.map_err(|error| wrong(format!("a chunk cannot be unpacked: {error}")))?;
    if bytes.len() as u64 != length {
        let many = bytes.len();
        return Err(wrong(format!("a chunk announces {length} bytes and holds {many}")));
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
