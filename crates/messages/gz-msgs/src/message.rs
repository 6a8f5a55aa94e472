//! Message trait, and macros that declare messages.

use std::fmt::Debug;

use crate::protobuf::{DecodeError, Reader, Wire, memory_for};
use crate::text::{Parser, Printer, TextError};

/// Parts of the message trait that are private to this crate.
pub(crate) mod walk {
    use super::{DecodeError, Parser, Printer, Reader, TextError, Wire};

    /// Traversal of the fields of a message.
    pub trait Walk {
        #[doc(hidden)]
        fn write_fields(&self, out: &mut Vec<u8>);
        #[doc(hidden)]
        fn read_field(
            &mut self,
            number: u32,
            wire: Wire,
            reader: &mut Reader<'_>,
        ) -> Result<(), DecodeError>;
        #[doc(hidden)]
        fn print_fields(&self, out: &mut Printer);
        #[doc(hidden)]
        fn parse_field(&mut self, name: &str, parser: &mut Parser<'_>) -> Result<(), TextError>;

        #[doc(hidden)]
        fn read_fields(&mut self, reader: &mut Reader<'_>) -> Result<(), DecodeError> {
            while !reader.is_empty() {
                let (number, wire) = reader.key()?;
                self.read_field(number, wire, reader)?;
            }
            Ok(())
        }
    }
}

/// Message of Gazebo.
pub trait Message:
    walk::Walk + Clone + Debug + Default + PartialEq + Send + Sync + 'static
{
    /// Its name, such as `LaserScan`; the release determines the package, see [`crate::Dialect`].
    const NAME: &'static str;

    /// Appends its protobuf form to `out`.
    fn encode_into(&self, out: &mut Vec<u8>) {
        self.write_fields(out);
    }

    /// Returns its protobuf form.
    #[must_use]
    fn encode(&self) -> Vec<u8> {
        let mut out = Vec::new();
        self.write_fields(&mut out);
        out
    }

    /// Parses protobuf. Unknown fields are skipped.
    ///
    /// # Errors
    /// If the bytes are not such a message.
    fn decode(bytes: &[u8]) -> Result<Self, DecodeError> {
        let memory = memory_for(bytes);
        let mut message = Self::default();
        message.read_fields(&mut Reader::new(bytes, &memory))?;
        Ok(message)
    }

    /// Returns its protobuf text, one field per line.
    #[must_use]
    fn text(&self) -> String {
        let mut out = Printer::default();
        self.print_fields(&mut out);
        out.into_text()
    }

    /// Parses protobuf text.
    ///
    /// # Errors
    /// If the text is not such a message; with line and column.
    fn from_text(text: &str) -> Result<Self, TextError> {
        let mut message = Self::default();
        Parser::new(text).whole(|name, parser| message.parse_field(name, parser))?;
        Ok(message)
    }
}

/// Declares messages: the name in Rust, that of Gazebo if it differs, fields with their numbers.
macro_rules! messages {
    ($(
        $(#[$doc:meta])*
        $name:ident $(= $gz:literal)? {
            $($(#[$field_doc:meta])* $number:literal $field:ident: $ty:ty),* $(,)?
        }
    )*) => {$(
        $(#[$doc])*
        #[derive(Clone, Debug, Default, PartialEq)]
        #[allow(missing_docs, reason = "Gazebo documents its fields")]
        pub struct $name {
            $($(#[$field_doc])* pub $field: $ty),*
        }

        impl $crate::message::walk::Walk for $name {
            fn write_fields(&self, out: &mut Vec<u8>) {
                $($crate::field::Field::write(&self.$field, $number, out);)*
                let _ = out;
            }

            fn read_field(
                &mut self,
                number: u32,
                wire: $crate::protobuf::Wire,
                reader: &mut $crate::protobuf::Reader<'_>,
            ) -> Result<(), $crate::DecodeError> {
                match number {
                    $($number => $crate::field::Field::read(&mut self.$field, wire, reader),)*
                    _ => reader.skip(wire),
                }
            }

            fn print_fields(&self, out: &mut $crate::text::Printer) {
                $($crate::field::Field::print(
                    &self.$field,
                    stringify!($field).trim_start_matches("r#"),
                    out,
                );)*
                let _ = out;
            }

            fn parse_field(
                &mut self,
                name: &str,
                parser: &mut $crate::text::Parser<'_>,
            ) -> Result<(), $crate::TextError> {
                const NAMES: &[&str] = &[$(stringify!($field)),*];
                $(if name == stringify!($field).trim_start_matches("r#") {
                    return $crate::field::Field::parse(&mut self.$field, parser);
                })*
                Err(parser.unknown(name, NAMES))
            }
        }

        impl $crate::Message for $name {
            const NAME: &'static str = $crate::message::first!($($gz,)? stringify!($name));
        }
    )*};
}
pub(crate) use messages;

/// First of its arguments.
macro_rules! first {
    ($first:expr $(, $rest:expr)?) => {
        $first
    };
}
pub(crate) use first;

/// Declares enumerations: numbers with names. A number without a name is kept.
macro_rules! kinds {
    ($(
        $(#[$doc:meta])*
        $name:ident { $($kind:ident = $number:literal),* $(,)? }
    )*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name(pub i32);

        #[allow(missing_docs, reason = "the names are those of Gazebo")]
        impl $name {
            $(pub const $kind: Self = Self($number);)*

            /// Name of the value, if it has one.
            #[must_use]
            pub fn name(self) -> Option<&'static str> {
                match self.0 {
                    $($number => Some(stringify!($kind)),)*
                    _ => None,
                }
            }
        }

        impl $crate::field::Field for $name {
            fn write(&self, number: u32, out: &mut Vec<u8>) {
                $crate::field::Field::write(&self.0, number, out);
            }

            fn read(
                &mut self,
                wire: $crate::protobuf::Wire,
                reader: &mut $crate::protobuf::Reader<'_>,
            ) -> Result<(), $crate::DecodeError> {
                $crate::field::Field::read(&mut self.0, wire, reader)
            }

            fn print(&self, name: &str, out: &mut $crate::text::Printer) {
                match self.name() {
                    _ if self.0 == 0 => {}
                    Some(kind) => out.value(name, kind),
                    None => out.value(name, &self.0),
                }
            }

            fn parse(&mut self, parser: &mut $crate::text::Parser<'_>) -> Result<(), $crate::TextError> {
                const KINDS: &[(&str, i32)] = &[$((stringify!($kind), $number)),*];
                self.0 = parser.kind(KINDS)?;
                Ok(())
            }
        }
    )*};
}
pub(crate) use kinds;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::messages::{Model, PoseV};
    use crate::protobuf::put_inside;

    /// A message whose field `number` is a list of `count` messages without content, two bytes each.
    fn empty_elements(number: u32, count: usize) -> Vec<u8> {
        let mut bytes = Vec::new();
        for _ in 0..count {
            put_inside(number, &mut bytes, |_| {});
        }
        assert_eq!(bytes.len(), 2 * count);
        bytes
    }

    #[test]
    fn a_few_bytes_cannot_claim_much_memory() {
        let small = PoseV::decode(&empty_elements(2, 1000)).map(|it| it.pose.len());
        assert_eq!(small, Ok(1000));
        // One megabyte whose elements would take more than a hundred.
        let bytes = empty_elements(2, 1 << 19);
        assert!(size_of::<crate::messages::Pose>() << 19 > 100 << 20);
        assert_eq!(PoseV::decode(&bytes), Err(DecodeError::Memory));
    }

    #[test]
    fn messages_cannot_be_nested_without_limit() {
        let nested = |depth: u32| {
            let mut bytes = Vec::new();
            for _ in 0..depth {
                let mut outer = Vec::new();
                put_inside(12, &mut outer, |out| out.extend_from_slice(&bytes));
                bytes = outer;
            }
            bytes
        };
        assert!(Model::decode(&nested(12)).is_ok());
        assert_eq!(Model::decode(&nested(10_000)), Err(DecodeError::Deep));
    }
}
