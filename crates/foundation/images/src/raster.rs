//! Images with the samples of the file.

use std::fmt;

/// Maximum length of a side [px].
pub const MAX_SIDE_PX: u32 = 1 << 16;

/// Maximum size of the samples [bytes]: 16,384 by 16,384 in grey, 8,192 by 8,192 in colour with alpha.
pub const MAX_SAMPLE_BYTES: usize = 1 << 28;

/// Samples of a pixel, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// Brightness.
    Grey,
    /// Brightness, opacity.
    GreyAlpha,
    /// Red, green, blue.
    Rgb,
    /// Red, green, blue, opacity.
    Rgba,
}

impl Layout {
    /// Number of samples per pixel.
    #[must_use]
    pub fn channels(self) -> usize {
        match self {
            Self::Grey => 1,
            Self::GreyAlpha => 2,
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }

    /// Returns true if the last sample of a pixel is its opacity.
    #[must_use]
    pub fn has_alpha(self) -> bool {
        matches!(self, Self::GreyAlpha | Self::Rgba)
    }
}

/// Image, first row at the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raster {
    /// Width [px].
    pub width: u32,
    /// Height [px].
    pub height: u32,
    /// Samples of a pixel.
    pub layout: Layout,
    /// True if a sample has sixteen bits, most significant byte first; else eight.
    pub is_deep: bool,
    /// Samples, pixel by pixel, row by row.
    pub bytes: Vec<u8>,
}

/// Error of an image that cannot be decoded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadImage(pub(crate) String);

impl fmt::Display for BadImage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for BadImage {}

impl Raster {
    /// Decodes a PNG, JPEG, BMP or PNM. Palettes are expanded, and fewer than eight bits are scaled to
    /// eight.
    ///
    /// # Errors
    /// If the bytes are none of these, broken, or too large.
    pub fn decode(bytes: &[u8]) -> Result<Self, BadImage> {
        let raster = match bytes {
            [0x89, b'P', b'N', b'G', ..] => crate::png_file::decode(bytes)?,
            [0xff, 0xd8, ..] => crate::jpeg::decode(bytes)?,
            [b'B', b'M', ..] => crate::bmp::decode(bytes)?,
            [b'P', b'1'..=b'6', ..] => crate::pnm::decode(bytes)?,
            _ => {
                return Err(BadImage(
                    "it is neither PNG, JPEG, BMP nor PGM; convert it to one of them".into(),
                ));
            }
        };
        let expected = raster.pixels() * raster.bytes_per_pixel();
        if expected == 0 || raster.bytes.len() != expected {
            return Err(BadImage("it has fewer pixels than its header declares".into()));
        }
        Ok(raster)
    }

    /// Number of pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.width as usize * self.height as usize
    }

    fn bytes_per_pixel(&self) -> usize {
        self.layout.channels() * if self.is_deep { 2 } else { 1 }
    }

    /// Samples of a pixel, counted from the first of the top row.
    #[must_use]
    pub fn sample(&self, pixel: usize) -> &[u8] {
        let size = self.bytes_per_pixel();
        &self.bytes[pixel * size..(pixel + 1) * size]
    }

    /// Returns the image with eight bits per sample, rounded down as `GraphicsMagick` does.
    #[must_use]
    pub fn into_shallow(self) -> Self {
        if !self.is_deep {
            return self;
        }
        let shallow = |pair: &[u8]| u16::from_be_bytes([pair[0], pair[1]]) / 257;
        let samples = self.bytes.chunks_exact(2).map(shallow);
        let bytes = samples.map(|it| u8::try_from(it).unwrap_or(u8::MAX)).collect();
        Self { is_deep: false, bytes, ..self }
    }
}

/// Refuses images that are too large, before memory is allocated.
pub(crate) fn within_limits(width: u32, height: u32, pixel_bytes: usize) -> Result<(), BadImage> {
    // Sides first: the product of longer ones could overflow.
    let has_sides = width <= MAX_SIDE_PX && height <= MAX_SIDE_PX;
    if has_sides
        && u64::from(width) * u64::from(height) * pixel_bytes as u64 <= MAX_SAMPLE_BYTES as u64
    {
        return Ok(());
    }
    Err(BadImage(format!(
        "it has {width} by {height} pixels, which take more than {} MiB; scale it down",
        MAX_SAMPLE_BYTES >> 20
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn giants_are_refused_before_memory_is_asked_for() {
        assert!(within_limits(16_384, 16_384, 1).is_ok());
        assert!(within_limits(8192, 8192, 4).is_ok());
        assert!(within_limits(8193, 8192, 4).is_err());
        assert!(within_limits(1 << 17, 1, 1).is_err());
        assert!(within_limits(u32::MAX, u32::MAX, 8).is_err());
    }

    #[test]
    fn other_formats_are_told_what_to_do() {
        assert!(Raster::decode(b"GIF89a").unwrap_err().to_string().contains("convert"));
        assert!(Raster::decode(b"").is_err());
    }
}
