//! Proof of sweeps: a local pool against a Ray cluster that loses a node.

use std::process::Command;

use crate::python;
use crate::step::{Failed, root, run};

/// Packages that the proof needs besides that of Periplus.
const PACKAGES: [&str; 7] =
    ["ray", "optuna", "pyarrow", "polars", "pandas", "pytest", "hypothesis"];

/// Runs the proof, or one part of it.
pub(crate) fn prove(only: Option<&str>) -> Result<(), Failed> {
    let python = python::with_packages("sweeps", &PACKAGES)?;
    let mut command = Command::new(&python);
    command.arg(root().join("python/tools/prove_sweeps.py")).current_dir(root());
    if let Some(only) = only {
        command.args(["--only", only]);
    }
    run(&mut command, "the folder target/sweeps has the results")?;
    if only.is_some() {
        return Ok(());
    }
    // The tests of Ray and Optuna, which are skipped where these are missing.
    let mut tests = Command::new(&python);
    tests.args(["-m", "pytest", "-q", "-rs"]).arg(root().join("python/tests/test_sweeps.py"));
    run(tests.current_dir(root()).env_remove("PYTHONPATH"), "see the errors above")
}
