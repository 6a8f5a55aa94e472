//! Debian's `ignition-transport` 11: its command line, and a test program compiled against it.
#![allow(dead_code, unreachable_pub, reason = "each test takes what it needs")]

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::OnceLock;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

pub const LONG: Duration = Duration::from_secs(40);

/// Folder of the programs behind `ign topic` and `ign service`.
const PROGRAMS: &str = "/usr/libexec/ignition/transport11";

/// Installation command.
const HOW: &str = "apt-get install g++ pkg-config ignition-transport-cli libignition-transport-dev";

fn here() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../transports/gz-transport")
}

/// A program in a separate partition.
pub struct Gazebo {
    partition: String,
}

impl Gazebo {
    /// None, with a message, if it is not installed.
    pub fn new(partition: &str) -> Option<Self> {
        let is_there = Path::new(PROGRAMS).join("ign-transport-topic").exists();
        if !is_there || peer().is_none() {
            eprintln!("SKIPPED: no Gazebo Transport to test against; {HOW}");
            return None;
        }
        Some(Self { partition: format!("{partition}-{}", std::process::id()) })
    }

    pub fn partition(&self) -> &str {
        &self.partition
    }

    fn start(&self, mut command: Command) -> Child {
        command
            .env("IGN_PARTITION", &self.partition)
            .env("IGN_IP", "127.0.0.1")
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it starts")
    }

    /// Runs `ign topic` or `ign service` to its end.
    pub fn tool(&self, which: &str, words: &[&str]) -> String {
        // A timeout ends a command that receives no message.
        let mut command = Command::new("timeout");
        let program = Path::new(PROGRAMS).join(format!("ign-transport-{which}"));
        command.arg("30").arg(program).args(words);
        let Output { stdout, stderr, .. } =
            self.start(command).wait_with_output().expect("it ends");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        text(&stdout) + &text(&stderr)
    }

    /// Repeats it until the output is as expected: discovery takes a moment.
    #[track_caller]
    pub fn tool_until(&self, which: &str, words: &[&str], wanted: &str) -> String {
        let mut said = String::new();
        for _ in 0..12 {
            said = self.tool(which, words);
            if said.contains(wanted) {
                return said;
            }
        }
        panic!("`ign {which} {words:?}` does not print `{wanted}`, but:\n{said}");
    }

    /// Starts `ign topic` or `ign service`.
    pub fn running_tool(&self, which: &str, words: &[&str]) -> Running {
        let mut command = Command::new("stdbuf");
        let program = Path::new(PROGRAMS).join(format!("ign-transport-{which}"));
        command.arg("-oL").arg(program).args(words);
        Running::of(self.start(command), format!("{words:?}"))
    }

    /// Starts the test program.
    pub fn peer(&self, words: &[&str]) -> Running {
        let mut command = Command::new(peer().expect("it was looked for"));
        command.args(words);
        Running::of(self.start(command), format!("{words:?}"))
    }
}

/// A running program; it is ended when this is dropped.
pub struct Running {
    child: Child,
    lines: Receiver<String>,
    what: String,
}

impl Running {
    pub fn of(mut child: Child, what: String) -> Self {
        let (send, lines) = channel();
        let output = BufReader::new(child.stdout.take().expect("it was asked for"));
        std::thread::spawn(move || {
            output.lines().map_while(Result::ok).try_for_each(|line| send.send(line))
        });
        Self { child, lines, what }
    }

    #[track_caller]
    pub fn line(&self) -> String {
        let line = self.lines.recv_timeout(LONG);
        line.unwrap_or_else(|_| panic!("{} has no more output", self.what))
    }

    /// Waits for the next line with this prefix.
    #[track_caller]
    pub fn line_with(&self, front: &str) -> String {
        loop {
            let line = self.line();
            if line.trim_start().starts_with(front) {
                return line;
            }
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn peer() -> Option<&'static PathBuf> {
    static PEER: OnceLock<Option<PathBuf>> = OnceLock::new();
    PEER.get_or_init(compiled).as_ref()
}

fn compiled() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let source = here().join("tests/peers/gazebo.cpp");
    let program = folder.join("gazebo-peer");
    let age = |path: &Path| path.metadata().and_then(|data| data.modified()).ok();
    if age(&program) >= age(&source) {
        return Some(program);
    }
    let flags = Command::new("pkg-config")
        .args(["--cflags", "--libs", "ignition-transport11"])
        .stderr(Stdio::null())
        .output()
        .ok()
        .filter(|output| output.status.success())?;
    let flags = String::from_utf8(flags.stdout).ok()?;
    // Under a unique name: other tests may compile it at the same time.
    let made = folder.join(format!("gazebo-peer-{}", std::process::id()));
    let compiler = Command::new("g++")
        .args(["-std=c++17", "-O0", "-o"])
        .arg(&made)
        .arg(&source)
        .args(flags.split_whitespace())
        .status();
    let is_made = compiler.is_ok_and(|status| status.success());
    (is_made && std::fs::rename(&made, &program).is_ok()).then_some(program)
}

/// Waits until a condition holds.
#[track_caller]
pub fn until(what: &str, mut is_so: impl FnMut() -> bool) {
    let start = std::time::Instant::now();
    while !is_so() {
        assert!(start.elapsed() < LONG, "{what}: not in {LONG:?}");
        std::thread::sleep(Duration::from_millis(20));
    }
}
