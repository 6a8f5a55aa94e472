//! Collection of findings while a file is read.

use crate::{Diagnostic, Severity};

/// Maximum number of findings that are kept; further ones are only counted, as a broken file may repeat one
/// fault a million times.
pub const MAX_FINDINGS: usize = 1_000;

/// Findings of a reader, in the order of their detection.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diagnostics {
    kept: Vec<Diagnostic>,
    counts: [usize; 3],
}

impl Diagnostics {
    /// Returns an empty collection.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a finding. A repetition at the same location is dropped.
    pub fn push(&mut self, mut diagnostic: Diagnostic) {
        shorten(&mut diagnostic);
        let repeated = |earlier: &Diagnostic| {
            earlier.code == diagnostic.code
                && earlier.span == diagnostic.span
                && earlier.message == diagnostic.message
        };
        // A repetition follows soon after the first (two readers of one element), so a short look back is
        // enough and keeps this linear.
        if self.kept.iter().rev().take(64).any(repeated) {
            return;
        }
        self.counts[diagnostic.severity as usize] += 1;
        if self.kept.len() < MAX_FINDINGS
            || diagnostic.severity == Severity::Error && self.errors() == 1
        {
            self.kept.push(diagnostic);
        }
    }

    /// Adds all findings of another collection.
    pub fn append(&mut self, other: Self) {
        let mut unkept = other.counts;
        for diagnostic in other.kept {
            unkept[diagnostic.severity as usize] -= 1;
            self.push(diagnostic);
        }
        for (count, more) in self.counts.iter_mut().zip(unkept) {
            *count += more;
        }
    }

    /// Findings, at most about [`MAX_FINDINGS`] of them.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.kept.iter()
    }

    /// Number of findings of one severity, kept or not.
    #[must_use]
    pub fn count(&self, severity: Severity) -> usize {
        self.counts[severity as usize]
    }

    /// Number of errors.
    #[must_use]
    pub fn errors(&self) -> usize {
        self.count(Severity::Error)
    }

    /// Returns true if there is any error.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.errors() > 0
    }

    /// Returns true if there are no findings.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.counts == [0; 3]
    }

    /// Number of findings that were counted but not kept.
    #[must_use]
    pub fn unkept(&self) -> usize {
        self.counts.iter().sum::<usize>() - self.kept.len()
    }
}

impl Extend<Diagnostic> for Diagnostics {
    fn extend<I: IntoIterator<Item = Diagnostic>>(&mut self, more: I) {
        more.into_iter().for_each(|diagnostic| self.push(diagnostic));
    }
}

/// Maximum length of a message [bytes]. A name in a hostile file may be as long as the file.
const MAX_TEXT_BYTES: usize = 2_000;

fn shorten(diagnostic: &mut Diagnostic) {
    let related = diagnostic.related.iter_mut().map(|(_, label)| label);
    let texts = std::iter::once(&mut diagnostic.message)
        .chain(&mut diagnostic.label)
        .chain(related)
        .chain(&mut diagnostic.notes)
        .chain(&mut diagnostic.help)
        .chain(diagnostic.replacement.iter_mut().flat_map(|r| [&mut r.text, &mut r.message]));
    for text in texts.filter(|text| text.len() > MAX_TEXT_BYTES) {
        let cut = (0..=MAX_TEXT_BYTES).rev().find(|&cut| text.is_char_boundary(cut)).unwrap_or(0);
        text.truncate(cut);
        text.push_str(" ...");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_slips_are_counted_but_not_kept() {
        let mut diagnostics = Diagnostics::new();
        for index in 0..1_000_000 {
            diagnostics.push(Diagnostic::warning("slip", format!("slip {index}")));
        }
        diagnostics.push(Diagnostic::error("end", "the end"));
        assert_eq!(diagnostics.count(Severity::Warning), 1_000_000);
        assert_eq!(diagnostics.iter().count(), MAX_FINDINGS + 1);
        assert!(diagnostics.iter().any(|d| d.code == "end"));
    }

    #[test]
    fn a_name_of_a_megabyte_is_not_quoted_in_full() {
        let mut diagnostics = Diagnostics::new();
        let name = "é".repeat(500_000);
        diagnostics.push(Diagnostic::error("long", &name).help(&name));
        let kept = diagnostics.iter().next().unwrap();
        assert!(kept.message.len() < 2_100 && kept.help[0].len() < 2_100);
    }

    #[test]
    fn the_same_finding_counts_once() {
        let mut diagnostics = Diagnostics::new();
        diagnostics.push(Diagnostic::hint("again", "again"));
        diagnostics.push(Diagnostic::hint("again", "again"));
        assert_eq!(diagnostics.count(Severity::Hint), 1);
    }
}
