//! Frames of the protocol: a length of four bytes, a kind, and a body, all numbers little endian.

use std::io;

use crate::socket::Source;

/// Kinds of frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Kind {
    /// From the process: a message to publish. Endpoint, bytes.
    Publish = b'P',
    /// From the process: a request. Endpoint, number, bytes.
    Call = b'C',
    /// From the process: a response. Number of the call, bytes.
    Answer = b'R',
    /// From the process: a call that gets no response. Number of the call.
    Refuse = b'X',
    /// From the process: an endpoint is dropped. Endpoint.
    Drop = b'D',
    /// From the process: all threads wait. Time to wake up \[ns\], 1 if messages wake it.
    Idle = b'I',
    /// From the process: a question or a new endpoint, JSON; answered by [`Kind::Reply`].
    Query = b'Q',
    /// To the process: a message. Endpoint, time \[ns\], sequence number, bytes.
    Message = b'M',
    /// To the process: a request. Endpoint, number of the call, bytes.
    Request = b'q',
    /// To the process: a response. Endpoint, number, bytes.
    Response = b'r',
    /// To the process: continue. Time of the graph \[ns\].
    Go = b'G',
    /// To the process: a reply, JSON.
    Reply = b'A',
}

impl Kind {
    fn of(byte: u8) -> Option<Self> {
        use Kind::{
            Answer, Call, Drop, Go, Idle, Message, Publish, Query, Refuse, Reply, Request, Response,
        };
        let all = [
            Publish, Call, Answer, Refuse, Drop, Idle, Query, Message, Request, Response, Go, Reply,
        ];
        all.into_iter().find(|kind| *kind as u8 == byte)
    }
}

/// Limit of the body of a frame, against garbage [bytes].
const MAX_BODY_BYTES: u32 = 1 << 30;

/// Header: length and kind [bytes].
const HEADER_BYTES: usize = 5;

/// Appends a frame; the parts of the body follow each other.
pub(crate) fn append(out: &mut Vec<u8>, kind: Kind, parts: &[&[u8]]) {
    let length: usize = parts.iter().map(|part| part.len()).sum();
    out.reserve(HEADER_BYTES + length);
    out.extend_from_slice(&u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes());
    out.push(kind as u8);
    for part in parts {
        out.extend_from_slice(part);
    }
}

/// Reads frames from a socket.
#[derive(Default)]
pub(crate) struct Reader {
    buffer: Vec<u8>,
    start: usize,
    end: usize,
}

/// Initial size of the buffer [bytes].
const BUFFER_BYTES: usize = 64 << 10;

impl Reader {
    /// Next frame: its kind and its body.
    ///
    /// # Errors
    /// `UnexpectedEof` at the end of the connection, `InvalidData` for garbage, and the errors of the socket. After a
    /// timeout or a signal the call can be repeated ([`is_pause`]).
    pub(crate) fn next(&mut self, source: &mut impl Source) -> io::Result<(Kind, &[u8])> {
        self.fill(source, HEADER_BYTES)?;
        let header = &self.buffer[self.start..self.start + HEADER_BYTES];
        let length = u32::from_le_bytes([header[0], header[1], header[2], header[3]]);
        let kind = Kind::of(header[4]).filter(|_| length <= MAX_BODY_BYTES);
        let Some(kind) = kind else { return Err(io::ErrorKind::InvalidData.into()) };
        let whole = HEADER_BYTES + length as usize;
        self.fill(source, whole)?;
        let body = self.start + HEADER_BYTES..self.start + whole;
        self.start += whole;
        Ok((kind, &self.buffer[body]))
    }

    /// Reads until there are `wanted` bytes.
    fn fill(&mut self, source: &mut impl Source, wanted: usize) -> io::Result<()> {
        while self.end - self.start < wanted {
            if self.start == self.end {
                (self.start, self.end) = (0, 0);
            }
            if self.buffer.len() < self.start + wanted {
                self.buffer.copy_within(self.start..self.end, 0);
                (self.start, self.end) = (0, self.end - self.start);
                let size = wanted.max(BUFFER_BYTES);
                if self.buffer.len() < size {
                    self.buffer.resize(size, 0);
                }
            }
            match source.receive(&mut self.buffer[self.end..]) {
                Ok(0) => return Err(io::ErrorKind::UnexpectedEof.into()),
                Ok(count) => self.end += count,
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }
}

/// True for a timeout or a signal.
pub(crate) fn is_pause(error: &io::Error) -> bool {
    use io::ErrorKind::{Interrupted, TimedOut, WouldBlock};
    matches!(error.kind(), Interrupted | TimedOut | WouldBlock)
}

/// Takes numbers from the start of a body.
pub(crate) struct Body<'a>(pub(crate) &'a [u8]);

impl<'a> Body<'a> {
    fn bytes<const N: usize>(&mut self) -> io::Result<[u8; N]> {
        let (head, tail) = self.0.split_at_checked(N).ok_or(io::ErrorKind::InvalidData)?;
        self.0 = tail;
        head.try_into().map_err(|_| io::ErrorKind::InvalidData.into())
    }

    pub(crate) fn u8(&mut self) -> io::Result<u8> {
        Ok(u8::from_le_bytes(self.bytes()?))
    }

    pub(crate) fn u32(&mut self) -> io::Result<u32> {
        Ok(u32::from_le_bytes(self.bytes()?))
    }

    pub(crate) fn u64(&mut self) -> io::Result<u64> {
        Ok(u64::from_le_bytes(self.bytes()?))
    }

    pub(crate) fn i64(&mut self) -> io::Result<i64> {
        Ok(i64::from_le_bytes(self.bytes()?))
    }

    /// Returns the remaining bytes.
    pub(crate) fn rest(self) -> &'a [u8] {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives one byte at a time.
    struct Slow<'a>(&'a [u8]);

    impl Source for Slow<'_> {
        fn receive(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let Some((first, rest)) = self.0.split_first() else { return Ok(0) };
            buffer[0] = *first;
            self.0 = rest;
            Ok(1)
        }
    }

    #[test]
    fn frames_survive_a_slow_socket() {
        let mut bytes = Vec::new();
        append(&mut bytes, Kind::Publish, &[&7_u32.to_le_bytes(), b"hello"]);
        append(&mut bytes, Kind::Go, &[&(-3_i64).to_le_bytes()]);
        let (mut slow, mut reader) = (Slow(&bytes), Reader::default());
        let (kind, body) = reader.next(&mut slow).expect("a frame");
        let mut body = Body(body);
        assert_eq!(
            (kind, body.u32().expect("a number"), body.rest()),
            (Kind::Publish, 7, &b"hello"[..])
        );
        let (kind, body) = reader.next(&mut slow).expect("a frame");
        assert_eq!((kind, Body(body).i64().expect("a number")), (Kind::Go, -3));
        let end = reader.next(&mut slow).expect_err("no more frames");
        assert_eq!(end.kind(), io::ErrorKind::UnexpectedEof);
    }

    #[test]
    fn garbage_is_refused() {
        for bytes in [&[0xff; 16][..], &[1, 0, 0, 0, b'?', 0]] {
            let error = Reader::default().next(&mut Slow(bytes)).expect_err("no frame");
            assert_eq!(error.kind(), io::ErrorKind::InvalidData);
        }
    }
}
