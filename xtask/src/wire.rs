//! Our wire beside those of others.

use std::path::PathBuf;
use std::process::{Command, Stdio};

use crate::results;
use crate::step::{Failed, cargo, root};

/// The Python that has the peers; `python3` when it is not set.
const PYTHON: &str = "PERIPLUS_PYTHON";

/// Sends clouds, scans and small messages between us, Fast DDS and Cyclone DDS, and writes the tables
/// into `benches/RESULTS.md`; all figures are in `wire.json` beside the peers. `only` picks loads.
pub(crate) fn bench(only: Option<&str>) -> Result<(), Failed> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let folder = target.unwrap_or_else(|| root().join("target")).join("oracles");
    std::fs::create_dir_all(&folder)
        .map_err(|error| Failed(format!("cannot make {}: {error}", folder.display())))?;
    let oracles = root().join("benches/oracles");
    let fast = folder.join("wire_fast");
    let built = Command::new("g++")
        .args(["-std=c++14", "-O2", "-o"])
        .arg(&fast)
        .arg(oracles.join("wire_fast.cc"))
        .args(["-lfastrtps", "-lfastcdr", "-lpthread"])
        .status();
    if !built.is_ok_and(|status| status.success()) {
        println!("MISSING PEER Fast DDS: install g++, libfastrtps-dev and libfastcdr-dev");
    }
    let python = std::env::var_os(PYTHON).unwrap_or_else(|| "python3".into());
    let mut race = cargo();
    race.args(["run", "--quiet", "--release", "--package", "periplus-dds", "--example"]);
    race.args(["race", "--"]).arg(fast).arg(python).arg(oracles.join("wire_cyclone.py"));
    race.arg(&folder).args(only);
    let output = race
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| Failed(format!("cannot run the race: {error}")))?;
    let tables = String::from_utf8_lossy(&output.stdout);
    print!("{tables}");
    if !output.status.success() {
        return Err(Failed("the race failed, see above".to_owned()));
    }
    // A part of it is not a result.
    if only.is_none() { results::write("wire", "wire", &tables) } else { Ok(()) }
}
