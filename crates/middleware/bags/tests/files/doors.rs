//! Opening and conversion of all kinds of bags.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::common::{Folder, Row, numbers, rows, write_numbers};
use periplus_bags::files::{
    Bag, BagError, BagKind, ChunkPacking, Conversion, IndexedBag, Info, OpenProgress, Packing,
    PackingMode, Storage, WriteSettings, convert,
};
use periplus_bags::{Selection, Style};

fn settings(storage: Storage) -> WriteSettings {
    WriteSettings::new(storage)
}

/// All storage and compression formats, by name.
pub(crate) fn ways() -> Vec<(&'static str, WriteSettings)> {
    use ChunkPacking::{Bz2, Lz4, None};
    use Storage::{Mcap, Ros1, Sqlite};
    let packed = |storage, mode, packing| WriteSettings { mode, packing, ..settings(storage) };
    let chunks = |storage, chunks| WriteSettings { chunks, ..settings(storage) };
    vec![
        ("folder", settings(Mcap)),
        ("one.mcap", settings(Mcap)),
        ("lz4.mcap", chunks(Mcap, Lz4)),
        ("plain.mcap", chunks(Mcap, None)),
        ("base", settings(Sqlite)),
        ("one.db3", settings(Sqlite)),
        ("live", WriteSettings { is_live: true, ..settings(Sqlite) }),
        ("one.bag", settings(Ros1)),
        ("bz2.bag", chunks(Ros1, Bz2)),
        ("lz4.bag", chunks(Ros1, Lz4)),
        ("file_zstd", packed(Mcap, PackingMode::File, Packing::Zstd)),
        ("file_lz4", packed(Sqlite, PackingMode::File, Packing::Lz4)),
        ("message_zstd", packed(Sqlite, PackingMode::Message, Packing::Zstd)),
        ("message_lz4", packed(Mcap, PackingMode::Message, Packing::Lz4)),
        ("split", WriteSettings { max_span_ns: Some(1_000_000_000), ..settings(Mcap) }),
        ("humble", WriteSettings { style: Style::Humble, ..settings(Sqlite) }),
    ]
}

#[test]
fn every_kind_goes_to_every_kind() {
    let folder = Folder::new("kinds");
    let source = folder.path("source");
    write_numbers(&source, settings(Storage::Mcap));
    let mut before = source;
    for (name, write) in ways() {
        let path = folder.path(name);
        let bag = Bag::open(&before).unwrap();
        let conversion = Conversion { selection: Selection::default(), write };
        let report = convert(&[bag], &path, conversion, &mut |_| {}).unwrap();
        assert!(report.findings.is_empty(), "{name}: {:?}", report.findings);
        assert_eq!(report.info.messages(), 40, "{name}");
        let bag = Bag::open(&path).unwrap();
        assert!(bag.findings().is_empty(), "{name}: {:?}", bag.findings());
        assert_eq!(bag.message_count(), 40, "{name}");
        assert_eq!(bag.counts(), [20, 20], "{name}");
        assert!(bag.is_whole(), "{name}");
        assert_eq!(rows(&bag, Selection::default()), numbers(), "{name}");
        before = path;
    }
}

#[test]
fn topics_and_times_are_selected_in_every_kind() {
    let folder = Folder::new("selected");
    let selection =
        Selection { span_ns: 1_000_000_000..=2_500_000_000, ..Selection::topics(["/odd"]) };
    let wanted = |row: &Row| row.2 == "/odd" && selection.span_ns.contains(&row.1);
    let expected: Vec<Row> = numbers().into_iter().filter(wanted).collect();
    assert_eq!(expected.len(), 7);
    for (name, write) in ways() {
        let path = folder.path(name);
        write_numbers(&path, write);
        let bag = Bag::open(&path).unwrap();
        assert_eq!(rows(&bag, selection.clone()), expected, "{name}");
        let none = Selection::topics(["/unknown"]);
        assert_eq!(rows(&bag, none), [], "{name}");
    }
}

#[test]
fn a_folder_is_split_by_time_and_by_size() {
    let folder = Folder::new("split");
    let (by_time, by_size) = (folder.path("time"), folder.path("size"));
    let write = settings(Storage::Mcap);
    write_numbers(&by_time, WriteSettings { max_span_ns: Some(1_000_000_000), ..write });
    let bag = Bag::open(&by_time).unwrap();
    let names: Vec<String> =
        bag.files().map(|file| file.file_name().unwrap().to_string_lossy().into_owned()).collect();
    assert_eq!(names, ["time_0.mcap", "time_1.mcap", "time_2.mcap", "time_3.mcap"]);
    let files = &bag.metadata().unwrap().info.files;
    assert!(files.iter().all(|file| file.messages == 10));
    write_numbers(&by_size, WriteSettings { max_bytes: Some(1), ..settings(Storage::Sqlite) });
    let bag = Bag::open(&by_size).unwrap();
    assert_eq!(bag.files().count(), 40);
    assert_eq!(rows(&bag, Selection::default()), numbers());
}

#[test]
fn a_folder_is_read_without_its_metadata() {
    let folder = Folder::new("metadata");
    let path = folder.path("bag");
    let split = WriteSettings { max_span_ns: Some(500_000_000), ..settings(Storage::Mcap) };
    write_numbers(&path, split);
    let metadata = path.join("metadata.yaml");
    let written = fs::read_to_string(&metadata).unwrap();
    fs::remove_file(&metadata).unwrap();
    let bag = Bag::open(&path).unwrap();
    assert_eq!(bag.findings().iter().count(), 1);
    assert_eq!(rows(&bag, Selection::default()), numbers());
    bag.reindex(Style::Jazzy).unwrap();
    assert_eq!(fs::read_to_string(&metadata).unwrap(), written);
    // The path of the metadata file opens the folder.
    assert_eq!(Bag::open(&metadata).unwrap().message_count(), 40);
    // Only the messages of a missing file are lost.
    fs::remove_file(path.join("bag_0.mcap")).unwrap();
    let bag = Bag::open(&path).unwrap();
    assert!(bag.findings().has_errors());
    assert_eq!(bag.message_count(), 35);
}

#[test]
fn a_database_without_index_is_read_in_order() {
    let folder = Folder::new("noindex");
    let path = folder.path("one.db3");
    write_numbers(&path, settings(Storage::Sqlite));
    let connection = rusqlite::Connection::open(&path).unwrap();
    connection.execute_batch("DROP INDEX timestamp_idx").unwrap();
    drop(connection);
    let bag = Bag::open(&path).unwrap();
    assert_eq!(rows(&bag, Selection::default()), numbers());
}

#[test]
fn a_database_whose_index_leads_back_is_read_all_the_same() {
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../fuzz/seeds/bag_database");
    let bag = Bag::open(seeds.join("index_out_of_order.db3")).unwrap();
    let mut messages = bag.messages(Selection::default());
    while messages.next().unwrap().is_some() {}
    assert!(messages.faults().iter().any(|fault| fault.contains("damaged")));
}

/// Four thousand more messages, so that there are pages to lose; their numbers are those of the
/// rows.
fn large_database(path: &Path) -> Vec<u8> {
    write_numbers(path, settings(Storage::Sqlite));
    let mut connection = rusqlite::Connection::open(path).unwrap();
    let all = connection.transaction().unwrap();
    for number in 40..4040_u32 {
        let data = [&[0, 1, 0, 0][..], &number.to_le_bytes()].concat();
        all.execute(
            "INSERT INTO messages(topic_id, timestamp, data) VALUES (1, ?1, ?2)",
            rusqlite::params![i64::from(number) * 100_000_000 + 5, data],
        )
        .unwrap();
    }
    all.commit().unwrap();
    drop(connection);
    fs::read(path).unwrap()
}

#[test]
fn of_a_damaged_database_what_can_be_read_is_read() {
    const PAGE: usize = 4096;
    let folder = Folder::new("damaged");
    let whole = large_database(&folder.path("whole.db3"));
    let pages = whole.len() / PAGE;
    assert!(pages > 30);
    let cut = whole[..pages * 7 / 10 * PAGE].to_vec();
    // A transfer interrupted within a page.
    let torn = whole[..whole.len() * 7 / 10 + 1000].to_vec();
    let mut hole = whole;
    hole[pages / 2 * PAGE..(pages / 2 + 4) * PAGE].fill(0xa5);
    for (name, bytes, least) in [("cut", cut, 2000), ("torn", torn, 2000), ("hole", hole, 3000)] {
        let path = folder.path(&format!("{name}.db3"));
        fs::write(&path, bytes).unwrap();
        let bag = Bag::open(&path).unwrap();
        assert!(!bag.is_whole(), "{name}");
        let mut messages = bag.messages(Selection::default());
        let mut found = Vec::new();
        while let Some(message) = messages.next().unwrap() {
            let number = message
                .data
                .iter()
                .skip(4)
                .rev()
                .fold(0_i64, |all, byte| all << 8 | i64::from(*byte));
            assert_eq!(message.log_ns, number * 100_000_000 + 5, "{name}");
            found.push(number);
        }
        assert!(found.len() >= least && found.len() < 4040, "{name}: {}", found.len());
        assert!(found.is_sorted_by(|a, b| a < b), "{name}");
        assert!(!messages.faults().is_empty(), "{name}");
    }
}

/// Tables of Foxy, Galactic and Humble, as created by `rosbag2_storage_sqlite3`.
#[test]
fn databases_of_older_releases_are_read() {
    let folder = Folder::new("older");
    let topics = "id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, \
                  serialization_format TEXT NOT NULL";
    let profiles = ", offered_qos_profiles TEXT NOT NULL";
    let schema = "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT \
                  NULL); INSERT INTO schema VALUES (3, 'humble');";
    for (name, tables, columns, distro) in [
        ("foxy.db3", "", "", ""),
        ("galactic.db3", "", profiles, ""),
        ("humble.db3", schema, profiles, "humble"),
    ] {
        let path = folder.path(name);
        let connection = rusqlite::Connection::open(&path).unwrap();
        let value = if columns.is_empty() { "" } else { ", ''" };
        let tables = format!(
            "{tables} CREATE TABLE topics({topics}{columns}); CREATE TABLE messages(id INTEGER \
             PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT \
             NULL); CREATE INDEX timestamp_idx ON messages (timestamp ASC); INSERT INTO topics \
             VALUES (1, '/odd', 'std_msgs/msg/UInt32', 'cdr'{value}); INSERT INTO messages \
             VALUES (1, 1, 7, x'0001000005000000')"
        );
        connection.execute_batch(&tables).unwrap();
        drop(connection);
        let bag = Bag::open(&path).unwrap();
        assert_eq!(bag.ros_distro(), distro);
        assert_eq!(rows(&bag, Selection::default()), [(5, 7, "/odd".to_owned())]);
        // Its type is known by name, so it can be converted to ROS 1.
        let goal = folder.path(&format!("{name}.bag"));
        let conversion =
            Conversion { selection: Selection::default(), write: settings(Storage::Ros1) };
        convert(&[bag], &goal, conversion, &mut |_| {}).unwrap();
        let bag = Bag::open(&goal).unwrap();
        assert_eq!(bag.kind(), BagKind::Ros1);
        assert_eq!(rows(&bag, Selection::default()), [(5, 7, "/odd".to_owned())]);
    }
}

#[test]
fn several_recordings_become_one() {
    let folder = Folder::new("merged");
    let (first, second, both) = (folder.path("a.mcap"), folder.path("b.bag"), folder.path("both"));
    write_numbers(&first, settings(Storage::Mcap));
    write_numbers(&second, settings(Storage::Ros1));
    let bags = [first, second].map(|path| Bag::open(path).unwrap());
    let write = settings(Storage::Sqlite);
    let conversion = Conversion { selection: Selection::default(), write };
    convert(&bags, &both, conversion, &mut |_| {}).unwrap();
    let bag = Bag::open(&both).unwrap();
    assert_eq!((bag.topics().len(), bag.message_count()), (2, 80));
    let rows = rows(&bag, Selection::default());
    assert!(rows.is_sorted_by_key(|row| row.1));
}

#[test]
fn what_cannot_be_is_refused() {
    let folder = Folder::new("refused");
    let path = folder.path("there.mcap");
    write_numbers(&path, settings(Storage::Mcap));
    let create = |path: &Path, settings| {
        periplus_bags::files::BagWriter::create(path, settings).err().map(|error| error.to_string())
    };
    let refused = create(&path, settings(Storage::Mcap)).unwrap();
    assert!(refused.contains("already exists"), "{refused}");
    let other = folder.path("x.db3");
    let refused = create(&other, settings(Storage::Mcap)).unwrap();
    assert!(refused.contains("does not have the extension of the storage mcap"), "{refused}");
    let split = WriteSettings { max_bytes: Some(9), ..settings(Storage::Sqlite) };
    assert!(create(&other, split).unwrap().contains("cannot be split"));
    fs::write(folder.path("text.txt"), "no bag").unwrap();
    assert!(matches!(Bag::open(folder.path("text.txt")), Err(BagError::NoBag(..))));
    fs::create_dir(folder.path("empty")).unwrap();
    assert!(matches!(Bag::open(folder.path("empty")), Err(BagError::NoBag(..))));
    assert!(matches!(Bag::open(folder.path("nowhere")), Err(BagError::File(..))));
}

/// Facts of a recorder, with characters that YAML quotes.
fn facts() -> BTreeMap<String, String> {
    let facts = [("command", "periplus sim 'my world.sdf' -p a:=b"), ("world", "house: \"x\"\n#")];
    facts.map(|(name, value)| (name.to_owned(), value.to_owned())).into()
}

#[test]
fn facts_of_the_recorder_are_kept_in_every_kind_that_has_room() {
    let folder = Folder::new("facts");
    let source = folder.path("source.mcap");
    write_numbers(&source, WriteSettings { custom_data: facts(), ..settings(Storage::Mcap) });
    for (name, write) in ways() {
        let has_room = write.storage != Storage::Ros1 && write.style == Style::Jazzy;
        let expected = if has_room { facts() } else { BTreeMap::new() };
        let path = folder.path(name);
        let bag = Bag::open(&source).unwrap();
        let conversion = Conversion { selection: Selection::default(), write };
        convert(&[bag], &path, conversion, &mut |_| {}).unwrap();
        assert_eq!(Bag::open(&path).unwrap().custom_data(), &expected, "{name}");
        let indexed = IndexedBag::open(&path, &OpenProgress::default()).unwrap();
        assert_eq!(indexed.custom_data(), &expected, "{name}");
    }
    // Without metadata.yaml the files have them.
    fs::remove_file(folder.path("folder").join("metadata.yaml")).unwrap();
    assert_eq!(Bag::open(folder.path("folder")).unwrap().custom_data(), &facts());
}

#[test]
fn joined_recordings_keep_the_facts_that_they_share() {
    let folder = Folder::new("shared_facts");
    let with = |name: &str, seed: &str| {
        let mut custom_data = facts();
        custom_data.insert("seed".to_owned(), seed.to_owned());
        let path = folder.path(name);
        write_numbers(&path, WriteSettings { custom_data, ..settings(Storage::Mcap) });
        Bag::open(&path).unwrap()
    };
    let bags = [with("a.mcap", "1"), with("b.mcap", "2")];
    let write = settings(Storage::Mcap);
    let conversion = Conversion { selection: Selection::default(), write };
    convert(&bags, folder.path("both.mcap"), conversion, &mut |_| {}).unwrap();
    assert_eq!(Bag::open(folder.path("both.mcap")).unwrap().custom_data(), &facts());
}

#[test]
fn info_is_that_of_ros2_bag() {
    let folder = Folder::new("info");
    let path = folder.path("bag");
    write_numbers(&path, settings(Storage::Mcap));
    let mut info = Info::of(&Bag::open(&path).unwrap());
    info.bytes = 1536;
    expect_test::expect![[r"

        Files:             bag_0.mcap
        Bag size:          1.5 KiB
        Storage id:        mcap
        ROS Distro:        unknown
        Duration:          3.900000000s
        Start:             Jan  1 1970 00:00:00.000000005 (0.000000005)
        End:               Jan  1 1970 00:00:03.900000005 (3.900000005)
        Messages:          40
        Topic information: Topic: /even | Type: std_msgs/msg/UInt32 | Count: 20 | Serialization Format: cdr
                           Topic: /odd | Type: std_msgs/msg/UInt32 | Count: 20 | Serialization Format: cdr
    "]]
    .assert_eq(&info.to_text());
}
