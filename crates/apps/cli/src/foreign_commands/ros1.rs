//! ROS 1 commands.

use super::answers::{elsewhere, lacking, with_packages};
use super::programs::{self, Dialect};
use super::ros2::{created, without};
use super::{Reading, become_words};

pub(super) fn read(program: &str, rest: &[String]) -> Option<Reading> {
    let (verb, behind) = match rest.split_first() {
        Some((verb, behind)) => (verb.as_str(), behind),
        None => ("", rest),
    };
    Some(match program {
        "roslaunch" => launch(rest),
        "rosrun" => match programs::split(rest) {
            Some((package, program, words)) => {
                programs::run(package, program, words, Dialect::Ros1)
            }
            None => elsewhere("`rosrun` takes a package and one of its programs"),
        },
        "rostopic" => topic(verb, behind),
        "rosnode" => node(verb, behind),
        "rosservice" => service(verb, behind),
        "rosparam" => parameter(verb, behind),
        "rosbag" => bag(verb, behind),
        "rosmsg" | "rossrv" => match verb {
            "show" | "info" | "list" | "package" | "packages" => {
                let verb = if verb == "info" { "show" } else { verb };
                become_words(&["interface", verb], behind.to_vec())
            }
            _ => elsewhere(format!("`{program}` takes show, list, package or packages")),
        },
        "roswtf" => become_words(&["doctor"], Vec::new()),
        "roscore" | "rosmaster" => master(rest),
        "rospack" | "rosstack" | "roscd" | "rosls" | "rosed" => {
            with_packages("packages are found by their package.xml; found here")
        }
        "roscreate-pkg" | "catkin_create_pkg" => created(rest),
        _ => return None,
    })
}

fn launch(rest: &[String]) -> Reading {
    let (mut words, mut dropped) = (Vec::new(), Vec::new());
    let mut rest = rest.iter();
    while let Some(word) = rest.next() {
        match word.as_str() {
            "--ros-args" => words.push("--show-args".to_owned()),
            "--dump-params" | "--nodes" | "--files" | "--args" | "--find-node" => {
                words.push("--print".to_owned());
                if matches!(word.as_str(), "--args" | "--find-node") {
                    dropped.extend(rest.next().cloned());
                }
            }
            "-p" | "--port" | "-w" | "--numworkers" | "-t" | "--timeout" => {
                dropped.push(word.clone());
                dropped.extend(rest.next().cloned());
            }
            _ if word.starts_with('-') => dropped.push(word.clone()),
            _ => words.push(word.clone()),
        }
    }
    // At full speed programs of ROS 1 could not keep pace.
    let is_free =
        words.iter().any(|word| matches!(word.as_str(), "--duration" | "--print" | "--show-args"));
    let has_choice =
        words.iter().any(|word| word.starts_with("--ros1") || word.starts_with("--rtf"));
    if !is_free && !has_choice {
        words.push("--ros1".to_owned());
    }
    without(become_words(&["launch"], words), &dropped)
}

fn topic(verb: &str, rest: &[String]) -> Reading {
    let (mut words, mut dropped) = (Vec::new(), Vec::new());
    let mut rest = rest.iter().peekable();
    while let Some(word) = rest.next() {
        match (verb, word.as_str()) {
            (_, "--") => {}
            ("echo", "-n") => match rest.next().map(String::as_str) {
                Some("1") => words.push("--once".to_owned()),
                count => {
                    dropped.extend(["-n".to_owned()].into_iter().chain(count.map(str::to_owned)));
                }
            },
            ("echo", "-p") => words.push("--csv".to_owned()),
            ("echo", "--noarr") => words.push("--no-arr".to_owned()),
            ("echo", "--nostr") => words.push("--no-str".to_owned()),
            ("echo", "-c" | "-a") | ("list", "-p" | "-s") | ("pub", "-l" | "--latch") => {
                dropped.push(word.clone());
            }
            ("echo", "-b" | "--bag") => {
                return lacking(
                    "rostopic echo -b",
                    "play the bag (`periplus bag play BAG`) and subscribe in another terminal",
                );
            }
            ("pub", "-f" | "--file") => {
                return lacking("rostopic pub -f", "give the values after the type, as YAML");
            }
            _ => words.push(word.clone()),
        }
    }
    match verb {
        "list" | "echo" | "hz" | "bw" | "pub" | "type" | "find" | "info" | "delay" => {
            without(on_ros1(&["topic", verb], words), &dropped)
        }
        _ => elsewhere("`rostopic` takes bw, delay, echo, find, hz, info, list, pub or type"),
    }
}

/// An own verb that uses ROS 1 if a master answers.
fn on_ros1(ours: &[&str], rest: Vec<String>) -> Reading {
    become_words(ours, rest).on_ros1(ours.len())
}

fn master(rest: &[String]) -> Reading {
    let (mut words, mut dropped) = (Vec::new(), Vec::new());
    let mut rest = rest.iter();
    while let Some(word) = rest.next() {
        match word.as_str() {
            "-p" | "--port" => {
                words.push("--port".to_owned());
                words.extend(rest.next().cloned());
            }
            "-w" | "--numworkers" | "-t" | "--timeout" => {
                dropped.push(word.clone());
                dropped.extend(rest.next().cloned());
            }
            "--core" => {}
            _ => dropped.push(word.clone()),
        }
    }
    without(become_words(&["ros1", "master"], words), &dropped)
}

fn node(verb: &str, rest: &[String]) -> Reading {
    match verb {
        "list" | "info" => {
            let known = rest.iter().filter(|word| !word.starts_with('-')).cloned();
            on_ros1(&["node", verb], known.collect())
        }
        "kill" | "ping" | "machine" | "cleanup" => {
            become_words(&["ros1", "node", verb], rest.to_vec())
        }
        _ => elsewhere("`rosnode` takes cleanup, info, kill, list, machine or ping"),
    }
}

fn service(verb: &str, rest: &[String]) -> Reading {
    match (verb, rest) {
        ("call", _) => become_words(&["ros1", "call"], rest.to_vec()),
        ("list" | "type" | "info" | "find", _) => on_ros1(&["service", verb], rest.to_vec()),
        _ => elsewhere("`rosservice` takes call, find, info, list or type"),
    }
}

/// The parameter server is that of the master.
fn parameter(verb: &str, rest: &[String]) -> Reading {
    match verb {
        "list" | "get" | "set" | "delete" | "dump" | "load" => {
            let known = rest.iter().filter(|word| !matches!(word.as_str(), "-p" | "-v"));
            become_words(&["ros1", "param", verb], known.cloned().collect())
        }
        _ => elsewhere("`rosparam` takes delete, dump, get, list, load or set"),
    }
}

fn bag(verb: &str, rest: &[String]) -> Reading {
    let mut words = Vec::new();
    let mut dropped = Vec::new();
    let mut rest = rest.iter();
    while let Some(word) = rest.next() {
        match (verb, word.as_str()) {
            ("record", "-O" | "--output-name" | "-o" | "--output-prefix") => {
                words.push("--output".to_owned());
                words.extend(rest.next().cloned());
            }
            ("record", "-j" | "--bz2" | "--lz4" | "-q" | "--quiet")
            | ("play", "-q" | "--quiet" | "--hz") => {
                dropped.push(word.clone());
            }
            ("play", "--pause") => words.push("--start-paused".to_owned()),
            ("play", "-s" | "--start") => {
                words.push("--start-offset".to_owned());
                words.extend(rest.next().cloned());
            }
            ("play", "-u" | "--duration") => {
                words.push("--playback-duration".to_owned());
                words.extend(rest.next().cloned());
            }
            _ => words.push(word.clone()),
        }
    }
    match verb {
        "record" | "play" | "info" | "check" | "reindex" => {
            let ours = match verb {
                "record" | "play" => on_ros1(&["bag", verb], clock_last(words)),
                _ => become_words(&["bag", verb], words),
            };
            without(ours, &dropped)
        }
        "compress" | "decompress" | "filter" | "fix" => lacking(
            &format!("rosbag {verb}"),
            "`periplus bag convert BAG --output NEW` compresses, decompresses and selects topics and times; truncated \
             recordings are read as they are",
        ),
        _ => elsewhere("`rosbag` takes record, play, info, check or reindex"),
    }
}

/// `--clock` takes an optional rate, which must not be confused with the name of a bag.
pub(super) fn clock_last(mut words: Vec<String>) -> Vec<String> {
    if let Some(at) = words.iter().position(|word| word == "--clock")
        && words.get(at + 1).is_some_and(|next| next.parse::<f64>().is_err())
    {
        let clock = words.remove(at);
        words.push(clock);
    }
    words
}
