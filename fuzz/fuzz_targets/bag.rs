//! Any bytes as an MCAP file: refused or read, in the order of time, with the summary or without; and
//! a file that passes the strict check gives as many messages as its summary declares.
#![no_main]

use std::io::Cursor;

use libfuzzer_sys::fuzz_target;
use periplus_bags::{Limits, Reader, Selection, check};
use periplus_diagnostics::{Diagnostics, SourceMap};

fuzz_target!(|bytes: &[u8]| {
    let is_right = check(bytes).is_empty();
    let limits = Limits { chunk: 1 << 20, unpacked: 4 << 20 };
    let Ok(mut reader) = Reader::open_within(Cursor::new(bytes), limits) else {
        assert!(!is_right, "a right file can be opened");
        return;
    };
    let _ = reader.types(&mut SourceMap::new(), &mut Diagnostics::new());
    let announced = reader.message_count();
    let mut messages = reader.messages(Selection::default());
    let mut count = 0;
    while let Ok(Some(message)) = messages.next() {
        assert!(message.data.len() <= limits.chunk as usize);
        count += 1;
    }
    if is_right && reader.faults().is_empty() {
        assert_eq!(Some(count), announced);
    }
});
