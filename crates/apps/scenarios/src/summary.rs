//! Summary of scenarios for GitHub Actions.

use std::fmt::Write as _;

use crate::report::ScenarioReport;

/// Markdown table of reports, for the file that `GITHUB_STEP_SUMMARY` names.
#[must_use]
pub fn github_summary(reports: &[ScenarioReport]) -> String {
    let passed = reports.iter().filter(|report| report.has_passed()).count();
    let mut out = format!("### Scenarios: {passed} of {} passed\n\n", reports.len());
    out.push_str("| scenario | seed | result | simulated | reason |\n|---|---|---|---|---|\n");
    for report in reports {
        let result = if report.has_passed() { "passed" } else { "**failed**" };
        let reason = report.failures().join("; ").replace('|', "\\|").replace('\n', " ");
        let (name, seed) = (report.name.replace('|', "\\|"), report.seed);
        let _ =
            writeln!(out, "| {name} | {seed} | {result} | {:.1} s | {reason} |", report.duration_s);
    }
    for report in reports.iter().filter(|report| !report.has_passed()) {
        let _ = write!(out, "\nRun `{}` again:\n\n```\n{}\n```\n", report.name, report.replay);
    }
    out
}
