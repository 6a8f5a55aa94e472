//! WebSocket frames of servers (RFC 6455, section 5.2): one per message, unmasked.

const TEXT: u8 = 1;
const BINARY: u8 = 2;
const CLOSE: u8 = 8;
const PING: u8 = 9;

/// Header of a message of this length \[bytes\].
pub(crate) fn header(is_text: bool, length: usize) -> Vec<u8> {
    head(if is_text { TEXT } else { BINARY }, length)
}

fn head(opcode: u8, length: usize) -> Vec<u8> {
    // The FIN bit: the message ends with this frame.
    let mut bytes = vec![0x80 | opcode];
    match (u8::try_from(length), u16::try_from(length)) {
        (Ok(length @ 0..=125), _) => bytes.push(length),
        (_, Ok(length)) => {
            bytes.push(126);
            bytes.extend(length.to_be_bytes());
        }
        _ => {
            bytes.push(127);
            bytes.extend((length as u64).to_be_bytes());
        }
    }
    bytes
}

/// Close frame with a code and reason.
pub(crate) fn close(code: u16, why: &str) -> Vec<u8> {
    // A control frame has at most 125 bytes, two of which are the code.
    let mut end = why.len().min(123);
    while !why.is_char_boundary(end) {
        end -= 1;
    }
    let mut bytes = head(CLOSE, 2 + end);
    bytes.extend(code.to_be_bytes());
    bytes.extend(&why.as_bytes()[..end]);
    bytes
}

/// Ping frame.
pub(crate) fn ping() -> Vec<u8> {
    head(PING, 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_written_as_short_as_can_be() {
        assert_eq!(header(true, 0), [0x81, 0]);
        assert_eq!(header(false, 125), [0x82, 125]);
        assert_eq!(header(false, 126), [0x82, 126, 0, 126]);
        assert_eq!(header(false, 65_535), [0x82, 126, 255, 255]);
        assert_eq!(header(false, 65_536), [0x82, 127, 0, 0, 0, 0, 0, 1, 0, 0]);
    }

    #[test]
    fn the_last_words_are_cut_between_letters() {
        let frame = close(1001, &"ü".repeat(100));
        assert_eq!(frame.len(), 2 + 2 + 122);
        assert!(std::str::from_utf8(&frame[4..]).is_ok());
        assert_eq!(close(1000, ""), [0x88, 2, 0x03, 0xe8]);
    }
}
