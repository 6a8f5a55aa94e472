//! A robot that drives for ten simulated hours: memory that stays flat, and numbers that stay finite.

use std::path::PathBuf;
use std::process::Command;

use crate::step::{Failed, cargo, root, run};

/// Runs the soak of `benches/src/bin/soak`, for ten simulated hours unless others are asked for.
pub(crate) fn kbot(hours: Option<f64>) -> Result<(), Failed> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let target = target.unwrap_or_else(|| root().join("target"));
    let mut build = cargo();
    build.args(["build", "--quiet", "--release", "--package", "periplus-cli", "--package"]);
    run(build.args(["periplus-benches", "--bins"]), "the programs cannot be built")?;
    let mut soak = Command::new(target.join("release/soak"));
    soak.arg(target.join("release/periplus")).arg(root()).arg(target.join("soak"));
    run(soak.args(hours.map(|hours| hours.to_string())), "see above")
}
