//! Localizes the second half of a log on the map of its first half, and compares with SLAM on the
//! whole log: `halves FOLDER [again] [NAME=VALUE ...]`.
//!
//! The folder contains `second.clf`, results of `periplus slam` for the whole log (`whole`) and the
//! first half (`map`), and of `periplus localize` for the second half (`localized`); with `again`,
//! localization runs here, with the given parameters. The output is a row of a table; data of every
//! scan and pictures are written to the folder.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    reason = "a tool that reads files and prints results"
)]

mod compare;
mod draw;
mod files;

use std::path::Path;
use std::process::ExitCode;

use periplus_diagnostics::Diagnostics;
use periplus_localization::{Amcl, Settings};
use periplus_params::Given;

use crate::compare::compare;
use crate::files::{Found, Half};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let Some((folder, rest)) = words.split_first() else {
        println!("usage: halves FOLDER [again] [NAME=VALUE ...]");
        return ExitCode::from(2);
    };
    match run(Path::new(folder), rest) {
        Ok(line) => {
            println!("{line}");
            ExitCode::SUCCESS
        }
        Err(why) => {
            println!("{why}");
            ExitCode::FAILURE
        }
    }
}

fn run(folder: &Path, words: &[String]) -> Result<String, String> {
    let half = Half::read(folder)?;
    let found = if words.first().is_some_and(|word| word == "again") {
        localize(&half, &words[1..])?
    } else {
        Found::read(&folder.join("localized"))?
    };
    let compared = compare(&half, &found);
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).map_err(|why| format!("{}: {why}", path.display()))
    };
    write("scans.csv", compared.csv().as_bytes())?;
    write("map.png", &draw::ways(&half.map, &compared))?;
    write("errors.png", &draw::errors(&compared))?;
    Ok(compared.line(&folder.file_name().unwrap_or_default().to_string_lossy()))
}

/// Runs localization as `periplus localize`.
fn localize(half: &Half, given: &[String]) -> Result<Found, String> {
    let given = given.iter().filter_map(|word| word.split_once('='));
    let mut diagnostics = Diagnostics::new();
    // Uses every scan, as SLAM does.
    let usual = [("update_min_d", "0.1"), ("update_min_a", "0.1")];
    let all = usual.into_iter().chain(given).map(|(name, value)| Given::new(name, value));
    let (_, settings) = Settings::read(all, &mut diagnostics);
    diagnostics.iter().for_each(|it| println!("{}", it.message));
    let mut amcl = Amcl::new(settings);
    amcl.set_map("map", &half.map).map_err(|why| why.message)?;
    let mut found = Found::default();
    for seen in &half.scans {
        let _ = amcl.update(seen.odom_from_base, &seen.scan);
        found.states.push((seen.stamp_us, format!("{:?}", amcl.status().state).to_lowercase()));
        if let Some(map_from_odom) = amcl.map_from_odom().filter(|_| amcl.has_pose()) {
            found.poses.insert(seen.stamp_us, map_from_odom * seen.odom_from_base);
        }
    }
    Ok(found)
}
