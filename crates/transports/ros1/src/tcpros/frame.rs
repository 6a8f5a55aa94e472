//! Messages with their length before them.

use std::io::{self, Read};
use std::sync::Arc;

/// Maximum size of a message, as in roscpp.
pub const MAX_MESSAGE_BYTES: usize = 1_000_000_000;

/// Size by which the memory for a message grows, whatever length is announced.
const STEP_BYTES: usize = 4 << 20;

/// A message as it is sent, with its length before it. Connections share it.
pub(crate) type Frame = Arc<Vec<u8>>;

/// Reads a message.
pub(crate) fn read_frame(stream: &mut impl Read, most: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    read_frame_after(stream, most, &mut bytes)?;
    Ok(bytes)
}

/// As [`read_frame`], in place of what `out` has.
pub(crate) fn read_frame_after(
    stream: &mut impl Read,
    most: usize,
    out: &mut Vec<u8>,
) -> io::Result<()> {
    let mut front = [0; 4];
    stream.read_exact(&mut front)?;
    read_sized(front, stream, most, out)
}

/// Reads a message whose length is read already. Memory grows with what arrives, not with what is announced.
pub(super) fn read_sized(
    front: [u8; 4],
    stream: &mut impl Read,
    most: usize,
    out: &mut Vec<u8>,
) -> io::Result<()> {
    let length = u32::from_le_bytes(front) as usize;
    if length > most {
        let wrong = format!("{length} bytes are announced; at most {most} are read");
        return Err(io::Error::new(io::ErrorKind::InvalidData, wrong));
    }
    out.clear();
    while out.len() < length {
        let start = out.len();
        // What an earlier message needed is there already.
        let step = STEP_BYTES.max(out.capacity() - start).min(length - start);
        out.resize(start + step, 0);
        stream.read_exact(&mut out[start..])?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_is_read_in_full_or_not_at_all() {
        let bytes = [2, 0, 0, 0, 7, 8, 9];
        let mut stream = bytes.as_slice();
        assert_eq!(read_frame(&mut stream, 10).expect("a message"), [7, 8]);
        assert_eq!(stream, [9]);
        assert!(read_frame(&mut [3, 0, 0, 0, 1].as_slice(), 10).is_err());
        assert!(read_frame(&mut [11, 0, 0, 0].as_slice(), 10).is_err());
    }

    #[test]
    fn an_announced_gigabyte_takes_no_memory() {
        let mut bytes = 900_000_000_u32.to_le_bytes().to_vec();
        bytes.push(1);
        let mut out = Vec::new();
        assert!(read_frame_after(&mut bytes.as_slice(), MAX_MESSAGE_BYTES, &mut out).is_err());
        assert!(out.capacity() <= STEP_BYTES, "{}", out.capacity());
    }
}
