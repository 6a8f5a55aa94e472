//! Our dynamics beside MuJoCo and ODE.

use std::path::PathBuf;
use std::process::Command;

use crate::step::{Failed, cargo, root, run};

/// The Python that has the peers; `python3` when it is not set.
const PYTHON: &str = "PERIPLUS_PYTHON";

/// Drives the same robot in all engines. Peers that are not installed are named and left out.
pub(crate) fn bench() -> Result<(), Failed> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let folder = target.unwrap_or_else(|| root().join("target")).join("oracles");
    std::fs::create_dir_all(&folder)
        .map_err(|error| Failed(format!("cannot make {}: {error}", folder.display())))?;
    let oracles = root().join("benches/oracles");
    let ode = folder.join("physics_ode");
    let built = Command::new("g++")
        .args(["-std=c++17", "-O2", "-Wall", "-Wextra", "-o"])
        .arg(&ode)
        .arg(oracles.join("physics_ode.cc"))
        .args(["-lode", "-lpthread", "-lm"])
        .status();
    if !built.is_ok_and(|status| status.success()) {
        println!("MISSING PEER ODE: install g++ and libode-dev");
    }
    let python = std::env::var_os(PYTHON).unwrap_or_else(|| "python3".into());
    let mut race = cargo();
    race.args(["run", "--quiet", "--release", "--package", "periplus-benches", "--", "physics"]);
    race.arg(oracles).arg(ode).arg(python).arg(folder.join("physics.json"));
    run(&mut race, "see what it says above; `pip install mujoco` and PERIPLUS_PYTHON for MuJoCo")
}
