//! CDR, the format of DDS and bags, and the format of ROS 1.
//!
//! CDR is XCDR version 1 of the DDS-XTypes specification, 7.4.3: every number is aligned to its size,
//! relative to the end of the four bytes of the encapsulation header. A string is its length with the final
//! zero, then its bytes and the zero; a `wstring` is the number of its UTF-16 units, then these (as in
//! rmw_cyclonedds). ROS 1 packs the same values without padding and without final zeros, and its headers
//! have a sequence number.

mod reader;
mod recode;
mod writer;

use crate::{Codec, DecodeError, EncodeError};

pub use recode::recode;

pub(crate) use reader::Reader;
pub(crate) use writer::Writer;

/// In ROS 1 the header has an additional sequence number.
pub(crate) const HEADER: &str = "std_msgs/msg/Header";

/// Binary format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// CDR; read in the byte order of its header, written in this byte order.
    Cdr(Encapsulation),
    /// ROS 1.
    Ros1,
}

impl Format {
    /// Little endian CDR, the usual format.
    pub const CDR: Self = Self::Cdr(Encapsulation::LittleEndian);
}

/// Byte order of CDR.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encapsulation {
    /// Least significant byte first.
    LittleEndian,
    /// Most significant byte first.
    BigEndian,
}

/// Appends the binary form of a value to `out`.
///
/// # Errors
/// If a string or list is longer than its type allows.
pub fn encode<T: Codec>(value: &T, format: Format, out: &mut Vec<u8>) -> Result<(), EncodeError> {
    let mut writer = Writer::new(format, out);
    value.write(&mut writer, None);
    writer.finish()
}

/// Decodes a value.
///
/// # Errors
/// If the bytes are not such a value.
pub fn decode<T: Codec>(format: Format, bytes: &[u8]) -> Result<T, DecodeError> {
    let mut reader = Reader::new(format, bytes)?;
    let mut value = T::blank();
    value.read(&mut reader, None)?;
    reader.finish()?;
    Ok(value)
}
