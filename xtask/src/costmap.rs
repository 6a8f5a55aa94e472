//! Costmaps, beside the wavefront of the reference and OpenCV.

use crate::step::{Failed, cargo, root, run};

/// The variable that names a Python with OpenCV.
const PYTHON: &str = "PERIPLUS_PYTHON";

/// Measures, and writes the table into `benches/RESULTS.md`.
pub(crate) fn bench() -> Result<(), Failed> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(std::path::PathBuf::from);
    let folder = target.unwrap_or_else(|| root().join("target")).join("costmap");
    std::fs::create_dir_all(&folder)
        .map_err(|error| Failed(format!("cannot write to {}: {error}", folder.display())))?;
    let python = std::env::var_os(PYTHON).unwrap_or_else(|| "python3".into());
    let mut race = cargo();
    race.args(["run", "--quiet", "--release", "--package", "periplus-benches", "--", "costmap"]);
    race.arg(python).arg(root().join("benches/src/costmap/opencv.py")).arg(folder);
    race.arg(root().join("benches/RESULTS.md"));
    run(&mut race, "see above; `pip install opencv-python-headless` and PERIPLUS_PYTHON for OpenCV")
}

/// Runs costmaps for an hour of simulated time.
pub(crate) fn soak() -> Result<(), Failed> {
    let mut hour = cargo();
    hour.args(["run", "--quiet", "--release", "--package", "periplus-sim"]);
    run(hour.args(["--example", "costmap_soak"]), "memory grew, or a mark stayed; see above")
}
