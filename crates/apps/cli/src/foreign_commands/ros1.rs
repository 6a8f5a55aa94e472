//! ROS 1 commands.

use super::answers::{elsewhere, lacking, needless, with_packages};
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
        "roscore" | "rosmaster" => needless("no master is needed: nodes discover each other"),
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
            without(become_words(&["topic", verb], words), &dropped)
        }
        _ => elsewhere("`rostopic` takes bw, delay, echo, find, hz, info, list, pub or type"),
    }
}

fn node(verb: &str, rest: &[String]) -> Reading {
    match verb {
        "list" | "info" => {
            let known = rest.iter().filter(|word| !word.starts_with('-')).cloned();
            become_words(&["node", verb], known.collect())
        }
        "kill" => lacking("rosnode kill", "end the program where it runs, with Ctrl-C"),
        "ping" | "machine" | "cleanup" => lacking(
            &format!("rosnode {verb}"),
            "nodes that ended disappear automatically: `periplus node list`",
        ),
        _ => elsewhere("`rosnode` takes list or info"),
    }
}

fn service(verb: &str, rest: &[String]) -> Reading {
    match (verb, rest) {
        ("call", [name]) => {
            let call = [name.clone(), "std_srvs/srv/Empty".to_owned()];
            become_words(&["service", "call"], call.to_vec())
                .noting("a call without values has the type std_srvs/srv/Empty")
        }
        ("call", [name, ..]) => elsewhere(format!(
            "a call needs the type of the service: `periplus service type {name}` prints it, then \
             `periplus service call {name} TYPE VALUES`"
        )),
        ("list" | "type" | "info" | "find", _) => become_words(&["service", verb], rest.to_vec()),
        _ => elsewhere("`rosservice` takes call, find, info, list or type"),
    }
}

/// ROS 1 has one parameter server; here each parameter belongs to a node: `/amcl/min_particles`.
fn parameter(verb: &str, rest: &[String]) -> Reading {
    let split = |name: &String| {
        let name = format!("/{}", name.trim_start_matches('/'));
        let (node, parameter) = name.rsplit_once('/').unwrap_or(("", &name));
        (!node.is_empty()).then(|| [node.to_owned(), parameter.to_owned()])
    };
    match (verb, rest) {
        ("list", _) => {
            let known = rest.iter().filter(|word| !word.starts_with('-')).cloned();
            become_words(&["param", "list"], known.collect())
        }
        ("get" | "delete", [name]) | ("set", [name, _]) => match split(name) {
            Some(words) => {
                let rest = words.into_iter().chain(rest.get(1).cloned()).collect();
                become_words(&["param", verb], rest)
            }
            None => elsewhere(format!(
                "parameters belong to nodes: `periplus param {verb} NODE {}`; `periplus param list` \
                 lists them",
                name.trim_start_matches('/')
            )),
        },
        ("load", [file, node]) => {
            become_words(&["param", "load"], vec![node.clone(), file.clone()])
        }
        ("dump" | "load", _) => elsewhere(format!(
            "parameters belong to nodes: `periplus param {verb} NODE{}`",
            if verb == "load" { " FILE" } else { "" }
        )),
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
            without(become_words(&["bag", verb], clock_last(words)), &dropped)
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
