//! Our TCPROS beside that of roscpp.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use crate::results;
use crate::step::{Failed, cargo, root, run};

/// Duration of each load \[s\].
const DURATION_S: &str = "10";

/// Port of the master.
const PORT: &str = "11399";

/// A process that ends with this value.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Figures printed by a peer.
struct Figures {
    messages: f64,
    cpu_s: f64,
}

/// Sends clouds of 9.8 MB at 30 Hz and small messages at 1 kHz between roscpp and us in each combination, and writes
/// messages, losses and CPU time into `benches/RESULTS.md`.
pub(crate) fn bench() -> Result<(), Failed> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let target = target.unwrap_or_else(|| root().join("target"));
    let folder = target.join("oracles");
    std::fs::create_dir_all(&folder)
        .map_err(|error| Failed(format!("cannot make {}: {error}", folder.display())))?;
    let theirs = folder.join("ros1_peer");
    let mut compile = Command::new("g++");
    compile.args(["-std=c++17", "-O2", "-o"]).arg(&theirs);
    compile.arg(root().join("benches/oracles/ros1_peer.cc"));
    for library in
        ["roscpp", "rosconsole", "roscpp_serialization", "rostime", "boost_system", "pthread"]
    {
        compile.arg(format!("-l{library}"));
    }
    run(&mut compile, "MISSING PEER roscpp: install g++, libroscpp-dev and libsensor-msgs-dev")?;
    let mut build = cargo();
    build.args(["build", "--quiet", "--release", "--package", "periplus-cli"]);
    run(&mut build, "the program cannot be built")?;
    let mut build = cargo();
    build.args([
        "build",
        "--quiet",
        "--release",
        "--package",
        "periplus-ros1",
        "--example",
        "ros1_peer",
    ]);
    run(&mut build, "the peer cannot be built")?;
    let ours = target.join("release/examples/ros1_peer");
    let mut master = command(&target.join("release/periplus"));
    let master = master.args(["roscore", "-p", PORT]).stderr(Stdio::null()).spawn();
    let _master = Running(master.map_err(|error| Failed(format!("no master: {error}")))?);
    std::thread::sleep(Duration::from_secs(1));
    let mut table = String::from(
        "| load | from | to | received of sent | CPU of both [ms per message] | beside roscpp to roscpp |\n\
         |---|---|---|---|---|---|\n",
    );
    for (load, title) in [("small", "64 B at 1 kHz"), ("cloud", "9.8 MB at 30 Hz")] {
        let mut reference = None;
        for (from, to) in [(&theirs, &theirs), (&ours, &theirs), (&theirs, &ours), (&ours, &ours)] {
            let (sent, received) = race(load, from, to)?;
            let each_ms = 1e3 * (sent.cpu_s + received.cpu_s) / sent.messages;
            let beside = each_ms / *reference.get_or_insert(each_ms);
            let name = |peer: &Path| if peer == ours { "Periplus" } else { "roscpp" };
            table.push_str(&format!(
                "| {title} | {} | {} | {} of {} | {each_ms:.3} | {beside:.2} |\n",
                name(from),
                name(to),
                received.messages,
                sent.messages
            ));
        }
    }
    print!("{table}");
    results::write("ros1", "ros1", &table)
}

fn command(program: &Path) -> Command {
    let mut command = Command::new(program);
    command.env("ROS_MASTER_URI", format!("http://127.0.0.1:{PORT}")).env("ROS_IP", "127.0.0.1");
    command.stdin(Stdio::null());
    command
}

fn race(load: &str, from: &Path, to: &Path) -> Result<(Figures, Figures), Failed> {
    let start = |peer: &Path, way: &str| {
        let started = command(peer).args([way, load, DURATION_S]).stdout(Stdio::piped()).spawn();
        started.map_err(|error| Failed(format!("{}: {error}", peer.display())))
    };
    let receiver = start(to, "sub")?;
    std::thread::sleep(Duration::from_secs(1));
    let sender = start(from, "pub")?;
    Ok((figures(sender)?, figures(receiver)?))
}

fn figures(child: Child) -> Result<Figures, Failed> {
    let output = child.wait_with_output().map_err(|error| Failed(error.to_string()))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let json: serde_json::Value = serde_json::from_str(text.trim())
        .map_err(|error| Failed(format!("a peer printed `{text}`: {error}")))?;
    let number = |name: &str| json[name].as_f64().unwrap_or_default();
    Ok(Figures { messages: number("messages"), cpu_s: number("cpu_s") })
}
