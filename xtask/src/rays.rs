//! Our rays against those of others.

use crate::step::{Failed, cargo, root, run};

/// Races the ray casters of the shared bench, as far as they are installed, and writes the tables
/// into `benches/RESULTS.md`.
pub(crate) fn bench() -> Result<(), Failed> {
    let Ok(engines) = root().join("../shared/bench/engines").canonicalize() else {
        println!("SKIPPED: there is no ../shared/bench/engines, which makes scenes and runs peers");
        return Ok(());
    };
    let target = std::env::var_os("CARGO_TARGET_DIR").map(std::path::PathBuf::from);
    let folder = target.unwrap_or_else(|| root().join("target")).join("rays");
    std::fs::create_dir_all(&folder)
        .map_err(|error| Failed(format!("cannot write to {}: {error}", folder.display())))?;
    let mut race = cargo();
    race.args(["run", "--quiet", "--release", "--package", "periplus-benches", "--", "rays"]);
    race.arg(engines).arg(folder).arg(root().join("benches/RESULTS.md"));
    run(&mut race, "see above")
}
