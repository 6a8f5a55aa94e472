//! Interoperability with other libraries in both directions, for every message type. Needs Python
//! with `mcap`, `mcap-ros2-support` and `rosbags`: `PERIPLUS_PYTHON`, otherwise `python3`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::Folder;
use periplus_bags::files::{
    Bag, BagWriter, ChunkPacking, Conversion, Packing, PackingMode, Storage, WriteSettings, convert,
};
use periplus_bags::{BagTopic, Selection, Stamp, Style, Target, Translation};
use periplus_diagnostics::Diagnostics;
use periplus_msgs::{DynamicMessage, Format, TypeRegistry};

/// Python with the peer libraries, if installed.
fn python() -> Option<PathBuf> {
    let python = std::env::var_os("PERIPLUS_PYTHON").unwrap_or_else(|| "python3".into());
    let probe = Command::new(&python).args([SCRIPT, "probe"]).output();
    if probe.is_ok_and(|output| output.status.success()) {
        return Some(python.into());
    }
    println!("SKIPPED: no Python with mcap, mcap-ros2-support and rosbags (PERIPLUS_PYTHON)");
    None
}

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/peers.py");

fn run(python: &Path, task: &str, paths: &[PathBuf]) -> String {
    let output = Command::new(python).args([SCRIPT, task]).args(paths).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Writes every type with the random values of rosbags' own test, three times.
fn write_all(path: &Path) -> u64 {
    let types = TypeRegistry::builtin();
    let mut bag = BagWriter::create(path, WriteSettings::new(Storage::Mcap)).unwrap();
    let mut count = 0;
    for line in include_str!("../../../../messages/msgs/tests/data/oracle.jsonl").lines() {
        let line: serde_json::Value = serde_json::from_str(line).unwrap();
        let type_name = line["type"].as_str().unwrap();
        // Parts of services and actions are not published on topics.
        if !type_name.contains("/msg/") {
            continue;
        }
        let layout = types.layout(type_name).unwrap();
        let message = DynamicMessage::from_json(layout, &line["json"]).unwrap();
        let mut data = Vec::new();
        message.encode(Format::CDR, &mut data).unwrap();
        let profile = "- history: keep_last\n  depth: 10\n  reliability: reliable\n  durability: \
                       volatile\n  deadline:\n    sec: 0\n    nsec: 0\n  lifespan:\n    sec: 0\n    \
                       nsec: 0\n  liveliness: automatic\n  liveliness_lease_duration:\n    sec: \
                       0\n    nsec: 0\n  avoid_ros_namespace_conventions: false\n";
        let topic = BagTopic {
            name: format!("/{}", type_name.replace("/msg/", "/")),
            type_name: type_name.into(),
            encoding: "cdr".into(),
            schema_encoding: "ros2msg".into(),
            schema: types.schema_text(type_name).unwrap().into(),
            metadata: BTreeMap::from([
                ("offered_qos_profiles".to_owned(), profile.to_owned()),
                ("topic_type_hash".to_owned(), types.hash(type_name).unwrap()),
            ]),
        };
        let id = bag.topic(&topic).unwrap();
        for second in 1..=3_i64 {
            bag.write(id, Stamp::at(second * 1_000_000_000 + count), &data).unwrap();
        }
        count += 1;
    }
    bag.finish().unwrap();
    assert!(count > 150, "{count}");
    count as u64 * 3
}

/// All messages as CDR, by topic.
fn contents(path: &Path) -> BTreeMap<String, Vec<Vec<u8>>> {
    let bag = Bag::open(path).unwrap();
    assert!(bag.findings().is_empty(), "{}: {:?}", path.display(), bag.findings());
    let mut found = Diagnostics::new();
    let mut ways: Vec<Translation> = bag
        .topics()
        .iter()
        .map(|topic| Translation::new(topic, Target::Ros2, &mut found).unwrap())
        .collect();
    let mut all: BTreeMap<String, Vec<Vec<u8>>> = BTreeMap::new();
    let mut messages = bag.messages(Selection::default());
    while let Some(message) = messages.next().unwrap() {
        let name = bag.topics()[message.topic].name.clone();
        let data = ways[message.topic].translate(message.data).unwrap().to_vec();
        all.entry(name).or_default().push(data);
    }
    all
}

#[test]
fn others_read_ours() {
    let Some(python) = python() else { return };
    let folder = Folder::new("ours");
    let source = folder.path("source");
    let count = write_all(&source);
    let plain = WriteSettings::new;
    let packed = |storage, mode| WriteSettings { mode, packing: Packing::Zstd, ..plain(storage) };
    let chunks = |storage, chunks| WriteSettings { chunks, ..plain(storage) };
    let humble = |storage| WriteSettings { style: Style::Humble, ..plain(storage) };
    let ways = [
        ("jazzy_mcap", plain(Storage::Mcap)),
        ("humble_mcap", humble(Storage::Mcap)),
        ("jazzy_sqlite", plain(Storage::Sqlite)),
        ("humble_sqlite", humble(Storage::Sqlite)),
        ("lz4", chunks(Storage::Mcap, ChunkPacking::Lz4)),
        ("file", packed(Storage::Mcap, PackingMode::File)),
        ("message", packed(Storage::Mcap, PackingMode::Message)),
        ("file_sqlite", packed(Storage::Sqlite, PackingMode::File)),
        ("message_sqlite", packed(Storage::Sqlite, PackingMode::Message)),
        ("one.mcap", plain(Storage::Mcap)),
        ("plain.bag", plain(Storage::Ros1)),
        ("bz2.bag", chunks(Storage::Ros1, ChunkPacking::Bz2)),
        ("lz4.bag", chunks(Storage::Ros1, ChunkPacking::Lz4)),
    ];
    let mut paths = Vec::new();
    for (name, write) in ways {
        let path = folder.path(name);
        let conversion = Conversion { selection: Selection::default(), write };
        let bag = Bag::open(&source).unwrap();
        convert(&[bag], &path, conversion, &mut |_| {}).unwrap();
        paths.push(path);
    }
    let report: BTreeMap<String, serde_json::Value> =
        serde_json::from_str(&run(&python, "read", &paths)).unwrap();
    assert_eq!(report.len(), paths.len());
    for (name, found) in report {
        let expected = serde_json::json!({ "messages": count, "told": count, "strange": [] });
        assert_eq!(found, expected, "{name}");
    }
}

#[test]
fn we_read_those_of_others() {
    let Some(python) = python() else { return };
    let folder = Folder::new("theirs");
    let source = folder.path("source");
    write_all(&source);
    let expected = contents(&source);
    run(&python, "write", &[source, folder.path("")]);
    let mut read = 0;
    for entry in std::fs::read_dir(folder.path("")).unwrap() {
        let path = entry.unwrap().path();
        if path.file_name().unwrap().to_string_lossy().starts_with("rosbags_") {
            let found = contents(&path);
            assert_eq!(found.len(), expected.len(), "{}", path.display());
            for (name, messages) in &expected {
                assert!(found[name] == *messages, "{} {name}", path.display());
            }
            read += 1;
        }
    }
    assert_eq!(read, 3 + 2 * 4 + 2 * 3);
}
