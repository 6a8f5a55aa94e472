//! Random access equals a linear read that is filtered by time and topic.

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use periplus_bags::files::{
    Bag, BagWriter, ChunkUse, IndexedBag, MessageLocation, OpenProgress, RecordingFormat, Storage,
    WriteSettings,
};
use periplus_bags::{Selection, Stamp};
use periplus_msgs::Message as _;
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::std_msgs::UInt32;
use proptest::prelude::*;

use crate::common::{Folder, topic};
use crate::doors::ways;

const NAMES: [&str; 3] = ["/left", "/middle", "/right"];

/// Number, time and topic.
type Row = (u32, i64, String);

/// Writes messages at these times \[0.1 s\] on these topics.
fn write(path: &Path, settings: WriteSettings, rows: &[(i64, usize)]) {
    let storage = settings.storage;
    let mut bag = BagWriter::create(path, settings).unwrap();
    let topics = NAMES.map(|name| bag.topic(&topic(name, storage)).unwrap());
    for (number, (tenths, which)) in rows.iter().enumerate() {
        let message = UInt32 { data: u32::try_from(number).unwrap() };
        let mut data = Vec::new();
        match storage {
            Storage::Ros1 => message.encode_ros1(&mut data).unwrap(),
            _ => message.encode_cdr(&mut data).unwrap(),
        }
        bag.write(topics[*which], Stamp::at(tenths * 100_000_000), &data).unwrap();
    }
    bag.finish().unwrap();
}

fn open(path: &Path) -> IndexedBag {
    IndexedBag::open(path, &OpenProgress::default()).unwrap()
}

fn read(bag: &IndexedBag, locations: &[MessageLocation]) -> Vec<Row> {
    let mut rows = Vec::new();
    let visit = &mut |location: &MessageLocation, data: &[u8]| {
        let name = bag.topics()[location.topic].name.clone();
        rows.push((UInt32::decode_cdr(data).unwrap().data, location.time_ns, name));
        ControlFlow::Continue(())
    };
    bag.read(locations, ChunkUse::Keep, visit).unwrap();
    rows
}

/// Messages of a span, fetched a few at a time.
fn between(bag: &IndexedBag, topics: &[usize], start_ns: i64, end_ns: i64, few: usize) -> Vec<Row> {
    let (mut rows, mut from_ns) = (Vec::new(), Some(start_ns));
    while let Some(start_ns) = from_ns {
        let span = bag.between(topics, start_ns, end_ns, few).unwrap();
        rows.extend(read(bag, &span.locations));
        from_ns = span.next_ns;
    }
    rows
}

fn linear(path: &Path) -> Vec<Row> {
    let bag = Bag::open(path).unwrap();
    let mut rows = Vec::new();
    let mut messages = bag.messages(Selection::default());
    while let Some(message) = messages.next().unwrap() {
        let topic = &bag.topics()[message.topic];
        let number = match topic.encoding.as_str() {
            "ros1" => UInt32::decode_ros1(message.data),
            _ => UInt32::decode_cdr(message.data),
        };
        rows.push((number.unwrap().data, message.log_ns, topic.name.clone()));
    }
    rows
}

/// Compares all accesses with a linear read.
#[track_caller]
fn check(path: &Path, name: &str) {
    let (bag, all) = (open(path), linear(path));
    let named = |topics: &[usize]| -> Vec<String> {
        topics.iter().map(|topic| bag.topics()[*topic].name.clone()).collect()
    };
    let every: Vec<usize> = (0..bag.topics().len()).collect();
    let count = |topic: &usize| all.iter().filter(|row| row.2 == bag.topics()[*topic].name).count();
    let counts: Vec<u64> = every.iter().map(|topic| count(topic) as u64).collect();
    if bag.faults().is_empty() {
        assert_eq!(bag.counts(), counts, "{name}");
    }
    let mut times = vec![0_u64; every.len()];
    let visit = &mut |topic: usize, _| {
        times[topic] += 1;
        ControlFlow::Continue(())
    };
    bag.visit_times(&every, visit).unwrap();
    assert_eq!(times, counts, "{name}");
    for topics in [&every[..], &every[..every.len().min(1)], &[]] {
        for (from, to) in [(-1, 100), (0, 30), (13, 14), (20, 20), (25, 61)] {
            let (start_ns, end_ns) = (from * 100_000_000, to * 100_000_000);
            let names = named(topics);
            let is_in = |row: &&Row| names.contains(&row.2) && row.1 >= start_ns && row.1 < end_ns;
            let expected: Vec<Row> = all.iter().filter(is_in).cloned().collect();
            for few in [1, 7, 1000] {
                let got = between(&bag, topics, start_ns, end_ns, few);
                assert_eq!(got, expected, "{name}, {from} to {to}, {few} at once");
            }
        }
    }
    for topic in every {
        for tenths in [-1, 0, 7, 20, 33, 79, 100] {
            let at_ns = tenths * 100_000_000 + 1;
            let names = named(&[topic]);
            let is_before = |row: &&Row| names.contains(&row.2) && row.1 <= at_ns;
            let before: Vec<Row> = all.iter().filter(is_before).cloned().collect();
            for count in [0, 1, 3, 50] {
                let expected = &before[before.len().saturating_sub(count)..];
                let newest = bag.newest(topic, at_ns, count).unwrap();
                assert_eq!(read(&bag, &newest), expected, "{name}, {count} at {tenths}");
            }
        }
    }
}

fn rows() -> impl Strategy<Value = Vec<(i64, usize)>> {
    prop::collection::vec((0..80_i64, 0..NAMES.len()), 1..120)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn random_access_equals_a_filtered_linear_read(rows in rows()) {
        let folder = Folder::new("random");
        for (name, settings) in ways() {
            let path = folder.path(name);
            write(&path, settings, &rows);
            check(&path, name);
        }
    }

    #[test]
    fn cut_and_damaged_files_give_what_a_linear_read_finds(
        rows in rows(), part in 0.3..1.0, hit in 0.1..0.9,
    ) {
        let folder = Folder::new("random_damaged");
        for (name, settings) in ways() {
            if !name.ends_with(".mcap") && !name.ends_with(".bag") {
                continue;
            }
            let path = folder.path(name);
            write(&path, settings, &rows);
            let bytes = fs::read(&path).unwrap();
            fs::write(&path, &bytes[..(bytes.len() as f64 * part) as usize]).unwrap();
            check(&path, name);
            let mut bytes = bytes;
            let at = (bytes.len() as f64 * hit) as usize;
            bytes[at] ^= 0x55;
            fs::write(&path, &bytes).unwrap();
            if Bag::open(&path).is_ok() {
                // Opening must not fail or panic; a damaged time is not found by its index.
                let bag = open(&path);
                let topics: Vec<usize> = (0..bag.topics().len()).collect();
                between(&bag, &topics, 0, i64::MAX, 10);
            }
        }
    }
}

#[test]
fn a_carmen_log_has_scans_odometry_and_transforms() {
    let folder = Folder::new("random_carmen");
    let path = folder.path("two.log");
    let lines = "FLASER 3 1.0 2.0 3.0 0.5 0 0 0.5 0 0 10.0 host 10.0\n\
                 ODOM 1.5 0 0 0 0 0 11.0 host 11.0\n\
                 ODOM oops\n";
    fs::write(&path, lines).unwrap();
    let bag = open(&path);
    assert_eq!(bag.format(), RecordingFormat::Carmen);
    let names: Vec<&str> = bag.topics().iter().map(|topic| &*topic.name).collect();
    assert_eq!(names, ["/scan", "/odom", "/tf"]);
    assert_eq!(bag.counts(), [1, 2, 3]);
    assert_eq!(bag.span_ns(), Some((10_000_000_000, 11_000_000_000)));
    assert_eq!(bag.path(), path);
    let finding = bag.findings().iter().next().expect("a finding").message.clone();
    assert!(finding.contains("line 3"), "{finding}");
    let mut x_m = None;
    let newest = bag.newest(1, 11_000_000_000, 1).unwrap();
    let visit = &mut |_: &MessageLocation, data: &[u8]| {
        x_m = Some(Odometry::decode_cdr(data).unwrap().pose.pose.position.x);
        ControlFlow::Continue(())
    };
    bag.read(&newest, ChunkUse::Keep, visit).unwrap();
    assert_eq!(x_m, Some(1.5));
}

#[test]
fn opening_can_be_cancelled() {
    let folder = Folder::new("random_cancelled");
    let path = folder.path("one.db3");
    write(&path, WriteSettings::new(Storage::Sqlite), &[(0, 0)]);
    let progress = OpenProgress::default();
    progress.cancel();
    assert!(IndexedBag::open(&path, &progress).is_err());
}
