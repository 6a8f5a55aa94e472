//! The cases that are shared, of the kinds that are checked.

use std::path::Path;

use periplus_conformance::{Verdict, run};
use periplus_host::Machine;

#[test]
fn every_case_of_a_kind_that_is_checked_passes() {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/cases"));
    let Ok(report) = run(folder, &Machine) else {
        println!("SKIPPED: there are no cases in {}", folder.display());
        return;
    };
    let wrong = report
        .results
        .iter()
        .filter(|result| !matches!(result.verdict, Verdict::Passed | Verdict::Unknown));
    assert_eq!(wrong.count(), 0, "\n{}", report.to_text());
    println!("{}", report.to_text());
}
