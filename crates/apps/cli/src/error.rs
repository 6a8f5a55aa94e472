//! Errors of commands.

use std::fmt::Display;
use std::io;
use std::process::ExitCode;

use periplus_bags::files::BagError;
use periplus_diagnostics::plain_words;
use periplus_graph::GraphError;
use periplus_session::files::FileError;
use periplus_session::log_mapping::LogMappingError;
use periplus_session::scan_log::ScanLogError;
use periplus_session::{PageError, RunError};

use crate::terminal;

/// Error that ends a command.
#[derive(Debug)]
pub(crate) enum CliError {
    /// Failed job: prints the message, exit code 1.
    Failed(String),
    /// Bad usage: prints the message, exit code 2.
    Usage(String),
    /// Prints the message, with the exit code of the ROS program that the command replaces.
    Exit(String, u8),
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

    /// Returns the message, for a part of a command that is not its end.
    pub(crate) fn message(&self) -> String {
        match self {
            Self::Failed(message) | Self::Usage(message) | Self::Exit(message, _) => {
                message.clone()
            }
            Self::Reported(_) => "errors were printed".to_owned(),
            Self::Output(error) => format!("cannot write the output: {}", plain_words(error)),
        }
    }

    /// Prints the message and returns the exit code.
    pub(crate) fn report(self) -> ExitCode {
        let (message, code) = match self {
            Self::Failed(message) => (message, 1),
            Self::Usage(message) => (message, 2),
            Self::Exit(message, code) => (message, code),
            Self::Reported(code) => return ExitCode::from(code),
            // The reader of our output has closed it.
            Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                return ExitCode::SUCCESS;
            }
            Self::Output(error) => (format!("cannot write the output: {}", plain_words(&error)), 1),
        };
        terminal::complain(&message);
        ExitCode::from(code)
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

impl From<RunError> for CliError {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Reported => Self::Reported(1),
            RunError::Output(error) => Self::Output(error),
            error => Self::failed(error),
        }
    }
}

impl From<FileError> for CliError {
    fn from(error: FileError) -> Self {
        Self::failed(error)
    }
}

impl From<ScanLogError> for CliError {
    fn from(error: ScanLogError) -> Self {
        match error {
            ScanLogError::Output(error) => Self::Output(error),
            error => Self::failed(error),
        }
    }
}

impl From<LogMappingError> for CliError {
    fn from(error: LogMappingError) -> Self {
        match error {
            LogMappingError::Reported => Self::Reported(1),
            LogMappingError::Output(error) => Self::Output(error),
            LogMappingError::Log(error) => error.into(),
            error => Self::failed(error),
        }
    }
}

impl From<PageError> for CliError {
    fn from(error: PageError) -> Self {
        Self::failed(error)
    }
}

impl From<GraphError> for CliError {
    fn from(error: GraphError) -> Self {
        Self::failed(error)
    }
}

impl From<BagError> for CliError {
    fn from(error: BagError) -> Self {
        Self::failed(error)
    }
}
