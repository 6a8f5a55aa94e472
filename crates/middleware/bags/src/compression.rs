//! Compression of chunks.

use std::io::{self, Read, Write as _};

use lz4_flex::frame::{BlockSize, FrameDecoder, FrameEncoder, FrameInfo};

use crate::zstandard;

/// Compression of chunks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compression {
    /// No compression.
    None,
    /// LZ4 frames; the default in WebAssembly.
    #[cfg_attr(target_family = "wasm", default)]
    Lz4,
    /// Zstandard at level 1. In WebAssembly it is read, but not written.
    #[cfg_attr(not(target_family = "wasm"), default)]
    Zstd,
}

/// Zstandard level: 1 compresses our streams as well as 3 and takes half the time.
const ZSTD_LEVEL: i32 = 1;

impl Compression {
    /// Name of the compression in a chunk.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Lz4 => "lz4",
            Self::Zstd => "zstd",
        }
    }

    /// Parses the name of the compression in a chunk.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::None, Self::Lz4, Self::Zstd].into_iter().find(|one| one.name() == name)
    }
}

/// Compresses chunks one after the other. The same chunks give the same bytes.
pub(crate) struct Packer {
    compression: Compression,
    zstd: Option<zstandard::Compressor>,
}

impl Packer {
    pub(crate) fn new(compression: Compression) -> io::Result<Self> {
        let zstd = match compression {
            Compression::Zstd => Some(zstandard::Compressor::new(ZSTD_LEVEL)?),
            _ => None,
        };
        Ok(Self { compression, zstd })
    }

    /// Compresses into a reused buffer, or into none without compression.
    pub(crate) fn pack(&mut self, bytes: &[u8], packed: &mut Option<Vec<u8>>) -> io::Result<()> {
        if self.compression == Compression::None {
            *packed = None;
            return Ok(());
        }
        let packed = packed.get_or_insert_default();
        packed.clear();
        match &mut self.zstd {
            Some(zstd) => zstd.compress(bytes, packed)?,
            None => {
                let blocks = FrameInfo::new()
                    .block_size(BlockSize::Max4MB)
                    .content_size(Some(bytes.len() as u64));
                let mut encoder = FrameEncoder::with_frame_info(blocks, packed);
                encoder.write_all(bytes)?;
                encoder.finish()?;
            }
        }
        Ok(())
    }
}

/// Decompresses a chunk with a declared size of `length` bytes. Memory is allocated as data
/// arrives, not by the declared size.
///
/// # Errors
/// When the bytes are damaged, or the size differs from the declared one.
pub(crate) fn unpack(compression: Compression, packed: &[u8], length: u64) -> io::Result<Vec<u8>> {
    if compression == Compression::Zstd
        && let Some(bytes) = unpack_zstd(packed, length)
    {
        return Ok(bytes);
    }
    let damaged = |why: String| io::Error::new(io::ErrorKind::InvalidData, why);
    let (bytes, outcome) = unpack_some(compression, packed, length);
    outcome.map_err(|error| damaged(format!("a chunk cannot be decompressed: {error}")))?;
    if bytes.len() as u64 != length {
        let many = bytes.len();
        return Err(damaged(format!("a chunk declares {length} bytes but has {many}")));
    }
    Ok(bytes)
}

/// Maximum length of chunks that are decompressed in one step [bytes].
const MAX_ONE_STEP_BYTES: u64 = 64 << 20;

/// Decompresses complete Zstandard data of this length in one step, which saves a copy. None if it is anything
/// else.
fn unpack_zstd(packed: &[u8], length: u64) -> Option<Vec<u8>> {
    let most = usize::try_from(length).ok().filter(|_| length <= MAX_ONE_STEP_BYTES)?;
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(most).ok()?;
    zstandard::decompress_within(packed, &mut bytes)?;
    (bytes.len() == most).then_some(bytes)
}

/// Decompresses as much as possible, at most one byte more than `length`; returns the error that
/// ended it.
pub(crate) fn unpack_some(
    compression: Compression,
    packed: &[u8],
    length: u64,
) -> (Vec<u8>, io::Result<()>) {
    let mut bytes = Vec::new();
    let outcome = match compression {
        Compression::None => read(packed, length, &mut bytes),
        Compression::Lz4 => read(FrameDecoder::new(packed), length, &mut bytes),
        Compression::Zstd => {
            zstandard::decoder_of(packed).and_then(|decoder| read(decoder, length, &mut bytes))
        }
    };
    (bytes, outcome)
}

/// Least memory that is asked for at one time \[bytes\].
const READ_STEP: usize = 1 << 20;

/// Reads at most one byte more than `length`, which shows that there are too many. Memory is at most
/// doubled at a time, and never exceeds what was announced, so that a few bytes that unpack to
/// gigabytes cost what `length` allows.
pub(crate) fn read(mut source: impl Read, length: u64, bytes: &mut Vec<u8>) -> io::Result<()> {
    let most = usize::try_from(length.saturating_add(1)).unwrap_or(usize::MAX);
    while bytes.len() < most {
        let step = bytes.len().clamp(READ_STEP, READ_STEP * 16).min(most - bytes.len());
        let before = bytes.len();
        if bytes.capacity() - before < step {
            bytes.try_reserve_exact(before.max(step).min(most - before))?;
        }
        let read = source.by_ref().take(step as u64).read_to_end(bytes)?;
        if read < step {
            break;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_packed_is_unpacked() {
        let bytes: Vec<u8> = (0..100_000_u32).map(|i| (i / 7 % 251) as u8).collect();
        for compression in [Compression::None, Compression::Lz4, Compression::Zstd] {
            let mut packer = Packer::new(compression).unwrap();
            let mut pack = || {
                let mut packed = None;
                packer.pack(&bytes, &mut packed).unwrap();
                packed.unwrap_or_else(|| bytes.clone())
            };
            let first = pack();
            assert_eq!(pack(), first, "the same again");
            assert_eq!(unpack(compression, &first, 100_000).unwrap(), bytes);
            assert!(unpack(compression, &first, 99_999).is_err(), "too long");
            assert!(unpack(compression, &first, 100_001).is_err(), "too short");
            assert!(unpack(compression, &first[..first.len() - 9], 100_000).is_err(), "cut");
            assert_eq!(Compression::from_name(compression.name()), Some(compression));
        }
        assert_eq!(Compression::from_name("bz2"), None);
    }

    #[test]
    fn memory_grows_with_what_is_announced() {
        let zeros = zstd::bulk::compress(&vec![0; 64 << 20], 1).unwrap();
        for length in [1_000, 20 << 20, 64 << 20] {
            let (bytes, outcome) = unpack_some(Compression::Zstd, &zeros, length);
            assert!(outcome.is_ok());
            let most = usize::try_from(length).unwrap() + 1;
            assert_eq!(bytes.len(), most.min(64 << 20));
            assert!(bytes.capacity() <= most + 64, "{} for {most}", bytes.capacity());
        }
    }
}
