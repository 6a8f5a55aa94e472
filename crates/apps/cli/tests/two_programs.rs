//! Two programs on the network of this machine, in a domain without other participants.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use std::process::{Child, Command, Output, Stdio};

/// A domain that only this run uses.
fn domain() -> String {
    (101 + std::process::id() % 100).to_string()
}

fn periplus(words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.args(words).env("ROS_DOMAIN_ID", domain());
    for name in ["ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_STATIC_PEERS", "CYCLONEDDS_URI"] {
        command.env_remove(name);
    }
    command
}

fn run(words: &[&str]) -> Output {
    periplus(words).output().unwrap()
}

fn text(output: &Output) -> String {
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// A program that runs until the test ends.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn one_publishes_and_the_other_sees_and_hears_it() {
    let alone = run(&["topic", "list", "--spin-time", "0"]);
    if !alone.status.success() {
        println!("SKIPPED: there is no network: {}", String::from_utf8_lossy(&alone.stderr));
        return;
    }
    let mut talker = periplus(&[
        "topic",
        "pub",
        "/chatter",
        "std_msgs/String",
        "data: hello",
        "-r",
        "20",
        "-p",
        "0",
        "-n",
        "talker",
    ]);
    let _talker = Running(talker.stdout(Stdio::null()).spawn().unwrap());
    let heard = run(&["topic", "echo", "/chatter", "std_msgs/String", "--once", "--timeout", "20"]);
    assert_eq!(text(&heard), "data: hello\n---\n");
    let json = run(&["topic", "echo", "/chatter", "--once", "--json", "--timeout", "20"]);
    assert_eq!(text(&json), "{\"data\":\"hello\"}\n");
    assert_eq!(text(&run(&["topic", "type", "/chatter"])), "std_msgs/msg/String\n");
    assert!(text(&run(&["topic", "list", "-t"])).contains("/chatter [std_msgs/msg/String]\n"));
    assert!(text(&run(&["node", "list"])).contains("/talker\n"));
    let info = text(&run(&["topic", "info", "-v", "/chatter"]));
    assert!(info.contains("Node name: talker\nNode namespace: /\n"), "{info}");
    assert!(info.contains("Topic type hash: RIHS01_df668c"), "{info}");
    let missing = run(&["topic", "type", "/chater"]);
    assert_eq!(missing.status.code(), Some(1));
    let words = String::from_utf8(missing.stderr).unwrap();
    assert!(words.contains("did you mean `/chatter`?"), "{words}");
}

#[test]
fn usage_errors_are_told_apart() {
    assert_eq!(run(&["topic", "find", "Twist"]).status.code(), Some(2));
    assert_eq!(run(&["topic", "echoo"]).status.code(), Some(2));
    assert_eq!(run(&["interface", "show", "std_msgs/Strng"]).status.code(), Some(1));
}
