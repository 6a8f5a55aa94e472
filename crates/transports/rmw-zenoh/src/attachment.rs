//! Attachments of messages, requests and responses: sequence number, time and sender.
//!
//! Source: `rmw_zenoh`'s design document, "Publishers" and "Service Clients".

/// Id of an endpoint on the network, a hash of its liveliness token.
pub type Gid = [u8; 16];

/// Size of an attachment \[bytes\]: two numbers, the length of the id, the id.
const SIZE: usize = 8 + 8 + 1 + 16;

/// Attachment of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attachment {
    /// Sequence number of the message; a response repeats that of its request.
    pub number: i64,
    /// Time of sending, since 1970 \[ns\].
    pub time_ns: i64,
    /// Id of the sender; a response repeats that of the client.
    pub gid: Gid,
}

impl Attachment {
    /// Encodes the attachment.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut out = Vec::with_capacity(SIZE);
        out.extend(self.number.to_le_bytes());
        out.extend(self.time_ns.to_le_bytes());
        out.push(16);
        out.extend(self.gid);
        out
    }

    /// Decodes an attachment; none if it is malformed.
    #[must_use]
    pub fn read(bytes: &[u8]) -> Option<Self> {
        let (number, rest) = bytes.split_first_chunk()?;
        let (time, rest) = rest.split_first_chunk()?;
        let (length, gid) = rest.split_first()?;
        (*length == 16).then_some(())?;
        Some(Self {
            number: i64::from_le_bytes(*number),
            time_ns: i64::from_le_bytes(*time),
            gid: gid.try_into().ok()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_bytes_are_those_of_rmw_zenoh() {
        let one = Attachment { number: 1, time_ns: 0x0203, gid: [9; 16] };
        let mut expected = vec![1, 0, 0, 0, 0, 0, 0, 0, 3, 2, 0, 0, 0, 0, 0, 0, 16];
        expected.extend([9; 16]);
        assert_eq!(one.write(), expected);
        assert_eq!(Attachment::read(&expected), Some(one));
        for end in 0..expected.len() {
            assert_eq!(Attachment::read(&expected[..end]), None);
        }
        expected.push(0);
        assert_eq!(Attachment::read(&expected), None);
    }

    proptest! {
        #[test]
        fn any_bytes_are_survived(bytes in prop::collection::vec(any::<u8>(), 0..50)) {
            if let Some(one) = Attachment::read(&bytes) {
                prop_assert_eq!(one.write(), bytes);
            }
        }
    }
}
