//! Results of all cases.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde_json::{Value, json};

use crate::run::{CaseOutcome, Verdict};

/// Results of all cases.
#[derive(Clone, Debug)]
pub struct ConformanceReport {
    /// One for each file.
    pub results: Vec<CaseOutcome>,
}

/// Number of cases by verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// As expected.
    pub passed: usize,
    /// Not as expected.
    pub failed: usize,
    /// Cases of a kind without a check.
    pub unknown: usize,
    /// No cases, or none that are understood.
    pub unreadable: usize,
}

impl Tally {
    /// All of them.
    #[must_use]
    pub fn all(&self) -> usize {
        self.passed + self.failed + self.unknown + self.unreadable
    }

    fn count(&mut self, verdict: Verdict) {
        match verdict {
            Verdict::Passed => self.passed += 1,
            Verdict::Failed => self.failed += 1,
            Verdict::Unknown => self.unknown += 1,
            Verdict::Unreadable => self.unreadable += 1,
        }
    }
}

impl ConformanceReport {
    /// All cases.
    #[must_use]
    pub fn total(&self) -> Tally {
        let mut tally = Tally::default();
        self.results.iter().for_each(|result| tally.count(result.verdict));
        tally
    }

    /// Those of each kind, in the order of their names.
    #[must_use]
    pub fn by_kind(&self) -> BTreeMap<&str, Tally> {
        let mut kinds: BTreeMap<&str, Tally> = BTreeMap::new();
        for result in &self.results {
            kinds.entry(&result.kind).or_default().count(result.verdict);
        }
        kinds
    }

    /// True if every case passed. A case without a check has not.
    #[must_use]
    pub fn is_passed(&self) -> bool {
        self.results.iter().all(|result| result.verdict == Verdict::Passed)
    }

    /// A table of kinds, and behind it what is wrong.
    #[must_use]
    pub fn to_text(&self) -> String {
        let kinds = self.by_kind();
        let widest = kinds.keys().map(|kind| kind.len()).chain([12]).max().unwrap_or(12);
        let mut text = format!(
            "{:widest$}  {:>5}  {:>6}  {:>6}  {:>11}\n",
            "kind", "cases", "passed", "failed", "not checked"
        );
        let mut line = |name: &str, tally: Tally| {
            let failed = tally.failed + tally.unreadable;
            let (all, passed, unknown) = (tally.all(), tally.passed, tally.unknown);
            // Writing to a String cannot fail.
            let _ =
                writeln!(text, "{name:widest$}  {all:>5}  {passed:>6}  {failed:>6}  {unknown:>11}");
        };
        for (kind, tally) in &kinds {
            line(if kind.is_empty() { "(no case)" } else { kind }, *tally);
        }
        line("all", self.total());
        for result in &self.results {
            let words = match result.verdict {
                Verdict::Failed => "failed",
                Verdict::Unreadable => "not understood",
                Verdict::Unknown => "not checked",
                Verdict::Passed => continue,
            };
            let _ = writeln!(text, "\n{} ({}): {words}", result.id, result.file);
            for difference in &result.differences {
                let _ = writeln!(text, "  {difference}");
            }
        }
        text
    }

    /// The same as JSON.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let tally = |it: Tally| {
            json!({
                "cases": it.all(), "passed": it.passed, "failed": it.failed + it.unreadable,
                "not_checked": it.unknown, "not_understood": it.unreadable,
            })
        };
        let kinds: serde_json::Map<String, Value> =
            self.by_kind().into_iter().map(|(kind, it)| (kind.to_owned(), tally(it))).collect();
        let results: Vec<Value> = self
            .results
            .iter()
            .map(|it| {
                let verdict = match it.verdict {
                    Verdict::Passed => "passed",
                    Verdict::Failed => "failed",
                    Verdict::Unknown => "not checked",
                    Verdict::Unreadable => "not understood",
                };
                json!({
                    "id": it.id, "file": it.file, "kind": it.kind, "title": it.title,
                    "verdict": verdict, "differences": it.differences,
                })
            })
            .collect();
        json!({ "total": tally(self.total()), "kinds": kinds, "results": results })
    }
}
