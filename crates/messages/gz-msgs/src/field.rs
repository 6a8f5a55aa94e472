//! Types of fields: serialization, parsing and printing of each. Unset fields are not serialized.

use crate::message::Message;
use crate::protobuf::{DecodeError, Reader, Wire, put_inside, put_key, put_sized, put_varint};
use crate::text::{Parser, Printer, TextError};

/// Type of a field of a message.
pub(crate) trait Field {
    fn write(&self, number: u32, out: &mut Vec<u8>);
    /// Reads a value. A value with the wrong wire type is skipped, as in protobuf.
    fn read(&mut self, wire: Wire, reader: &mut Reader<'_>) -> Result<(), DecodeError>;
    fn print(&self, name: &str, out: &mut Printer);
    fn parse(&mut self, parser: &mut Parser<'_>) -> Result<(), TextError>;
}

/// Numeric fields: single and repeated.
macro_rules! numbers {
    ($($ty:ty, $wire:ident, $put:expr, $get:expr, $is_set:expr;)*) => {$(
        impl Field for $ty {
            fn write(&self, number: u32, out: &mut Vec<u8>) {
                if $is_set(*self) {
                    put_key(number, Wire::$wire, out);
                    $put(*self, out);
                }
            }

            fn read(&mut self, wire: Wire, reader: &mut Reader<'_>) -> Result<(), DecodeError> {
                if wire != Wire::$wire {
                    return reader.skip(wire);
                }
                *self = $get(reader)?;
                Ok(())
            }

            fn print(&self, name: &str, out: &mut Printer) {
                if $is_set(*self) {
                    out.value(name, self);
                }
            }

            fn parse(&mut self, parser: &mut Parser<'_>) -> Result<(), TextError> {
                *self = parser.number()?;
                Ok(())
            }
        }

        impl Field for Vec<$ty> {
            fn write(&self, number: u32, out: &mut Vec<u8>) {
                if !self.is_empty() {
                    put_inside(number, out, |out| {
                        for one in self {
                            $put(*one, out);
                        }
                    });
                }
            }

            /// Reads packed and unpacked values: a reader must accept both.
            fn read(&mut self, wire: Wire, reader: &mut Reader<'_>) -> Result<(), DecodeError> {
                if wire == Wire::$wire {
                    reader.charge(size_of::<$ty>())?;
                    self.push($get(reader)?);
                    return Ok(());
                }
                if wire != Wire::Sized {
                    return reader.skip(wire);
                }
                let mut inside = reader.inside()?;
                while !inside.is_empty() {
                    inside.charge(size_of::<$ty>())?;
                    self.push($get(&mut inside)?);
                }
                Ok(())
            }

            fn print(&self, name: &str, out: &mut Printer) {
                for one in self {
                    out.value(name, one);
                }
            }

            fn parse(&mut self, parser: &mut Parser<'_>) -> Result<(), TextError> {
                parser.list(|parser| {
                    self.push(parser.number()?);
                    Ok(())
                })
            }
        }
    )*};
}

// Negative numbers are written as 64 bits; a value that is too long for its type is truncated, as in
// protobuf.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "protobuf's own rule")]
mod of_varints {
    use super::*;

    numbers! {
        i32, Varint, |value: i32, out: &mut Vec<u8>| put_varint(i64::from(value) as u64, out),
            |reader: &mut Reader<'_>| reader.varint().map(|value| value as i32), |value| value != 0;
        i64, Varint, |value: i64, out: &mut Vec<u8>| put_varint(value as u64, out),
            |reader: &mut Reader<'_>| reader.varint().map(|value| value.cast_signed()), |value| value != 0;
        u32, Varint, |value: u32, out: &mut Vec<u8>| put_varint(value.into(), out),
            |reader: &mut Reader<'_>| reader.varint().map(|value| value as u32), |value| value != 0;
        u64, Varint, put_varint, |reader: &mut Reader<'_>| reader.varint(), |value| value != 0;
    }
}

numbers! {
    f32, Four, |value: f32, out: &mut Vec<u8>| out.extend_from_slice(&value.to_le_bytes()),
        |reader: &mut Reader<'_>| reader.fixed().map(f32::from_le_bytes), |value: f32| value.to_bits() != 0;
    f64, Eight, |value: f64, out: &mut Vec<u8>| out.extend_from_slice(&value.to_le_bytes()),
        |reader: &mut Reader<'_>| reader.fixed().map(f64::from_le_bytes), |value: f64| value.to_bits() != 0;
}

impl Field for bool {
    fn write(&self, number: u32, out: &mut Vec<u8>) {
        if *self {
            put_key(number, Wire::Varint, out);
            out.push(1);
        }
    }

    fn read(&mut self, wire: Wire, reader: &mut Reader<'_>) -> Result<(), DecodeError> {
        if wire != Wire::Varint {
            return reader.skip(wire);
        }
        *self = reader.varint()? != 0;
        Ok(())
    }

    fn print(&self, name: &str, out: &mut Printer) {
        if *self {
            out.value(name, self);
        }
    }

    fn parse(&mut self, parser: &mut Parser<'_>) -> Result<(), TextError> {
        *self = parser.boolean()?;
        Ok(())
    }
}

/// Text that is not UTF-8 is read lossily, so that the rest of the message remains usable.
impl Field for String {
    fn write(&self, number: u32, out: &mut Vec<u8>) {
        if !self.is_empty() {
            put_sized(number, self.as_bytes(), out);
        }
    }

    fn read(&mut self, wire: Wire, reader: &mut Reader<'_>) -> Result<(), DecodeError> {
        if wire != Wire::Sized {
            return reader.skip(wire);
        }
        *self = String::from_utf8_lossy(reader.sized()?).into_owned();
        Ok(())
    }

    fn print(&self, name: &str, out: &mut Printer) {
        if !self.is_empty() {
            out.quoted(name, self.as_bytes());
        }
    }

    fn parse(&mut self, parser: &mut Parser<'_>) -> Result<(), TextError> {
        *self = String::from_utf8_lossy(&parser.string()?).into_owned();
        Ok(())
    }
}

impl Field for Vec<String> {
    fn write(&self, number: u32, out: &mut Vec<u8>) {
        for one in self {
            put_sized(number, one.as_bytes(), out);
        }
    }

    fn read(&mut self, wire: Wire, reader: &mut Reader<'_>) -> Result<(), DecodeError> {
        let mut one = String::new();
        if wire != Wire::Sized {
            return reader.skip(wire);
        }
        reader.charge(size_of::<String>())?;
        one.read(wire, reader)?;
        self.push(one);
        Ok(())
    }

    fn print(&self, name: &str, out: &mut Printer) {
        for one in self {
            out.quoted(name, one.as_bytes());
        }
    }

    fn parse(&mut self, parser: &mut Parser<'_>) -> Result<(), TextError> {
        parser.list(|parser| {
            self.push(String::from_utf8_lossy(&parser.string()?).into_owned());
            Ok(())
        })
    }
}

/// Bytes: images, point clouds.
impl Field for Vec<u8> {
    fn write(&self, number: u32, out: &mut Vec<u8>) {
        if !self.is_empty() {
            put_sized(number, self, out);
        }
    }

    fn read(&mut self, wire: Wire, reader: &mut Reader<'_>) -> Result<(), DecodeError> {
        if wire != Wire::Sized {
            return reader.skip(wire);
        }
        *self = reader.sized()?.to_vec();
        Ok(())
    }

    fn print(&self, name: &str, out: &mut Printer) {
        if !self.is_empty() {
            out.quoted(name, self);
        }
    }

    fn parse(&mut self, parser: &mut Parser<'_>) -> Result<(), TextError> {
        *self = parser.string()?;
        Ok(())
    }
}

impl<M: Message> Field for Option<M> {
    fn write(&self, number: u32, out: &mut Vec<u8>) {
        if let Some(message) = self {
            put_inside(number, out, |out| message.write_fields(out));
        }
    }

    /// Merges a message that occurs twice, as in protobuf.
    fn read(&mut self, wire: Wire, reader: &mut Reader<'_>) -> Result<(), DecodeError> {
        if wire != Wire::Sized {
            return reader.skip(wire);
        }
        let mut inside = reader.inside()?;
        self.get_or_insert_with(M::default).read_fields(&mut inside)
    }

    fn print(&self, name: &str, out: &mut Printer) {
        if let Some(message) = self {
            out.message(name, |out| message.print_fields(out));
        }
    }

    fn parse(&mut self, parser: &mut Parser<'_>) -> Result<(), TextError> {
        let message = self.get_or_insert_with(M::default);
        parser.message(|name, parser| message.parse_field(name, parser))
    }
}

impl<M: Message> Field for Vec<M> {
    fn write(&self, number: u32, out: &mut Vec<u8>) {
        for message in self {
            put_inside(number, out, |out| message.write_fields(out));
        }
    }

    fn read(&mut self, wire: Wire, reader: &mut Reader<'_>) -> Result<(), DecodeError> {
        if wire != Wire::Sized {
            return reader.skip(wire);
        }
        let mut inside = reader.inside()?;
        inside.charge(size_of::<M>())?;
        let mut message = M::default();
        message.read_fields(&mut inside)?;
        self.push(message);
        Ok(())
    }

    fn print(&self, name: &str, out: &mut Printer) {
        for message in self {
            out.message(name, |out| message.print_fields(out));
        }
    }

    fn parse(&mut self, parser: &mut Parser<'_>) -> Result<(), TextError> {
        parser.list(|parser| {
            let mut message = M::default();
            parser.message(|name, parser| message.parse_field(name, parser))?;
            self.push(message);
            Ok(())
        })
    }
}
