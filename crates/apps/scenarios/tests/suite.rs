//! The scenarios of the folder `scenarios`.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::disallowed_methods,
    clippy::print_stdout,
    reason = "tests"
)]

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::{options, read};
use periplus_scenarios::{ScenarioRunOptions, run};

/// Scenarios of the suite, by name.
fn suite() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../scenarios");
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|it| it == "yaml")).collect();
    files.sort();
    files
}

/// `SCENARIO=name` runs one of them.
#[test]
fn every_scenario_of_the_suite_passes() {
    let wanted = std::env::var("SCENARIO").unwrap_or_default();
    let mut failures = Vec::new();
    for path in suite().iter().filter(|path| path.to_string_lossy().contains(&wanted)) {
        let report = run(&read(path, &[]), &options()).unwrap();
        report.write_text(&mut std::io::stdout().lock()).unwrap();
        if !report.has_passed() {
            failures.push(report.name);
        }
    }
    assert!(failures.is_empty(), "failed: {failures:?}");
}

/// Two runs, with one thread and with two, publish the same bytes; `cargo xtask scenarios --repeat 1000` is the long
/// form.
#[test]
fn the_suite_is_equal_to_the_byte() {
    for name in ["localization_moved_furniture", "costmap_box_appears", "navigation_lost_scans"] {
        let path = suite().into_iter().find(|path| path.to_string_lossy().contains(name)).unwrap();
        let scenario = read(&path, &[]);
        let of = |threads: usize| {
            let options = ScenarioRunOptions { has_digest: true, threads, ..options() };
            run(&scenario, &options).unwrap().to_json().to_string()
        };
        assert_eq!(of(1), of(2), "{name}");
    }
}
