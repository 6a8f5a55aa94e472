//! Entries for fuzzers.

use std::io::BufReader;

use crate::tcpros::{Header, MAX_HEADER_BYTES, read_frame, read_header};
use crate::xmlrpc::{read_body, read_head};

/// Reads bytes as requests and responses of HTTP, and their bodies.
pub fn fuzz_http(bytes: &[u8]) {
    for is_request in [true, false] {
        let mut reader = BufReader::new(bytes);
        while let Ok(Some(head)) = read_head(&mut reader, is_request) {
            if read_body(&mut reader, &head).is_err() {
                break;
            }
        }
    }
}

/// Reads bytes as a header, then as messages.
///
/// # Panics
/// When a header is not read back as it was written.
pub fn fuzz_tcpros(bytes: &[u8]) {
    let mut stream = bytes;
    if let Ok(header) = read_header(&mut stream) {
        let again = Header::read(&header.write()[4..]);
        assert_eq!(again, Ok(header));
    }
    while read_frame(&mut stream, MAX_HEADER_BYTES).is_ok() {}
    if let Ok(header) = Header::read(bytes) {
        assert_eq!(Header::read(&header.write()[4..]), Ok(header));
    }
}
