//! Messages to the user in a browser tab, which has no stderr.

use std::io::{self, Write};
use std::sync::{Mutex, PoisonError};

/// Number of bytes that are kept; what comes later is dropped and counted.
const MAX_KEPT_BYTES: usize = 1 << 20;

/// Messages since the last [`take_messages`], and the number of dropped bytes.
static LOG: Mutex<(Vec<u8>, usize)> = Mutex::new((Vec::new(), 0));

/// Writer of messages.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MessageLog;

impl Write for MessageLog {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut log = LOG.lock().unwrap_or_else(PoisonError::into_inner);
        if log.0.len() + bytes.len() > MAX_KEPT_BYTES {
            log.1 += bytes.len();
        } else {
            log.0.extend_from_slice(bytes);
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Takes the messages since the last call, without colours.
#[must_use]
pub fn take_messages() -> String {
    let (bytes, dropped) = std::mem::take(&mut *LOG.lock().unwrap_or_else(PoisonError::into_inner));
    let text = String::from_utf8_lossy(&bytes);
    let mut text = crate::terminal::without_colours(&text);
    if dropped > 0 {
        text.push_str(&format!("{dropped} bytes of further messages were dropped\n"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_taken_once_without_colours_and_their_memory_is_bounded() {
        writeln!(MessageLog, "\u{1b}[1mbold\u{1b}[0m").unwrap();
        assert_eq!(take_messages(), "bold\n");
        assert_eq!(take_messages(), "");
        let line = [b'x'; 4096];
        for _ in 0..(MAX_KEPT_BYTES / line.len() + 2) {
            MessageLog.write_all(&line).unwrap();
        }
        let text = take_messages();
        assert_eq!(&text[MAX_KEPT_BYTES..], "8192 bytes of further messages were dropped\n");
    }
}
