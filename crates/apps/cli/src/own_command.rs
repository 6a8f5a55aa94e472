//! The command that starts this program in another process.

use std::sync::OnceLock;

static OWN_COMMAND: OnceLock<Vec<String>> = OnceLock::new();

/// Sets the words that start this program. Later calls change nothing.
pub(crate) fn set_own_command(words: Vec<String>) {
    let _ = OWN_COMMAND.set(words);
}

/// Words that start this program, such as `/usr/bin/periplus` or `python3 -m periplus`; empty if unknown.
pub(crate) fn own_command() -> &'static [String] {
    OWN_COMMAND.get().map_or(&[], Vec::as_slice)
}
