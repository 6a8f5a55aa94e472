//! The cases of this tree and those that are shared.

#![allow(clippy::print_stdout, reason = "a test that prints its table")]

use std::path::Path;

use periplus_conformance::{ConformanceReport, Verdict, run};
use periplus_os::Machine;

fn check(folder: &Path) -> Option<ConformanceReport> {
    let report = run(folder, &Machine).ok()?;
    let wrong = report.results.iter().filter(|result| result.verdict != Verdict::Passed);
    assert_eq!(wrong.count(), 0, "\n{}", report.to_text());
    println!("{}", report.to_text());
    Some(report)
}

#[test]
fn every_case_of_this_tree_passes() {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/cases"));
    assert!(check(folder).is_some(), "there are no cases in {}", folder.display());
}

#[test]
fn every_shared_case_passes() {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/cases"));
    if check(folder).is_none() {
        println!("SKIPPED: there are no cases in {}", folder.display());
    }
}

/// Cases of navigation. Kinds without a check are only counted, until all of them have one.
#[test]
fn every_shared_navigation_case_passes() {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/nav/cases"));
    let Ok(report) = run(folder, &Machine) else {
        println!("SKIPPED: there are no cases in {}", folder.display());
        return;
    };
    let is_wrong = |verdict| matches!(verdict, Verdict::Failed | Verdict::Unreadable);
    let wrong = report.results.iter().filter(|result| is_wrong(result.verdict));
    assert_eq!(wrong.count(), 0, "\n{}", report.to_text());
    println!("{}", report.to_text());
}
