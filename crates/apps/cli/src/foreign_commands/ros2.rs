//! `ros2 ...`.

use super::answers::{elsewhere, lacking, needless, unknown, with_packages};
use super::programs::{self, Dialect};
use super::ros1::clock_last;
use super::{Reading, become_words};

/// Subcommands of `ros2` that are translated.
const WORDS: [&str; 13] = [
    "action",
    "bag",
    "doctor",
    "interface",
    "launch",
    "lifecycle",
    "multicast",
    "node",
    "param",
    "pkg",
    "run",
    "service",
    "topic",
];

pub(super) fn read(words: &[String]) -> Reading {
    let Some((verb, rest)) = words.split_first() else {
        return elsewhere("`ros2` needs a subcommand; `periplus --help` lists the commands");
    };
    match verb.as_str() {
        "topic" | "node" | "service" | "param" | "action" | "lifecycle" | "interface" => {
            become_words(&[verb], rest.to_vec())
        }
        "bag" => become_words(&["bag"], clock_last(rest.to_vec())),
        "launch" => launch(rest),
        "run" => match programs::split(rest) {
            Some((package, executable, words)) => {
                programs::run(package, executable, words, Dialect::Ros2)
            }
            None => elsewhere("`ros2 run` takes a package and one of its programs"),
        },
        "doctor" | "wtf" => become_words(&["doctor"], doctored(rest)),
        "multicast" => become_words(&["doctor"], Vec::new())
            .noting("the doctor tests multicast and lists other programs"),
        "daemon" => needless("there is no daemon: every command discovers the network itself"),
        "pkg" => package(rest),
        "component" => lacking(
            "ros2 component",
            "components are started from launch files: `periplus launch FILE`",
        ),
        "control" => lacking(
            "ros2 control",
            "controllers start with the robot or by spawners in launch files; the services of \
             `/controller_manager` answer `periplus service call`",
        ),
        "security" => lacking("ros2 security", "DDS Security is not supported"),
        "test" => lacking("ros2 test", "run tests of launch files where ROS 2 is installed"),
        "--help" | "-h" => needless(format!(
            "`ros2` takes {}; `periplus ros2 WORD --help` explains one of them",
            WORDS.join(", ")
        )),
        other => unknown("ros2", other, &WORDS),
    }
}

/// Translates `ros2 launch`; display options are dropped.
fn launch(rest: &[String]) -> Reading {
    let mut words = Vec::new();
    let mut dropped = Vec::new();
    let mut rest = rest.iter();
    while let Some(word) = rest.next() {
        match word.as_str() {
            "-d"
            | "--debug"
            | "-n"
            | "--noninteractive"
            | "-a"
            | "--show-all-subprocesses-output" => dropped.push(word.clone()),
            "--launch-prefix" | "--launch-prefix-filter" => {
                dropped.push(word.clone());
                dropped.extend(rest.next().cloned());
            }
            _ => words.push(word.clone()),
        }
    }
    without(become_words(&["launch"], words), &dropped)
}

/// Notes which arguments are ignored.
pub(super) fn without(reading: Reading, dropped: &[String]) -> Reading {
    if dropped.is_empty() {
        return reading;
    }
    reading.noting(format!("`{}` has no effect here and is omitted", dropped.join(" ")))
}

fn doctored(rest: &[String]) -> Vec<String> {
    // The doctor always prints what `--report` and similar options request.
    let is_known = |word: &&String| matches!(word.as_str(), "--json");
    rest.iter().filter(is_known).cloned().collect()
}

/// Translates `ros2 pkg create` and `catkin_create_pkg`: the name is the one word that belongs to
/// no option.
pub(super) fn created(rest: &[String]) -> Reading {
    let (mut name, mut dropped) = (None, Vec::new());
    let mut rest = rest.iter().peekable();
    while let Some(word) = rest.next() {
        if word.starts_with('-') {
            dropped.push(word.clone());
            // `--dependencies` takes several words, other options one.
            while let Some(value) = rest.next_if(|next| !next.starts_with('-')) {
                // The name may be last, after the single word of an option.
                if name.is_none() && rest.peek().is_none() && word != "--dependencies" {
                    name = Some(value.clone());
                } else {
                    dropped.push(value.clone());
                }
                if word != "--dependencies" {
                    break;
                }
            }
        } else if name.is_none() {
            name = Some(word.clone());
        } else {
            dropped.push(word.clone());
        }
    }
    match name {
        Some(name) => without(become_words(&["new", "package"], vec![name]), &dropped),
        None => elsewhere("give a name: `periplus new package NAME`"),
    }
}

fn package(rest: &[String]) -> Reading {
    match rest.first().map(String::as_str) {
        Some("list" | "prefix" | "xml" | "executables") => {
            with_packages("packages are found by their package.xml; found here")
        }
        Some("create") => created(&rest[1..]),
        _ => elsewhere("`ros2 pkg` takes list, prefix, executables or xml"),
    }
}
