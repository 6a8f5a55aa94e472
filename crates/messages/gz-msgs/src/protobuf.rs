//! Protobuf wire format: numbers, lengths and validation.
//!
//! Source: Protocol Buffers, "Encoding".

use std::cell::Cell;
use std::fmt;

/// Maximum nesting depth of messages; those of Gazebo have up to 12.
const MAX_DEPTH: u32 = 64;

/// Memory that any message may use \[bytes\], in addition to a multiple of its size: two bytes can be an
/// element of a list that takes some hundred bytes of memory.
const FREE_MEMORY: usize = 16 << 20;
const MEMORY_PER_BYTE: usize = 16;

/// Wire type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wire {
    /// Seven bits per byte.
    Varint,
    /// Eight bytes.
    Eight,
    /// Length, and as many bytes.
    Sized,
    /// Four bytes.
    Four,
}

/// Error of bytes that are not such a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DecodeError {
    /// The bytes end inside a value.
    Short,
    /// A number has more than 64 bits, or a field has the number 0.
    Number,
    /// Deprecated or unknown wire type.
    Kind,
    /// Messages are nested too deeply.
    Deep,
    /// The message would use far more memory than its size.
    Memory,
}

impl fmt::Display for DecodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Short => "the message ends too early",
            Self::Number => "a number in the message is invalid",
            Self::Kind => "a field of the message has an unknown wire type",
            Self::Deep => "messages are nested too deeply",
            Self::Memory => "the message would take far more memory than it has bytes",
        })
    }
}

impl std::error::Error for DecodeError {}

/// Remaining bytes of a message.
#[derive(Debug)]
pub struct Reader<'a> {
    bytes: &'a [u8],
    memory: &'a Cell<usize>,
    depth: u32,
}

/// Memory limit of a message.
pub(crate) fn memory_for(bytes: &[u8]) -> Cell<usize> {
    Cell::new(bytes.len().saturating_mul(MEMORY_PER_BYTE).saturating_add(FREE_MEMORY))
}

impl<'a> Reader<'a> {
    pub(crate) fn new(bytes: &'a [u8], memory: &'a Cell<usize>) -> Self {
        Self { bytes, memory, depth: 0 }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// Charges memory \[bytes\].
    pub(crate) fn charge(&self, size: usize) -> Result<(), DecodeError> {
        let left = self.memory.get().checked_sub(size).ok_or(DecodeError::Memory)?;
        self.memory.set(left);
        Ok(())
    }

    pub(crate) fn varint(&mut self) -> Result<u64, DecodeError> {
        let mut value = 0_u64;
        for (index, &byte) in self.bytes.iter().enumerate().take(10) {
            if index == 9 && byte > 1 {
                return Err(DecodeError::Number);
            }
            value |= u64::from(byte & 0x7f) << (7 * index);
            if byte < 0x80 {
                self.bytes = &self.bytes[index + 1..];
                return Ok(value);
            }
        }
        Err(if self.bytes.len() < 10 { DecodeError::Short } else { DecodeError::Number })
    }

    pub(crate) fn fixed<const N: usize>(&mut self) -> Result<[u8; N], DecodeError> {
        let (value, rest) = self.bytes.split_first_chunk::<N>().ok_or(DecodeError::Short)?;
        self.bytes = rest;
        Ok(*value)
    }

    pub(crate) fn sized(&mut self) -> Result<&'a [u8], DecodeError> {
        let length = usize::try_from(self.varint()?).map_err(|_| DecodeError::Short)?;
        let (value, rest) = self.bytes.split_at_checked(length).ok_or(DecodeError::Short)?;
        self.bytes = rest;
        Ok(value)
    }

    /// Reader of a nested message, or of a packed list.
    pub(crate) fn inside(&mut self) -> Result<Self, DecodeError> {
        let depth = self.depth + 1;
        if depth > MAX_DEPTH {
            return Err(DecodeError::Deep);
        }
        Ok(Self { bytes: self.sized()?, memory: self.memory, depth })
    }

    /// Field number and wire type of the next field.
    pub(crate) fn key(&mut self) -> Result<(u32, Wire), DecodeError> {
        let key = u32::try_from(self.varint()?).map_err(|_| DecodeError::Number)?;
        let wire = match key & 7 {
            0 => Wire::Varint,
            1 => Wire::Eight,
            2 => Wire::Sized,
            5 => Wire::Four,
            _ => return Err(DecodeError::Kind),
        };
        if key >> 3 == 0 { Err(DecodeError::Number) } else { Ok((key >> 3, wire)) }
    }

    /// Skips the value of an unknown field.
    pub(crate) fn skip(&mut self, wire: Wire) -> Result<(), DecodeError> {
        match wire {
            Wire::Varint => self.varint().map(drop),
            Wire::Eight => self.fixed::<8>().map(drop),
            Wire::Sized => self.sized().map(drop),
            Wire::Four => self.fixed::<4>().map(drop),
        }
    }
}

pub(crate) fn put_varint(mut value: u64, out: &mut Vec<u8>) {
    while value >= 0x80 {
        #[expect(clippy::cast_possible_truncation, reason = "seven bits are kept")]
        out.push(value as u8 | 0x80);
        value >>= 7;
    }
    #[expect(clippy::cast_possible_truncation, reason = "less than 128")]
    out.push(value as u8);
}

pub(crate) fn put_key(number: u32, wire: Wire, out: &mut Vec<u8>) {
    let kind = match wire {
        Wire::Varint => 0,
        Wire::Eight => 1,
        Wire::Sized => 2,
        Wire::Four => 5,
    };
    put_varint(u64::from(number) << 3 | kind, out);
}

pub(crate) fn put_sized(number: u32, bytes: &[u8], out: &mut Vec<u8>) {
    put_key(number, Wire::Sized, out);
    put_varint(bytes.len() as u64, out);
    out.extend_from_slice(bytes);
}

/// Appends the output of `write`, preceded by its length.
pub(crate) fn put_inside(number: u32, out: &mut Vec<u8>, write: impl FnOnce(&mut Vec<u8>)) {
    put_key(number, Wire::Sized, out);
    // Most are short; the length of others is inserted afterwards.
    let start = out.len();
    out.push(0);
    write(out);
    let length = out.len() - start - 1;
    if let Ok(short @ ..0x80) = u8::try_from(length) {
        out[start] = short;
        return;
    }
    let mut front = Vec::with_capacity(10);
    put_varint(length as u64, &mut front);
    out.splice(start..=start, front);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(value: u64, bytes: &[u8]) {
        let mut out = Vec::new();
        put_varint(value, &mut out);
        assert_eq!(out, bytes);
        let memory = memory_for(bytes);
        let mut reader = Reader::new(bytes, &memory);
        assert_eq!(reader.varint(), Ok(value));
        assert!(reader.is_empty());
    }

    #[test]
    fn numbers_take_seven_bits_a_byte() {
        check(0, &[0]);
        check(127, &[127]);
        check(150, &[0x96, 1]);
        check(u64::MAX, &[255, 255, 255, 255, 255, 255, 255, 255, 255, 1]);
    }

    #[track_caller]
    fn check_wrong(bytes: &[u8], error: DecodeError) {
        let memory = memory_for(bytes);
        assert_eq!(Reader::new(bytes, &memory).varint(), Err(error));
    }

    #[test]
    fn numbers_that_are_none_are_refused() {
        check_wrong(&[], DecodeError::Short);
        check_wrong(&[0x80, 0x80], DecodeError::Short);
        check_wrong(&[0x80; 11], DecodeError::Number);
        check_wrong(&[255, 255, 255, 255, 255, 255, 255, 255, 255, 2], DecodeError::Number);
    }

    #[test]
    fn the_length_of_a_long_message_is_put_in_afterwards() {
        for length in [0, 1, 127, 128, 20_000] {
            let mut out = Vec::new();
            put_inside(1, &mut out, |out| out.resize(out.len() + length, 7));
            let memory = memory_for(&out);
            let mut reader = Reader::new(&out, &memory);
            assert_eq!(reader.key(), Ok((1, Wire::Sized)));
            assert_eq!(reader.sized().map(<[u8]>::len), Ok(length));
            assert!(reader.is_empty());
        }
    }
}
