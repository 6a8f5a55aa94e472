//! The same run, built twice, on different numbers of threads, and on the platforms whose programs are built: the bags
//! must be the same, byte for byte.

use std::fs;
use std::process::Command;

use crate::platforms;
use crate::step::{Failed, build_program, cargo, equal_start, root, run};

/// A robot with lidar, camera and IMU in a room; short, for debug builds are slow.
const RUN: [&str; 11] = [
    "sim",
    "worlds/closed_room.world",
    "--robot",
    "robots/sam_bot/urdf/sam_bot.urdf.xacro",
    "--cmd",
    "worlds/drives/circle.yaml",
    "--duration",
    "0.6",
    "--seed",
    "7",
    "--quiet",
];

/// Program with the checks of debug builds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum DebugProgram {
    /// Built for this.
    Own,
    /// The one that the tests of the workspace use, which must be compiled: another one takes minutes.
    OfTests,
}

const THREADS: [&str; 3] = ["1", "2", "8"];

/// Recording, as the program gets it: the same name for all runs, since the bag contains it.
const RECORDING: &str = "target/determinism/run.mcap";

/// Runs it every way and compares.
pub(crate) fn check(debug: DebugProgram) -> Result<(), Failed> {
    let folder = root().join("target/determinism");
    fs::create_dir_all(&folder).map_err(|error| Failed(format!("target/determinism: {error}")))?;
    let mut first = None;
    if debug == DebugProgram::Own {
        run(cargo().args(["build", "--quiet", "-p", "periplus-cli"]), "see the errors above")?;
    }
    build_program()?;
    for kind in ["debug", "release"] {
        let program = root().join("target").join(kind).join("periplus");
        for threads in THREADS {
            let name = format!("{kind}-{threads}-threads");
            compare(&mut first, name, &mut Command::new(&program), threads)?;
        }
    }
    for (target, runner) in platforms::built() {
        let name = format!("{} by {}", target.triple, runner.name());
        compare(&mut first, name, &mut runner.command(), "2")?;
    }
    Ok(())
}

/// Compares the bag of a command with the first one.
fn compare(
    first: &mut Option<(String, Vec<u8>)>,
    name: String,
    command: &mut Command,
    threads: &str,
) -> Result<(), Failed> {
    let bag = bag_of(command, threads)?;
    match first {
        None => {
            println!("{name}: {} bytes", bag.len());
            *first = Some((name, bag));
        }
        Some((of, same)) if *same == bag => println!("{name}: the same as {of}"),
        Some((of, other)) => {
            let place = equal_start(&bag, other);
            return Err(Failed(format!("{name} differs from {of} at byte {place}")));
        }
    }
    Ok(())
}

fn bag_of(command: &mut Command, threads: &str) -> Result<Vec<u8>, Failed> {
    let path = root().join(RECORDING);
    // So that a run that writes nothing is not taken for the one before.
    if path.exists() {
        fs::remove_file(&path).map_err(|error| Failed(format!("{RECORDING}: {error}")))?;
    }
    command.args(RUN).args(["--threads", threads, "--record", RECORDING]).current_dir(root());
    run(command, "the run itself failed")?;
    fs::read(&path).map_err(|error| Failed(format!("{RECORDING}: {error}")))
}
