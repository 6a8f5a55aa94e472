//! Rays per CPU second, beside the peers.
//!
//! Every turn runs us and all peers one after the other over the same files, so that a busy moment
//! of the machine hits all alike; of each the best turn counts.

mod ours;
mod peers;
mod table;

use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};

pub(crate) use ours::run as cast;

const SCENES: [&str; 4] = ["tutorial", "house", "warehouse", "city"];

/// Result of the race.
pub(crate) enum Race {
    Tables(String),
    /// No peer is installed: our figures compare with nothing.
    Alone(String),
    /// The scenes cannot be made: a program is missing.
    NoScenes,
}

/// Races everybody over the scenes in `work`, made by scripts in `engines`; writes
/// `work/rays.jsonl` and gives the tables. With no turn, tables of the race before.
pub(crate) fn compare(engines: &Path, work: &Path, turns: usize) -> Result<Race, String> {
    let failed = |error: std::io::Error| format!("{}: {error}", work.display());
    let record = work.join("rays.jsonl");
    if turns == 0 {
        let text = std::fs::read_to_string(&record).map_err(failed)?;
        let lines: Vec<Value> =
            text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
        return Ok(Race::Tables(table::tables(&lines)));
    }
    let out = work.join("out");
    std::fs::create_dir_all(&out).map_err(failed)?;
    if !peers::make_scenes(engines, work) {
        return Ok(Race::NoScenes);
    }
    let peers = peers::all(engines, work)?;
    let own = std::env::current_exe().map_err(failed)?;
    let ours = |scene: &str| {
        let mut command = Command::new(&own);
        command.arg("cast").arg(work.join("scenes")).arg(scene).arg(&out);
        command
    };
    let mut lines: Vec<Value> = Vec::new();
    for turn in 1..=turns {
        lines.extend(answers(&mut ours("dynamic"))?);
        for scene in SCENES {
            eprintln!("{scene}, turn {turn} of {turns}");
            lines.extend(answers(&mut ours(scene))?);
            if scene == "tutorial" {
                lines.extend(answers(&mut ours("tutorial-prim"))?);
            }
            for peer in peers.iter().filter(|peer| peer.takes(scene)) {
                eprintln!("  {}", peer.name());
                match answers(&mut peer.command(scene)) {
                    Ok(new) => {
                        if peer.name() == "embree" {
                            lines.extend(differences(&out, &new));
                        }
                        lines.extend(new);
                    }
                    Err(why) => eprintln!("SKIPPED: {} in {scene}: {why}", peer.name()),
                }
            }
        }
    }
    let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
    std::fs::write(record, text).map_err(failed)?;
    let tables = table::tables(&lines);
    Ok(if peers.is_empty() { Race::Alone(tables) } else { Race::Tables(tables) })
}

/// Difference of two distances that counts \[m\].
const MAX_DIFFERENCE_M: f32 = 1e-3;

/// Number of rays of each load of Embree's lines whose distances differ from ours.
fn differences(out: &Path, lines: &[Value]) -> Vec<Value> {
    let distances = |who: &str, scene: &str, load: &str| -> Option<Vec<f32>> {
        let bytes = std::fs::read(out.join(format!("{who}.{scene}.{load}.f32"))).ok()?;
        let number = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
        Some(bytes.chunks_exact(4).map(number).collect())
    };
    let mut counted = Vec::new();
    for line in lines.iter().filter(|line| line["width"] == 1) {
        let (Some(scene), Some(load)) = (line["scene"].as_str(), line["load"].as_str()) else {
            continue;
        };
        let (Some(ours), Some(theirs)) =
            (distances("ours", scene, load), distances("c:embree", scene, load))
        else {
            continue;
        };
        let same = |(a, b): (&f32, &f32)| a == b || (a - b).abs() <= MAX_DIFFERENCE_M;
        let differ = ours.len().abs_diff(theirs.len())
            + ours.iter().zip(&theirs).filter(|&pair| !same(pair)).count();
        counted.push(json!({ "scene": scene, "load": load, "differ": differ }));
    }
    counted
}

/// The JSON lines that a program prints.
fn answers(command: &mut Command) -> Result<Vec<Value>, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("{name}: {error}"))?;
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr);
        return Err(format!("{name} failed: {why}"));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    Ok(text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect())
}
