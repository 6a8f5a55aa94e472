//! Localization: worlds with known truth, speed, and logs of real robots whose first half makes the
//! map for their second.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::step::{Failed, cargo, root, run};

/// Logs whose second half goes where the first was.
const LOGS: [&str; 2] = ["csail-full", "seattle"];

/// Prints all tables; maps and pictures of the logs go to `target/localization`.
pub(crate) fn bench() -> Result<(), Failed> {
    for example in ["worlds", "speed"] {
        let mut command = cargo();
        command.args(["run", "--quiet", "--release", "--package", "periplus-localization"]);
        run(command.args(["--example", example]), "a world with known truth failed")?;
    }
    let Ok(logs) = root().join("../shared/datasets").canonicalize() else {
        println!("SKIPPED: there is no ../shared/datasets to localize in");
        return Ok(());
    };
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let out = target.unwrap_or_else(|| root().join("target")).join("localization");
    let mut table = String::from(
        "| log | second half | scans | against SLAM: RMS m | 99 % m | most m | most degrees |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for name in LOGS {
        halves(&logs.join(name).join("raw.clf"), &out.join(name), name, &mut table)?;
    }
    println!("\n{table}\nmaps, trajectories and pictures are in {}", out.display());
    Ok(())
}

/// A stamp, x, y and yaw.
type Line = (String, [f64; 3]);

fn halves(log: &Path, out: &Path, name: &str, table: &mut String) -> Result<(), Failed> {
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
    let (whole, map, found) = (out.join("whole"), out.join("map"), out.join("localized"));
    let slam = |log: &Path, out: &Path| {
        run(periplus().arg("slam").arg(log).arg("--out").arg(out), "see above")
    };
    slam(log, &whole)?;
    slam(&out.join("first.clf"), &map)?;
    let mut localize = periplus();
    localize.arg("localize").arg(out.join("second.clf")).arg("--map").arg(map.join("map.yaml"));
    // Every scan counts, as it does in SLAM.
    localize.args(["-p", "update_min_d:=0.1", "-p", "update_min_a:=0.1"]);
    run(localize.arg("--out").arg(&found), "see above")?;
    let read = |folder: &Path| lines(&folder.join("trajectory.txt"));
    let (truth, found) = (read(&whole)?, read(&found)?);
    let mut off: Vec<(f64, f64)> = Vec::new();
    for (stamp, [x, y, yaw]) in &found {
        if let Some((_, it)) = truth.iter().find(|(other, _)| other == stamp) {
            let turn = (yaw - it[2]).sin().atan2((yaw - it[2]).cos()).abs();
            off.push(((x - it[0]).hypot(y - it[1]), turn.to_degrees()));
        }
    }
    let mut metres: Vec<f64> = off.iter().map(|it| it.0).collect();
    metres.sort_by(f64::total_cmp);
    let squares: f64 = metres.iter().map(|it| it * it).sum();
    let at = |part: f64| {
        let place = (part * metres.len().saturating_sub(1) as f64) as usize;
        metres.get(place).copied().unwrap_or(f64::NAN)
    };
    let _ = writeln!(
        table,
        "| {name} | {} scans | {} | {:.3} | {:.3} | {:.3} | {:.2} |",
        scans - scans / 2,
        metres.len(),
        (squares / metres.len() as f64).sqrt(),
        at(0.99),
        at(1.0),
        off.iter().map(|it| it.1).fold(0.0, f64::max),
    );
    Ok(())
}

fn periplus() -> Command {
    let mut command = cargo();
    command.args(["run", "--quiet", "--release", "--package", "periplus-cli", "--"]);
    command
}

fn lines(path: &Path) -> Result<Vec<Line>, Failed> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| Failed(format!("{}: {error}", path.display())))?;
    let line = |line: &str| {
        let mut words = line.split_whitespace();
        let stamp = words.next()?.to_owned();
        let mut number = || words.next()?.parse().ok();
        Some((stamp, [number()?, number()?, number()?]))
    };
    Ok(text.lines().filter_map(line).collect())
}
