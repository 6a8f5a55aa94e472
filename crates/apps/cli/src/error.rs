//! Errors of commands.

use std::fmt::Display;
use std::io;
use std::process::ExitCode;

use periplus_diagnostics::plain_words;

use crate::terminal;

/// Error that ends a command.
#[derive(Debug)]
pub(crate) enum CliError {
    /// Failed job: prints the message, exit code 1.
    Failed(String),
    /// Bad usage: prints the message, exit code 2.
    Usage(String),
    /// Error with this exit code that is printed already, such as findings of a file.
    Reported(u8),
    /// Failed write to stdout or stderr.
    Output(io::Error),
}

impl CliError {
    /// Failed job, from any error.
    pub(crate) fn failed(error: impl Display) -> Self {
        Self::Failed(error.to_string())
    }

    /// Bad usage, from any error.
    pub(crate) fn usage(error: impl Display) -> Self {
        Self::Usage(error.to_string())
    }

    /// Prints the message and returns the exit code.
    pub(crate) fn report(self) -> ExitCode {
        match self {
            Self::Failed(message) => {
                terminal::complain(&message);
                ExitCode::FAILURE
            }
            Self::Usage(message) => {
                terminal::complain(&message);
                ExitCode::from(2)
            }
            Self::Reported(code) => ExitCode::from(code),
            // The reader of our output has closed it.
            Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
            Self::Output(error) => {
                terminal::complain(&format!("cannot write the output: {}", plain_words(&error)));
                ExitCode::FAILURE
            }
        }
    }
}

impl From<String> for CliError {
    fn from(message: String) -> Self {
        Self::Failed(message)
    }
}

impl From<io::Error> for CliError {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}
