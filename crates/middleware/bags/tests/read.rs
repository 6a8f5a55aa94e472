//! Reading: all intact messages, in order, from complete and damaged files.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use std::io::Cursor;

use periplus_bags::{
    Compression, Limits, QosProfile, ReadError, Reader, Selection, Settings, Stamp, Style, Topic,
    Writer, read_metadata, repair,
};
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_msgs::std_msgs::UInt32;
use periplus_msgs::{DynamicMessage, Format, Message};
use proptest::prelude::*;

/// Number, log time and topic of each message.
type Row = (u32, i64, String);

fn rows(reader: &mut Reader<Cursor<&[u8]>>, selection: Selection) -> Vec<Row> {
    let names: Vec<String> = reader.topics().iter().map(|topic| topic.name.clone()).collect();
    let mut rows = Vec::new();
    let mut messages = reader.messages(selection);
    while let Some(message) = messages.next().unwrap() {
        let number = UInt32::decode_cdr(message.data).unwrap().data;
        rows.push((number, message.log_ns, names[message.topic].clone()));
    }
    rows
}

fn read(bytes: &[u8]) -> Vec<Row> {
    rows(&mut Reader::open(Cursor::new(bytes)).unwrap(), Selection::default())
}

/// Forty numbers on two topics, 0.1 s apart, each pair in the wrong order.
fn numbers(compression: Compression) -> (Vec<u8>, Vec<Row>) {
    let settings = Settings { compression, threads: 0, ..Settings::new("n.mcap") };
    let mut bag = Writer::new(Vec::new(), settings).unwrap();
    let names = ["/even", "/odd"];
    let topics = names.map(|name| bag.topic(Topic::of::<UInt32>(name, &[QosProfile::latched(1)])));
    let topics = topics.map(Result::unwrap);
    let mut rows = Vec::new();
    for number in 0..40_u32 {
        let time_ns = i64::from(number ^ 1) * 100_000_000;
        let (data, which) = (UInt32 { data: number }.to_cdr().unwrap(), number as usize % 2);
        bag.write(topics[which], Stamp::at(time_ns), &data).unwrap();
        rows.push((number, time_ns, names[which].to_owned()));
    }
    rows.sort_by_key(|row| row.1);
    (bag.finish().unwrap().0, rows)
}

const ALL: [Compression; 3] = [Compression::None, Compression::Lz4, Compression::Zstd];

#[test]
fn what_was_written_is_read_in_order() {
    for compression in ALL {
        let (bytes, rows) = numbers(compression);
        let mut reader = Reader::open(Cursor::new(&*bytes)).unwrap();
        assert!(reader.has_summary() && reader.faults().is_empty());
        assert_eq!(reader.message_count(), Some(40));
        assert_eq!(reader.span_ns(), Some((0, 3_900_000_000)));
        assert_eq!(self::rows(&mut reader, Selection::default()), rows);
        let topic = &reader.topics()[1];
        assert_eq!((&*topic.name, &*topic.type_name), ("/odd", "std_msgs/msg/UInt32"));
        assert!(topic.metadata["offered_qos_profiles"].contains("transient_local"));
    }
}

#[test]
fn topics_and_times_are_selected() {
    let (bytes, mut expected) = numbers(Compression::Zstd);
    let mut reader = Reader::open(Cursor::new(&*bytes)).unwrap();
    let selection = Selection {
        span_ns: 500_000_000..=2_000_000_000,
        ..Selection::topics(["/odd", "/unknown"])
    };
    expected.retain(|(_, time_ns, topic)| {
        (500_000_000..=2_000_000_000).contains(time_ns) && topic == "/odd"
    });
    assert_eq!(expected.len(), 8);
    assert_eq!(rows(&mut reader, selection), expected);
    let none = Selection { span_ns: i64::MIN..=-1, ..Selection::default() };
    assert_eq!(rows(&mut reader, none), []);
}

#[test]
fn messages_are_decoded_by_the_types_of_the_file() {
    let (bytes, _) = numbers(Compression::Lz4);
    let mut reader = Reader::open(Cursor::new(&*bytes)).unwrap();
    let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
    let types = reader.types(&mut sources, &mut findings);
    assert!(findings.is_empty(), "{findings:?}");
    let layout = types.layout(&reader.topics()[0].type_name).unwrap().clone();
    let mut messages = reader.messages(Selection::topics(["/even"]));
    let first = messages.next().unwrap().unwrap();
    let first = DynamicMessage::decode(&layout, Format::CDR, first.data).unwrap();
    assert_eq!(first.to_json(), serde_json::json!({ "data": 0 }));
}

/// Files by PyPI `mcap` 1.6.0, made by `benches/oracles/bags_oracle.py write`.
#[test]
fn files_of_another_writer() {
    let files: [(&str, &[u8]); 5] = [
        ("plain", include_bytes!("data/mcap_plain.mcap")),
        ("lz4", include_bytes!("data/mcap_lz4.mcap")),
        ("zstd", include_bytes!("data/mcap_zstd.mcap")),
        ("unchunked", include_bytes!("data/mcap_unchunked.mcap")),
        ("no_summary", include_bytes!("data/mcap_no_summary.mcap")),
    ];
    let name = |number: u32| if number.is_multiple_of(2) { "/even" } else { "/odd" };
    let expected: Vec<Row> =
        (0..40).map(|n| (n ^ 1, i64::from(n) * 1_000, name(n ^ 1).to_owned())).collect();
    for (file, bytes) in files {
        assert_eq!(periplus_bags::check(bytes), [], "{file}");
        let mut reader = Reader::open(Cursor::new(bytes)).unwrap();
        assert_eq!(reader.faults(), [], "{file}");
        assert_eq!(rows(&mut reader, Selection::default()), expected, "{file}");
        // As if the recorder had been killed.
        let end = bytes.len() - 40;
        let mut reader = Reader::open(Cursor::new(&bytes[..end])).unwrap();
        assert!(!reader.has_summary() && !reader.faults().is_empty());
        assert_eq!(rows(&mut reader, Selection::default()), expected, "{file}");
    }
}

#[test]
fn a_file_cut_anywhere_gives_what_is_complete() {
    for compression in ALL {
        let (bytes, all) = numbers(compression);
        let mut before = 0;
        for end in 8..bytes.len() {
            let mut rows = read(&bytes[..end]);
            // Messages are in the order of their numbers in the file.
            rows.sort();
            let mut expected = all.clone();
            expected.sort();
            assert_eq!(rows, expected[..rows.len()], "{compression:?}, cut at {end}");
            assert!(rows.len() >= before, "{compression:?}, cut at {end}");
            before = rows.len();
        }
        assert_eq!(before, 40);
        // All flushed messages are present; chunks span a second.
        let cut = read(&bytes[..bytes.len() * 2 / 3]);
        assert!(cut.len() >= 10, "{}", cut.len());
    }
}

#[test]
fn a_damaged_chunk_takes_only_its_own_messages() {
    for compression in [Compression::None, Compression::Zstd] {
        let (mut bytes, all) = numbers(compression);
        // The first chunk has numbers 0 to 9; its last byte precedes the first index.
        let at = find_record(&bytes, 0x07) - 1;
        bytes[at] ^= 0xff;
        let mut reader = Reader::open(Cursor::new(&*bytes)).unwrap();
        let rows = rows(&mut reader, Selection::default());
        let left: Vec<Row> = all.into_iter().filter(|row| row.0 >= 10).collect();
        assert_eq!(rows, left, "{compression:?}");
        assert_eq!(reader.faults().len(), 1, "{:?}", reader.faults());
    }
}

#[test]
fn a_damaged_first_chunk_of_a_cut_file_does_not_lose_topics() {
    for compression in [Compression::None, Compression::Zstd] {
        let (mut bytes, all) = numbers(compression);
        // The record Data End precedes the summary, which would repeat types and topics.
        bytes.truncate(find_record(&bytes, 0x0f));
        let at = find_record(&bytes, 0x07) - 1;
        bytes[at] ^= 0xff;
        let mut reader = Reader::open(Cursor::new(&*bytes)).unwrap();
        assert!(!reader.has_summary());
        let rows = rows(&mut reader, Selection::default());
        let left: Vec<Row> = all.into_iter().filter(|row| row.0 >= 10).collect();
        assert_eq!(rows, left, "{compression:?}");
    }
}

/// The first record with an opcode.
fn find_record(bytes: &[u8], opcode: u8) -> usize {
    let mut at = 8;
    while bytes[at] != opcode {
        at += 9 + u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap()) as usize;
    }
    at
}

#[test]
fn other_files_are_named() {
    let open = |bytes: &'static [u8]| match Reader::open(Cursor::new(bytes)) {
        Err(error @ ReadError::Unknown(_)) => error.to_string(),
        _ => String::new(),
    };
    assert!(open(b"SQLite format 3\0...").contains("sqlite3"));
    assert!(open(b"#ROSBAG V1.2\n").contains("ROS 1"));
    assert_eq!(open(b""), "this is not a bag: neither MCAP nor a ROS 1 bag");
}

#[test]
fn memory_is_limited() {
    let (bytes, _) = numbers(Compression::Zstd);
    let limits = Limits { chunk: 100, unpacked: 1_000 };
    let mut reader = Reader::open_within(Cursor::new(&*bytes), limits).unwrap();
    assert_eq!(rows(&mut reader, Selection::default()), []);
    assert!(!reader.faults().is_empty());
    let limits = Limits { chunk: 10_000, unpacked: 100 };
    let mut reader = Reader::open_within(Cursor::new(&*bytes), limits).unwrap();
    let result = reader.messages(Selection::default()).next().map(|_| ());
    assert!(matches!(result, Err(ReadError::TooLarge(_))));
}

#[test]
fn a_cut_file_is_made_whole() {
    let (bytes, all) = numbers(Compression::Zstd);
    // After the first chunk, and in the middle of the second.
    let cut = &bytes[..find_record(&bytes, 0x07) + 250];
    let mut reader = Reader::open(Cursor::new(cut)).unwrap();
    let settings = Settings { threads: 0, ..Settings::new("repaired.mcap") };
    let (repaired, info) = repair(&mut reader, Vec::new(), settings).unwrap();
    assert_eq!(periplus_bags::check(&repaired), []);
    assert_eq!(read(&repaired), read(cut));
    assert!(info.messages() >= 10 && info.messages() < all.len() as u64);
    assert_eq!(info.topics[0].qos, [QosProfile::latched(1)]);
    assert!(info.topics[0].type_hash.starts_with("RIHS01_"));
    // Complete files are copied unchanged except for the metadata.
    let mut reader = Reader::open(Cursor::new(&*bytes)).unwrap();
    let (again, _) = repair(&mut reader, Vec::new(), Settings::new("n.mcap")).unwrap();
    assert_eq!(read(&again), all);
}

#[test]
fn metadata_reads_back() {
    for text in
        [include_str!("data/metadata_humble.yaml"), include_str!("data/metadata_jazzy.yaml")]
    {
        let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
        let file = sources.add("metadata.yaml", text);
        let metadata = read_metadata(file, &sources, &mut findings).unwrap();
        assert!(findings.is_empty(), "{findings:?}");
        assert_eq!(metadata.storage, "mcap");
        let style = if metadata.version == 5 { Style::Humble } else { Style::Jazzy };
        assert_eq!(metadata.info.to_yaml(style), text);
    }
    let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
    let file = sources.add("metadata.yaml", "rosbag2_bagfile_information:\n  files: 7\n");
    assert!(read_metadata(file, &sources, &mut findings).is_none());
    assert!(findings.has_errors());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn damaged_files_are_read_without_harm(
        changes in prop::collection::vec((0_usize..6_000, any::<u8>()), 1..20),
        cut in 0_usize..6_000,
        which in 0_usize..3,
    ) {
        let (mut bytes, _) = numbers(ALL[which]);
        for (at, value) in changes {
            let length = bytes.len();
            bytes[at % length] = value;
        }
        bytes.truncate(bytes.len().saturating_sub(cut % 3_000));
        let _ = periplus_bags::check(&bytes);
        let limits = Limits { chunk: 1 << 20, unpacked: 4 << 20 };
        if let Ok(mut reader) = Reader::open_within(Cursor::new(&*bytes), limits) {
            let mut messages = reader.messages(Selection::default());
            let mut last_ns = 0;
            while let Ok(Some(message)) = messages.next() {
                last_ns = message.log_ns.max(last_ns);
            }
        }
    }
}
