//! Whole runs of `periplus sim`, against the wall.

use std::path::PathBuf;
use std::process::Command;

use serde_json::{Value, json};

use crate::step::{Failed, cargo, root, run};

/// A run, what it is asked for, and what it should reach.
struct Load {
    name: &'static str,
    words: &'static [&'static str],
    /// Simulated seconds per second of the wall that are wanted.
    wanted: f64,
}

const ROBOT: &str = "robots/sam_bot/urdf/sam_bot.urdf.xacro";

const LOADS: [Load; 5] = [
    Load {
        name: "tutorial world, physics at 1 ms, lidar and odometry recorded, camera without subscribers",
        words: &["--duration", "60", "--topics", "scan|odom", "--threads", "1"],
        wanted: 25.0,
    },
    Load {
        name: "the same without physics",
        words: &[
            "--duration",
            "600",
            "--topics",
            "scan|odom",
            "--threads",
            "1",
            "--dynamics",
            "kinematic",
        ],
        wanted: 500.0,
    },
    Load {
        name: "depth image subscribed, 640x480 at 30 Hz, one core",
        words: &[
            "--duration",
            "10",
            "--topics",
            "scan|odom",
            "--compute",
            "depth/image_raw",
            "--threads",
            "1",
        ],
        wanted: 2.0,
    },
    Load {
        name: "depth image and coloured points subscribed, one core",
        words: &[
            "--duration",
            "10",
            "--topics",
            "scan|odom",
            "--compute",
            "depth/image_raw|points",
            "--threads",
            "1",
        ],
        wanted: 2.0,
    },
    Load {
        name: "depth image and coloured points subscribed, two cores",
        words: &[
            "--duration",
            "10",
            "--topics",
            "scan|odom",
            "--compute",
            "depth/image_raw|points",
            "--threads",
            "2",
        ],
        wanted: 3.5,
    },
];

/// First scans that are wanted within this \[s\].
const START_UP_S: f64 = 0.3;

/// Turns of each load; the best counts, for the machine has others.
const TURNS: usize = 3;

/// Runs all loads and prints how they compare with what is wanted.
pub(crate) fn bench() -> Result<(), Failed> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let folder = target.unwrap_or_else(|| root().join("target"));
    let mut build = cargo();
    build.args(["build", "--quiet", "--release", "--package", "periplus-cli"]);
    run(&mut build, "see the errors above")?;
    let program = folder.join("release/periplus");
    let bag = folder.join("bench.mcap");
    let mut lines = Vec::new();
    println!("| run | x real time | wanted | physics | sensing | messages | recording |");
    println!("|---|---|---|---|---|---|---|");
    for load in &LOADS {
        let mut best: Option<Value> = None;
        for _ in 0..TURNS {
            let report = report(&program, load, &bag)?;
            if factor(&report) > best.as_ref().map_or(0.0, factor) {
                best = Some(report);
            }
        }
        let Some(best) = best else { continue };
        let share = |work: &str| {
            let spent_s = best["work"][format!("{work}_s")].as_f64().unwrap_or_default();
            format!("{:.0} %", spent_s / best["wall_s"].as_f64().unwrap_or(1.0) * 100.0)
        };
        println!(
            "| {} | {:.1} | {} | {} | {} | {} | {} |",
            load.name,
            factor(&best),
            load.wanted,
            share("physics"),
            share("sensing"),
            share("messages"),
            share("recording"),
        );
        lines.push(json!({
            "load": load.name,
            "real_time_factor": factor(&best),
            "wanted": load.wanted,
            "work": best["work"],
            "start_up_s": best["start_up_s"],
        }));
    }
    let first_s = first_scan_s(&program, &bag)?;
    println!(
        "\nstart of the program to the first scan in the bag: {first_s:.3} s (wanted {START_UP_S})"
    );
    lines.push(json!({ "load": "first scan", "seconds": first_s, "wanted": START_UP_S }));
    for line in &lines {
        println!("{line}");
    }
    Ok(())
}

fn report(program: &PathBuf, load: &Load, bag: &PathBuf) -> Result<Value, Failed> {
    let output = Command::new(program)
        .current_dir(root())
        .args(["sim", "worlds/closed_room.world", "--robot", ROBOT])
        .args(["--cmd", "worlds/drives/circle.yaml", "--json", "--quiet", "--record"])
        .arg(bag)
        .args(load.words)
        .output()
        .map_err(|error| Failed(format!("cannot run {}: {error}", program.display())))?;
    serde_json::from_slice(&output.stdout).map_err(|error| {
        Failed(format!("{}: {error}\n{}", load.name, String::from_utf8_lossy(&output.stderr)))
    })
}

fn factor(report: &Value) -> f64 {
    report["real_time_factor"].as_f64().unwrap_or_default()
}

/// The whole life of a program that ends after its first scan.
fn first_scan_s(program: &PathBuf, bag: &PathBuf) -> Result<f64, Failed> {
    let mut best_s = f64::INFINITY;
    for _ in 0..TURNS {
        let load = Load { name: "first scan", words: &["--duration", "0.001"], wanted: 0.0 };
        let start = std::time::Instant::now();
        let told = report(program, &load, bag)?;
        if told["recording"]["messages"].as_u64().unwrap_or_default() == 0 {
            return Err(Failed("nothing was measured in the first step".into()));
        }
        best_s = best_s.min(start.elapsed().as_secs_f64());
    }
    Ok(best_s)
}
