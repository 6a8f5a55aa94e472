//! Speed, side by side with the peers, in one run.
//!
//! `cargo xtask bench` builds the peers and runs this. Figures mean something only beside each
//! other: both sides run in turns on the same machine, and of each the fastest turn counts.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program that measures"
)]

mod costmap;
mod files;
mod loading;
mod peers;
mod physics;
mod rays;
mod world;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde_json::json;

use crate::rays::Race;

fn main() -> ExitCode {
    let words: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    match words.split_first() {
        Some((first, rest)) if first.as_os_str() == "physics" => physics(rest),
        Some((first, rest)) if first.as_os_str() == "rays" => tell(race_rays(rest)),
        Some((first, rest)) if first.as_os_str() == "cast" => tell(cast_rays(rest)),
        Some((first, rest)) if first.as_os_str() == "costmap" => tell(measure_costmap(rest)),
        _ => loading(),
    }
}

/// `physics ORACLES ODE PYTHON RESULT.json`
fn physics(words: &[PathBuf]) -> ExitCode {
    let [oracles, ode, python, result] = words else {
        eprintln!("usage: periplus-benches physics ORACLES ODE PYTHON RESULT.json");
        return ExitCode::from(2);
    };
    let (table, figures) = match physics::run(oracles, ode, python) {
        Ok(done) => done,
        Err(why) => {
            eprintln!("{why}");
            return ExitCode::FAILURE;
        }
    };
    println!("{table}");
    write(result, &figures)
}

fn write(path: &std::path::Path, result: &serde_json::Value) -> ExitCode {
    match std::fs::write(path, format!("{result:#}\n")) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("cannot write {}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}

fn loading() -> ExitCode {
    let Some(oracles) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!(
            "usage: periplus-benches ORACLES [RESULT.json]; `cargo xtask bench` knows the folder"
        );
        return ExitCode::from(2);
    };
    let turns = 3;
    match loading::compare(&oracles, turns) {
        Ok(rows) => {
            let large = world::large(turns);
            println!("{}", loading::table(&rows));
            println!(
                "a world of {:.1} MB with {} models: {:.0} ms (limit 1000 ms)",
                large.megabytes,
                large.models,
                large.seconds * 1e3
            );
            if let Some(path) = std::env::args_os().nth(2) {
                let result = json!({ "loading": rows_json(&rows), "large_world": {
                    "megabytes": large.megabytes, "models": large.models, "seconds": large.seconds } });
                return write(std::path::Path::new(&path), &result);
            }
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// `rays ENGINES FOLDER RESULTS.md [TURNS]`
fn race_rays(words: &[PathBuf]) -> Result<(), String> {
    let [engines, folder, results, turns @ ..] = words else {
        return Err("usage: periplus-benches rays ENGINES FOLDER RESULTS.md [TURNS]".to_owned());
    };
    let turns = turns.first().and_then(|turns| turns.to_str()?.parse().ok()).unwrap_or(2);
    match rays::compare(engines, folder, turns)? {
        Race::NoScenes => Ok(()),
        Race::Alone(tables) => {
            println!("{tables}\nNo peer ran, so {} stays as it is.", results.display());
            Ok(())
        }
        Race::Tables(tables) => {
            println!("{tables}");
            replace_section(results, RAYS, &tables)
                .map_err(|error| format!("{}: {error}", results.display()))
        }
    }
}

/// `cast SCENES SCENE OUT`: us alone.
fn cast_rays(words: &[PathBuf]) -> Result<(), String> {
    let [scenes, scene, out] = words else {
        return Err("usage: periplus-benches cast SCENES SCENE OUT".to_owned());
    };
    rays::cast(scenes, &scene.to_string_lossy(), out).map_err(|error| error.to_string())
}

/// `costmap PYTHON SCRIPT FOLDER RESULTS.md`
fn measure_costmap(words: &[PathBuf]) -> Result<(), String> {
    let [python, script, folder, results] = words else {
        return Err("usage: periplus-benches costmap PYTHON SCRIPT FOLDER RESULTS.md".to_owned());
    };
    let table = costmap::compare(python, script, folder)?;
    println!("{table}");
    replace_section(results, COSTMAP, &table)
        .map_err(|error| format!("{}: {error}", results.display()))
}

const RAYS: [&str; 2] =
    ["<!-- rays: written by `cargo xtask bench rays` -->\n", "<!-- end of rays -->\n"];

const COSTMAP: [&str; 2] =
    ["<!-- costmap: written by `cargo xtask bench costmap` -->\n", "<!-- end of costmap -->\n"];

/// Puts new tables where the old ones were, or at the end.
fn replace_section(results: &Path, section: [&str; 2], tables: &str) -> std::io::Result<()> {
    let text = std::fs::read_to_string(results)?;
    let [start, end] = section;
    let (before, after) = match (text.split_once(start), text.split_once(end)) {
        (Some((before, _)), Some((_, after))) => (before, after),
        _ => (&*text, ""),
    };
    std::fs::write(results, format!("{before}{start}\n{tables}\n{end}{after}"))
}

fn tell(result: Result<(), String>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

fn rows_json(rows: &[loading::Row]) -> serde_json::Value {
    rows.iter()
        .map(|row| {
            json!({ "work": row.work, "peer": row.peer, "files": row.files, "megabytes": row.megabytes,
                "peer_seconds": row.peer_seconds, "our_seconds": row.our_seconds,
                "ratio": row.peer_seconds / row.our_seconds })
        })
        .collect()
}
