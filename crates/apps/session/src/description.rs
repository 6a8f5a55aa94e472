//! Facts of a run that its recordings contain.
//!
//! Equal runs have equal facts: neither the time of the day, nor the machine, nor options without
//! influence on the result are among them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use periplus_sim::{Composition, Options};

/// Facts of a simulation: version of the program, command, world, robots, seed.
pub(crate) fn describe(
    composition: &Composition,
    options: &Options,
    command: Option<&str>,
) -> BTreeMap<String, String> {
    let mut facts = BTreeMap::new();
    facts.insert("world".to_owned(), world(composition));
    let robots = robots(composition);
    if !robots.is_empty() {
        facts.insert("robots".to_owned(), robots.join(", "));
    }
    facts.insert("seed".to_owned(), options.seed.to_string());
    if let Some(command) = command {
        facts.insert("command".to_owned(), command.to_owned());
    }
    with_version(facts)
}

/// Adds the version of the program.
#[must_use]
pub fn with_version(mut facts: BTreeMap<String, String>) -> BTreeMap<String, String> {
    facts.insert("periplus".to_owned(), env!("CARGO_PKG_VERSION").to_owned());
    facts
}

/// Name of the world, and of its file without folders.
fn world(composition: &Composition) -> String {
    let name = &composition.world.name;
    match composition.files.first() {
        Some(file) if !composition.is_default_world => with_file(name, &file.path),
        _ => name.clone(),
    }
}

/// Models of robot files, and of other files than that of the world.
fn robots(composition: &Composition) -> Vec<String> {
    let first_robot_file = usize::from(!composition.is_default_world);
    let robots = composition
        .members
        .iter()
        .filter(|member| member.description.is_some() || member.file >= first_robot_file);
    let mut seen = BTreeSet::new();
    let named = robots.map(|member| match composition.files.get(member.file) {
        Some(file) => with_file(&member.name, &file.path),
        None => member.name.clone(),
    });
    named.filter(|robot| seen.insert(robot.clone())).collect()
}

fn with_file(name: &str, path: &Path) -> String {
    match path.file_name() {
        Some(file) => format!("{name} ({})", file.to_string_lossy()),
        None => name.to_owned(),
    }
}
