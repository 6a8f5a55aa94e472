//! Interfaces to programs and interpreters.

use std::path::PathBuf;

use serde_json::Value;

/// Result of a program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Printed {
    /// Standard output.
    pub output: String,
    /// Standard error.
    pub errors: String,
    /// True if it succeeded.
    pub is_success: bool,
    /// Missing input that caused the failure, if that is the only cause.
    pub missing: Option<MissingInput>,
}

/// Input of a launch that is missing on this machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MissingInput {
    /// File of a package that is on the machine.
    File,
    /// Package, with all its files.
    Package,
}

impl MissingInput {
    /// Code of findings on this kind.
    #[must_use]
    pub const fn code(self) -> &'static str {
        match self {
            Self::File => "launch-missing-file",
            Self::Package => "launch-missing-package",
        }
    }

    /// Kind of input of a finding's code; `None` for other findings.
    #[must_use]
    pub fn of(code: &str) -> Option<Self> {
        [Self::File, Self::Package].into_iter().find(|input| input.code() == code)
    }
}

/// Error of an interpreter or a launch file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LaunchError {
    /// Error message.
    pub message: String,
    /// `file:line` of the launch file, if known.
    pub line: Option<String>,
    /// Suggested correction.
    pub help: Option<String>,
}

impl From<String> for LaunchError {
    fn from(message: String) -> Self {
        Self { message, ..Self::default() }
    }
}

/// Programs and temporary files, for code without access to the machine.
pub trait Outside {
    /// Runs a program to its end; `xacro` is always available.
    ///
    /// # Errors
    /// A message when it cannot be started.
    fn run(&mut self, words: &[String]) -> Result<Printed, String>;

    /// Writes a text to a temporary file that exists as long as the launch. `name` is a suggestion.
    ///
    /// # Errors
    /// A message when it cannot be written.
    fn scratch(&mut self, name: &str, text: &str) -> Result<PathBuf, String>;

    /// Starts an interpreter for launch files in Python.
    ///
    /// # Errors
    /// A message when there is none.
    fn python(&mut self) -> Result<Box<dyn Interpreter>, String>;
}

/// Callback for questions of an interpreter.
pub type Answer<'a> = dyn FnMut(Value) -> Result<Value, String> + 'a;

/// Interpreter of launch files in another process. The protocol is internal to this crate.
pub trait Interpreter {
    /// Sends a request and returns its result; questions that arrive before are passed to `answer`.
    ///
    /// # Errors
    /// An error of the interpreter or the launch file.
    fn ask(&mut self, request: Value, answer: &mut Answer<'_>) -> Result<Value, LaunchError>;
}

/// Machine without programs, for tests.
#[derive(Debug, Default)]
pub struct Nothing;

impl Outside for Nothing {
    fn run(&mut self, words: &[String]) -> Result<Printed, String> {
        Err(format!("program `{}` does not exist", words.first().map_or("", String::as_str)))
    }

    fn scratch(&mut self, name: &str, _text: &str) -> Result<PathBuf, String> {
        Ok(PathBuf::from("/scratch").join(name))
    }

    fn python(&mut self) -> Result<Box<dyn Interpreter>, String> {
        Err("Python is not available".into())
    }
}
