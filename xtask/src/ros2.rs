//! Our programs beside a real ROS 2, from PyPI: rclpy on rmw_fastrtps_cpp, and Cyclone DDS.

use std::path::PathBuf;
use std::process::Stdio;

use crate::results;
use crate::step::{Failed, cargo, root, run};

/// The Python with Cyclone DDS; that of `.venv`, or `python3`, when it is not set.
const PYTHON: &str = "PERIPLUS_PYTHON";

/// Measurements against rclpy, in the order of the tables.
const PARTS: [&str; 3] = ["rates", "lists", "idle"];

/// Rates and losses of sensor messages at rclpy, complete lists of rclpy nodes, and CPU before and after
/// service calls. `only` picks parts whose names contain it.
pub(crate) fn bench(only: Option<&str>, is_quick: bool) -> Result<(), Failed> {
    let mut parts = PARTS.iter().filter(|part| part.contains(only.unwrap_or_default())).peekable();
    if parts.peek().is_none() {
        return Err(Failed(format!("`bench ros2` has the parts {}", PARTS.join(", "))));
    }
    build()?;
    parts.try_for_each(|part| measure(part, "ros2", is_quick))
}

/// The real-time factor of a simulation beside subscribers that are stopped, and that read.
pub(crate) fn subscribers(is_quick: bool) -> Result<(), Failed> {
    build()?;
    measure("subscribers", "subscribers", is_quick)
}

fn build() -> Result<(), Failed> {
    let mut build = cargo();
    build.args(["build", "--quiet", "--release", "--package", "periplus-cli", "--package"]);
    run(build.args(["periplus-benches", "--bins"]), "the programs cannot be built")
}

/// Runs a part, and writes its table into `benches/RESULTS.md` unless it was a quick one.
fn measure(part: &str, command: &str, is_quick: bool) -> Result<(), Failed> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let target = target.unwrap_or_else(|| root().join("target"));
    let folder = target.join("oracles/ros2");
    std::fs::create_dir_all(&folder)
        .map_err(|error| Failed(format!("cannot make {}: {error}", folder.display())))?;
    let own = root().join(".venv/bin/python");
    let cyclone = std::env::var_os(PYTHON).map(PathBuf::from);
    let cyclone = cyclone.unwrap_or(if own.exists() { own } else { "python3".into() });
    let mut race = std::process::Command::new(target.join("release/ros2"));
    race.arg(part).arg(root()).arg(target.join("release/periplus"));
    race.arg(root().join("target/peers/ros2/bin/python")).arg(cyclone).arg(folder);
    race.args(is_quick.then_some("--quick"));
    let output = race
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| Failed(format!("cannot run the race: {error}")))?;
    let table = String::from_utf8_lossy(&output.stdout);
    println!("{table}");
    if !is_quick && !table.is_empty() {
        results::write(&format!("ros2 {part}"), command, &table)?;
    }
    if output.status.success() { Ok(()) } else { Err(Failed("see above".to_owned())) }
}
