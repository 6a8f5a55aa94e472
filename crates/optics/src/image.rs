//! Pictures from bytes.

use std::fmt;
use std::io::Cursor;

use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// More pixels than this are no texture but an attack on memory: 8192 by 8192.
const MOST_PIXELS: usize = 1 << 26;
/// No side is longer.
const LONGEST_SIDE: u32 = 1 << 16;

/// A picture of eight bits a channel, its first row at the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Red, green, blue, alpha, row by row.
    pub rgba: Vec<[u8; 4]>,
}

/// Brightness alone, as heightmaps have it: the first channel, in up to 16 bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grey {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Brightness, row by row from the top.
    pub values: Vec<u16>,
}

/// Why bytes are no picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadImage(String);

impl fmt::Display for BadImage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for BadImage {}

/// Samples as a file holds them.
struct Raw {
    width: u32,
    height: u32,
    /// 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha.
    channels: usize,
    samples: Samples,
}

enum Samples {
    Eight(Vec<u8>),
    /// Most significant byte first.
    Sixteen(Vec<u8>),
}

impl Image {
    /// Reads a PNG or a JPEG; of 16 bits a channel the upper 8 count.
    ///
    /// # Errors
    /// When the bytes are neither, broken, or of more than 2^26 pixels.
    pub fn decode(bytes: &[u8]) -> Result<Self, BadImage> {
        let raw = decode(bytes)?;
        let all = match &raw.samples {
            Samples::Eight(samples) => samples.clone(),
            Samples::Sixteen(samples) => samples.chunks_exact(2).map(|pair| pair[0]).collect(),
        };
        let rgba = all.chunks_exact(raw.channels).map(|pixel| match *pixel {
            [grey] => [grey, grey, grey, 255],
            [grey, alpha] => [grey, grey, grey, alpha],
            [r, g, b] => [r, g, b, 255],
            [r, g, b, alpha] => [r, g, b, alpha],
            _ => [0, 0, 0, 255],
        });
        Ok(Self { width: raw.width, height: raw.height, rgba: rgba.collect() })
    }
}

impl Grey {
    /// Reads a PNG or a JPEG.
    ///
    /// # Errors
    /// As [`Image::decode`].
    pub fn decode(bytes: &[u8]) -> Result<Self, BadImage> {
        let Raw { width, height, channels, samples } = decode(bytes)?;
        let values = match samples {
            Samples::Eight(samples) => {
                samples.chunks_exact(channels).map(|pixel| u16::from(pixel[0])).collect()
            }
            Samples::Sixteen(samples) => samples
                .chunks_exact(2 * channels)
                .map(|pixel| u16::from_be_bytes([pixel[0], pixel[1]]))
                .collect(),
        };
        Ok(Self { width, height, values })
    }
}

fn decode(bytes: &[u8]) -> Result<Raw, BadImage> {
    let raw = if bytes.starts_with(&[0x89, b'P', b'N', b'G']) {
        decode_png(bytes)?
    } else if bytes.starts_with(&[0xff, 0xd8]) {
        decode_jpeg(bytes)?
    } else {
        return Err(BadImage("it is neither PNG nor JPEG; convert it to one of them".into()));
    };
    let pixels = raw.width as usize * raw.height as usize;
    let per_pixel = raw.channels * if matches!(raw.samples, Samples::Sixteen(_)) { 2 } else { 1 };
    let (Samples::Eight(samples) | Samples::Sixteen(samples)) = &raw.samples;
    if pixels == 0 || samples.len() != pixels * per_pixel {
        return Err(BadImage("it holds fewer pixels than its header says".into()));
    }
    Ok(raw)
}

/// Refuses what would not fit before memory is asked for.
fn within_limits(width: u32, height: u32) -> Result<(), BadImage> {
    if width <= LONGEST_SIDE
        && height <= LONGEST_SIDE
        && width as usize * height as usize <= MOST_PIXELS
    {
        return Ok(());
    }
    Err(BadImage(format!(
        "it has {width} by {height} pixels, more than {MOST_PIXELS} in all; scale it down"
    )))
}

fn decode_png(bytes: &[u8]) -> Result<Raw, BadImage> {
    let bad = |error: png::DecodingError| BadImage(format!("it is a broken PNG: {error}"));
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(bad)?;
    let (width, height) = (reader.info().width, reader.info().height);
    within_limits(width, height)?;
    let size = reader.output_buffer_size().unwrap_or(0);
    let mut samples = vec![0; size];
    let frame = reader.next_frame(&mut samples).map_err(bad)?;
    samples.truncate(frame.buffer_size());
    let samples = match frame.bit_depth {
        png::BitDepth::Sixteen => Samples::Sixteen(samples),
        _ => Samples::Eight(samples),
    };
    Ok(Raw { width, height, channels: frame.color_type.samples(), samples })
}

fn decode_jpeg(bytes: &[u8]) -> Result<Raw, BadImage> {
    let options = DecoderOptions::default()
        // Without special instructions, so that every machine gives the same bits.
        .set_use_unsafe(false)
        .set_max_width(LONGEST_SIDE as usize)
        .set_max_height(LONGEST_SIDE as usize)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let bad = |error| BadImage(format!("it is a broken JPEG: {error}"));
    decoder.decode_headers().map_err(bad)?;
    let (width, height) = decoder.dimensions().unwrap_or((0, 0));
    let side = |length: usize| u32::try_from(length).unwrap_or(u32::MAX);
    within_limits(side(width), side(height))?;
    let samples = decoder.decode().map_err(bad)?;
    Ok(Raw {
        width: side(width),
        height: side(height),
        channels: 3,
        samples: Samples::Eight(samples),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn png_of(colour: png::ColorType, depth: png::BitDepth, bytes: &[u8]) -> Vec<u8> {
        let mut out = Vec::new();
        let mut encoder = png::Encoder::new(&mut out, 2, 1);
        encoder.set_color(colour);
        encoder.set_depth(depth);
        encoder.write_header().unwrap().write_image_data(bytes).unwrap();
        out
    }

    #[test]
    fn colours_of_a_png() {
        let bytes = png_of(png::ColorType::Rgb, png::BitDepth::Eight, &[1, 2, 3, 4, 5, 6]);
        let image = Image::decode(&bytes).unwrap();
        assert_eq!((image.width, image.height), (2, 1));
        assert_eq!(image.rgba, [[1, 2, 3, 255], [4, 5, 6, 255]]);
    }

    #[test]
    fn sixteen_bits_of_grey() {
        let bytes =
            png_of(png::ColorType::Grayscale, png::BitDepth::Sixteen, &[0x12, 0x34, 0xff, 0]);
        assert_eq!(Grey::decode(&bytes).unwrap().values, [0x1234, 0xff00]);
        assert_eq!(Image::decode(&bytes).unwrap().rgba[0], [0x12, 0x12, 0x12, 255]);
    }

    #[test]
    fn broken_bytes_are_told() {
        let bytes = png_of(png::ColorType::Rgb, png::BitDepth::Eight, &[1, 2, 3, 4, 5, 6]);
        for cut in 0..bytes.len() - 12 {
            assert!(Image::decode(&bytes[..cut]).is_err(), "{cut}");
        }
        assert!(Image::decode(&[0xff, 0xd8, 0xff, 0xe0, 1, 2]).is_err());
        assert!(Image::decode(b"GIF89a").unwrap_err().to_string().contains("convert"));
    }

    #[test]
    fn giants_are_refused_before_memory_is_asked_for() {
        assert!(within_limits(8192, 8192).is_ok());
        assert!(within_limits(8193, 8192).is_err());
        assert!(within_limits(1 << 17, 1).is_err());
    }
}
