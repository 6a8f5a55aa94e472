//! ZeroMQ framing on TCP.
//!
//! Source: ZMTP 3.0, `rfc.zeromq.org/spec/23`. Only the NULL security mechanism is implemented,
//! which is the one that Gazebo uses.

use std::io::{self, Read, Write};

/// Maximum number of parts of a message; Gazebo's have nine.
const MOST_PARTS: usize = 32;

/// Maximum size of a command \[bytes\].
const MOST_COMMAND: usize = 4096;

/// Size of the pieces in which a body is read \[bytes\], so that a length field alone allocates no
/// memory.
const PIECE: usize = 1 << 20;

const MORE: u8 = 1;
const LONG: u8 = 2;
const COMMAND: u8 = 4;

/// Socket type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Pub,
    Sub,
    Router,
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Self::Pub => "PUB",
            Self::Sub => "SUB",
            Self::Router => "ROUTER",
        }
    }

    /// True if a socket of the other type may be at the other end.
    fn talks_to(self, other: &[u8]) -> bool {
        match self {
            Self::Pub => matches!(other, b"SUB" | b"XSUB"),
            Self::Sub => matches!(other, b"PUB" | b"XPUB"),
            Self::Router => matches!(other, b"ROUTER" | b"DEALER" | b"REQ"),
        }
    }
}

fn wrong(what: &'static str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what)
}

/// The first 64 bytes of each side: signature, version, mechanism.
fn greeting() -> [u8; 64] {
    let mut bytes = [0; 64];
    bytes[0] = 0xff;
    bytes[9] = 0x7f;
    bytes[10] = 3;
    bytes[12..16].copy_from_slice(b"NULL");
    bytes
}

/// The READY command, with the socket type.
fn ready(kind: Kind, identity: &[u8]) -> Vec<u8> {
    let mut body = b"\x05READY".to_vec();
    let mut property = |name: &[u8], value: &[u8]| {
        body.push(u8::try_from(name.len()).unwrap_or(u8::MAX));
        body.extend_from_slice(name);
        body.extend_from_slice(&u32::try_from(value.len()).unwrap_or_default().to_be_bytes());
        body.extend_from_slice(value);
    };
    property(b"Socket-Type", kind.name().as_bytes());
    if kind == Kind::Router {
        property(b"Identity", identity);
    }
    body
}

/// Value of a property of the peer.
fn property<'a>(mut body: &'a [u8], wanted: &str) -> Option<&'a [u8]> {
    while let [length, rest @ ..] = body {
        let (name, rest) = rest.split_at_checked((*length).into())?;
        let (length, rest) = rest.split_first_chunk::<4>()?;
        let length = usize::try_from(u32::from_be_bytes(*length)).ok()?;
        let (value, rest) = rest.split_at_checked(length)?;
        if name.eq_ignore_ascii_case(wanted.as_bytes()) {
            return Some(value);
        }
        body = rest;
    }
    None
}

/// Performs the handshake. `identity` is the socket identity for a router.
///
/// # Errors
/// When the peer does not speak ZeroMQ, or has an incompatible socket type.
pub(super) fn shake_hands(
    stream: &mut (impl Read + Write),
    kind: Kind,
    identity: &[u8],
) -> io::Result<()> {
    stream.write_all(&greeting())?;
    let mut theirs = [0; 64];
    stream.read_exact(&mut theirs)?;
    if theirs[0] != 0xff || theirs[9] & 1 == 0 || theirs[10] < 3 {
        return Err(wrong("the peer does not speak ZMTP 3"));
    }
    if &theirs[12..17] != b"NULL\0" {
        return Err(wrong("the peer requires authentication"));
    }
    let mut out = Vec::new();
    put_frame(&mut out, COMMAND, &ready(kind, identity));
    stream.write_all(&out)?;
    let (flags, body) = read_frame(stream, MOST_COMMAND)?;
    let told = body.strip_prefix(b"\x05READY").filter(|_| flags & COMMAND != 0);
    let theirs = told.and_then(|body| property(body, "Socket-Type"));
    match theirs {
        Some(theirs) if kind.talks_to(theirs) => Ok(()),
        _ => Err(wrong("the peer has an incompatible socket type")),
    }
}

fn put_head(out: &mut Vec<u8>, flags: u8, length: usize) {
    if let Ok(short) = u8::try_from(length) {
        out.extend_from_slice(&[flags, short]);
    } else {
        out.push(flags | LONG);
        out.extend_from_slice(&(length as u64).to_be_bytes());
    }
}

fn put_frame(out: &mut Vec<u8>, flags: u8, body: &[u8]) {
    put_head(out, flags, body.len());
    out.extend_from_slice(body);
}

/// Encodes a message of several parts.
pub(super) fn message(parts: &[&[u8]]) -> Vec<u8> {
    let size: usize = parts.iter().map(|part| part.len() + 9).sum();
    let mut out = Vec::with_capacity(size);
    for (index, part) in parts.iter().enumerate() {
        let flags = if index + 1 < parts.len() { MORE } else { 0 };
        put_frame(&mut out, flags, part);
    }
    out
}

fn read_frame(stream: &mut impl Read, most: usize) -> io::Result<(u8, Vec<u8>)> {
    let mut head = [0; 2];
    stream.read_exact(&mut head)?;
    let flags = head[0];
    if flags & !(MORE | LONG | COMMAND) != 0 {
        return Err(wrong("a frame has unknown flags"));
    }
    let length = if flags & LONG == 0 {
        usize::from(head[1])
    } else {
        let mut rest = [0; 8];
        rest[0] = head[1];
        stream.read_exact(&mut rest[1..])?;
        usize::try_from(u64::from_be_bytes(rest)).unwrap_or(usize::MAX)
    };
    if length > most {
        return Err(wrong("a frame exceeds the maximum size"));
    }
    let mut body = Vec::with_capacity(length.min(PIECE));
    while body.len() < length {
        let from = body.len();
        body.resize((from + PIECE).min(length), 0);
        stream.read_exact(&mut body[from..])?;
    }
    Ok((flags, body))
}

/// Data received after the handshake.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Event {
    /// A message in its parts.
    Message(Vec<Vec<u8>>),
    /// A ping with its context, which the pong repeats.
    Ping(Vec<u8>),
    /// A subscription (true) or its end, with the filter.
    Subscribe(bool, Vec<u8>),
}

/// Reads the next event, of at most `most` bytes.
///
/// # Errors
/// When the connection ends, or the data violates ZMTP.
pub(super) fn read(stream: &mut impl Read, most: usize) -> io::Result<Event> {
    let mut parts = Vec::new();
    let mut left = most;
    loop {
        let (flags, body) = read_frame(stream, left)?;
        if flags & COMMAND != 0 {
            if let Some(event) = command(&body) {
                return Ok(event);
            }
            continue;
        }
        left -= body.len();
        parts.push(body);
        if flags & MORE == 0 {
            return Ok(Event::Message(parts));
        }
        if parts.len() == MOST_PARTS {
            return Err(wrong("a message has too many parts"));
        }
    }
}

fn command(body: &[u8]) -> Option<Event> {
    let (length, rest) = body.split_first()?;
    let (name, rest) = rest.split_at_checked((*length).into())?;
    match name {
        // The first two bytes are the time to live.
        b"PING" => Some(Event::Ping(rest.get(2..).unwrap_or_default().to_vec())),
        b"SUBSCRIBE" => Some(Event::Subscribe(true, rest.to_vec())),
        b"CANCEL" => Some(Event::Subscribe(false, rest.to_vec())),
        _ => None,
    }
}

/// The PONG command.
pub(super) fn pong(context: &[u8]) -> Vec<u8> {
    let mut body = b"\x04PONG".to_vec();
    body.extend_from_slice(context);
    let mut out = Vec::new();
    put_frame(&mut out, COMMAND, &body);
    out
}

/// Encodes a subscription of a topic, or its end.
pub(super) fn subscription(is_wanted: bool, filter: &str) -> Vec<u8> {
    let mut body = vec![u8::from(is_wanted)];
    body.extend_from_slice(filter.as_bytes());
    message(&[&body])
}

/// Entry point for fuzzing: reads all events.
#[doc(hidden)]
pub fn fuzz(mut bytes: &[u8]) -> usize {
    let mut count = 0;
    while let Ok(event) = read(&mut bytes, 1 << 20) {
        count += 1;
        if let Event::Message(parts) = event {
            let parts: Vec<&[u8]> = parts.iter().map(Vec::as_slice).collect();
            let again = message(&parts);
            assert_eq!(
                read(&mut again.as_slice(), 1 << 20).ok(),
                Some(Event::Message(parts.into_iter().map(<[u8]>::to_vec).collect()))
            );
        }
    }
    let _ = property(bytes, "Identity");
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::VecDeque;

    /// A stream that the test fills.
    #[derive(Default)]
    struct Loop {
        input: VecDeque<u8>,
        output: Vec<u8>,
    }

    impl Read for Loop {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            self.input.read(buffer)
        }
    }

    impl Write for Loop {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.output.write(bytes)
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn hands(theirs: Kind, ours: Kind) -> io::Result<()> {
        let mut stream = Loop::default();
        stream.input.extend(greeting());
        let mut frame = Vec::new();
        put_frame(&mut frame, COMMAND, &ready(theirs, b"me"));
        stream.input.extend(frame);
        shake_hands(&mut stream, ours, b"you")
    }

    #[test]
    fn only_those_who_fit_shake_hands() {
        assert!(hands(Kind::Sub, Kind::Pub).is_ok());
        assert!(hands(Kind::Pub, Kind::Sub).is_ok());
        assert!(hands(Kind::Router, Kind::Router).is_ok());
        assert!(hands(Kind::Pub, Kind::Pub).is_err());
        assert!(hands(Kind::Router, Kind::Sub).is_err());
    }

    #[test]
    fn properties_are_found_by_their_names() {
        let body = ready(Kind::Router, b"abc");
        let told = body.strip_prefix(b"\x05READY").expect("it begins so");
        assert_eq!(property(told, "identity"), Some(&b"abc"[..]));
        assert_eq!(property(told, "Socket-Type"), Some(&b"ROUTER"[..]));
        assert_eq!(property(told, "Other"), None);
    }

    /// A stream that ends after some bytes, and the largest buffer that it was asked to fill.
    struct Measured<'a> {
        bytes: &'a [u8],
        largest: usize,
    }

    impl Read for Measured<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            self.largest = self.largest.max(buffer.len());
            self.bytes.read(buffer)
        }
    }

    fn header_of_long_frame(length: u64) -> Vec<u8> {
        let mut bytes = vec![LONG];
        bytes.extend(length.to_be_bytes());
        bytes
    }

    #[test]
    fn a_frame_of_excessive_length_is_refused_at_its_header() {
        for length in [(1 << 30) + 1, 1 << 40, u64::MAX] {
            let bytes = header_of_long_frame(length);
            let mut stream = Measured { bytes: &bytes, largest: 0 };
            let error = read(&mut stream, 1 << 30).err().map(|error| error.to_string());
            assert_eq!(error.as_deref(), Some("a frame exceeds the maximum size"), "{length}");
            assert!(stream.largest < 10, "{length}: {}", stream.largest);
        }
    }

    #[test]
    fn a_length_alone_allocates_no_memory() {
        // Half a gigabyte is announced, and none of it follows.
        let bytes = header_of_long_frame(1 << 29);
        let mut stream = Measured { bytes: &bytes, largest: 0 };
        assert!(read(&mut stream, 1 << 30).is_err());
        assert_eq!(stream.largest, PIECE);
    }

    #[test]
    fn commands_between_messages_are_understood() {
        let mut bytes = Vec::new();
        put_frame(&mut bytes, COMMAND, b"\x04PING\0\x10hey");
        put_frame(&mut bytes, COMMAND, b"\x09SUBSCRIBE@/p@/a");
        put_frame(&mut bytes, COMMAND, b"\x05WHAT?");
        bytes.extend(message(&[b"x"]));
        let mut stream = bytes.as_slice();
        assert_eq!(read(&mut stream, 99).ok(), Some(Event::Ping(b"hey".to_vec())));
        assert_eq!(read(&mut stream, 99).ok(), Some(Event::Subscribe(true, b"@/p@/a".to_vec())));
        assert_eq!(read(&mut stream, 99).ok(), Some(Event::Message(vec![b"x".to_vec()])));
        assert_eq!(pong(b"hey"), b"\x04\x08\x04PONGhey");
    }

    proptest! {
        #[test]
        fn messages_come_back(parts in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..600), 1..9)) {
            let slices: Vec<&[u8]> = parts.iter().map(Vec::as_slice).collect();
            let bytes = message(&slices);
            prop_assert_eq!(read(&mut bytes.as_slice(), 1 << 20).ok(), Some(Event::Message(parts)));
        }

        #[test]
        fn any_bytes_are_survived(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
            fuzz(&bytes);
        }
    }
}
