//! What launching asks of the machine beyond files and environment.

use std::path::PathBuf;

use serde_json::Value;

/// What a program left behind.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Printed {
    /// On its standard output.
    pub output: String,
    /// On its standard error.
    pub errors: String,
    /// Whether it ended well.
    pub is_success: bool,
    /// The cause of a failure that only an absent file or package has.
    pub missing: Option<MissingInput>,
}

/// An input of a launch that is not on this machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MissingInput {
    /// A file, although its package is on the machine.
    File,
    /// A package, with everything in it.
    Package,
}

impl MissingInput {
    /// The code of findings about one of this kind.
    #[must_use]
    pub const fn code(self) -> &'static str {
        match self {
            Self::File => "launch-missing-file",
            Self::Package => "launch-missing-package",
        }
    }

    /// The kind of input that findings of a code are about; none for other findings.
    #[must_use]
    pub fn of(code: &str) -> Option<Self> {
        [Self::File, Self::Package].into_iter().find(|input| input.code() == code)
    }
}

/// What an interpreter has to say against a launch file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Complaint {
    /// What is wrong.
    pub message: String,
    /// `file:line` of the launch file, where that is known.
    pub line: Option<String>,
    /// What to do.
    pub help: Option<String>,
}

impl From<String> for Complaint {
    fn from(message: String) -> Self {
        Self { message, ..Self::default() }
    }
}

/// Programs and places for files, for those who may not touch the machine themselves.
pub trait Outside {
    /// Runs a program to its end; `xacro` is one that is always there.
    ///
    /// # Errors
    /// Why it cannot be started.
    fn run(&mut self, words: &[String]) -> Result<Printed, String>;

    /// Puts a text into a file of its own that lasts as long as the launch. `name` is a wish.
    ///
    /// # Errors
    /// Why it cannot be written.
    fn scratch(&mut self, name: &str, text: &str) -> Result<PathBuf, String>;

    /// An interpreter for launch files in Python.
    ///
    /// # Errors
    /// Why there is none.
    fn python(&mut self) -> Result<Box<dyn Interpreter>, String>;
}

/// What an interpreter asks while it answers.
pub type Answer<'a> = dyn FnMut(Value) -> Result<Value, String> + 'a;

/// An interpreter of launch files in another process. What is said is for this crate to know.
pub trait Interpreter {
    /// Sends a request and gives what comes back; questions that come before it are passed to
    /// `answer`.
    ///
    /// # Errors
    /// What the interpreter or the launch file has to complain about.
    fn ask(&mut self, request: Value, answer: &mut Answer<'_>) -> Result<Value, Complaint>;
}

/// A machine without programs, for tests.
#[derive(Debug, Default)]
pub struct Nothing;

impl Outside for Nothing {
    fn run(&mut self, words: &[String]) -> Result<Printed, String> {
        Err(format!("there is no `{}` here", words.first().map_or("", String::as_str)))
    }

    fn scratch(&mut self, name: &str, _text: &str) -> Result<PathBuf, String> {
        Ok(PathBuf::from("/scratch").join(name))
    }

    fn python(&mut self) -> Result<Box<dyn Interpreter>, String> {
        Err("there is no Python here".into())
    }
}
