//! Tests of the table: translations parse, and commands of three tutorials are covered.
#![allow(clippy::disallowed_methods, reason = "the tutorials are read where they are at hand")]
#![allow(clippy::print_stderr, reason = "skipped tests are reported")]

use std::fmt::Write as _;
use std::path::Path;

use clap::Parser as _;
use expect_test::expect_file;
use periplus_graph::split_arguments;

use super::{Reading, read, shown};
use crate::options::Options;

/// Splits a line into words as a shell does.
pub(crate) fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut quote = None;
    for letter in line.chars() {
        match (quote, letter) {
            (Some(open), _) if letter == open => quote = None,
            (None, '\'' | '"') => {
                quote = Some(letter);
                word.get_or_insert_default();
            }
            (None, ' ') => words.extend(word.take()),
            _ => word.get_or_insert_default().push(letter),
        }
    }
    words.extend(word);
    words
}

/// Asserts that a translated command parses.
fn parse(line: &str, words: &[String], own: Vec<String>) {
    let typed = ["periplus".to_owned()].into_iter().chain(own);
    if let Err(error) = Options::try_parse_from(typed) {
        // A page of help is a valid result.
        assert!(!error.use_stderr(), "`{line}` becomes `{}`: {error}", shown(words));
    }
}

/// Translation of a line, which must be a valid command or an explanation.
fn becomes(line: &str) -> String {
    match read(&words(line)) {
        Reading::Ours => panic!("`{line}` is not translated"),
        Reading::Words { words, notes } => {
            let (own, ros) = split_arguments(words.iter().cloned());
            parse(line, &words, own);
            for pair in ros.chunks(2) {
                assert!(pair[0].starts_with('-'), "`{line}`: {ros:?}");
            }
            let notes: String = notes.iter().map(|note| format!(" ({note})")).collect();
            format!("`periplus {}`{notes}", shown(&words))
        }
        Reading::Answer(answer) => {
            let packages = if answer.lists_packages { ": (a list)" } else { "" };
            format!("{}{packages}", answer.text)
        }
    }
}

#[test]
fn every_foreign_command_is_translated() {
    let mut page = String::from(
        "# ROS and Gazebo commands\n\nPrefix the ROS or Gazebo command you know with `periplus`; it runs the \
         equivalent and prints it. This page is generated: `UPDATE_EXPECT=1 cargo test -p periplus-cli \
         foreign_command` rewrites it.\n\n| Command | Equivalent of `periplus` |\n|---|---|\n",
    );
    for line in include_str!("examples.txt").lines().filter(|line| !line.is_empty()) {
        if let Some(title) = line.strip_prefix("# ") {
            let _ = writeln!(page, "| **{title}** | |");
            continue;
        }
        let _ = writeln!(page, "| `{line}` | {} |", becomes(line).replace('|', "\\|"));
    }
    expect_file!["../../../../../docs/ros-and-gazebo-commands.md"].assert_eq(&page);
}

#[test]
fn own_words_stay() {
    for line in
        ["sim world.sdf", "topic list", "bag info a.mcap", "--help", "tf tree", "doctor", ""]
    {
        assert_eq!(read(&words(line)), Reading::Ours, "{line}");
    }
}

#[test]
fn a_line_of_several_commands_is_its_last_one() {
    let line = "source /opt/ros/jazzy/setup.bash && ros2 topic echo /laser_scan";
    assert_eq!(becomes(line), "`periplus topic echo /laser_scan`");
    assert!(becomes("mkdir x && ros2 topic list").contains("is a shell command"));
}

/// Command printed in a tutorial: tutorial, line, command.
fn printed() -> Vec<(&'static str, usize, &'static str)> {
    include_str!("../../tests/tutorials/commands.tsv")
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
        .map(|line| {
            let mut parts = line.splitn(3, '\t');
            let mut part = || parts.next().unwrap();
            (part(), part().parse().unwrap(), part())
        })
        .collect()
}

#[test]
fn every_command_of_the_tutorials_is_understood() {
    assert_eq!(printed().len(), 18);
    for (tutorial, line, command) in printed() {
        for simple in command.split(" && ") {
            let told = becomes(simple);
            assert!(
                told.starts_with('`') || told.starts_with("nothing need"),
                "{tutorial}:{line}: {told}"
            );
        }
        becomes(command);
    }
}

#[test]
fn no_command_of_the_tutorials_is_missing() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/tutorials");
    if !folder.is_dir() {
        eprintln!("SKIPPED: the tutorials are not in {}", folder.display());
        return;
    }
    let starts = ["$ ", "ros2 ", "colcon ", ". install", "sudo ", "gz sim ", "source "];
    for name in ["harmonic-jazzy-adding-lidar", "kbot-laser-slam-maps", "nav2-setting-up-sensors"] {
        let text = std::fs::read_to_string(folder.join(name).with_extension("txt")).unwrap();
        let known: Vec<_> = printed().into_iter().filter(|(of, ..)| *of == name).collect();
        for (number, line) in (1..).zip(text.lines()) {
            // Item numbers and line numbers of listings precede commands.
            let bare =
                line.trim_start_matches(|it: char| it.is_ascii_digit() || " |)".contains(it));
            let is_command = starts.iter().any(|start| bare.starts_with(start));
            let here: Vec<_> = known.iter().filter(|(_, of, _)| *of == number).collect();
            assert_eq!(is_command, !here.is_empty(), "{name}:{number}: {line}");
            for (_, _, command) in here {
                assert!(line.contains(command), "{name}:{number}: {line}");
            }
        }
    }
}
