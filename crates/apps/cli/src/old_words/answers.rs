//! What is said where nothing is run.

use periplus_diagnostics::closest;

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

/// A word that the program of this name does not have either, as far as is known: wrong usage.
pub(super) fn unknown(program: &str, word: &str, known: &[&str]) -> Reading {
    let near = closest(word, known.iter().copied());
    let near = near.map(|near| format!("did you mean `{program} {near}`? ")).unwrap_or_default();
    elsewhere(format!("there is no `{program} {word}`: {near}{program} has {}", known.join(", ")))
}

/// It is the shell's, or lacks a word.
pub(super) fn elsewhere(text: impl Into<String>) -> Reading {
    Reading::Answer(Answer { text: text.into(), lists_packages: false, code: 2 })
}
