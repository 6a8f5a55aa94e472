//! The same run, built twice and on different numbers of threads: the bags must be the same, byte
//! for byte.

use std::fs;
use std::path::Path;

use crate::step::{Failed, cargo, run};

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

/// Debug first: it is what tests have built.
const BUILDS: [&[&str]; 2] = [&[], &["--release"]];

const THREADS: [&str; 3] = ["1", "2", "8"];

/// Runs it every way and compares.
pub(crate) fn check() -> Result<(), Failed> {
    let folder = crate::step::root().join("target/determinism");
    fs::create_dir_all(&folder).map_err(|error| Failed(format!("target/determinism: {error}")))?;
    let mut first: Option<(String, Vec<u8>)> = None;
    for build in BUILDS {
        for threads in THREADS {
            let name =
                format!("{}-{threads}-threads", if build.is_empty() { "debug" } else { "release" });
            let bag = bag_of(&folder, build, threads)?;
            match &first {
                None => {
                    println!("{name}: {} bytes", bag.len());
                    first = Some((name, bag));
                }
                Some((of, same)) if *same == bag => println!("{name}: the same as {of}"),
                Some((of, other)) => {
                    let place = bag.iter().zip(other).take_while(|(a, b)| a == b).count();
                    return Err(Failed(format!("{name} differs from {of} at byte {place}")));
                }
            }
        }
    }
    Ok(())
}

fn bag_of(folder: &Path, build: &[&str], threads: &str) -> Result<Vec<u8>, Failed> {
    // The same name for all runs, since the bag contains it.
    let path = folder.join("run.mcap");
    let mut command = cargo();
    command.arg("run").arg("--quiet").args(build).arg("--").args(RUN);
    command.args(["--threads", threads, "--record"]).arg(&path);
    run(&mut command, "the run itself failed")?;
    fs::read(&path).map_err(|error| Failed(format!("{}: {error}", path.display())))
}
