//! Bags with very many topics: work grows linearly with their number.

use std::path::Path;
use std::time::{Duration, Instant};

use crate::common::Folder;
use periplus_bags::files::{Bag, BagWriter, Storage, WriteSettings};
use periplus_bags::{BagTopic, Selection, Stamp};

fn write(path: &Path, count: u32) {
    let mut bag = BagWriter::create(path, WriteSettings::new(Storage::Mcap)).unwrap();
    for number in 0..count {
        let topic = BagTopic {
            name: format!("/a_name_that_all_of_them_begin_with/{number}"),
            type_name: "std_msgs/msg/UInt32".into(),
            encoding: "cdr".into(),
            schema_encoding: "ros2msg".into(),
            schema: b"uint32 data\n".to_vec(),
            metadata: Default::default(),
        };
        let id = bag.topic(&topic).unwrap();
        bag.write(id, Stamp::at(i64::from(number)), &[0, 1, 0, 0, 0, 0, 0, 0]).unwrap();
    }
    bag.finish().unwrap();
}

/// Shortest time of three runs.
fn fastest(mut work: impl FnMut()) -> Duration {
    let turn = |_| {
        let start = Instant::now();
        work();
        start.elapsed()
    };
    (0..3).map(turn).min().unwrap()
}

#[test]
fn many_channels_are_opened_and_read_in_linear_time() {
    let folder = Folder::new("many");
    let (few, many) = (folder.path("few.mcap"), folder.path("many.mcap"));
    write(&few, 1_500);
    write(&many, 30_000);
    let read = |path: &Path| {
        let bag = Bag::open(path).unwrap();
        let mut messages = bag.messages(Selection::default());
        let mut count = 0;
        while messages.next().unwrap().is_some() {
            count += 1;
        }
        assert_eq!(count, bag.topics().len());
    };
    let (few, many) = (fastest(|| read(&few)), fastest(|| read(&many)));
    // 20 times as many: not 400 times as long.
    assert!(many < few * 120 || many.as_secs() < 2, "{few:?} for 1,500, {many:?} for 30,000");
}
