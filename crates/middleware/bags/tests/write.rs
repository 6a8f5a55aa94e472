//! Writing: correct and reproducible bytes, at most a second lost.
#![allow(clippy::unwrap_used, reason = "a test may stop")]

use periplus_bags::{
    BagInfo, Compression, QosProfile, Settings, Stamp, Style, Topic, WriteError, Writer, check,
};
use periplus_msgs::geometry_msgs::Twist;
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_msgs::std_msgs::String as Text;
use periplus_msgs::{Message, TypeRegistry};

fn settings(compression: Compression) -> Settings {
    Settings { compression, threads: 0, ..Settings::new("run.mcap") }
}

/// Three topics for `seconds`: a clock at 100 Hz, a velocity at 10 Hz, one text at the start.
fn drive(settings: Settings, seconds: i64) -> (Vec<u8>, BagInfo) {
    let mut bag = Writer::new(Vec::new(), settings).unwrap();
    let clock = bag.topic(Topic::of::<Clock>("/clock", &[QosProfile::sensor_data()])).unwrap();
    let twist = bag.topic(Topic::of::<Twist>("/cmd_vel", &[QosProfile::reliable(10)])).unwrap();
    let text = Topic::of::<Text>("/robot_description", &[QosProfile::latched(1)]);
    let text = bag.topic(text).unwrap();
    bag.write(text, Stamp::at(0), &Text { data: "<robot/>".into() }.to_cdr().unwrap()).unwrap();
    for tick in 0..seconds * 100 {
        let time_ns = tick * 10_000_000;
        let data = Clock::default().to_cdr().unwrap();
        bag.write(clock, Stamp::at(time_ns), &data).unwrap();
        if tick % 10 == 0 {
            let stamp = Stamp { publish_ns: time_ns + 1, ..Stamp::at(time_ns + 3) };
            bag.write(twist, stamp, &Twist::default().to_cdr().unwrap()).unwrap();
        }
    }
    bag.finish().unwrap()
}

#[test]
fn every_byte_is_in_its_place() {
    for compression in [Compression::None, Compression::Lz4, Compression::Zstd] {
        let (bytes, info) = drive(settings(compression), 3);
        assert_eq!(check(&bytes), [], "{compression:?}");
        assert_eq!(info.messages(), 1 + 300 + 30);
        assert_eq!(info.span_ns(), Some((0, 2_990_000_000)));
    }
}

#[test]
fn an_empty_bag_is_a_bag() {
    let bag = Writer::new(Vec::new(), settings(Compression::Zstd)).unwrap();
    let (bytes, info) = bag.finish().unwrap();
    assert_eq!(check(&bytes), []);
    assert_eq!(info.span_ns(), None);

    let mut bag = Writer::new(Vec::new(), settings(Compression::Zstd)).unwrap();
    bag.topic(Topic::of::<Twist>("/unheard", &[])).unwrap();
    let (bytes, info) = bag.finish().unwrap();
    assert_eq!(check(&bytes), []);
    assert_eq!((info.topics.len(), info.messages()), (1, 0));
}

#[test]
fn compression_threads_do_not_change_the_bytes() {
    for compression in [Compression::None, Compression::Lz4, Compression::Zstd] {
        let straight = drive(settings(compression), 5);
        for threads in [1, 3] {
            let threaded = drive(Settings { threads, ..settings(compression) }, 5);
            assert!(straight == threaded, "{compression:?}, {threads}");
        }
    }
}

#[test]
fn messages_out_of_order_are_indexed_in_order() {
    let mut bag = Writer::new(Vec::new(), settings(Compression::None)).unwrap();
    let topic = bag.topic(Topic::of::<Clock>("/clock", &[])).unwrap();
    for time_ns in [5, 3, 4, 3] {
        bag.write(topic, Stamp::at(time_ns), &[0, 1, 0, 0, 9]).unwrap();
    }
    let (bytes, info) = bag.finish().unwrap();
    assert_eq!(check(&bytes), []);
    assert_eq!(info.span_ns(), Some((3, 5)));
}

#[test]
fn all_types_can_be_recorded() {
    let types = TypeRegistry::builtin();
    let mut bag = Writer::new(Vec::new(), settings(Compression::Zstd)).unwrap();
    let mut count = 0;
    for type_name in types.type_names() {
        let topic = Topic {
            name: format!("/{type_name}"),
            type_name: type_name.into(),
            schema_text: types.schema_text(type_name).unwrap_or_default().into(),
            type_hash: types.hash(type_name).unwrap(),
            qos: vec![],
        };
        let topic = bag.topic(topic).unwrap();
        bag.write(topic, Stamp::at(count), &[0, 1, 0, 0, 0]).unwrap();
        count += 1;
    }
    assert!(count > 300);
    let (bytes, _) = bag.finish().unwrap();
    assert_eq!(check(&bytes), []);
}

/// A sink that records the flushed size at the last query.
#[derive(Clone, Default)]
struct Disk(std::sync::Arc<std::sync::Mutex<(Vec<u8>, usize)>>);

impl std::io::Write for Disk {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().0.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        let mut disk = self.0.lock().unwrap();
        disk.1 = disk.0.len();
        Ok(())
    }
}

#[test]
fn each_second_is_flushed_when_the_next_begins() {
    let disk = Disk::default();
    let mut bag = Writer::new(disk.clone(), settings(Compression::None)).unwrap();
    let topic = bag.topic(Topic::of::<Clock>("/clock", &[])).unwrap();
    let flushed = || disk.0.lock().unwrap().1;
    let before = flushed();
    bag.write(topic, Stamp::at(0), b"first").unwrap();
    bag.write(topic, Stamp::at(999_999_999), b"same second").unwrap();
    assert_eq!(flushed(), before);
    bag.write(topic, Stamp::at(1_000_000_000), b"next second").unwrap();
    let written = disk.0.lock().unwrap().0.clone();
    let contains = |text: &[u8]| written[..flushed()].windows(text.len()).any(|w| w == text);
    assert!(contains(b"same second") && !contains(b"next second"));
    // No more messages, but time advances.
    bag.advance_to(1_999_999_999).unwrap();
    assert_eq!(flushed(), written.len());
    bag.advance_to(2_000_000_000).unwrap();
    assert!(flushed() > written.len());
}

#[test]
fn what_a_bag_cannot_hold_is_refused() {
    let mut bag = Writer::new(Vec::new(), settings(Compression::None)).unwrap();
    let topic = bag.topic(Topic::of::<Clock>("/clock", &[])).unwrap();
    let early = bag.write(topic, Stamp::at(-1), b"");
    assert!(matches!(early, Err(WriteError::NegativeTime(-1))));
    let again = bag.topic(Topic::of::<Clock>("/clock", &[])).unwrap();
    assert_eq!(again, topic);
    for index in 1..65_535 {
        bag.topic(Topic::of::<Clock>(format!("/{index}"), &[])).unwrap();
    }
    let one_more = bag.topic(Topic::of::<Clock>("/one_more", &[]));
    assert!(matches!(one_more, Err(WriteError::TooManyTopics)));
    let mut other = Writer::new(Vec::new(), settings(Compression::None)).unwrap();
    assert!(matches!(other.write(topic, Stamp::at(0), b""), Err(WriteError::UnknownTopic)));
}

/// A disk that is full after some bytes.
struct Full(usize);

impl std::io::Write for Full {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or(std::io::ErrorKind::StorageFull)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_told_and_nothing_hangs() {
    for threads in [0, 1, 3] {
        let settings = Settings { threads, ..settings(Compression::None) };
        let mut bag = Writer::new(Full(20_000), settings).unwrap();
        let topic = bag.topic(Topic::of::<Clock>("/clock", &[])).unwrap();
        let mut told = 0;
        for second in 0..100 {
            let stamp = Stamp::at(second * 1_000_000_000);
            told += u32::from(bag.write(topic, stamp, &[7; 1_000]).is_err());
        }
        assert!(told > 50, "{told}");
        assert!(matches!(bag.finish(), Err(WriteError::Sink(_))));
    }
}

#[test]
fn both_styles_of_metadata() {
    let (_, info) = drive(settings(Compression::Zstd), 1);
    for style in [Style::Humble, Style::Jazzy] {
        let settings = Settings { style, ..settings(Compression::Zstd) };
        let (bytes, same) = drive(settings, 1);
        assert_eq!(same, info);
        assert_eq!(check(&bytes), []);
    }
    let small = BagInfo { topics: info.topics[..1].to_vec(), ..info };
    expect_test::expect_file!["data/metadata_humble.yaml"].assert_eq(&small.to_yaml(Style::Humble));
    expect_test::expect_file!["data/metadata_jazzy.yaml"].assert_eq(&small.to_yaml(Style::Jazzy));
}

#[test]
fn the_check_finds_every_changed_byte() {
    let (bytes, _) = drive(settings(Compression::Zstd), 1);
    let mut missed = Vec::new();
    for at in (0..bytes.len()).step_by(7) {
        let mut changed = bytes.clone();
        changed[at] ^= 0x10;
        if check(&changed).is_empty() {
            missed.push(at);
        }
    }
    assert_eq!(missed, Vec::<usize>::new());
}
