//! Interfaces to programs and interpreters.

use std::path::PathBuf;
use std::time::Duration;

use periplus_diagnostics::{Diagnostic, DiagnosticCause};
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

    /// Class of findings on this kind.
    #[must_use]
    pub const fn cause(self) -> DiagnosticCause {
        match self {
            Self::File => DiagnosticCause::MissingFile,
            Self::Package => DiagnosticCause::MissingPackage,
        }
    }

    /// Input whose absence a finding reports; `None` for other findings.
    #[must_use]
    pub fn of(finding: &Diagnostic) -> Option<Self> {
        [Self::File, Self::Package].into_iter().find(|input| finding.cause == Some(input.cause()))
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

impl From<OutsideError> for LaunchError {
    fn from(error: OutsideError) -> Self {
        error.to_string().into()
    }
}

/// Reason that the machine does not do what a launch file asks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OutsideError {
    /// The command line is invalid, with the reason.
    InvalidCommand(String),
    /// The user forbids code of launch files, with the consequence.
    Forbidden(&'static str),
    /// A program or interpreter cannot be started, or a file cannot be written, with the reason.
    Unavailable(String),
    /// A program did not end within its time limit.
    TimedOut(Duration),
}

impl std::fmt::Display for OutsideError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::InvalidCommand(why) | Self::Unavailable(why) => f.write_str(why),
            Self::Forbidden(consequence) => f.write_str(consequence),
            Self::TimedOut(limit) => write!(
                f,
                "it did not end within {} s; `--evaluation-limit SECONDS` allows more",
                limit.as_secs_f64()
            ),
        }
    }
}

impl std::error::Error for OutsideError {}

/// Programs and temporary files, for code without access to the machine.
pub trait Outside {
    /// Runs a program to its end; `xacro` is always available.
    ///
    /// # Errors
    /// When it cannot be started, or does not end.
    fn run(&mut self, words: &[String]) -> Result<Printed, OutsideError>;

    /// Writes a text to a temporary file that exists as long as the launch. `name` is a suggestion.
    ///
    /// # Errors
    /// When it cannot be written.
    fn scratch(&mut self, name: &str, text: &str) -> Result<PathBuf, OutsideError>;

    /// Starts an interpreter for launch files in Python.
    ///
    /// # Errors
    /// When there is none.
    fn python(&mut self) -> Result<Box<dyn Interpreter>, OutsideError>;
}

/// Callback for questions of an interpreter.
pub type Answer<'a> = dyn FnMut(Value) -> Result<Value, LaunchError> + 'a;

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
    fn run(&mut self, words: &[String]) -> Result<Printed, OutsideError> {
        let program = words.first().map_or("", String::as_str);
        Err(OutsideError::Unavailable(format!("program `{program}` does not exist")))
    }

    fn scratch(&mut self, name: &str, _text: &str) -> Result<PathBuf, OutsideError> {
        Ok(PathBuf::from("/scratch").join(name))
    }

    fn python(&mut self) -> Result<Box<dyn Interpreter>, OutsideError> {
        Err(OutsideError::Unavailable("Python is not available".into()))
    }
}
