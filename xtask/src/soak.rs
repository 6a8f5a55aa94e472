//! A robot that drives for ten simulated hours: memory that stays flat, poses that stay numbers.

use std::path::Path;
use std::process::{Child, Command};
use std::time::Duration;

use crate::step::{Failed, cargo, root, run};

/// Simulated time of the run \[s\].
const LENGTH_S: u64 = 36_000;

/// Memory may be this much larger at the end than after the first hour, as a ratio.
const MAX_GROWTH_RATIO: f64 = 1.05;

/// How often memory is measured.
const PERIOD: Duration = Duration::from_secs(2);

/// kbot in its room in circles, with a lifelong map and both costmaps. Motion is exact
/// (`--dynamics kinematic`), and one scan in ten counts, so that it takes minutes.
pub(crate) fn kbot() -> Result<(), Failed> {
    let folder = root().join("target/soak");
    let failed = |error: std::io::Error| Failed(format!("the soak cannot run: {error}"));
    std::fs::create_dir_all(&folder).map_err(failed)?;
    let script = folder.join("drive.yaml");
    let circles = format!("- {{at: 0, until: {LENGTH_S}, rate: 1, linear: 0.3, angular: 0.3}}\n");
    std::fs::write(&script, circles).map_err(failed)?;
    let parameters = folder.join("slam.yaml");
    let text = "slam_toolbox:\n  ros__parameters:\n    throttle_scans: 10\n    map_update_interval: 60.0\n";
    std::fs::write(&parameters, text).map_err(failed)?;
    let mut build = cargo();
    run(build.args(["build", "--quiet", "--release", "--package", "periplus-cli"]), "see above")?;
    let out = folder.join("map");
    let mut command = Command::new(root().join("target/release/periplus"));
    command.current_dir(root()).arg("sim").arg("worlds/closed_room.world");
    command.args(["--robot", "robots/kbot/urdf/kbot.urdf.xacro", "--dynamics", "kinematic"]);
    command.arg("--cmd").arg(&script).arg("--slam").arg(&parameters);
    command.args(["--slam-node", "lifelong", "--stack", "--duration", &LENGTH_S.to_string()]);
    command.arg("--slam-out").arg(&out);
    let mut child = command.spawn().map_err(failed)?;
    let samples = sampled(&mut child).map_err(failed)?;
    let status = child.wait().map_err(failed)?;
    if !status.success() {
        return Err(Failed(format!("the run has ended with {status}: see above")));
    }
    let first_hour = samples.len() / 10;
    let (Some(after_hour), Some(last)) = (samples.get(first_hour), samples.last()) else {
        return Err(Failed("memory could not be measured: it is read from /proc".into()));
    };
    let ratio = *last as f64 / *after_hour as f64;
    println!("{after_hour} kB after an hour, {last} kB after ten: {ratio:.3}");
    if ratio > MAX_GROWTH_RATIO {
        return Err(Failed(format!("memory grew by {:.0} %", (ratio - 1.0) * 100.0)));
    }
    Ok(())
}

/// Memory of a process until it ends \[kB\].
fn sampled(child: &mut Child) -> std::io::Result<Vec<u64>> {
    let status = Path::new("/proc").join(child.id().to_string()).join("status");
    let mut samples = Vec::new();
    while child.try_wait()?.is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        samples.extend(line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok()));
        std::thread::sleep(PERIOD);
    }
    Ok(samples)
}
