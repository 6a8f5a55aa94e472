//! PNM: PBM, PGM and PPM, ASCII or binary.
//!
//! Source: the manual pages pbm(5), pgm(5) and ppm(5) of Netpbm.

use crate::raster::{BadImage, Layout, Raster, within_limits};

pub(crate) fn decode(bytes: &[u8]) -> Result<Raster, BadImage> {
    let mut reader = Reader { bytes, at: 2 };
    let kind = bytes[1];
    let width = reader.number("width")?;
    let height = reader.number("height")?;
    let is_bitmap = matches!(kind, b'1' | b'4');
    let most = if is_bitmap { 1 } else { reader.number("largest value")? };
    if most == 0 || most > 0xffff {
        return Err(BadImage(format!("its largest value is {most}; it must be 1 to 65535")));
    }
    let layout = if matches!(kind, b'3' | b'6') { Layout::Rgb } else { Layout::Grey };
    within_limits(width, height, layout.channels())?;
    let samples = width as usize * height as usize * layout.channels();
    let scale = |value: u32| scaled(value.min(most), most);
    let bytes = match kind {
        b'1' => reader.digits(samples)?,
        b'4' => bits(reader.raw(height as usize * (width as usize).div_ceil(8))?, width),
        b'2' | b'3' => reader.numbers(samples)?.map_while(scale),
        _ if most == 255 => reader.raw(samples)?.to_vec(),
        _ if most < 256 => {
            reader.raw(samples)?.iter().map(|&value| scale(u32::from(value))).collect()
        }
        _ => {
            let pairs = reader.raw(2 * samples)?.chunks_exact(2);
            pairs.map(|pair| scale(u32::from(u16::from_be_bytes([pair[0], pair[1]])))).collect()
        }
    };
    Ok(Raster { width, height, layout, is_deep: false, bytes })
}

/// Scales to 0..255, rounded down as `GraphicsMagick` does.
fn scaled(value: u32, most: u32) -> u8 {
    u8::try_from(value * 255 / most).unwrap_or(u8::MAX)
}

/// Unpacks eight pixels per byte, the first in the highest bit; a set bit is black. Every row starts at a
/// byte.
fn bits(bytes: &[u8], width: u32) -> Vec<u8> {
    let width = width as usize;
    let rows = bytes.chunks_exact(width.div_ceil(8).max(1));
    rows.flat_map(|row| {
        (0..width).map(|x| if row[x / 8] >> (7 - x % 8) & 1 == 1 { 0 } else { 255 })
    })
    .collect()
}

struct Reader<'b> {
    bytes: &'b [u8],
    at: usize,
}

/// Parsed numbers.
struct Numbers(Vec<u32>);

impl Numbers {
    fn map_while(self, scale: impl Fn(u32) -> u8) -> Vec<u8> {
        self.0.into_iter().map(scale).collect()
    }
}

impl<'b> Reader<'b> {
    fn skip(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            if byte == b'#' {
                let rest = &self.bytes[self.at..];
                self.at += rest.iter().position(|&it| it == b'\n').unwrap_or(rest.len());
            } else if byte.is_ascii_whitespace() {
                self.at += 1;
            } else {
                break;
            }
        }
    }

    fn number(&mut self, what: &str) -> Result<u32, BadImage> {
        self.skip();
        let start = self.at;
        let mut value = 0_u32;
        while let Some(digit) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_digit()) {
            value = value.saturating_mul(10).saturating_add(u32::from(digit - b'0'));
            self.at += 1;
        }
        if self.at == start {
            return Err(BadImage(format!("its header has no {what} at byte {start}")));
        }
        Ok(value)
    }

    fn numbers(&mut self, count: usize) -> Result<Numbers, BadImage> {
        // A number needs a digit and a blank, so the number of bytes limits their count.
        let mut numbers = Vec::with_capacity(count.min(self.bytes.len()));
        for _ in 0..count {
            numbers.push(self.number("more pixels")?);
        }
        Ok(Numbers(numbers))
    }

    /// Parses digits 0 and 1, with or without blanks between; 1 is black.
    fn digits(&mut self, count: usize) -> Result<Vec<u8>, BadImage> {
        let mut pixels = Vec::with_capacity(count.min(self.bytes.len()));
        while pixels.len() < count {
            self.skip();
            match self.bytes.get(self.at) {
                Some(b'0') => pixels.push(255),
                Some(b'1') => pixels.push(0),
                _ => return Err(short()),
            }
            self.at += 1;
        }
        Ok(pixels)
    }

    /// Bytes after the single blank that ends the header.
    fn raw(&mut self, count: usize) -> Result<&'b [u8], BadImage> {
        let start = self.at + 1;
        start.checked_add(count).and_then(|end| self.bytes.get(start..end)).ok_or_else(short)
    }
}

fn short() -> BadImage {
    BadImage("it has fewer pixels than its header declares".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> Result<Vec<u8>, BadImage> {
        decode(bytes).map(|raster| raster.bytes)
    }

    #[test]
    fn bytes_and_numbers() {
        assert_eq!(read(b"P5\n# by hand\n2 1\n255\n\x01\xfe"), Ok(vec![1, 254]));
        assert_eq!(read(b"P5 2 1 255 \n\xfe"), Ok(vec![b'\n', 254]), "one blank, no more");
        assert_eq!(read(b"P2 3 1 100 0 50 100"), Ok(vec![0, 127, 255]));
        assert_eq!(read(b"P5\n1 1\n65535\n\x80\xff"), Ok(vec![128]));
        assert_eq!(read(b"P6 1 1 255\n\x01\x02\x03"), Ok(vec![1, 2, 3]));
        assert_eq!(read(b"P1 3 1 011"), Ok(vec![255, 0, 0]));
        assert_eq!(read(b"P4\n9 1\n\x80\x80"), Ok(vec![0, 255, 255, 255, 255, 255, 255, 255, 0]));
    }

    #[test]
    fn broken_ones_are_told() {
        for broken in [
            &b"P5"[..],
            b"P5 2 1",
            b"P5 2 1 255",
            b"P5 2 1 255\nx",
            b"P5 2 1 0\nxx",
            b"P5 2 1 65536\nxxxx",
            b"P5 99999999 99999999 255\n",
            b"P2 2 1 255 1",
            b"P1 2 1 0",
            b"P4 9 1\nx",
            b"P5 # no end",
        ] {
            assert!(read(broken).is_err(), "{}", broken.escape_ascii());
        }
    }
}
