//! Binary writer.

use super::{Encapsulation, Format, HEADER};
use crate::{Count, EncodeError, Number, Numbers, Sink};

pub(crate) struct Writer<'a> {
    out: &'a mut Vec<u8>,
    /// Offset to which alignment is relative.
    base: usize,
    is_cdr: bool,
    big_endian: bool,
    /// Field that is being written, for errors.
    field: String,
    error: Option<EncodeError>,
}

impl<'a> Writer<'a> {
    pub(crate) fn new(format: Format, out: &'a mut Vec<u8>) -> Self {
        let big_endian = format == Format::Cdr(Encapsulation::BigEndian);
        let is_cdr = format != Format::Ros1;
        if is_cdr {
            out.extend([0, u8::from(!big_endian), 0, 0]);
        }
        let base = out.len();
        Self { out, base, is_cdr, big_endian, field: String::new(), error: None }
    }

    pub(crate) fn finish(self) -> Result<(), EncodeError> {
        self.error.map_or(Ok(()), Err)
    }

    fn align(&mut self, size: usize) {
        if self.is_cdr {
            let padding = (size - (self.out.len() - self.base) % size) % size;
            self.out.resize(self.out.len() + padding, 0);
        }
    }

    /// Writes numbers of one size, given in native byte order.
    fn bytes(&mut self, bytes: &[u8], size: usize) {
        if bytes.is_empty() {
            return;
        }
        self.align(size);
        let start = self.out.len();
        self.out.extend_from_slice(bytes);
        if size > 1 && self.big_endian != cfg!(target_endian = "big") {
            self.out[start..].chunks_exact_mut(size).for_each(<[u8]>::reverse);
        }
    }

    /// Writes numbers of one size, given in the specified byte order.
    pub(super) fn copy(&mut self, bytes: &[u8], size: usize, big_endian: bool) {
        self.align(size);
        let start = self.out.len();
        self.out.extend_from_slice(bytes);
        if size > 1 && self.big_endian != big_endian {
            self.out[start..].chunks_exact_mut(size).for_each(<[u8]>::reverse);
        }
    }

    /// Writes a text of any bytes.
    pub(super) fn text_bytes(&mut self, text: &[u8]) {
        self.length(text.len() + usize::from(self.is_cdr), usize::MAX);
        self.out.extend_from_slice(text);
        if self.is_cdr {
            self.out.push(0);
        }
    }

    fn length(&mut self, length: usize, limit: usize) {
        let limit = limit.min(u32::MAX as usize);
        if length > limit && self.error.is_none() {
            let field = self.field.clone();
            self.error = Some(EncodeError { count: length, limit, field });
        }
        #[allow(clippy::cast_possible_truncation, reason = "too long a list is an error")]
        self.number(Number::U32(length as u32));
    }
}

fn most(limit: Option<u32>) -> usize {
    limit.map_or(usize::MAX, |limit| limit as usize)
}

impl Sink for Writer<'_> {
    fn begin(&mut self, type_name: &str) {
        if !self.is_cdr && type_name == HEADER {
            self.number(Number::U32(0));
        }
    }

    fn end(&mut self, is_empty: bool) {
        if is_empty && self.is_cdr {
            self.number(Number::U8(0));
        }
    }

    fn field(&mut self, name: &str) {
        self.field.clear();
        self.field.push_str(name);
    }

    fn number(&mut self, number: Number) {
        match number {
            Number::Bool(number) => self.out.push(u8::from(number)),
            Number::I8(number) => self.bytes(&number.to_ne_bytes(), 1),
            Number::U8(number) => self.out.push(number),
            Number::I16(number) => self.bytes(&number.to_ne_bytes(), 2),
            Number::U16(number) => self.bytes(&number.to_ne_bytes(), 2),
            Number::I32(number) => self.bytes(&number.to_ne_bytes(), 4),
            Number::U32(number) => self.bytes(&number.to_ne_bytes(), 4),
            Number::I64(number) => self.bytes(&number.to_ne_bytes(), 8),
            Number::U64(number) => self.bytes(&number.to_ne_bytes(), 8),
            Number::F32(number) => self.bytes(&number.to_ne_bytes(), 4),
            Number::F64(number) => self.bytes(&number.to_ne_bytes(), 8),
        }
    }

    fn text(&mut self, text: &str, limit: Option<u32>) {
        let end = usize::from(self.is_cdr);
        self.length(text.len() + end, most(limit).saturating_add(end));
        self.out.extend_from_slice(text.as_bytes());
        if self.is_cdr {
            self.out.push(0);
        }
    }

    fn wide_text(&mut self, text: &str, limit: Option<u32>) {
        let units: Vec<u16> = text.encode_utf16().collect();
        self.length(units.len(), most(limit));
        self.bytes(bytemuck::cast_slice(&units), 2);
    }

    fn list(&mut self, length: usize, count: Count) {
        match count {
            Count::Fixed(_) => {}
            Count::AtMost(limit) => self.length(length, limit),
            Count::Any => self.length(length, usize::MAX),
        }
    }

    fn end_list(&mut self) {}

    fn numbers(&mut self, numbers: Numbers<'_>) {
        match numbers {
            Numbers::Bool(all) => self.out.extend(all.iter().map(|&one| u8::from(one))),
            Numbers::I8(all) => self.bytes(bytemuck::cast_slice(all), 1),
            Numbers::U8(all) => self.bytes(all, 1),
            Numbers::I16(all) => self.bytes(bytemuck::cast_slice(all), 2),
            Numbers::U16(all) => self.bytes(bytemuck::cast_slice(all), 2),
            Numbers::I32(all) => self.bytes(bytemuck::cast_slice(all), 4),
            Numbers::U32(all) => self.bytes(bytemuck::cast_slice(all), 4),
            Numbers::I64(all) => self.bytes(bytemuck::cast_slice(all), 8),
            Numbers::U64(all) => self.bytes(bytemuck::cast_slice(all), 8),
            Numbers::F32(all) => self.bytes(bytemuck::cast_slice(all), 4),
            Numbers::F64(all) => self.bytes(bytemuck::cast_slice(all), 8),
        }
    }
}
