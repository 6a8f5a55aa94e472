//! Maps of worlds whose truth is known: `slam-worlds PERIPLUS FOLDER [--only WORLD] [--seeds FIRST..END]
//! [--keep]`. `cargo xtask bench slam-worlds` knows the first two.
//!
//! The simulator drives a robot through one of the project's worlds, `periplus slam` maps its bag, and
//! trajectory and map are compared with the true poses and walls.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program that measures and says how it went"
)]

mod drive;
mod floor;
mod score;
mod stage;
mod table;

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use crate::score::Score;
use crate::stage::{Stage, VENUES, Venue};
use crate::table::Table;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let after = |name: &str| {
        words.iter().position(|it| it == name).and_then(|at| words.get(at + 1)).map(String::as_str)
    };
    let (Some(periplus), Some(folder)) = (words.first(), words.get(1)) else {
        eprintln!("usage: slam-worlds PERIPLUS FOLDER [--only WORLD] [--seeds 0..10] [--keep]");
        return ExitCode::from(2);
    };
    let seeds = after("--seeds").and_then(range).unwrap_or(0..10);
    let only = after("--only");
    let keep = words.iter().any(|it| it == "--keep");
    let mut table = Table::new();
    let mut outcome = ExitCode::SUCCESS;
    for venue in VENUES.iter().filter(|it| only.is_none_or(|only| it.name == only)) {
        for seed in seeds.clone() {
            let folder = PathBuf::from(folder).join(format!("{}_{seed}", venue.name));
            match race(Path::new(periplus), &folder, venue, seed, keep) {
                Ok(score) => table.take(venue.name, seed, score),
                Err(why) => {
                    eprintln!("{} with seed {seed}: {why}", venue.name);
                    outcome = ExitCode::FAILURE;
                }
            }
        }
    }
    table.sum_up();
    outcome
}

fn range(text: &str) -> Option<Range<u64>> {
    let (from, to) = text.split_once("..")?;
    Some(from.parse().ok()?..to.parse().ok()?)
}

/// One drive, its map, and how right they are.
fn race(
    periplus: &Path,
    folder: &Path,
    venue: &Venue,
    seed: u64,
    keep: bool,
) -> Result<Score, String> {
    std::fs::create_dir_all(folder).map_err(|why| why.to_string())?;
    let bag = folder.join("drive.mcap");
    let stage = Stage::set(venue, seed)?;
    let drive = drive::drive(&stage, seed, &bag)?;
    drive.write(folder).map_err(|why| why.to_string())?;
    let out = folder.join("map");
    let status = Command::new(periplus)
        .args(["slam", "--quiet", "--out"])
        .arg(&out)
        .arg(&bag)
        .status()
        .map_err(|why| format!("cannot start {}: {why}", periplus.display()))?;
    if !status.success() {
        return Err(format!("periplus slam ended with {status}"));
    }
    let score = score::score(&stage, &drive, &out)?;
    if !keep {
        // A bag is large, and comes again from its seed.
        let _ = std::fs::remove_file(&bag);
    }
    Ok(score)
}
