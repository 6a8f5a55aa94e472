//! Explanations for commands that run nothing.

use periplus_diagnostics::closest;

use super::{Answer, Reading};

/// Explains that nothing has to be done.
pub(super) fn needless(text: impl Into<String>) -> Reading {
    Reading::Answer(Answer { text: text.into(), lists_packages: false, code: 0 })
}

/// Explains that nothing has to be done, and lists the packages found.
pub(super) fn with_packages(text: impl Into<String>) -> Reading {
    Reading::Answer(Answer { text: text.into(), lists_packages: true, code: 0 })
}

/// Explains that Periplus lacks a feature.
pub(super) fn lacking(what: &str, instead: &str) -> Reading {
    let text = format!("Periplus has no `{what}`: {instead}");
    Reading::Answer(Answer { text, lists_packages: false, code: 1 })
}

/// Reports an unknown subcommand of a foreign program: wrong usage.
pub(super) fn unknown(program: &str, word: &str, known: &[&str]) -> Reading {
    let near = closest(word, known.iter().copied());
    let near = near.map(|near| format!("did you mean `{program} {near}`? ")).unwrap_or_default();
    elsewhere(format!("there is no `{program} {word}`: {near}{program} has {}", known.join(", ")))
}

/// Explains that a command belongs to the shell or lacks a word.
pub(super) fn elsewhere(text: impl Into<String>) -> Reading {
    Reading::Answer(Answer { text: text.into(), lists_packages: false, code: 2 })
}
