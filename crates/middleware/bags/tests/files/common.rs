//! Temporary folders for tests, and a bag of numbers.

use std::fs;
use std::path::{Path, PathBuf};

use periplus_bags::files::{Bag, BagWriter, Storage, WriteSettings};
use periplus_bags::{BagTopic, Selection, Stamp, Target, Translation};
use periplus_diagnostics::Diagnostics;
use periplus_msgs::{Message, std_msgs::UInt32};

/// A separate folder for each test.
pub(crate) struct Folder(PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("bags_files_{name}"));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Number, time and topic.
pub(crate) type Row = (u32, i64, String);

/// Forty numbers on two topics, 0.1 s apart.
pub(crate) fn numbers() -> Vec<Row> {
    let name = |number: u32| if number.is_multiple_of(2) { "/even" } else { "/odd" };
    (0..40).map(|one| (one, i64::from(one) * 100_000_000 + 5, name(one).to_owned())).collect()
}

pub(crate) fn topic(name: &str, storage: Storage) -> BagTopic {
    let bare = BagTopic {
        name: name.into(),
        type_name: UInt32::TYPE_NAME.into(),
        encoding: "cdr".into(),
        schema_encoding: "ros2msg".into(),
        schema: UInt32::schema_text().into(),
        metadata: [("topic_type_hash".to_owned(), UInt32::TYPE_HASH.to_owned())].into(),
    };
    match storage {
        Storage::Ros1 => {
            let mut findings = Diagnostics::new();
            Translation::new(&bare, Target::Ros1, &mut findings).unwrap().topic().clone()
        }
        _ => bare,
    }
}

pub(crate) fn write_numbers(path: &Path, settings: WriteSettings) {
    let storage = settings.storage;
    let mut bag = BagWriter::create(path, settings).unwrap();
    let even = bag.topic(&topic("/even", storage)).unwrap();
    let odd = bag.topic(&topic("/odd", storage)).unwrap();
    for (number, time_ns, name) in numbers() {
        let message = UInt32 { data: number };
        let mut data = Vec::new();
        if storage == Storage::Ros1 {
            message.encode_ros1(&mut data).unwrap();
        } else {
            message.encode_cdr(&mut data).unwrap();
        }
        let topic = if name == "/even" { even } else { odd };
        bag.write(topic, Stamp::at(time_ns), &data).unwrap();
    }
    bag.finish().unwrap();
}

pub(crate) fn rows(bag: &Bag, selection: Selection) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut messages = bag.messages(selection);
    while let Some(message) = messages.next().unwrap() {
        let topic = &bag.topics()[message.topic];
        let number = if topic.encoding == "ros1" {
            UInt32::decode_ros1(message.data)
        } else {
            UInt32::decode_cdr(message.data)
        };
        rows.push((number.unwrap().data, message.log_ns, topic.name.clone()));
    }
    rows
}
