//! CDR as DDS and bags carry it, and the bytes of ROS 1.
//!
//! CDR is XCDR version 1 of the DDS-XTypes specification, 7.4.3: every number stands at a multiple
//! of its size, counted from behind the four bytes of the encapsulation header. A string is its
//! length with the final zero, then its bytes and the zero; a `wstring` is the number of its UTF-16
//! units, then these (as rmw_cyclonedds sends it). ROS 1 packs the same values without padding and
//! without final zeros, and counts its headers.

mod reader;
mod recode;
mod writer;

use crate::{Codec, DecodeError, EncodeError};

pub use recode::recode;

pub(crate) use reader::Reader;
pub(crate) use writer::Writer;

/// The header of ROS 1 has a counter in front that ROS 2 has not.
pub(crate) const HEADER: &str = "std_msgs/msg/Header";

/// Which bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// CDR; read in the order that its header names, written in the order named here.
    Cdr(Encapsulation),
    /// ROS 1.
    Ros1,
}

impl Format {
    /// What everyone sends: little endian CDR.
    pub const CDR: Self = Self::Cdr(Encapsulation::LittleEndian);
}

/// The order of bytes in CDR.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encapsulation {
    /// The last byte first.
    LittleEndian,
    /// The first byte first.
    BigEndian,
}

/// Appends a value to `out`.
///
/// # Errors
/// When a string or list is longer than its type allows.
pub fn encode<T: Codec>(value: &T, format: Format, out: &mut Vec<u8>) -> Result<(), EncodeError> {
    let mut writer = Writer::new(format, out);
    value.write(&mut writer, None);
    writer.finish()
}

/// Reads a value.
///
/// # Errors
/// When the bytes are no such value.
pub fn decode<T: Codec>(format: Format, bytes: &[u8]) -> Result<T, DecodeError> {
    let mut reader = Reader::new(format, bytes)?;
    let mut value = T::blank();
    value.read(&mut reader, None)?;
    reader.finish()?;
    Ok(value)
}
