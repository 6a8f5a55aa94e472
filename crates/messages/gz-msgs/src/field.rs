//! Kinds of fields: how each is written, read, printed and parsed. What is not set is not written.

use crate::message::Message;
use crate::protobuf::{DecodeError, Reader, Wire, put_inside, put_key, put_sized, put_varint};
use crate::text::{Parser, Printer, TextError};

/// What a field of a message can be.
pub(crate) trait Field {
    fn write(&self, number: u32, out: &mut Vec<u8>);
    /// A value of another kind than the field has is passed over, as protobuf does.
    fn read(&mut self, wire: Wire, reader: &mut Reader<'_>) -> Result<(), DecodeError>;
    fn print(&self, name: &str, out: &mut Printer);
    fn parse(&mut self, parser: &mut Parser<'_>) -> Result<(), TextError>;
}

/// Fields that are numbers: one, and a list of it.
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

            /// Packed or one by one: a reader has to take both.
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

// Numbers below zero are written as 64 bits; what is too long for its type is cut, as protobuf does.
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

/// What is no UTF-8 is read as well as it goes: it comes from names, and the rest is of use.
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

/// Bytes: pictures, clouds.
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

    /// A message that comes twice is put together from both.
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
