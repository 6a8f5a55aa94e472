//! What is said where nothing is run.

use super::{Answer, Reading};

/// Nothing has to be done.
pub(super) fn needless(text: impl Into<String>) -> Reading {
    Reading::Answer(Answer { text: text.into(), lists_packages: false, code: 0 })
}

/// Nothing has to be done; the packages that can be found are listed.
pub(super) fn with_packages(text: impl Into<String>) -> Reading {
    Reading::Answer(Answer { text: text.into(), lists_packages: true, code: 0 })
}

/// Periplus does not have it.
pub(super) fn lacking(what: &str, instead: &str) -> Reading {
    let text = format!("Periplus has no `{what}`: {instead}");
    Reading::Answer(Answer { text, lists_packages: false, code: 1 })
}

/// It is the shell's, or lacks a word.
pub(super) fn elsewhere(text: impl Into<String>) -> Reading {
    Reading::Answer(Answer { text: text.into(), lists_packages: false, code: 2 })
}
