//! Playback and recording on a graph, and killed recorders.

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{Folder, numbers, rows, write_numbers};
use periplus_bags::Selection;
use periplus_bags::files::{
    Bag, PlaySettings, Player, RecordSettings, Recorder, Storage, WriteSettings,
};
use periplus_graph::{Durability, Graph, NodeSettings, Qos};
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_msgs::std_msgs::{String as Text, UInt32};

const STORAGES: [(Storage, &str); 3] =
    [(Storage::Mcap, "bag"), (Storage::Sqlite, "base"), (Storage::Ros1, "one.bag")];

/// Plays to the end on a simulated caller clock. Returns the duration \[ns\].
fn play(player: &mut Player, graph: &Graph) -> i64 {
    let mut wall_ns = 1_000;
    while let Some(next_ns) = player.advance_to(wall_ns).unwrap() {
        assert!(next_ns > wall_ns);
        wall_ns = next_ns;
        graph.advance_to(wall_ns);
    }
    wall_ns - 1_000
}

#[test]
fn what_is_recorded_is_played_and_recorded_again() {
    let folder = Folder::new("played");
    let first = folder.path("first");
    write_numbers(&first, WriteSettings::new(Storage::Mcap));
    for (storage, name) in STORAGES {
        let graph = Graph::new();
        let settings = PlaySettings { rate: 2.0, ..PlaySettings::default() };
        let mut player = Player::new(Bag::open(&first).unwrap(), &graph, settings).unwrap();
        let path = folder.path(name);
        let settings = RecordSettings::all(WriteSettings::new(storage));
        let recorder = Recorder::start(&graph, &path, settings).unwrap();
        // 3.9 s at twice the speed.
        assert_eq!(play(&mut player, &graph), 1_950_000_000);
        assert_eq!((player.published(), recorder.messages()), (40, 40));
        recorder.keep().unwrap();
        let recording = recorder.finish().unwrap();
        assert_eq!((recording.info.messages(), recording.dropped), (40, 0));
        let bag = Bag::open(&path).unwrap();
        assert!(bag.findings().is_empty(), "{:?}", bag.findings());
        let played: Vec<(u32, String)> =
            rows(&bag, Selection::default()).into_iter().map(|row| (row.0, row.2)).collect();
        let expected: Vec<(u32, String)> =
            numbers().into_iter().map(|row| (row.0, row.2)).collect();
        assert_eq!(played, expected);
    }
}

#[test]
fn a_player_knows_parts_names_and_clocks() {
    let folder = Folder::new("parts");
    let path = folder.path("bag");
    write_numbers(&path, WriteSettings::new(Storage::Sqlite));
    let graph = Graph::new();
    let listener = graph.node(NodeSettings::new("listener").bare()).unwrap();
    let odd = listener.mailbox::<UInt32>("/strange", Qos::reliable(100)).unwrap();
    let even = listener.mailbox::<UInt32>("/even", Qos::reliable(100)).unwrap();
    let clock = listener.mailbox::<Clock>("/clock", Qos::clock().keep_all()).unwrap();
    let settings = PlaySettings {
        selection: Selection {
            span_ns: 1_000_000_000..=1_999_999_999,
            ..Selection::topics(["/odd"])
        },
        remaps: vec!["/odd:=/strange".into()],
        clock_hz: Some(10.0),
        is_paused: true,
        ..PlaySettings::default()
    };
    let mut player = Player::new(Bag::open(&path).unwrap(), &graph, settings).unwrap();
    assert_eq!(player.advance_to(0).unwrap(), Some(i64::MAX));
    assert!(player.step().unwrap());
    let numbers = |all: Vec<std::sync::Arc<UInt32>>| all.iter().map(|one| one.data).collect();
    let played: Vec<u32> = numbers(odd.drain());
    assert_eq!(played, [11]);
    player.set_paused(false);
    play(&mut player, &graph);
    let played: Vec<u32> = numbers(odd.drain());
    assert_eq!(played, [13, 15, 17, 19]);
    assert!(even.drain().is_empty());
    let ticks = clock.drain();
    assert_eq!((ticks[0].clock.sec, ticks[0].clock.nanosec), (1, 0));
    assert_eq!(ticks.len(), 10);
}

#[test]
fn a_loop_begins_again() {
    let folder = Folder::new("loop");
    let path = folder.path("bag.mcap");
    write_numbers(&path, WriteSettings::new(Storage::Mcap));
    let graph = Graph::new();
    let settings = PlaySettings { is_looped: true, ..PlaySettings::default() };
    let mut player = Player::new(Bag::open(&path).unwrap(), &graph, settings).unwrap();
    let mut wall_ns = 0;
    while player.published() < 100 {
        wall_ns = player.advance_to(wall_ns).unwrap().unwrap();
    }
    // Two times 3.9 s, and twenty tenths more.
    assert!((9_600_000_000..=9_900_000_000).contains(&wall_ns), "{wall_ns}");
}

#[test]
fn latched_topics_stay_latched() {
    let folder = Folder::new("latched");
    for (storage, name) in STORAGES {
        let path = folder.path(name);
        let graph = Graph::new();
        let node = graph.node(NodeSettings::new("robot").bare()).unwrap();
        let text = node.publisher::<Text>("/robot_description", Qos::latched(1)).unwrap();
        text.publish(Text { data: "<robot/>".into() });
        let settings = RecordSettings::all(WriteSettings::new(storage));
        let recorder = Recorder::start(&graph, &path, settings).unwrap();
        assert_eq!(recorder.finish().unwrap().info.messages(), 1);

        let graph = Graph::new();
        let settings = PlaySettings::default();
        let mut player = Player::new(Bag::open(&path).unwrap(), &graph, settings).unwrap();
        play(&mut player, &graph);
        let topics = graph.topics();
        let played = topics.iter().find(|topic| topic.name == "/robot_description").unwrap();
        assert_eq!(played.publishers[0].qos.durability, Durability::TransientLocal);
        let late = graph.node(NodeSettings::new("late").bare()).unwrap();
        let late = late.mailbox::<Text>("/robot_description", Qos::latched(1)).unwrap();
        assert_eq!(late.latest().unwrap().data, "<robot/>");
    }
}

#[test]
fn latched_messages_are_recorded_at_the_beginning_of_the_recording() {
    let folder = Folder::new("retained");
    let path = folder.path("bag.mcap");
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("robot").bare()).unwrap();
    let text = node.publisher::<Text>("/robot_description", Qos::latched(1)).unwrap();
    text.publish(Text { data: "<robot/>".into() });
    graph.advance_to(5_000_000_000);
    let settings = RecordSettings::all(WriteSettings::new(Storage::Mcap));
    let recorder = Recorder::start(&graph, &path, settings).unwrap();
    graph.advance_to(6_000_000_000);
    text.publish(Text { data: "<robot/>".into() });
    recorder.finish().unwrap();
    let bag = Bag::open(&path).unwrap();
    let mut messages = bag.messages(Selection::default());
    let mut times = Vec::new();
    while let Some(message) = messages.next().unwrap() {
        times.push((message.log_ns, message.publish_ns));
    }
    assert_eq!(times, [(5_000_000_000, 0), (6_000_000_000, 6_000_000_000)]);
}

/// Child process of [`a_killed_recording_loses_a_second_at_most`]; does nothing on its own.
#[test]
fn child_that_records_until_it_is_killed() {
    let Some(path) = std::env::var_os("PERIPLUS_KILLED_RECORDING") else { return };
    let path = Path::new(&path);
    let storage = Storage::of_path(path).unwrap_or(Storage::Mcap);
    let graph = Graph::new();
    let settings = RecordSettings::all(WriteSettings::new(storage));
    let recorder = Recorder::start(&graph, path, settings).unwrap();
    let node = graph.node(NodeSettings::new("counter").bare()).unwrap();
    let numbers = node.publisher::<UInt32>("/odd", Qos::reliable(10)).unwrap();
    let start = Instant::now();
    for number in 0..6_000_u32 {
        let due = Duration::from_millis(u64::from(number) * 10);
        std::thread::sleep(due.saturating_sub(start.elapsed()));
        graph.advance_to(i64::from(number) * 10_000_000);
        numbers.publish(UInt32 { data: number });
        recorder.keep().unwrap();
        println!("number {number}");
        std::io::stdout().flush().unwrap();
    }
}

#[test]
fn a_killed_recording_loses_a_second_at_most() {
    let folder = Folder::new("killed");
    for name in ["folder", "one.mcap", "one.db3", "one.bag"] {
        let path = folder.path(name);
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "live::child_that_records_until_it_is_killed", "--nocapture"])
            .env("PERIPLUS_KILLED_RECORDING", &path)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut told = 0;
        for line in BufReader::new(child.stdout.take().unwrap()).lines() {
            let line = line.unwrap();
            if let Some((_, number)) = line.rsplit_once("number ") {
                told = number.parse::<u32>().unwrap();
            }
            if told >= 250 {
                break;
            }
        }
        // SIGKILL: no cleanup code runs.
        child.kill().unwrap();
        child.wait().unwrap();
        let bag = Bag::open(&path).unwrap();
        let rows = rows(&bag, Selection::default());
        let expected: Vec<u32> = (0..rows.len() as u32).collect();
        let found: Vec<u32> = rows.iter().map(|row| row.0).collect();
        assert_eq!(found, expected, "{name}: no gaps");
        assert!(rows.len() as u32 + 100 > told, "{name}: {} of {told}", rows.len());
    }
}
