//! Periplus beside a real ROS 2: `ros2 PART ROOT PERIPLUS ROS_PYTHON CYCLONE_PYTHON FOLDER [--quick]`, with
//! the part `rates`, `lists`, `idle` or `subscribers`; `cargo xtask bench ros2` and `cargo xtask bench
//! subscribers` know the rest. Tables go to the standard output.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program that measures"
)]

mod idle;
mod lists;
mod process;
mod publisher;
mod rates;
mod subscribers;

use std::path::PathBuf;
use std::process::{Command, ExitCode, Stdio};

/// Programs and folders of a measurement.
pub(crate) struct Setup {
    /// Root of the source tree.
    pub(crate) root: PathBuf,
    /// The program `periplus`.
    pub(crate) periplus: PathBuf,
    /// This program.
    pub(crate) own: PathBuf,
    /// A Python with rclpy.
    pub(crate) python: PathBuf,
    /// The peer that measures, for `python`.
    pub(crate) script: PathBuf,
    /// The peer of the command's tests, for `python`.
    pub(crate) peer: PathBuf,
    /// A Python with Cyclone DDS.
    pub(crate) cyclone_python: PathBuf,
    /// The peer for `cyclone_python`.
    pub(crate) cyclone_script: PathBuf,
    /// Folder for temporary files.
    pub(crate) folder: PathBuf,
    /// Few and short measurements.
    pub(crate) is_quick: bool,
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match words.split_first() {
        Some((first, rest)) if first == "pub" => publisher::run(rest),
        Some((first, _)) if first == "busy" => lists::busy(),
        Some((part, [root, periplus, python, cyclone, folder, rest @ ..])) => {
            let quick = rest.iter().any(|word| word == "--quick");
            run(part, [root, periplus, python, cyclone, folder].map(PathBuf::from), quick)
        }
        _ => {
            eprintln!(
                "usage: ros2 PART ROOT PERIPLUS ROS_PYTHON CYCLONE_PYTHON FOLDER [--quick]; `cargo xtask \
                 bench ros2` knows all of it"
            );
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

fn run(part: &str, paths: [PathBuf; 5], is_quick: bool) -> Result<(), String> {
    let [root, periplus, python, cyclone_python, folder] = paths;
    let mut asked = Command::new(&python);
    asked.args(["-c", "import rclpy, sensor_msgs.msg"]).stderr(Stdio::null());
    if !asked.status().is_ok_and(|status| status.success()) {
        return Err(format!(
            "there is no ROS 2 at {}: python3.12 -m venv target/peers/ros2 && target/peers/ros2/bin/pip \
             install -r .ci/ros2.txt",
            python.display()
        ));
    }
    let setup = Setup {
        periplus,
        own: std::env::current_exe().map_err(|error| error.to_string())?,
        python,
        script: root.join("benches/oracles/wire_rclpy.py"),
        peer: root.join("crates/apps/cli/tests/peers/rclpy_peer.py"),
        cyclone_python,
        cyclone_script: root.join("benches/oracles/wire_cyclone.py"),
        folder,
        is_quick,
        root,
    };
    let table = match part {
        "rates" => rates::measure(&setup)?,
        "lists" => lists::measure(&setup)?,
        "idle" => idle::measure(&setup)?,
        "subscribers" => {
            subscribers::has_cyclone(&setup.cyclone_python)?;
            let (table, fault) = subscribers::measure(&setup)?;
            print!("{table}");
            return fault.map_or(Ok(()), Err);
        }
        other => return Err(format!("there is no part `{other}`")),
    };
    print!("{table}");
    Ok(())
}
