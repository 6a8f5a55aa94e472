//! The commands of README.md, run in this order, print what it shows. `UPDATE_EXPECT=1` rewrites it.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "this test reads the README and runs its commands")]

mod common;

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

use common::Folder;
use regex::Regex;

/// Root of the source tree.
fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..").canonicalize().unwrap()
}

/// Runs a command of the README and returns its output, both streams in one.
fn output_of(folder: &Folder, words: &[&str]) -> String {
    let path = folder.path("output.txt");
    let output = File::create(&path).unwrap();
    let status = Command::new(env!("CARGO_BIN_EXE_periplus"))
        .args(words)
        .current_dir(&folder.0)
        .env("NO_COLOR", "1")
        .env("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")
        .stdout(output.try_clone().unwrap())
        .stderr(output)
        .status()
        .unwrap();
    let text = fs::read_to_string(path).unwrap();
    assert!(status.success(), "periplus {}\n{text}", words.join(" "));
    text
}

/// Replaces figures that depend on the speed of the machine.
fn without_speed(text: &str) -> String {
    let speed = Regex::new(r"in [\d.]+ s: [\d.]+ x real time|\d+ %").unwrap();
    speed.replace_all(text, "...").into_owned()
}

#[test]
fn every_command_prints_what_the_readme_shows() {
    let folder = Folder::new("readme");
    for name in ["robots", "worlds"] {
        std::os::unix::fs::symlink(top().join(name), folder.path(name)).unwrap();
    }
    let path = top().join("README.md");
    let mut readme = fs::read_to_string(&path).unwrap();

    // The log that `slam` maps.
    let demo =
        readme.lines().find_map(|line| line.strip_prefix("cargo run --release -- ")).unwrap();
    assert!(demo.starts_with("demo "), "{demo}");
    output_of(&folder, &demo.split(' ').collect::<Vec<_>>());

    let blocks = Regex::new(r"```console\n\$ periplus (.*)\n((?s:.*?))```\n").unwrap();
    let text = readme.clone();
    let mut count = 0;
    for block in blocks.captures_iter(&text) {
        let (line, expected) = (&block[1], &block[2]);
        let found = output_of(&folder, &line.split(' ').collect::<Vec<_>>());
        if without_speed(expected) != without_speed(&found) {
            readme = readme.replacen(expected, &found, 1);
        }
        count += 1;
    }
    assert_eq!(count, text.matches("```console").count(), "a block is not a command of periplus");
    assert!(count > 0, "the README has no commands");
    if readme != text {
        if std::env::var_os("UPDATE_EXPECT").is_some() {
            fs::write(&path, readme).unwrap();
        } else {
            fail_with_difference(&text, &readme);
        }
    }
}

/// Fails with the lines that differ.
fn fail_with_difference(shown: &str, printed: &str) {
    let differing: Vec<_> =
        printed.lines().filter(|line| !shown.lines().any(|it| it == *line)).collect();
    panic!(
        "README.md shows other output than:\n{}\nupdate it: UPDATE_EXPECT=1 cargo test -p periplus-cli --test readme",
        differing.join("\n")
    );
}
