//! JPEG.

use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::raster::{BadImage, Layout, MAX_SIDE_PX, Raster, within_limits};

pub(crate) fn decode(bytes: &[u8]) -> Result<Raster, BadImage> {
    let options = DecoderOptions::default()
        // Without SIMD, so that every machine gives the same bits.
        .set_use_unsafe(false)
        .set_max_width(MAX_SIDE_PX as usize)
        .set_max_height(MAX_SIDE_PX as usize)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let bad = |error| BadImage(format!("it is a broken JPEG: {error}"));
    decoder.decode_headers().map_err(bad)?;
    let (width, height) = decoder.dimensions().unwrap_or((0, 0));
    let side = |length: usize| u32::try_from(length).unwrap_or(u32::MAX);
    let (width, height) = (side(width), side(height));
    within_limits(width, height, 3)?;
    let bytes = decoder.decode().map_err(bad)?;
    Ok(Raster { width, height, layout: Layout::Rgb, is_deep: false, bytes })
}
