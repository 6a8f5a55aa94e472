//! Zstandard: the reference implementation in C, or in WebAssembly a reader in Rust.

#[cfg(not(target_family = "wasm"))]
mod system {
    use std::io::{self, BufReader, Read, Write};

    /// Compresses blocks one after the other, each into a frame.
    pub(crate) struct Compressor(zstd::bulk::Compressor<'static>);

    impl Compressor {
        pub(crate) fn new(level: i32) -> io::Result<Self> {
            zstd::bulk::Compressor::new(level).map(Self)
        }

        /// Compresses into an empty buffer.
        pub(crate) fn compress(&mut self, bytes: &[u8], packed: &mut Vec<u8>) -> io::Result<()> {
            packed.reserve(zstd::zstd_safe::compress_bound(bytes.len()));
            self.0.compress_to_buffer(bytes, packed).map(drop)
        }
    }

    /// Compresses a stream.
    pub(crate) fn compress_all<W: Write>(
        level: i32,
        mut plain: impl Read,
        target: W,
    ) -> io::Result<W> {
        let mut encoder = zstd::stream::write::Encoder::new(target, level)?;
        io::copy(&mut plain, &mut encoder)?;
        encoder.finish()
    }

    /// Decompresses into an empty buffer, at most as much as it has room for. None if it is more, or damaged.
    pub(crate) fn decompress_within(packed: &[u8], bytes: &mut Vec<u8>) -> Option<()> {
        zstd::bulk::Decompressor::new().ok()?.decompress_to_buffer(packed, bytes).ok().map(drop)
    }

    /// Reader of decompressed bytes.
    pub(crate) fn decoder<R: Read>(
        source: R,
    ) -> io::Result<zstd::stream::read::Decoder<'static, BufReader<R>>> {
        zstd::stream::read::Decoder::new(source)
    }

    /// Reader of the decompressed bytes of a slice.
    pub(crate) fn decoder_of(
        packed: &[u8],
    ) -> io::Result<zstd::stream::read::Decoder<'static, &[u8]>> {
        zstd::stream::read::Decoder::with_buffer(packed)
    }
}

#[cfg(not(target_family = "wasm"))]
pub(crate) use system::{Compressor, compress_all, decoder, decoder_of, decompress_within};

#[cfg(target_family = "wasm")]
mod portable {
    use std::io::{self, BufRead, BufReader, ErrorKind, Read, Write};

    use ruzstd::decoding::FrameDecoder;
    use ruzstd::decoding::StreamingDecoder;

    fn no_writer() -> io::Error {
        let why = "Zstandard is not written in a browser tab; choose LZ4 or no compression";
        io::Error::new(ErrorKind::Unsupported, why)
    }

    fn damaged(error: impl ToString) -> io::Error {
        io::Error::new(ErrorKind::InvalidData, error.to_string())
    }

    /// Refuses to compress: the writers in Rust give other bytes than the one in C.
    pub(crate) struct Compressor;

    impl Compressor {
        pub(crate) fn new(_level: i32) -> io::Result<Self> {
            Err(no_writer())
        }

        pub(crate) fn compress(&mut self, _: &[u8], _: &mut Vec<u8>) -> io::Result<()> {
            Err(no_writer())
        }
    }

    pub(crate) fn compress_all<W: Write>(_: i32, _: impl Read, _: W) -> io::Result<W> {
        Err(no_writer())
    }

    /// Decompresses into an empty buffer, at most as much as it has room for. None if it is more, or damaged.
    pub(crate) fn decompress_within(packed: &[u8], bytes: &mut Vec<u8>) -> Option<()> {
        let most = bytes.capacity();
        decoder_of(packed).ok()?.take(most as u64 + 1).read_to_end(bytes).ok()?;
        (bytes.len() <= most).then_some(())
    }

    pub(crate) fn decoder<R: Read>(source: R) -> io::Result<Frames<BufReader<R>>> {
        Frames::new(BufReader::new(source))
    }

    pub(crate) fn decoder_of(packed: &[u8]) -> io::Result<Frames<&[u8]>> {
        Frames::new(packed)
    }

    /// Reader of all frames of a source.
    pub(crate) struct Frames<R: BufRead>(Option<StreamingDecoder<R, FrameDecoder>>);

    impl<R: BufRead> Frames<R> {
        fn new(source: R) -> io::Result<Self> {
            StreamingDecoder::new(source).map(|decoder| Self(Some(decoder))).map_err(damaged)
        }
    }

    impl<R: BufRead> Read for Frames<R> {
        fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
            while let Some(decoder) = &mut self.0 {
                let count = decoder.read(bytes)?;
                if count > 0 || bytes.is_empty() {
                    return Ok(count);
                }
                let Some(decoder) = self.0.take() else { break };
                let mut source = decoder.into_inner();
                if !source.fill_buf()?.is_empty() {
                    self.0 = Some(StreamingDecoder::new(source).map_err(damaged)?);
                }
            }
            Ok(0)
        }
    }
}

#[cfg(target_family = "wasm")]
pub(crate) use portable::{Compressor, compress_all, decoder, decoder_of, decompress_within};
