//! Our dynamics beside MuJoCo and ODE.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::step::{Failed, cargo, root, run};

/// The Python that has the peers; `python3` when it is not set.
const PYTHON: &str = "PERIPLUS_PYTHON";

/// Folder for the peers' programs.
fn folder() -> Result<PathBuf, Failed> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let folder = target.unwrap_or_else(|| root().join("target")).join("oracles");
    std::fs::create_dir_all(&folder)
        .map_err(|error| Failed(format!("cannot make {}: {error}", folder.display())))?;
    Ok(folder)
}

/// Builds a program that links ODE; prints a message if that fails.
fn build_ode(source: &Path, program: &Path) {
    let built = Command::new("g++")
        .args(["-std=c++17", "-O2", "-Wall", "-Wextra", "-o"])
        .arg(program)
        .arg(source)
        .args(["-lode", "-lpthread", "-lm"])
        .status();
    if !built.is_ok_and(|status| status.success()) {
        println!("MISSING PEER ODE: install g++ and libode-dev");
    }
}

/// Drives a cart between two casters that are too low in all engines, and writes the table. No time
/// is measured, so the profile of the tests will do.
pub(crate) fn casters() -> Result<(), Failed> {
    let ode = folder()?.join("casters_ode");
    let oracles = root().join("benches/oracles");
    build_ode(&oracles.join("casters_ode.cc"), &ode);
    let python = std::env::var_os(PYTHON).unwrap_or_else(|| "python3".into());
    let mut race = cargo();
    race.args(["run", "--quiet", "--profile", "test", "--package", "periplus-physics"]);
    race.args(["--example", "casters", "--"]);
    race.arg(ode).arg(python).arg(oracles.join("casters_mujoco.py"));
    race.arg(root().join("benches/RESULTS.md"));
    run(&mut race, "see its output above; `pip install mujoco` and PERIPLUS_PYTHON for MuJoCo")
}

/// Drives the same robot in all engines. Peers that are not installed are named and left out.
pub(crate) fn bench() -> Result<(), Failed> {
    let folder = folder()?;
    let ode = folder.join("physics_ode");
    let oracles = root().join("benches/oracles");
    build_ode(&oracles.join("physics_ode.cc"), &ode);
    let python = std::env::var_os(PYTHON).unwrap_or_else(|| "python3".into());
    let mut race = cargo();
    race.args(["run", "--quiet", "--release", "--package", "periplus-benches", "--", "physics"]);
    race.arg(oracles).arg(ode).arg(python).arg(folder.join("physics.json"));
    run(&mut race, "see its output above; `pip install mujoco` and PERIPLUS_PYTHON for MuJoCo")
}
