//! PNG.

use std::io::Cursor;

use crate::raster::{BadImage, Layout, Raster, within_limits};

pub(crate) fn decode(bytes: &[u8]) -> Result<Raster, BadImage> {
    let bad = |error: png::DecodingError| BadImage(format!("it is a broken PNG: {error}"));
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(bad)?;
    let (width, height) = (reader.info().width, reader.info().height);
    let (colour, depth) = reader.output_color_type();
    let is_deep = depth == png::BitDepth::Sixteen;
    within_limits(width, height, colour.samples() * if is_deep { 2 } else { 1 })?;
    let mut samples = vec![0; reader.output_buffer_size().unwrap_or(0)];
    let frame = reader.next_frame(&mut samples).map_err(bad)?;
    samples.truncate(frame.buffer_size());
    let layout = match frame.color_type {
        png::ColorType::Grayscale => Layout::Grey,
        png::ColorType::GrayscaleAlpha => Layout::GreyAlpha,
        // Palettes are expanded to colours.
        png::ColorType::Rgb | png::ColorType::Indexed => Layout::Rgb,
        png::ColorType::Rgba => Layout::Rgba,
    };
    Ok(Raster { width, height, layout, is_deep, bytes: samples })
}
