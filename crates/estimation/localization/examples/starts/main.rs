//! Measures how often localization reports a wrong pose as known: tracking, global localization, a
//! half-known map, a wrong map, kidnapping, moved furniture. `starts [--logs FOLDER] [--only
//! NAME,..] [--tests NAME,..] [--runs N] [--seed N] [NAME=VALUE ...]`, with names of parameters.
//!
//! Logs are `FOLDER/NAME/raw.clf`; their maps and references come from SLAM on the same log. Sure
//! means state `tracking`; wrong means an error above 1 m or 30 degrees.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a tool that measures time and prints results"
)]

mod courses;
mod logs;
mod trials;
#[path = "../worlds/mod.rs"]
#[allow(dead_code, reason = "each tool uses its part")]
mod worlds;

use std::path::PathBuf;
use std::process::ExitCode;

use periplus_diagnostics::Diagnostics;
use periplus_localization::Settings;
use periplus_params::Given;

use crate::courses::Course;
use crate::logs::course_of_log;
use crate::trials::{Tally, Tests};
use crate::worlds::World;

/// Logs with odometry that SLAM maps correctly.
const LOGS: [&str; 6] = ["aces", "csail-full", "edmonton", "fr101", "intel", "seattle"];

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let after = |name: &str| {
        words.iter().position(|it| it == name).and_then(|at| words.get(at + 1)).cloned()
    };
    let list = |name: &str| after(name).map(|it| it.split(',').map(str::to_owned).collect());
    let folder = after("--logs").map(PathBuf::from);
    let only: Option<Vec<String>> = list("--only");
    let wanted: Option<Vec<String>> = list("--tests");
    let number = |name: &str, or: u64| after(name).map_or(or, |it| it.parse().unwrap());
    let (runs, seed) = (number("--runs", 100) as usize, number("--seed", 0));
    let mut diagnostics = Diagnostics::new();
    let given = words.iter().filter_map(|word| word.split_once('='));
    let given = given.map(|(name, value)| Given::new(name, value));
    let (_, settings) = Settings::read(given, &mut diagnostics);
    diagnostics.iter().for_each(|it| println!("{}", it.message));

    let wants = |name: &str| only.as_ref().is_none_or(|only| only.iter().any(|it| it == name));
    let mut courses = Vec::new();
    let every = number("--every", 0) as usize;
    let logs = LOGS.map(str::to_owned).into_iter();
    // Logs besides these can be named.
    let named = only.iter().flatten().filter(|it| !LOGS.contains(&it.as_str()));
    for name in logs.chain(named.cloned()) {
        let Some(path) = folder.as_ref().map(|it| it.join(&name).join("raw.clf")) else { break };
        if !wants(&name) || !path.exists() {
            continue;
        }
        match course_of_log(&name, &path, every.max(1)) {
            Ok(course) => courses.push(course),
            Err(why) => {
                println!("{why}");
                return ExitCode::FAILURE;
            }
        }
    }
    for world in World::all().into_iter().chain([World::block_of_offices()]) {
        if wants(world.name) {
            courses.push(Course::of_world(&world, seed));
        }
    }
    let tests = Tests { settings, runs, seed };
    let wants = |name: &str| wanted.as_ref().is_none_or(|it| it.iter().any(|it| it == name));
    println!("{}", Tally::HEAD);
    let mut all = Tally::default();
    let mut tell = |tally: Tally| {
        println!("{}", tally.line());
        all.add(&tally);
    };
    for course in &courses {
        if wants("tracking") {
            tell(tests.tracking(course));
        }
        if wants("starts") {
            tell(tests.starts(course));
        }
        if wants("erased") {
            tell(tests.erased(course));
        }
        if wants("kidnapped") {
            tell(tests.kidnapped(course, false));
            tell(tests.kidnapped(course, true));
        }
        if wants("moved") {
            tell(tests.moved_furniture(course));
        }
    }
    if wants("foreign") {
        for course in &courses {
            for other in courses.iter().filter(|it| it.name != course.name) {
                tell(tests.foreign(course, other));
            }
        }
    }
    println!("{}", all.line());
    ExitCode::SUCCESS
}
