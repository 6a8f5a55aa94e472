//! `ros2 ...`.

use super::answers::{elsewhere, lacking, needless, with_packages};
use super::programs::{self, Dialect};
use super::ros1::clock_last;
use super::{Reading, become_words};

pub(super) fn read(words: &[String]) -> Reading {
    let Some((verb, rest)) = words.split_first() else {
        return elsewhere("`ros2` needs a word behind it; `periplus --help` lists what there is");
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
            None => elsewhere("`ros2 run` takes a package and a program of it"),
        },
        "doctor" | "wtf" => become_words(&["doctor"], doctored(rest)),
        "multicast" => become_words(&["doctor"], Vec::new())
            .noting("the doctor looks whether multicast works, and who is there"),
        "daemon" => needless("there is no daemon: every command looks for itself"),
        "pkg" => package(rest),
        "component" => lacking(
            "ros2 component",
            "components are started from launch files: `periplus launch FILE`",
        ),
        "control" => lacking(
            "ros2 control",
            "the simulation drives robots by Gazebo's own plugins, not by ros2_control",
        ),
        "security" => {
            lacking("ros2 security", "no keys are made here, and topics are not encrypted")
        }
        "test" => lacking("ros2 test", "run tests of launch files where ROS 2 is installed"),
        "--help" | "-h" => elsewhere(
            "these words of `ros2` are here: action, bag, doctor, \
            interface, launch, lifecycle, node, param, run, service, topic; see `periplus --help`",
        ),
        other => lacking(
            &format!("ros2 {other}"),
            "of `ros2` there are action, bag, doctor, interface, launch, lifecycle, node, param, run, \
             service and topic",
        ),
    }
}

/// Options of `ros2 launch` that say how it shows things, not what it starts.
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

/// Says which words count for nothing.
pub(super) fn without(reading: Reading, dropped: &[String]) -> Reading {
    if dropped.is_empty() {
        return reading;
    }
    reading.noting(format!("`{}` has no meaning here and is left out", dropped.join(" ")))
}

fn doctored(rest: &[String]) -> Vec<String> {
    // `--report` and the like print what the doctor prints by itself.
    let is_known = |word: &&String| matches!(word.as_str(), "--json");
    rest.iter().filter(is_known).cloned().collect()
}

fn package(rest: &[String]) -> Reading {
    match rest.first().map(String::as_str) {
        Some("list" | "prefix" | "xml" | "executables") => {
            with_packages("packages are found by their package.xml; here are those that are found")
        }
        Some("create") => lacking(
            "ros2 pkg create",
            "a package is a folder with a package.xml: write one with `<package><name>NAME</name>\
             </package>` beside your files",
        ),
        _ => elsewhere("`ros2 pkg` takes list, prefix, executables or xml"),
    }
}
