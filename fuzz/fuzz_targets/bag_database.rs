//! Any bytes as a database of rosbag2: refused or read in the order of time.
#![no_main]

use std::fs;

use libfuzzer_sys::fuzz_target;
use periplus_bags::Selection;
use periplus_bags::files::Bag;

fuzz_target!(|bytes: &[u8]| {
    // What does not begin like a database is another target's.
    if !bytes.starts_with(b"SQLite format 3\0") {
        return;
    }
    let path = std::env::temp_dir().join(format!("periplus-fuzz-{}.db3", std::process::id()));
    fs::write(&path, bytes).expect("the folder for temporary files can be written");
    if let Ok(bag) = Bag::open(&path) {
        let mut messages = bag.messages(Selection::default());
        let mut last_ns = i64::MIN;
        let mut count = 0;
        while let Ok(Some(message)) = messages.next() {
            assert!(message.topic < bag.topics().len());
            assert!(message.log_ns >= last_ns, "in order");
            last_ns = message.log_ns;
            count += 1;
            // A damaged tree may lead in circles as long as its file allows.
            assert!(count < 1_000_000);
        }
    }
    let _ = fs::remove_file(&path);
});
