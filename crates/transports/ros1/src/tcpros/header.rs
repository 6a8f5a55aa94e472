//! Headers of connections.

use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Read};

use super::frame::{read_frame, read_sized};

/// Maximum size of a header; the definition of a message is part of it.
pub const MAX_HEADER_BYTES: usize = 1 << 20;

/// Header of a connection: fields with their names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Header(BTreeMap<String, String>);

/// Bytes that are no header.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MalformedHeader(pub &'static str);

impl fmt::Display for MalformedHeader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "malformed TCPROS header: {}", self.0)
    }
}

impl std::error::Error for MalformedHeader {}

impl Header {
    /// Header with these fields.
    #[must_use]
    pub fn new(fields: &[(&str, &str)]) -> Self {
        Self(fields.iter().map(|(name, value)| ((*name).into(), (*value).into())).collect())
    }

    /// Value of a field; empty if it is missing.
    #[must_use]
    pub fn get(&self, name: &str) -> &str {
        self.0.get(name).map_or("", String::as_str)
    }

    /// True if a field exists.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// Reads the fields, without the length of the whole.
    ///
    /// # Errors
    /// When a length leads out of the bytes, or a field has no `=`.
    pub fn read(mut bytes: &[u8]) -> Result<Self, MalformedHeader> {
        let mut fields = BTreeMap::new();
        while !bytes.is_empty() {
            let (length, rest) =
                bytes.split_first_chunk().ok_or(MalformedHeader("a length is cut off"))?;
            let length = u32::from_le_bytes(*length) as usize;
            if length > rest.len() {
                return Err(MalformedHeader("a field is longer than the header"));
            }
            let (field, rest) = rest.split_at(length);
            let field = String::from_utf8_lossy(field);
            let (name, value) =
                field.split_once('=').ok_or(MalformedHeader("a field has no `=`"))?;
            fields.insert(name.to_owned(), value.to_owned());
            bytes = rest;
        }
        Ok(Self(fields))
    }

    /// Bytes with all lengths.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut out = vec![0; 4];
        for (name, value) in &self.0 {
            put_length(&mut out, name.len() + 1 + value.len());
            out.extend_from_slice(name.as_bytes());
            out.push(b'=');
            out.extend_from_slice(value.as_bytes());
        }
        let mut front = Vec::new();
        put_length(&mut front, out.len() - 4);
        out[..4].copy_from_slice(&front);
        out
    }
}

fn put_length(out: &mut Vec<u8>, length: usize) {
    out.extend_from_slice(&u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes());
}

/// Reads a header.
pub(crate) fn read_header(stream: &mut impl Read) -> io::Result<Header> {
    let bytes = read_frame(stream, MAX_HEADER_BYTES)?;
    Header::read(&bytes).map_err(io::Error::other)
}

/// Reads a header whose length is read already.
pub(crate) fn read_header_after(front: [u8; 4], stream: &mut impl Read) -> io::Result<Header> {
    let mut bytes = Vec::new();
    read_sized(front, stream, MAX_HEADER_BYTES, &mut bytes)?;
    Header::read(&bytes).map_err(io::Error::other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_header_has_the_bytes_of_the_documentation() {
        let header = Header::new(&[("topic", "/chatter")]);
        let mut bytes = vec![18, 0, 0, 0, 14, 0, 0, 0];
        bytes.extend_from_slice(b"topic=/chatter");
        assert_eq!(header.write(), bytes);
        assert_eq!(read_header(&mut bytes.as_slice()).expect("a header"), header);
    }

    #[test]
    fn wrong_lengths_are_refused() {
        let error = |bytes: &[u8]| Header::read(bytes).unwrap_err().0;
        assert_eq!(error(&[1, 0]), "a length is cut off");
        assert_eq!(error(&[9, 0, 0, 0, b'a']), "a field is longer than the header");
        assert_eq!(error(&[1, 0, 0, 0, b'a']), "a field has no `=`");
        let huge = [0xff, 0xff, 0xff, 0x7f, 1, 2, 3];
        let error = read_header(&mut huge.as_slice()).unwrap_err();
        assert!(error.to_string().contains("2147483647"), "{error}");
    }

    proptest! {
        #[test]
        fn any_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
            if let Ok(header) = Header::read(&bytes) {
                prop_assert_eq!(Header::read(&header.write()[4..]), Ok(header));
            }
        }
    }
}
