//! Small files with large claims: memory is bounded, and work grows with the input only.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]
#![allow(clippy::disallowed_methods, reason = "these tests measure time")]

use std::io::Cursor;
use std::time::{Duration, Instant};

use periplus_bags::{BagTopic, Reader, Ros1Settings, Ros1Writer, Selection, Stamp, check};

const MAGIC: &[u8] = b"\x89MCAP0\r\n";

fn record(opcode: u8, content: &[u8]) -> Vec<u8> {
    let mut record = vec![opcode];
    record.extend((content.len() as u64).to_le_bytes());
    record.extend(content);
    record
}

fn text(text: &str) -> Vec<u8> {
    let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
    bytes.extend(text.as_bytes());
    bytes
}

/// An MCAP file with a chunk of zeros in Zstandard that declares a length.
fn zeros(announced: u64) -> Vec<u8> {
    let packed = zstd::bulk::compress(&vec![0; 1 << 20], 1).unwrap();
    assert!(packed.len() < 200);
    let mut chunk = [[0_u8; 8], [0; 8], announced.to_le_bytes()].concat();
    chunk.extend([0; 4]);
    chunk.extend(text("zstd"));
    chunk.extend((packed.len() as u64).to_le_bytes());
    chunk.extend(packed);
    let header = [text(""), text("")].concat();
    let mut file = MAGIC.to_vec();
    file.extend([record(1, &header), record(6, &chunk), record(15, &[0; 4])].concat());
    file.extend(record(2, &[0; 20]));
    file.extend(MAGIC);
    file
}

#[test]
fn a_chunk_that_announces_a_gigabyte_is_not_unpacked() {
    let file = zeros(1 << 30);
    let told = |faults: &[periplus_bags::Fault]| {
        let needle = "declares 1073741824 bytes, more than the limit of 268435456";
        faults.iter().any(|fault| fault.to_string().contains(needle))
    };
    assert!(told(&check(&file)), "{:?}", check(&file));
    let mut reader = Reader::open(Cursor::new(&*file)).unwrap();
    while reader.messages(Selection::default()).next().unwrap().is_some() {}
    assert!(told(reader.faults()), "{:?}", reader.faults());
}

#[test]
fn the_first_empty_record_ends_the_check_of_a_chunk() {
    let faults = check(&zeros(1 << 20));
    let of_chunk = faults.iter().filter(|fault| fault.to_string().contains("opcode 0x00"));
    assert_eq!(of_chunk.count(), 1, "{faults:?}");
}

/// A ROS 1 bag with some topics, one message each.
fn topics(count: u32) -> Vec<u8> {
    let mut bag = Ros1Writer::new(Cursor::new(Vec::new()), Ros1Settings::new("n.bag")).unwrap();
    for number in 0..count {
        let topic = BagTopic {
            name: format!("/a_name_that_all_of_them_begin_with/{number}"),
            type_name: "std_msgs/UInt32".into(),
            encoding: "ros1".into(),
            schema_encoding: "ros1msg".into(),
            schema: b"uint32 data\n".to_vec(),
            metadata: [("md5sum".to_owned(), "304a39449588c7f8ce2df6e8001c5fce".to_owned())].into(),
        };
        let id = bag.topic(&topic).unwrap();
        bag.write(id, Stamp::at(i64::from(number)), &number.to_le_bytes()).unwrap();
    }
    bag.finish().unwrap().0.into_inner()
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
fn connections_of_ros1_are_opened_in_linear_time() {
    let (few, many) = (topics(2_000), topics(32_000));
    let open = |bytes: &[u8]| {
        assert!(Reader::open(Cursor::new(bytes)).unwrap().topics().len() >= 2_000);
    };
    let (few, many) = (fastest(|| open(&few)), fastest(|| open(&many)));
    // 16 times as many: not 256 times as long, which was 10 s.
    assert!(many < few * 160 || many.as_secs() < 1, "{few:?} for 2,000, {many:?} for 32,000");
}
