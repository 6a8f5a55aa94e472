//! Binary reader.

use super::{Format, HEADER};
use crate::{Count, DecodeError, Number, NumberKind, NumbersMut, Problem, Source};

/// Maximum padding at the end: writers may pad to a multiple of eight bytes.
const MAX_PADDING_BYTES: usize = 7;

/// Maximum number of elements of an empty type: they take no bytes in ROS 1, so the message size does not
/// limit them.
const MAX_EMPTY_ELEMENTS: usize = 16;

pub(crate) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Offset to which alignment is relative.
    base: usize,
    is_cdr: bool,
    big_endian: bool,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(format: Format, bytes: &'a [u8]) -> Result<Self, DecodeError> {
        if format == Format::Ros1 {
            return Ok(Self { bytes, at: 0, base: 0, is_cdr: false, big_endian: false });
        }
        match *bytes {
            [0, order @ (0 | 1), _, _, ..] => {
                Ok(Self { bytes, at: 4, base: 4, is_cdr: true, big_endian: order == 0 })
            }
            [first, second, _, _, ..] => {
                Err(DecodeError::new(Problem::Encapsulation(first, second), 0))
            }
            _ => Err(DecodeError::new(Problem::Short { needed: 4, left: bytes.len() }, 0)),
        }
    }

    pub(crate) fn finish(self) -> Result<(), DecodeError> {
        let left = self.bytes.len() - self.at;
        let allowed = if self.is_cdr { MAX_PADDING_BYTES } else { 0 };
        if left > allowed { Err(self.error(Problem::Long { left })) } else { Ok(()) }
    }

    fn error(&self, problem: Problem) -> DecodeError {
        DecodeError::new(problem, self.at)
    }

    fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], DecodeError> {
        let left = self.left();
        let end = self.at.checked_add(count).filter(|_| count <= left);
        let end = end.ok_or_else(|| self.error(Problem::Short { needed: count, left }))?;
        let taken = &self.bytes[self.at..end];
        self.at = end;
        Ok(taken)
    }

    /// Skips padding before a number of this size.
    fn align(&mut self, size: usize) -> Result<(), DecodeError> {
        if self.is_cdr {
            let padding = (size - (self.at - self.base) % size) % size;
            self.take(padding)?;
        }
        Ok(())
    }

    fn one<const N: usize>(&mut self) -> Result<[u8; N], DecodeError> {
        self.align(N)?;
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.take(N)?);
        if self.is_swapped() {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn is_swapped(&self) -> bool {
        self.big_endian != cfg!(target_endian = "big")
    }

    /// Fills numbers of one size, in native byte order.
    fn many(&mut self, into: &mut [u8], size: usize) -> Result<(), DecodeError> {
        if into.is_empty() {
            return Ok(());
        }
        self.align(size)?;
        into.copy_from_slice(self.take(into.len())?);
        if size > 1 && self.is_swapped() {
            into.chunks_exact_mut(size).for_each(<[u8]>::reverse);
        }
        Ok(())
    }

    /// Copies numbers of one size to a writer.
    pub(super) fn copy(
        &mut self,
        count: usize,
        size: usize,
        writer: &mut super::Writer<'_>,
    ) -> Result<(), DecodeError> {
        if count == 0 {
            return Ok(());
        }
        self.align(size)?;
        let bytes = self.take(count.saturating_mul(size))?;
        writer.copy(bytes, size, self.big_endian);
        Ok(())
    }

    /// Bytes of a text without its terminator.
    pub(super) fn text_bytes(&mut self) -> Result<&'a [u8], DecodeError> {
        let length = self.length()?;
        let bytes = self.take(length)?;
        // Some writers omit the final zero.
        Ok(if self.is_cdr { bytes.strip_suffix(&[0]).unwrap_or(bytes) } else { bytes })
    }

    fn length(&mut self) -> Result<usize, DecodeError> {
        Ok(u32::from_ne_bytes(self.one()?) as usize)
    }

    fn bounded(&self, count: usize, limit: usize) -> Result<(), DecodeError> {
        if count > limit { Err(self.error(Problem::Bound { count, limit })) } else { Ok(()) }
    }

    fn truth(&self, byte: u8) -> Result<bool, DecodeError> {
        match byte {
            0 => Ok(false),
            1 => Ok(true),
            byte => Err(self.error(Problem::Truth(byte))),
        }
    }
}

fn most(limit: Option<u32>) -> usize {
    limit.map_or(usize::MAX, |limit| limit as usize)
}

impl Source for Reader<'_> {
    fn begin(
        &mut self,
        type_name: &str,
        _: &mut dyn Iterator<Item = &str>,
    ) -> Result<(), DecodeError> {
        if !self.is_cdr && type_name == HEADER {
            self.take(4)?;
        }
        Ok(())
    }

    fn end(&mut self, is_empty: bool) -> Result<(), DecodeError> {
        if is_empty && self.is_cdr {
            self.take(1)?;
        }
        Ok(())
    }

    fn enter(&mut self, _: &str) -> Result<bool, DecodeError> {
        Ok(true)
    }

    fn enter_element(&mut self, _: usize) -> Result<(), DecodeError> {
        Ok(())
    }

    fn leave(&mut self) {}

    fn number(&mut self, kind: NumberKind) -> Result<Number, DecodeError> {
        Ok(match kind {
            NumberKind::Bool => {
                let [byte] = self.one()?;
                Number::Bool(self.truth(byte)?)
            }
            NumberKind::I8 => Number::I8(i8::from_ne_bytes(self.one()?)),
            NumberKind::U8 => Number::U8(u8::from_ne_bytes(self.one()?)),
            NumberKind::I16 => Number::I16(i16::from_ne_bytes(self.one()?)),
            NumberKind::U16 => Number::U16(u16::from_ne_bytes(self.one()?)),
            NumberKind::I32 => Number::I32(i32::from_ne_bytes(self.one()?)),
            NumberKind::U32 => Number::U32(u32::from_ne_bytes(self.one()?)),
            NumberKind::I64 => Number::I64(i64::from_ne_bytes(self.one()?)),
            NumberKind::U64 => Number::U64(u64::from_ne_bytes(self.one()?)),
            NumberKind::F32 => Number::F32(f32::from_ne_bytes(self.one()?)),
            NumberKind::F64 => Number::F64(f64::from_ne_bytes(self.one()?)),
        })
    }

    fn text(&mut self, limit: Option<u32>) -> Result<String, DecodeError> {
        let bytes = self.text_bytes()?;
        self.bounded(bytes.len(), most(limit))?;
        let text = std::str::from_utf8(bytes).map_err(|_| self.error(Problem::Text))?;
        Ok(text.to_owned())
    }

    fn wide_text(&mut self, limit: Option<u32>) -> Result<String, DecodeError> {
        let length = self.length()?;
        self.bounded(length, most(limit))?;
        if length.saturating_mul(2) > self.left() {
            return Err(self.error(Problem::Count(length)));
        }
        let mut units = vec![0_u16; length];
        self.many(bytemuck::cast_slice_mut(&mut units), 2)?;
        String::from_utf16(&units).map_err(|_| self.error(Problem::Text))
    }

    fn list(&mut self, count: Count, min_bytes: usize) -> Result<usize, DecodeError> {
        let length = match count {
            Count::Fixed(length) => length,
            Count::AtMost(limit) => {
                let length = self.length()?;
                self.bounded(length, limit)?;
                length
            }
            Count::Any => self.length()?,
        };
        let most = match min_bytes {
            0 => self.left() + MAX_EMPTY_ELEMENTS,
            min_bytes => self.left() / min_bytes,
        };
        if length > most {
            return Err(self.error(Problem::Count(length)));
        }
        Ok(length)
    }

    fn numbers(&mut self, numbers: NumbersMut<'_>) -> Result<(), DecodeError> {
        match numbers {
            NumbersMut::Bool(all) => {
                let bytes = self.take(all.len())?;
                for (one, &byte) in all.iter_mut().zip(bytes) {
                    *one = self.truth(byte)?;
                }
                Ok(())
            }
            NumbersMut::I8(all) => self.many(bytemuck::cast_slice_mut(all), 1),
            NumbersMut::U8(all) => self.many(all, 1),
            NumbersMut::I16(all) => self.many(bytemuck::cast_slice_mut(all), 2),
            NumbersMut::U16(all) => self.many(bytemuck::cast_slice_mut(all), 2),
            NumbersMut::I32(all) => self.many(bytemuck::cast_slice_mut(all), 4),
            NumbersMut::U32(all) => self.many(bytemuck::cast_slice_mut(all), 4),
            NumbersMut::I64(all) => self.many(bytemuck::cast_slice_mut(all), 8),
            NumbersMut::U64(all) => self.many(bytemuck::cast_slice_mut(all), 8),
            NumbersMut::F32(all) => self.many(bytemuck::cast_slice_mut(all), 4),
            NumbersMut::F64(all) => self.many(bytemuck::cast_slice_mut(all), 8),
        }
    }
}
