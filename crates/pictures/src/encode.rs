//! Pictures to bytes.

use crate::raster::Layout;

/// A PNG of eight bits a sample. What does not fit together, which is a mistake of the caller's, is
/// an empty file.
#[must_use]
pub fn write_png(width: u32, height: u32, layout: Layout, samples: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(match layout {
        Layout::Grey => png::ColorType::Grayscale,
        Layout::GreyAlpha => png::ColorType::GrayscaleAlpha,
        Layout::Rgb => png::ColorType::Rgb,
        Layout::Rgba => png::ColorType::Rgba,
    });
    encoder.set_depth(png::BitDepth::Eight);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(samples)?;
        writer.finish()
    });
    debug_assert!(written.is_ok(), "{written:?}");
    if written.is_err() {
        bytes.clear();
    }
    bytes
}

/// A PGM in bytes (`P5`), with a comment behind its kind if there is one.
#[must_use]
pub fn write_pgm(width: u32, height: u32, grey: &[u8], comment: Option<&str>) -> Vec<u8> {
    let comment = comment.map_or(String::new(), |words| format!("# {words}\n"));
    let mut bytes = format!("P5\n{comment}{width} {height}\n255\n").into_bytes();
    bytes.extend_from_slice(grey);
    bytes
}

/// A BMP: grey in eight bits with a palette of 256 greys, else in 24 bits a pixel, or 32 with alpha.
#[must_use]
pub fn write_bmp(width: u32, height: u32, layout: Layout, samples: &[u8]) -> Vec<u8> {
    let (bits, colours): (u16, u32) = match layout {
        Layout::Grey => (8, 256),
        Layout::Rgb => (24, 0),
        Layout::GreyAlpha | Layout::Rgba => (32, 0),
    };
    // With alpha the header is the one that says where it is.
    let header = if layout.has_alpha() { 108_u32 } else { 40 };
    let stride = (width as usize * usize::from(bits)).div_ceil(32) * 4;
    let size = stride * height as usize;
    let pixels = 14 + header + 4 * colours;
    let mut bytes = Vec::with_capacity(pixels as usize + size);
    let long = |bytes: &mut Vec<u8>, value: u32| bytes.extend(value.to_le_bytes());
    bytes.extend(b"BM");
    long(&mut bytes, u32::try_from(pixels as usize + size).unwrap_or(u32::MAX));
    long(&mut bytes, 0);
    long(&mut bytes, pixels);
    long(&mut bytes, header);
    long(&mut bytes, width);
    long(&mut bytes, height);
    bytes.extend(1_u16.to_le_bytes());
    bytes.extend(bits.to_le_bytes());
    long(&mut bytes, if layout.has_alpha() { 3 } else { 0 });
    long(&mut bytes, u32::try_from(size).unwrap_or(u32::MAX));
    // 72 dots an inch.
    long(&mut bytes, 2834);
    long(&mut bytes, 2834);
    long(&mut bytes, colours);
    long(&mut bytes, colours);
    if layout.has_alpha() {
        for mask in [0xff_0000, 0xff00, 0xff, 0xff00_0000, u32::from_be_bytes(*b"sRGB")] {
            long(&mut bytes, mask);
        }
        bytes.extend([0; 48]);
    }
    for grey in 0..colours {
        let grey = u8::try_from(grey).unwrap_or(u8::MAX);
        bytes.extend([grey, grey, grey, 0]);
    }
    let row = width as usize * layout.channels();
    for row in samples.chunks_exact(row.max(1)).rev() {
        let start = bytes.len();
        match layout {
            Layout::Grey => bytes.extend_from_slice(row),
            Layout::Rgb => bytes.extend(row.chunks_exact(3).flat_map(|it| [it[2], it[1], it[0]])),
            Layout::GreyAlpha => {
                bytes.extend(row.chunks_exact(2).flat_map(|it| [it[0], it[0], it[0], it[1]]));
            }
            Layout::Rgba => {
                bytes.extend(row.chunks_exact(4).flat_map(|it| [it[2], it[1], it[0], it[3]]));
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
    use crate::raster::Raster;

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
            prop_assert_eq!(Raster::decode(&png).unwrap(), whole.clone());
            let bmp = Raster::decode(&write_bmp(width, height, layout, &whole.bytes)).unwrap();
            if layout == Layout::Grey || layout == Layout::Rgb {
                prop_assert_eq!(bmp, whole.clone());
            } else {
                prop_assert_eq!((bmp.width, bmp.height, bmp.layout), (width, height, Layout::Rgba));
            }
            if layout == Layout::Grey {
                let pgm = write_pgm(width, height, &whole.bytes, Some("a remark"));
                prop_assert_eq!(Raster::decode(&pgm).unwrap(), whole);
            }
        }
    }
}
