//! SLAM on logs of real robots, against relations that are known.

use crate::step::{Failed, cargo, root, run};

/// Runs over all logs of `../shared/datasets`, as they are and perturbed, and prints errors, times and
/// memory in one table; then over worlds whose truth is known.
pub(crate) fn bench() -> Result<(), Failed> {
    let example = |name: &str| {
        let mut command = cargo();
        command.args(["run", "--quiet", "--release", "--package", "periplus-slam"]);
        command.args(["--example", name, "--"]);
        command
    };
    match root().join("../shared/datasets").canonicalize() {
        Ok(logs) => run(example("logs").arg(logs), "a log of the folder cannot be read")?,
        Err(_) => println!("SKIPPED: there is no ../shared/datasets to make maps of"),
    }
    run(&mut example("worlds"), "a world with known truth failed")
}
