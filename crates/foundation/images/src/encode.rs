//! Encoding of images.

use std::io::{self, Write};

use crate::raster::Layout;

/// Encodes a PNG with eight bits per sample. Arguments that do not match, a mistake of the caller, give an
/// empty file.
#[must_use]
pub fn write_png(width: u32, height: u32, layout: Layout, samples: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let written =
        encoder(&mut bytes, width, height, layout).write_header().and_then(|mut writer| {
            writer.write_image_data(samples)?;
            writer.finish()
        });
    debug_assert!(written.is_ok(), "{written:?}");
    if written.is_err() {
        bytes.clear();
    }
    bytes
}

/// Encodes a PNG with eight bits per sample from samples that are written piecewise, row by row from the
/// top. Only the compressed image is held in memory.
///
/// # Errors
/// Errors of `samples`, and missing rows or an image without pixels.
pub fn pack_png(
    width: u32,
    height: u32,
    layout: Layout,
    samples: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut writer = encoder(&mut bytes, width, height, layout).write_header()?;
    let mut stream = writer.stream_writer()?;
    samples(&mut stream)?;
    stream.finish()?;
    writer.finish()?;
    Ok(bytes)
}

fn encoder<W: Write>(out: W, width: u32, height: u32, layout: Layout) -> png::Encoder<'static, W> {
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(match layout {
        Layout::Grey => png::ColorType::Grayscale,
        Layout::GreyAlpha => png::ColorType::GrayscaleAlpha,
        Layout::Rgb => png::ColorType::Rgb,
        Layout::Rgba => png::ColorType::Rgba,
    });
    encoder.set_depth(png::BitDepth::Eight);
    encoder
}

/// Encodes a binary PGM (`P5`), with an optional comment after the format.
#[must_use]
pub fn write_pgm(width: u32, height: u32, grey: &[u8], comment: Option<&str>) -> Vec<u8> {
    let mut bytes = pgm_head(width, height, comment).into_bytes();
    bytes.extend_from_slice(grey);
    bytes
}

/// Header of a binary PGM; brightness follows, one byte per pixel, row by row from the top.
#[must_use]
pub fn pgm_head(width: u32, height: u32, comment: Option<&str>) -> String {
    let comment = comment.map_or(String::new(), |words| format!("# {words}\n"));
    format!("P5\n{comment}{width} {height}\n255\n")
}

/// Encodes a BMP as `GraphicsMagick` does, byte for byte: 24 bits per pixel, grey or not, and 32 with
/// alpha.
#[must_use]
pub fn write_bmp(width: u32, height: u32, layout: Layout, samples: &[u8]) -> Vec<u8> {
    /// Resolution [px/m].
    const PIXELS_PER_M: u32 = 2925;
    let has_alpha = layout.has_alpha();
    let bits: u16 = if has_alpha { 32 } else { 24 };
    // The header for alpha has the mask of the alpha channel.
    let (header, compression) = if has_alpha { (108_u32, 3) } else { (40, 0) };
    let stride = (width as usize * usize::from(bits)).div_ceil(32) * 4;
    let size = stride * height as usize;
    let pixels = 14 + header as usize;
    let long = |bytes: &mut Vec<u8>, value: u32| bytes.extend(value.to_le_bytes());
    let length = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
    let mut bytes = Vec::with_capacity(pixels + size);
    bytes.extend(b"BM");
    for value in [length(pixels + size), 0, length(pixels), header, width, height] {
        long(&mut bytes, value);
    }
    bytes.extend(1_u16.to_le_bytes());
    bytes.extend(bits.to_le_bytes());
    for value in [compression, length(size), PIXELS_PER_M, PIXELS_PER_M, 0, 0] {
        long(&mut bytes, value);
    }
    if has_alpha {
        // Masks of red, green, blue and alpha; then an unspecified colour space.
        for value in [0xff_0000, 0xff00, 0xff, 0xff00_0000, 1] {
            long(&mut bytes, value);
        }
        for value in [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0] {
            long(&mut bytes, value);
        }
    }
    let row = width as usize * layout.channels();
    for row in samples.chunks_exact(row.max(1)).rev() {
        let start = bytes.len();
        for pixel in row.chunks_exact(layout.channels()) {
            match *pixel {
                [grey] => bytes.extend([grey; 3]),
                [grey, alpha] => bytes.extend([grey, grey, grey, alpha]),
                [r, g, b] => bytes.extend([b, g, r]),
                [r, g, b, alpha] => bytes.extend([b, g, r, alpha]),
                _ => {}
            }
        }
        bytes.resize(start + stride, 0);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::decode::Image;
    use crate::raster::Raster;

    /// Made by Magick++ 1.3.40 from a picture of type Grayscale and one of type TrueColorMatte.
    #[test]
    fn a_bmp_is_that_of_graphicsmagick() {
        let grey = "424d3e0000000000000036000000280000000100000002000000010018000000000008000000\
                    6d0b00006d0b00000000000000000000fefefe00cdcdcd00";
        assert_eq!(hex(&write_bmp(1, 2, Layout::Grey, &[205, 254])), grey);
        let rgba = "424d7e000000000000007a0000006c0000000100000001000000010020000300000004000000\
                    6d0b00006d0b000000000000000000000000ff0000ff0000ff000000000000ff010000000000\
                    0000000000000100000000000000000000000100000000000000000000000100000000000000\
                    00000000000000007f7f7f00";
        assert_eq!(hex(&write_bmp(1, 1, Layout::Rgba, &[127, 127, 127, 0])), rgba);
    }

    fn hex(bytes: &[u8]) -> String {
        bytes.iter().map(|byte| format!("{byte:02x}")).collect()
    }

    proptest! {
        #[test]
        fn what_is_written_is_read_again(
            width in 1..9_u32, height in 1..9_u32, channels in 1..5_usize, seed in any::<u8>(),
        ) {
            let layout = [Layout::Grey, Layout::GreyAlpha, Layout::Rgb, Layout::Rgba][channels - 1];
            let count = width as usize * height as usize * channels;
            let bytes: Vec<u8> =
                (0..count).map(|at| (at as u8).wrapping_mul(37).wrapping_add(seed)).collect();
            let whole = Raster { width, height, layout, is_deep: false, bytes };
            let png = write_png(width, height, layout, &whole.bytes);
            prop_assert_eq!(&Raster::decode(&png).unwrap(), &whole);
            let mut rows = whole.bytes.chunks(width as usize * channels);
            let packed = pack_png(width, height, layout, |out| {
                rows.try_for_each(|row| out.write_all(row))
            });
            prop_assert_eq!(&Raster::decode(&packed.unwrap()).unwrap(), &whole);
            let bmp = write_bmp(width, height, layout, &whole.bytes);
            prop_assert_eq!(Image::decode(&bmp).unwrap(), Image::decode(&png).unwrap());
            if layout == Layout::Grey {
                let pgm = write_pgm(width, height, &whole.bytes, Some("a remark"));
                prop_assert_eq!(&Raster::decode(&pgm).unwrap(), &whole);
            }
        }
    }
}
