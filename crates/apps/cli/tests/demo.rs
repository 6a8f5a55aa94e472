//! The demo without a page: the same seed gives the same bytes.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests look at files")]

mod common;

use std::collections::BTreeMap;
use std::process::Command;

use common::Folder;
use serde_json::Value;

/// All output files of a run by name; of the report only the part that does not depend on the speed of the machine.
fn run(folder: &Folder, name: &str, seed: &str) -> BTreeMap<String, Vec<u8>> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.current_dir(&folder.0);
    command.args(["demo", "--headless", "--duration", "4", "--seed", seed, "--out", name]);
    let output = command.output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let files = std::fs::read_dir(folder.path(name)).unwrap().map(|entry| entry.unwrap());
    let read = |entry: std::fs::DirEntry| {
        let file = entry.file_name().into_string().unwrap();
        (file, std::fs::read(entry.path()).unwrap())
    };
    let mut files: BTreeMap<String, Vec<u8>> = files.map(read).collect();
    let report = files.get_mut("report.json").expect("a report");
    let mut told: Value = serde_json::from_slice(report).unwrap();
    let told_of = told.as_object_mut().unwrap();
    for of_this_machine in ["wall_s", "start_up_s", "real_time_factor", "work"] {
        assert!(told_of.remove(of_this_machine).is_some(), "{of_this_machine}");
    }
    // The folder's name is in it.
    assert!(told_of["recording"].as_object_mut().unwrap().remove("path").is_some());
    *report = told.to_string().into_bytes();
    files
}

#[test]
fn the_same_seed_leaves_the_same_bytes_and_another_does_not() {
    let folder = Folder::new("demo");
    let one = run(&folder, "one", "3");
    let names: Vec<&str> = one.keys().map(String::as_str).collect();
    for wanted in ["demo.mcap", "report.json"] {
        assert!(names.contains(&wanted), "{names:?}");
    }
    for kind in ["pgm", "yaml", "png"] {
        assert!(names.iter().any(|name| name.ends_with(kind)), "{names:?}");
    }
    let again = run(&folder, "two", "3");
    assert_eq!(names, again.keys().map(String::as_str).collect::<Vec<_>>());
    for (name, bytes) in &one {
        assert!(*bytes == again[name], "{name} differs");
    }
    let other = run(&folder, "three", "4");
    assert!(one["demo.mcap"] != other["demo.mcap"], "another seed, and the same noise");
    // And the map has something to do with the room.
    let report: Value = serde_json::from_slice(&one["report.json"]).unwrap();
    let mean_m = report["truth"]["wall_mean_m"].as_f64().unwrap();
    assert!(mean_m < 0.1, "{report:#}");
}
