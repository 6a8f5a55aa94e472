//! ROS 1 bags: written files are read back, also if truncated or damaged.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use std::io::Cursor;

use periplus_bags::{
    BagTopic, Limits, Reader, Ros1Compression, Ros1Settings, Ros1Writer, Selection, Stamp,
    WriteError,
};
use proptest::prelude::*;

const ALL: [Ros1Compression; 3] =
    [Ros1Compression::None, Ros1Compression::Bz2, Ros1Compression::Lz4];

fn topic(name: &str) -> BagTopic {
    let md5 = "304a39449588c7f8ce2df6e8001c5fce".to_owned();
    BagTopic {
        name: name.into(),
        type_name: "std_msgs/UInt32".into(),
        encoding: "ros1".into(),
        schema_encoding: "ros1msg".into(),
        schema: b"uint32 data\n".to_vec(),
        metadata: [("md5sum".to_owned(), md5), ("latching".to_owned(), "1".to_owned())].into(),
    }
}

/// Number, time and topic.
type Row = (u32, i64, String);

/// Forty numbers on two topics, 0.1 s apart, each pair in the wrong order.
fn numbers(compression: Ros1Compression) -> (Vec<u8>, Vec<Row>) {
    let settings = Ros1Settings { compression, ..Ros1Settings::new("n.bag") };
    let mut bag = Ros1Writer::new(Cursor::new(Vec::new()), settings).unwrap();
    let topics = ["/even", "/odd"].map(|name| bag.topic(&topic(name)).unwrap());
    let mut rows = Vec::new();
    for number in 0..40_u32 {
        let (time_ns, which) = (i64::from(number ^ 1) * 100_000_000 + 5, number as usize % 2);
        bag.write(topics[which], Stamp::at(time_ns), &number.to_le_bytes()).unwrap();
        rows.push((number, time_ns, ["/even", "/odd"][which].to_owned()));
    }
    rows.sort_by_key(|row| row.1);
    let (sink, info) = bag.finish().unwrap();
    assert_eq!((info.messages(), info.span_ns()), (40, Some((5, 3_900_000_005))));
    (sink.into_inner(), rows)
}

fn rows(reader: &mut Reader<Cursor<&[u8]>>, selection: Selection) -> Vec<Row> {
    let names: Vec<String> = reader.topics().iter().map(|topic| topic.name.clone()).collect();
    let mut rows = Vec::new();
    let mut messages = reader.messages(selection);
    while let Some(message) = messages.next().unwrap() {
        let number = u32::from_le_bytes(message.data.try_into().unwrap());
        rows.push((number, message.log_ns, names[message.topic].clone()));
    }
    rows
}

fn open(bytes: &[u8]) -> Reader<Cursor<&[u8]>> {
    Reader::open(Cursor::new(bytes)).unwrap()
}

#[test]
fn what_was_written_is_read_in_order() {
    for compression in ALL {
        let (bytes, expected) = numbers(compression);
        let mut reader = open(&bytes);
        assert!(reader.has_summary() && reader.faults().is_empty());
        assert_eq!(reader.counts(), Some(&[20, 20][..]));
        assert_eq!(reader.span_ns(), Some((5, 3_900_000_005)));
        assert_eq!(reader.topics()[1], topic("/odd"));
        assert_eq!(rows(&mut reader, Selection::default()), expected);
        let selection =
            Selection { span_ns: 500_000_000..=2_000_000_000, ..Selection::topics(["/odd"]) };
        let some = |row: &&Row| row.2 == "/odd" && (500_000_000..=2_000_000_000).contains(&row.1);
        let some: Vec<Row> = expected.iter().filter(some).cloned().collect();
        assert_eq!(rows(&mut reader, selection), some);
    }
}

#[test]
fn a_bag_cut_anywhere_gives_what_is_complete() {
    for compression in ALL {
        let (bytes, mut all) = numbers(compression);
        all.sort();
        let mut before = 0;
        for end in 13..bytes.len() {
            let mut rows = rows(&mut open(&bytes[..end]), Selection::default());
            rows.sort();
            assert_eq!(rows, all[..rows.len()], "{compression:?}, cut at {end}");
            assert!(rows.len() >= before, "{compression:?}, cut at {end}");
            before = rows.len();
        }
        assert_eq!(before, 40);
    }
}

#[test]
fn a_bag_that_was_not_closed_is_read_without_its_index() {
    let (mut bytes, expected) = numbers(Ros1Compression::Lz4);
    // The offset of the index follows `index_pos=`.
    let at = bytes.windows(10).position(|window| window == b"index_pos=").unwrap() + 10;
    bytes[at..at + 8].fill(0);
    let mut reader = open(&bytes);
    assert!(!reader.has_summary());
    assert_eq!(reader.faults().len(), 1);
    assert_eq!(reader.counts(), Some(&[20, 20][..]));
    assert_eq!(rows(&mut reader, Selection::default()), expected);
}

#[test]
fn an_index_with_wrong_times_is_found_out() {
    let (mut bytes, expected) = numbers(Ros1Compression::None);
    // The last record of the index contains the start time of the last chunk, 3 s.
    let key = b"start_time=";
    let at = bytes.windows(key.len()).rposition(|window| window == key).unwrap() + key.len();
    assert_eq!(bytes[at], 3);
    bytes[at] = 4;
    let mut reader = open(&bytes);
    assert!(reader.has_summary() && reader.faults().is_empty());
    assert_eq!(rows(&mut reader, Selection::default()), expected);
    let faults: Vec<String> = reader.faults().iter().map(ToString::to_string).collect();
    assert!(faults.len() == 1 && faults[0].contains("older than their index states"), "{faults:?}");
}

#[test]
fn nothing_stands_after_the_last_nanosecond() {
    const LATEST: i64 = 4_294_967_295_999_999_999;
    let write = |time_ns| {
        let settings = Ros1Settings::new("late.bag");
        let mut bag = Ros1Writer::new(Cursor::new(Vec::new()), settings).unwrap();
        let topic = bag.topic(&topic("/late")).unwrap();
        bag.write(topic, Stamp::at(time_ns), &7_u32.to_le_bytes()).unwrap();
        bag.finish().unwrap().0.into_inner()
    };
    let times = |bytes: &[u8]| -> Vec<i64> {
        rows(&mut open(bytes), Selection::default()).iter().map(|row| row.1).collect()
    };
    assert_eq!(times(&write(i64::MAX)), [LATEST]);
    // Four seconds of nanoseconds after the last second; found by fuzzing.
    let mut bytes = write(LATEST);
    let last = [u32::MAX.to_le_bytes(), 999_999_999_u32.to_le_bytes()].concat();
    for at in 0..bytes.len() - 8 {
        if bytes[at..at + 8] == last {
            bytes[at + 4..at + 8].copy_from_slice(&u32::MAX.to_le_bytes());
        }
    }
    assert_eq!(times(&bytes), [LATEST]);
}

#[test]
fn nothing_stands_before_the_first_nanosecond() {
    let settings = Ros1Settings::new("n.bag");
    let mut bag = Ros1Writer::new(Cursor::new(Vec::new()), settings).unwrap();
    let id = bag.topic(&topic("/a")).unwrap();
    assert!(matches!(bag.write(id, Stamp::at(-1), &[]), Err(WriteError::NegativeTime(-1))));
    assert!(matches!(bag.write(9, Stamp::at(1), &[]), Err(WriteError::UnknownTopic)));
    bag.write(id, Stamp::at(0), &[1, 0, 0, 0]).unwrap();
    let bytes = bag.finish().unwrap().0.into_inner();
    assert_eq!(open(&bytes).span_ns(), Some((1, 1)));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn damaged_bags_are_read_without_harm(
        changes in prop::collection::vec((0_usize..20_000, any::<u8>()), 1..20),
        cut in 0_usize..3_000,
        which in 0_usize..3,
    ) {
        let (mut bytes, _) = numbers(ALL[which]);
        for (at, value) in changes {
            let length = bytes.len();
            bytes[13 + at % (length - 13)] = value;
        }
        bytes.truncate(bytes.len() - cut);
        let limits = Limits { chunk: 1 << 20, unpacked: 4 << 20 };
        if let Ok(mut reader) = Reader::open_within(Cursor::new(&*bytes), limits) {
            let mut messages = reader.messages(Selection::default());
            while let Ok(Some(_)) = messages.next() {}
        }
    }
}
