//! SLAM on logs of real robots, against relations that are known.

use crate::step::{Failed, cargo, root, run};

/// Runs over all logs of `../shared/datasets`, as they are and perturbed, and prints errors, times and
/// memory in one table, by both methods; then over worlds whose truth is known.
pub(crate) fn bench() -> Result<(), Failed> {
    let example = |name: &str| {
        let mut command = cargo();
        command.args(["run", "--quiet", "--release", "--package", "periplus-slam"]);
        command.args(["--example", name, "--"]);
        command
    };
    match root().join("../shared/datasets").canonicalize() {
        Ok(logs) => {
            let why = "a log of the folder cannot be read";
            run(example("logs").arg(&logs), why)?;
            // Thirty maps each: as they are only.
            let gmapping = ["--method", "gmapping", "--runs", "plain"];
            run(example("logs").arg(&logs).args(gmapping), why)?;
        }
        Err(_) => println!("SKIPPED: there is no ../shared/datasets to make maps of"),
    }
    run(&mut example("worlds"), "a world with known truth failed")
}

/// Drives through our worlds by the real simulator, ten seeds each, and holds maps and trajectories of
/// `periplus slam` against the truth.
pub(crate) fn worlds() -> Result<(), Failed> {
    let mut command = cargo();
    command.args(["build", "--release", "--package", "periplus-cli", "--package"]);
    run(command.args(["periplus-benches", "--bins"]), "the programs cannot be built")?;
    let target = root().join("target");
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or(target, Into::into);
    let mut race = std::process::Command::new(target.join("release/slam_worlds"));
    race.current_dir(root()).arg(target.join("release/periplus")).arg(target.join("slam-worlds"));
    run(&mut race, "a drive or a map failed")
}
