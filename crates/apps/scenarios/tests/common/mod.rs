//! Scenarios of the tests.
#![allow(
    dead_code,
    clippy::unwrap_used,
    clippy::panic,
    reason = "each test uses a part; a test may panic"
)]

use std::fs;
use std::path::Path;

use periplus_diagnostics::{RenderStyle, render};
use periplus_scenarios::{Scenario, ScenarioReport, ScenarioRunOptions, run};
use periplus_sim::Search;

/// Options of the tests: no artifacts, two threads.
pub(crate) fn options() -> ScenarioRunOptions {
    let working_folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../scenarios");
    ScenarioRunOptions {
        threads: 2,
        search: Search { working_folder, ..Search::default() },
        ..ScenarioRunOptions::default()
    }
}

/// Reads a file of a scenario without mistakes.
pub(crate) fn read(path: &Path, set: &[(&str, &str)]) -> Scenario {
    parse(path, fs::read_to_string(path).unwrap(), set)
}

/// Reads a text as a scenario of the folder `scenarios`.
pub(crate) fn read_text(text: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../scenarios").join("test.yaml");
    parse(&path, text.to_owned(), &[])
}

fn parse(path: &Path, text: String, set: &[(&str, &str)]) -> Scenario {
    let set: Vec<(String, String)> =
        set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    Scenario::read(path, text, &set).unwrap_or_else(|error| {
        let findings = error.diagnostics.iter();
        let texts = findings.map(|it| render(it, &error.sources, RenderStyle::Plain));
        panic!("{}", texts.collect::<String>())
    })
}

/// Runs a text as a scenario.
pub(crate) fn run_text(text: &str) -> ScenarioReport {
    run(&read_text(text), &options()).unwrap()
}

/// Words of all kinds of faults.
pub(crate) fn fault_kinds() -> std::collections::BTreeSet<&'static str> {
    periplus_faults::FaultKind::tables().iter().map(|table| table.name).collect()
}
