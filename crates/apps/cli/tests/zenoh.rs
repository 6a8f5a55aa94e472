//! `periplus sim --ros2 zenoh`: PyPI's `eclipse-zenoh` discovers and reads a run like a program of
//! `rmw_zenoh`.
#![cfg(feature = "zenoh")]
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "tests with other programs wait and look for them")]

use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..")
}

/// A robot between walls, on Zenoh.
fn run(more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.arg("sim").arg(root().join("worlds/closed_room.world"));
    command.arg("--robot").arg(root().join("robots/sam_bot/urdf/sam_bot.urdf.xacro"));
    command.args(["--ros2", "zenoh"]).args(more);
    for name in ["ROS_DOMAIN_ID", "ZENOH_SESSION_CONFIG_URI", "ZENOH_CONFIG_OVERRIDE"] {
        command.env_remove(name);
    }
    command
}

#[test]
fn a_run_is_seen_and_heard() {
    const PORT: &str = "17510";
    let python = root().join(".venv/bin/python");
    let mut asked = Command::new(&python);
    let asked = asked.args(["-c", "import zenoh, xxhash"]).stderr(Stdio::null()).status();
    if !asked.is_ok_and(|status| status.success()) {
        eprintln!("SKIPPED: no Zenoh to test against; `cargo xtask zenoh` installs it");
        return;
    }
    let peer = |words: &[&str]| {
        let mut command = Command::new(&python);
        command.arg(root().join("crates/transports/rmw-zenoh/tests/peers/zenoh_peer.py")).arg(PORT);
        command.args(words).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap()).lines();
        (Killed(child), lines)
    };
    let (_router, mut said) = peer(&["router"]);
    assert_eq!(said.next().unwrap().unwrap(), "ready");
    let mut running = run(&["--rtf", "1", "--duration", "60"]);
    running.env("ZENOH_CONFIG_OVERRIDE", format!("connect/endpoints=[\"tcp/127.0.0.1:{PORT}\"]"));
    let _running = Killed(running.stdout(Stdio::null()).spawn().unwrap());
    let (_peer, said) = peer(&["hear", "/clock", "3"]);
    let lines: Vec<String> = said.map(Result::unwrap).collect();
    // Four bytes of encapsulation, seconds and nanoseconds.
    let expected = "rosgraph_msgs::msg::dds_::Clock_ of 12 bytes, its name";
    assert_eq!(lines, [expected; 3]);
}

/// Killed when it is dropped.
struct Killed(Child);

impl Drop for Killed {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}
