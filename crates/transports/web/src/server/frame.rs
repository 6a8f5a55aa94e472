//! WebSocket frames of servers (RFC 6455, section 5.2): one per message, unmasked.

use tungstenite::protocol::CloseFrame;
use tungstenite::protocol::frame::coding::{Data, OpCode};
use tungstenite::protocol::frame::{Frame, FrameHeader};

/// Maximum length of the reason of a close frame \[bytes\]: a control frame has at most 125 bytes,
/// two of which are the code.
const MAX_REASON_BYTES: usize = 123;

/// Header of a message of this length \[bytes\].
pub(crate) fn header(is_text: bool, length: usize) -> Vec<u8> {
    let opcode = OpCode::Data(if is_text { Data::Text } else { Data::Binary });
    let header = FrameHeader { opcode, ..FrameHeader::default() };
    let mut bytes = Vec::with_capacity(10);
    // Fails only if the sink does, and memory does not.
    let _ = header.format(length as u64, &mut bytes);
    bytes
}

/// Close frame with a code and reason.
pub(crate) fn close(code: u16, why: &str) -> Vec<u8> {
    let mut end = why.len().min(MAX_REASON_BYTES);
    while !why.is_char_boundary(end) {
        end -= 1;
    }
    encode(Frame::close(Some(CloseFrame { code: code.into(), reason: why[..end].into() })))
}

/// Ping frame.
pub(crate) fn ping() -> Vec<u8> {
    encode(Frame::ping(Vec::new()))
}

fn encode(frame: Frame) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(frame.len());
    let _ = frame.format(&mut bytes);
    bytes
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
        assert_eq!(ping(), [0x89, 0]);
    }
}
