//! The wire on Zenoh, which is built only with its feature.

use std::process::Command;

use crate::step::{Failed, cargo, root, run, timed};

/// Python packages of the peer: Zenoh, and the hash of its endpoint names.
const PEER: [&str; 2] = ["eclipse-zenoh==1.10.2", "xxhash"];

/// Checks and tests everything that is only there with the feature.
pub(crate) fn check() -> Result<(), Failed> {
    timed("peer", install)?;
    timed("clippy", || {
        let packages = ["-p", "periplus-rmw-zenoh", "-p", "periplus-session", "-p", "periplus-cli"];
        let mut command = cargo();
        command.arg("clippy").args(packages).args(["--features", "zenoh", "--all-targets"]);
        run(command.args(["--", "-D", "warnings"]), "see the findings above")
    })?;
    timed("test", || {
        let arguments = ["test", "-p", "periplus-rmw-zenoh", "--features", "zenoh"];
        run(cargo().args(arguments), "see the failures above")
    })?;
    timed("test of the command", || {
        let arguments = ["test", "-p", "periplus-cli", "--features", "zenoh", "--test", "zenoh"];
        run(cargo().args(arguments), "see the failures above")
    })
}

/// Puts the peer into the environment of Python that other peers use.
fn install() -> Result<(), Failed> {
    let python = root().join(".venv/bin/python");
    if !python.exists() {
        let mut making = Command::new("python3");
        making.args(["-m", "venv", ".venv"]).current_dir(root());
        run(&mut making, "install Python with its module `venv`")?;
    }
    let mut installing = Command::new(python);
    installing.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
    run(installing.args(PEER), "see whether PyPI can be reached")
}
