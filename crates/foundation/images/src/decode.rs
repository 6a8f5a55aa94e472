//! Decoding to colours and to brightness.

use crate::raster::{BadImage, Layout, Raster};

/// Maximum number of pixels: 8192 by 8192. More are not a texture but an attack on memory.
const MAX_PIXELS: usize = 1 << 26;

/// Image with eight bits per channel, first row at the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Width [px].
    pub width: u32,
    /// Height [px].
    pub height: u32,
    /// Red, green, blue, alpha, row by row.
    pub rgba: Vec<[u8; 4]>,
}

/// Brightness image, as used for heightmaps: the first channel, with up to 16 bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grey {
    /// Width [px].
    pub width: u32,
    /// Height [px].
    pub height: u32,
    /// Brightness, row by row from the top.
    pub values: Vec<u16>,
}

impl Image {
    /// Decodes a PNG, JPEG, BMP or PNM; 16 bits per channel are reduced to 8.
    ///
    /// # Errors
    /// If the bytes are none of these, broken, or have more than 2^26 pixels.
    pub fn decode(bytes: &[u8]) -> Result<Self, BadImage> {
        let raster = decode(bytes)?.into_shallow();
        let pixels = raster.bytes.chunks_exact(raster.layout.channels());
        let rgba = pixels.map(|pixel| match (raster.layout, pixel) {
            (Layout::Grey, &[grey]) => [grey, grey, grey, 255],
            (Layout::GreyAlpha, &[grey, alpha]) => [grey, grey, grey, alpha],
            (Layout::Rgb, &[r, g, b]) => [r, g, b, 255],
            (Layout::Rgba, &[r, g, b, alpha]) => [r, g, b, alpha],
            _ => [0, 0, 0, 255],
        });
        Ok(Self { width: raster.width, height: raster.height, rgba: rgba.collect() })
    }
}

impl Grey {
    /// Decodes a PNG, JPEG, BMP or PNM.
    ///
    /// # Errors
    /// As [`Image::decode`].
    pub fn decode(bytes: &[u8]) -> Result<Self, BadImage> {
        let raster = decode(bytes)?;
        let channels = raster.layout.channels();
        let values = if raster.is_deep {
            let pixels = raster.bytes.chunks_exact(2 * channels);
            pixels.map(|pixel| u16::from_be_bytes([pixel[0], pixel[1]])).collect()
        } else {
            raster.bytes.chunks_exact(channels).map(|pixel| u16::from(pixel[0])).collect()
        };
        Ok(Self { width: raster.width, height: raster.height, values })
    }
}

fn decode(bytes: &[u8]) -> Result<Raster, BadImage> {
    let raster = Raster::decode(bytes)?;
    if raster.pixels() > MAX_PIXELS {
        let (width, height) = (raster.width, raster.height);
        return Err(BadImage(format!(
            "it has {width} by {height} pixels, more than {MAX_PIXELS} in all; scale it down"
        )));
    }
    Ok(raster)
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
}
