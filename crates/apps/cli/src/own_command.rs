//! The command that starts this program in another process, and the Python interpreter around it.

use std::sync::OnceLock;

use periplus_launch::bringup::PythonInterpreter;

static OWN_COMMAND: OnceLock<Vec<String>> = OnceLock::new();

/// Sets the words that start this program. Later calls change nothing.
pub(crate) fn set_own_command(words: Vec<String>) {
    let _ = OWN_COMMAND.set(words);
}

/// Words that start this program, such as `/usr/bin/periplus` or `python3 -m periplus`; empty if unknown.
pub(crate) fn own_command() -> &'static [String] {
    OWN_COMMAND.get().map_or(&[], Vec::as_slice)
}

static INTERPRETER: OnceLock<PythonInterpreter> = OnceLock::new();

/// Sets the Python interpreter in whose package this program is. Later calls change nothing.
pub(crate) fn set_interpreter(interpreter: Option<String>) {
    let _ = INTERPRETER.set(PythonInterpreter::new(interpreter));
}

/// Interpreter of nodes in Python.
pub(crate) fn interpreter() -> PythonInterpreter {
    INTERPRETER.get_or_init(PythonInterpreter::default).clone()
}
