//! Localization: worlds with known truth, speed beside MRPT, and logs of real robots whose first half
//! makes the map for their second.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::step::{Failed, cargo, root, run};

/// Logs whose second half goes where the first was.
const LOGS: [&str; 2] = ["csail-full", "seattle"];

/// The head of the table of logs: agreement with SLAM where the robot was sure, as it is, after one
/// motion and after that of the poses nearby.
const HEAD: &str = "| log | scans on the map | sure of | as it is: most m | one motion: RMS, most m \
| nearby: RMS, most m | most degrees | more than 0.1 m nearby | sure off the map: scans, most m |\n\
|---|---|---|---|---|---|---|---|---|";

/// Prints all tables; maps, figures of every scan and pictures of the logs go to `target/localization`.
pub(crate) fn bench() -> Result<(), Failed> {
    for name in ["worlds", "speed"] {
        run(&mut example(name), "a world with known truth failed")?;
    }
    let mut command = cargo();
    command.args(["build", "--quiet", "--release", "--package", "periplus-cli"]);
    run(&mut command, "the command cannot be built")?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let target = target.unwrap_or_else(|| root().join("target"));
    let (periplus, out) = (target.join("release/periplus"), target.join("localization"));
    println!();
    let mut peer = Command::new("python3");
    peer.arg(root().join("benches/oracles/localization_mrpt.py"));
    run(peer.arg(&periplus).arg(out.join("mrpt")), "see above")?;
    let Ok(logs) = root().join("../shared/datasets").canonicalize() else {
        println!("SKIPPED: there is no ../shared/datasets to localize in");
        return Ok(());
    };
    for name in LOGS {
        halves(&periplus, &logs.join(name).join("raw.clf"), &out.join(name))?;
    }
    println!("\n{HEAD}");
    for name in LOGS {
        run(example("halves").arg("--").arg(out.join(name)), "see above")?;
    }
    println!(
        "\nIn {}, of each log: `map.png` (trajectory of SLAM blue; of localization green where it was certain, orange \
         where not, red where it was sure and wrong), `errors.png`, `scans.csv`",
        out.display()
    );
    Ok(())
}

fn example(name: &str) -> Command {
    let mut command = cargo();
    command.args(["run", "--quiet", "--release", "--package", "periplus-localization"]);
    command.args(["--example", name]);
    command
}

/// Runs SLAM on the whole log and on its first half, and localization on the second.
fn halves(periplus: &Path, log: &Path, out: &Path) -> Result<(), Failed> {
    let failed = |what: &Path| {
        let what = what.display().to_string();
        move |error: std::io::Error| Failed(format!("{what}: {error}"))
    };
    std::fs::create_dir_all(out).map_err(failed(out))?;
    let text = std::fs::read_to_string(log).map_err(failed(log))?;
    let scans = text.lines().filter(|line| line.starts_with("FLASER")).count();
    let mut seen = 0;
    let (mut first, mut second) = (String::new(), String::new());
    for line in text.lines() {
        seen += usize::from(line.starts_with("FLASER"));
        let half = if 2 * seen <= scans { &mut first } else { &mut second };
        let _ = writeln!(half, "{line}");
    }
    for (half, text) in [("first.clf", &first), ("second.clf", &second)] {
        std::fs::write(out.join(half), text).map_err(failed(out))?;
    }
    let slam = |log: &Path, name: &str| {
        let mut slam = Command::new(periplus);
        run(slam.arg("slam").arg(log).arg("--quiet").arg("--out").arg(out.join(name)), "see above")
    };
    slam(log, "whole")?;
    slam(&out.join("first.clf"), "map")?;
    let mut localize = Command::new(periplus);
    localize.arg("localize").arg(out.join("second.clf")).arg("--map").arg(out.join("map/map.yaml"));
    // Every scan counts, as it does in SLAM.
    localize.args(["-p", "update_min_d:=0.1", "-p", "update_min_a:=0.1", "--quiet"]);
    run(localize.arg("--out").arg(out.join("localized")), "see above")
}
