//! Recording by the command: topics of the network, and one output file that names several bags.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]
#![allow(clippy::disallowed_methods, reason = "tests with other programs wait for them")]

mod common;

use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use common::Folder;
use periplus_bags::files::{Bag, BagWriter, Storage, WriteSettings};
use periplus_bags::{BagTopic, Selection, Stamp};
use periplus_msgs::Message;
use periplus_msgs::std_msgs::String as Text;

const LONG: Duration = Duration::from_secs(40);

fn periplus(words: &[&str], domain: u32) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.args(words).env("ROS_DOMAIN_ID", domain.to_string());
    for name in ["ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_STATIC_PEERS", "CYCLONEDDS_URI"] {
        command.env_remove(name);
    }
    command
}

/// A program that runs until this is dropped.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Text messages of a recording by topic.
fn texts(bag: &Path) -> Vec<(String, String)> {
    let bag = Bag::open(bag).unwrap();
    let names: Vec<String> = bag.topics().iter().map(|topic| topic.name.clone()).collect();
    let mut messages = bag.messages(Selection::default());
    let mut all = Vec::new();
    while let Some(message) = messages.next().unwrap() {
        let text = Text::decode_cdr(message.data).unwrap();
        all.push((names[message.topic].clone(), text.data));
    }
    all
}

#[test]
fn a_publisher_that_offers_less_is_recorded_as_well() {
    let domain = 106;
    let folder = Folder::new("record-less");
    let bag = folder.path("bag.mcap");
    let say = |data: &str, more: &[&str]| {
        let text = format!("data: {data}");
        let words = ["topic", "pub", "/chatter", "std_msgs/String", &text, "-r", "20", "-p", "0"];
        let mut talker = periplus(&[&words, more].concat(), domain);
        Running(talker.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap())
    };
    let words = ["bag", "record", "/chatter", "-o", bag.to_str().unwrap()];
    let mut recorder = Running(periplus(&words, domain).stderr(Stdio::null()).spawn().unwrap());
    let _first = say("reliable", &[]);
    // A recording is on the disk after a second.
    let recorded = |wanted: &str| {
        let start = Instant::now();
        while !(bag.exists() && texts(&bag).iter().any(|(_, text)| text == wanted)) {
            assert!(start.elapsed() < LONG, "`{wanted}` is not recorded");
            std::thread::sleep(Duration::from_millis(200));
        }
    };
    recorded("reliable");
    let _second = say("hasty", &["--qos-reliability", "best_effort"]);
    recorded("hasty");
    let interrupted = Command::new("kill").args(["-INT", &recorder.0.id().to_string()]).status();
    assert!(interrupted.unwrap().success());
    assert!(recorder.0.wait().unwrap().success());
    let all = texts(&bag);
    let last = |wanted: &str| all.iter().rposition(|(_, text)| text == wanted).unwrap();
    assert!(last("reliable") + 20 > all.len(), "the first is heard until the end");
    assert!(last("hasty") + 20 > all.len());
}

fn convert(words: &[&str]) -> Output {
    periplus(&[&["bag", "convert"], words].concat(), 0).output().unwrap()
}

#[test]
fn one_file_names_many_results() {
    let folder = Folder::new("outputs");
    let source = folder.path("source.mcap");
    let mut bag = BagWriter::create(&source, WriteSettings::new(Storage::Mcap)).unwrap();
    for name in ["/a", "/b"] {
        let topic = BagTopic {
            name: name.into(),
            type_name: Text::TYPE_NAME.into(),
            encoding: "cdr".into(),
            schema_encoding: "ros2msg".into(),
            schema: Text::schema_text().into(),
            metadata: [].into(),
        };
        let topic = bag.topic(&topic).unwrap();
        for time_ns in 0..10 {
            let text = Text { data: format!("{time_ns}") };
            bag.write(topic, Stamp::at(time_ns), &text.to_cdr().unwrap()).unwrap();
        }
    }
    bag.finish().unwrap();
    let options = folder.path("out.yaml");
    let uri = |name: &str| folder.path(name).display().to_string();
    let yaml = format!(
        "output_bags:\n- uri: {}\n  storage_id: sqlite3\n  all_topics: true\n  \
         compression_mode: message\n  compression_format: zstd\n- uri: {}\n  storage_id: mcap\n  \
         topics: [b]\n  start_time_ns: 3\n  storage_preset_profile: none\n  max_cache_size: 7\n  \
         regexx: x\n",
        uri("all"),
        uri("some"),
    );
    std::fs::write(&options, &yaml).unwrap();
    let words = ["-i", source.to_str().unwrap(), "-o", options.to_str().unwrap()];
    let output = convert(&words);
    assert!(output.status.success(), "{output:?}");
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("did you mean `regex`?"), "{said}");
    assert_eq!(texts(&folder.path("all")).len(), 20);
    assert_eq!(Bag::open(folder.path("all")).unwrap().storage(), Storage::Sqlite);
    let some = texts(&folder.path("some"));
    assert!(some.iter().all(|(topic, _)| topic == "/b") && some.len() == 7, "{some:?}");

    std::fs::write(&options, yaml.replace("sqlite3", "sqlite4")).unwrap();
    let output = convert(&words);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        said.contains("out.yaml:3") && said.contains("expected one of mcap, sqlite3"),
        "{said}"
    );
}
