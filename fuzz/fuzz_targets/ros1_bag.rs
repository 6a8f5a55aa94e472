//! Any bytes as the rest of a bag of ROS 1: read in the order of time, within limits; and what was
//! read is written and read again.
#![no_main]

use std::io::Cursor;

use libfuzzer_sys::fuzz_target;
use periplus_bags::{Limits, Reader, Ros1Settings, Ros1Writer, Selection, Stamp};
use periplus_diagnostics::{Diagnostics, SourceMap};

fuzz_target!(|rest: &[u8]| {
    let bytes = [b"#ROSBAG V2.0\n", rest].concat();
    let limits = Limits { chunk: 1 << 20, unpacked: 4 << 20 };
    let Ok(mut reader) = Reader::open_within(Cursor::new(&*bytes), limits) else { return };
    let _ = reader.types(&mut SourceMap::new(), &mut Diagnostics::new());
    let mut bag = Ros1Writer::new(Cursor::new(Vec::new()), Ros1Settings::new("again.bag"))
        .expect("memory takes all");
    let topics: Vec<u32> = reader
        .topics()
        .iter()
        .map(|topic| bag.topic(topic).expect("what was read can be written"))
        .collect();
    let mut written = Vec::new();
    let mut messages = reader.messages(Selection::default());
    while let Ok(Some(message)) = messages.next() {
        assert!(message.data.len() <= limits.chunk as usize);
        let stamp = Stamp::at(message.log_ns);
        bag.write(topics[message.topic], stamp, message.data)
            .expect("what was read can be written");
        written.push((message.log_ns.max(1), message.data.to_vec()));
    }
    // Times decrease only with a wrong index, which is reported as a fault.
    assert!(written.is_sorted_by_key(|(time_ns, _)| *time_ns) || !reader.faults().is_empty());
    written.sort_by_key(|(time_ns, _)| *time_ns);
    let again = bag.finish().expect("memory takes all").0.into_inner();
    let mut reader = Reader::open(Cursor::new(&*again)).expect("what was written can be read");
    assert!(reader.has_summary() && reader.faults().is_empty(), "{:?}", reader.faults());
    let mut messages = reader.messages(Selection::default());
    let mut read = Vec::new();
    while let Ok(Some(message)) = messages.next() {
        read.push((message.log_ns, message.data.to_vec()));
    }
    assert_eq!(read, written);
});
