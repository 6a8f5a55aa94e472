//! Unit tests of libraries, compiled for a target and run as its programs are.

use std::path::PathBuf;

use serde_json::Value;

use super::Runner;
use crate::dist::{Profile, Target, build_command};
use crate::step::{Failed, root};

/// Libraries whose tests compute, read and write, without a network and other programs.
const LIBRARIES: [&str; 6] = [
    "periplus-geometry",
    "periplus-os",
    "periplus-msgs",
    "periplus-yaml",
    "periplus-tf",
    "periplus-grid",
];

/// Compiles and runs the tests.
pub(super) fn run(target: &Target, profile: Profile, runner: &Runner) -> Result<(), Failed> {
    let mut command = build_command(&root(), target, profile)?;
    command.args(["--tests", "--lib", "--message-format", "json"]);
    command.args(LIBRARIES.iter().flat_map(|name| ["--package", name]));
    let output = command.output().map_err(|error| Failed(format!("cargo zigbuild: {error}")))?;
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(Failed(format!("the tests do not compile for {}: {why}", target.triple)));
    }
    let programs = programs(&String::from_utf8_lossy(&output.stdout));
    if programs.len() < LIBRARIES.len() {
        return Err(Failed(format!("{} test programs were built", programs.len())));
    }
    for (folder, program) in programs {
        let mut command = runner.with_program(program).command();
        command.arg("--quiet").current_dir(folder);
        run_one(&mut command, target)?;
    }
    Ok(())
}

fn run_one(command: &mut std::process::Command, target: &Target) -> Result<(), Failed> {
    crate::step::run(command, &format!("a test fails on {}", target.triple))
}

/// Test programs in the messages of cargo, with the folders of their packages.
fn programs(messages: &str) -> Vec<(PathBuf, PathBuf)> {
    let messages = messages.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let tests = messages.filter(|it| it["profile"]["test"] == true);
    let found = tests.filter_map(|it| {
        let manifest = PathBuf::from(it["manifest_path"].as_str()?);
        Some((manifest.parent()?.to_path_buf(), PathBuf::from(it["executable"].as_str()?)))
    });
    found.collect()
}

#[test]
fn test_programs_are_found_in_the_messages_of_cargo() {
    let messages = "{\"manifest_path\":\"/p/Cargo.toml\",\"profile\":{\"test\":true},\"executable\":\"/t/p-1\"}\n\
        {\"manifest_path\":\"/q/Cargo.toml\",\"profile\":{\"test\":false},\"executable\":null}\nnot JSON\n";
    assert_eq!(programs(messages), [(PathBuf::from("/p"), PathBuf::from("/t/p-1"))]);
}
