//! BMP: uncompressed, with palettes of 1, 4 and 8 bits, 16, 24 and 32 bits, bottom-up and top-down.
//!
//! Source: Microsoft's description of bitmap storage, "BITMAPINFOHEADER" and "BITMAPV5HEADER".

use crate::raster::{BadImage, Layout, Raster, within_limits};

/// Length of the file header in front of the bitmap header [bytes].
const FILE_HEADER_BYTES: usize = 14;

/// Content of the headers.
struct Header {
    width: u32,
    height: u32,
    is_top_down: bool,
    bits: usize,
    /// Offset of the pixels.
    pixels: usize,
    palette: Vec<[u8; 3]>,
    /// Bit masks of red, green, blue and alpha, for pixels that are one number.
    masks: [u32; 4],
}

pub(crate) fn decode(bytes: &[u8]) -> Result<Raster, BadImage> {
    let header = Header::read(bytes)?;
    let Header { width, height, .. } = header;
    let has_alpha = header.masks[3] != 0;
    let is_grey = header.bits <= 8 && header.palette.iter().all(|[r, g, b]| r == g && g == b);
    let layout = match (has_alpha, is_grey) {
        (true, _) => Layout::Rgba,
        (false, true) => Layout::Grey,
        (false, false) => Layout::Rgb,
    };
    within_limits(width, height, layout.channels())?;
    let stride = (width as usize * header.bits).div_ceil(32) * 4;
    let rows = bytes.get(header.pixels..).unwrap_or_default();
    if (stride as u64) * u64::from(height) > rows.len() as u64 {
        return Err(BadImage("it has fewer pixels than its header declares".into()));
    }
    let mut samples = Vec::with_capacity(width as usize * height as usize * layout.channels());
    for y in 0..height as usize {
        let row = if header.is_top_down { y } else { height as usize - 1 - y };
        let row = &rows[row * stride..(row + 1) * stride];
        for x in 0..width as usize {
            let pixel = header.pixel(row, x)?;
            match layout {
                Layout::Grey => samples.push(pixel[0]),
                Layout::Rgba => samples.extend_from_slice(&pixel),
                _ => samples.extend_from_slice(&pixel[..3]),
            }
        }
    }
    let mut raster = Raster { width, height, layout, is_deep: false, bytes: samples };
    // Many programs leave the fourth byte zero for opaque pixels.
    if has_alpha && raster.bytes.chunks_exact(4).all(|pixel| pixel[3] == 0) {
        raster.bytes.chunks_exact_mut(4).for_each(|pixel| pixel[3] = 255);
    }
    Ok(raster)
}

impl Header {
    fn read(bytes: &[u8]) -> Result<Self, BadImage> {
        let long = |at: usize| {
            let word = bytes.get(at..at + 4).and_then(|word| word.try_into().ok());
            word.map(u32::from_le_bytes).ok_or_else(cut)
        };
        let short = |at: usize| {
            let word = bytes.get(at..at + 2).and_then(|word| word.try_into().ok());
            word.map(u16::from_le_bytes).ok_or_else(cut)
        };
        let pixels = long(10)? as usize;
        let size = long(FILE_HEADER_BYTES)? as usize;
        let is_core = size == 12;
        if !is_core && size < 40 {
            return Err(BadImage(format!("its header of {size} bytes is of no known kind")));
        }
        let (width, signed_height, bits, compression) = if is_core {
            (u32::from(short(18)?), i32::from(short(20)?), short(24)?, 0)
        } else {
            (long(18)?, long(22)?.cast_signed(), short(28)?, long(30)?)
        };
        let bits = usize::from(bits);
        let masks = match (bits, compression) {
            (1 | 4 | 8 | 24, 0) => [0; 4],
            (16, 0) => [0x7c00, 0x3e0, 0x1f, 0],
            (32, 0) => [0xff_0000, 0xff00, 0xff, 0],
            (16 | 32, 3 | 6) => {
                let has_alpha = size >= 56 || compression == 6;
                let alpha = if has_alpha { long(66)? } else { 0 };
                [long(54)?, long(58)?, long(62)?, alpha]
            }
            _ => {
                return Err(BadImage(format!(
                    "it is a BMP of {bits} bits and compression {compression}, which is not read; \
                     save it without compression"
                )));
            }
        };
        let mut palette = Vec::new();
        if bits <= 8 {
            let used = if is_core { 0 } else { long(46)? as usize };
            let most = 1 << bits;
            let count = if used == 0 { most } else { used.min(most) };
            let (first, step) = (FILE_HEADER_BYTES + size, if is_core { 3 } else { 4 });
            for colour in 0..count {
                let at = first + colour * step;
                let [b, g, r] = bytes
                    .get(at..at + 3)
                    .and_then(|colour| <[u8; 3]>::try_from(colour).ok())
                    .ok_or_else(cut)?;
                palette.push([r, g, b]);
            }
        }
        Ok(Self {
            width,
            height: signed_height.unsigned_abs(),
            is_top_down: signed_height < 0,
            bits,
            pixels,
            palette,
            masks,
        })
    }

    fn pixel(&self, row: &[u8], x: usize) -> Result<[u8; 4], BadImage> {
        let colour = |[r, g, b]: [u8; 3]| [r, g, b, 255];
        if self.bits <= 8 {
            let per_byte = 8 / self.bits;
            let shift = 8 - self.bits * (x % per_byte + 1);
            let index = usize::from(row[x / per_byte] >> shift) & ((1 << self.bits) - 1);
            let outside = || BadImage(format!("a pixel has colour {index}, which is not in it"));
            return self.palette.get(index).map(|&it| colour(it)).ok_or_else(outside);
        }
        if self.bits == 24 {
            return Ok(colour([row[3 * x + 2], row[3 * x + 1], row[3 * x]]));
        }
        let number = match self.bits {
            16 => u32::from(u16::from_le_bytes([row[2 * x], row[2 * x + 1]])),
            _ => u32::from_le_bytes([row[4 * x], row[4 * x + 1], row[4 * x + 2], row[4 * x + 3]]),
        };
        let [r, g, b, a] = self.masks.map(|mask| part(number, mask));
        Ok([r, g, b, if self.masks[3] == 0 { 255 } else { a }])
    }
}

/// Scales the bits under a mask to eight bits.
fn part(number: u32, mask: u32) -> u8 {
    if mask == 0 {
        return 0;
    }
    let shift = mask.trailing_zeros();
    let (value, most) = (u64::from((number & mask) >> shift), u64::from(mask >> shift));
    u8::try_from((value * 255 + most / 2) / most).unwrap_or(u8::MAX)
}

fn cut() -> BadImage {
    BadImage("it is a BMP that ends in its header".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Common header, followed by its data.
    fn file(width: u32, height: i32, bits: u16, compression: u32, rest: &[u8]) -> Vec<u8> {
        let palette = if bits <= 8 { 4 << bits } else { 0 } + if compression == 3 { 12 } else { 0 };
        let mut bytes = b"BM".to_vec();
        bytes.extend([0; 8]);
        bytes.extend((54 + palette as u32).to_le_bytes());
        bytes.extend(40_u32.to_le_bytes());
        bytes.extend(width.to_le_bytes());
        bytes.extend(height.to_le_bytes());
        bytes.extend([1, 0]);
        bytes.extend(bits.to_le_bytes());
        bytes.extend(compression.to_le_bytes());
        bytes.extend([0; 20]);
        bytes.extend(rest);
        bytes
    }

    #[test]
    fn colours_come_backwards_and_rows_from_below() {
        let rest = [1, 2, 3, 0, 4, 5, 6, 0];
        let raster = decode(&file(1, 2, 24, 0, &rest)).unwrap();
        assert_eq!((raster.layout, raster.bytes), (Layout::Rgb, vec![6, 5, 4, 3, 2, 1]));
        let raster = decode(&file(1, -2, 24, 0, &rest)).unwrap();
        assert_eq!(raster.bytes, [3, 2, 1, 6, 5, 4]);
    }

    #[test]
    fn palettes_and_masks() {
        let rest = [0, 0, 0, 0, 205, 205, 205, 0, 0b1000_0000, 0, 0, 0];
        let raster = decode(&file(2, 1, 1, 0, &rest)).unwrap();
        assert_eq!((raster.layout, raster.bytes), (Layout::Grey, vec![205, 0]));
        let rest = [0xff, 0x7f, 0x1f, 0x00];
        assert_eq!(decode(&file(2, 1, 16, 0, &rest)).unwrap().bytes, [255, 255, 255, 0, 0, 255]);
        let rest = [0, 0xff, 0, 0, 0, 0, 0xff, 0, 0xff, 0, 0, 0, 1, 2, 3, 4];
        assert_eq!(decode(&file(1, 1, 32, 3, &rest)).unwrap().bytes, [2, 3, 1]);
    }

    #[test]
    fn broken_ones_are_told() {
        let whole = file(1, 2, 24, 0, &[1, 2, 3, 0, 4, 5, 6, 0]);
        for end in 2..whole.len() {
            assert!(decode(&whole[..end]).is_err(), "{end}");
        }
        assert!(decode(&file(9, 9, 24, 1, &[0; 999])).is_err());
        assert!(decode(&file(u32::MAX, i32::MIN, 24, 0, &[0; 99])).is_err());
    }
}
