//! Speed and memory of fleets.

use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;

use serde_json::Value;

use crate::results;
use crate::step::{Failed, build_native, peak_memory_kb, root, run};

/// Numbers of robots.
const COUNTS: [usize; 6] = [1, 10, 50, 100, 200, 500];

/// Simulated time of each run, and of the shorter one that is subtracted: starting and first plans are not driving \[s\].
const DURATIONS_S: [f64; 2] = [25.0, 10.0];

/// Time between two looks at the memory of a run.
const MEMORY_PERIOD: Duration = Duration::from_millis(50);

/// Figures of a run.
struct FleetRun {
    wall_s: f64,
    memory_mb: f64,
    reached: usize,
    error_m: f64,
}

/// Drives fleets through the warehouse, each robot with its own lidar, AMCL, costmaps, planner and controller, and writes
/// the table of `benches/RESULTS.md`. `program` replaces a release build.
pub(crate) fn bench(program: Option<PathBuf>) -> Result<(), Failed> {
    let program = program.map_or_else(build_native, Ok)?;
    let folder = root().join("target/fleet");
    std::fs::create_dir_all(&folder)
        .map_err(|error| Failed(format!("cannot make {}: {error}", folder.display())))?;
    let map = folder.join("warehouse");
    let world = root().join("worlds/warehouse.sdf");
    let mut draw = Command::new(&program);
    draw.args(["map", "draw"]).arg(&world).args(["--start=-10,-2.5", "-f"]).arg(&map);
    run(&mut draw, "the map of the warehouse cannot be drawn")?;
    let mut table = String::from(
        "| robots | real time factor | per robot and second [ms] | memory [MB] | error of AMCL [m] | goals reached |\n\
         |---|---|---|---|---|---|\n",
    );
    for count in COUNTS {
        let [long_s, short_s] = DURATIONS_S;
        let long = drive(&program, &map.with_extension("yaml"), count, long_s)?;
        let short = drive(&program, &map.with_extension("yaml"), count, short_s)?;
        let factor = (long_s - short_s) / (long.wall_s - short.wall_s).max(1e-3);
        let row = format!(
            "| {count} | {factor:.2} | {:.2} | {:.0} | {:.3} | {} |\n",
            1e3 / (factor * count as f64),
            long.memory_mb,
            long.error_m,
            long.reached
        );
        print!("{row}");
        table.push_str(&row);
    }
    results::write("fleets", "fleet", &table)
}

/// Runs a fleet for some simulated seconds.
fn drive(
    program: &std::path::Path,
    map: &std::path::Path,
    count: usize,
    duration_s: f64,
) -> Result<FleetRun, Failed> {
    let mut command = Command::new(program);
    command.arg("navigate").arg(root().join("worlds/warehouse.sdf"));
    command.arg("--robot").arg(root().join("benches/fleet_robot.urdf")).arg("--pose=-10,-2.5,0");
    command.arg("--map").arg(map);
    command.args([
        "--random-goals=100",
        "--dynamics=kinematic",
        "--max-speed=0.3",
        "--json",
        "--quiet",
    ]);
    command.args([format!("--robots={count}"), format!("--timeout={duration_s}")]);
    // The controller of fleets, for one robot, too.
    command.arg("--controller=rpp");
    let started = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
    let mut child = started.map_err(|error| Failed(format!("{}: {error}", program.display())))?;
    let status = format!("/proc/{}/status", child.id());
    let output = child.stdout.take();
    let reading = std::thread::spawn(move || {
        let mut text = String::new();
        if let Some(mut output) = output {
            let _ = std::io::Read::read_to_string(&mut output, &mut text);
        }
        text
    });
    let mut memory_mb = 0.0_f64;
    while child.try_wait().is_ok_and(|ended| ended.is_none()) {
        memory_mb = memory_mb.max(peak_mb(&status).unwrap_or(0.0));
        std::thread::sleep(MEMORY_PERIOD);
    }
    let text = reading.join().unwrap_or_default();
    let report: Value = serde_json::from_str(&text)
        .map_err(|error| Failed(format!("{count} robots printed no report: {error}")))?;
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let empty = Vec::new();
    let robots = report["robots"].as_array().unwrap_or(&empty);
    let goals = robots.iter().map(|robot| &robot["goals"]);
    let reached = goals.filter_map(Value::as_array).flatten();
    let reached = reached.filter(|goal| goal["is_reached"] == true).count();
    let errors: Vec<f64> =
        robots.iter().map(|robot| number(&robot["localization_error_mean_m"])).collect();
    Ok(FleetRun {
        wall_s: number(&report["run"]["wall_s"]),
        memory_mb,
        reached,
        error_m: errors.iter().sum::<f64>() / errors.len() as f64,
    })
}

/// Largest memory of a process so far \[MB\].
fn peak_mb(status: &str) -> Option<f64> {
    Some(1.024e-3 * peak_memory_kb(&std::fs::read_to_string(status).ok()?)? as f64)
}
